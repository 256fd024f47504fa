#include "import/gltf_transform.h"

#include <cmath>

namespace roomlight::importers {
namespace {

Vec3 vector(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// Columns first; the last row, 0 0 0 1, is not looked at but for a common factor.
Affine fromMatrix(const Json& matrix) {
  if (matrix.size() != 16) matrix.fail("must have 16 numbers");
  double v[16];
  for (size_t i = 0; i < 16; ++i) v[i] = matrix[i].number();
  const double last = v[15] != 0 ? v[15] : 1;
  for (double& value : v) value /= last;
  return {vector(v[0], v[1], v[2]), vector(v[4], v[5], v[6]), vector(v[8], v[9], v[10]), vector(v[12], v[13], v[14])};
}

}  // namespace

Affine composed(Vec3 translation, Quaternion q, Vec3 scale) {
  double size = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(size > 1e-6) || !std::isfinite(size)) q = {0, 0, 0, 1}, size = 1;
  const double x = q.x / size, y = q.y / size, z = q.z / size, w = q.w / size;
  Affine m;
  m.x = vector(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)) * scale.x;
  m.y = vector(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)) * scale.y;
  m.z = vector(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)) * scale.z;
  m.w = translation;
  return m;
}

Affine transformOf(const Json& node) {
  if (const auto matrix = node.find("matrix")) return fromMatrix(*matrix);
  Quaternion q;
  if (const auto rotation = node.find("rotation")) {
    if (rotation->size() != 4) rotation->fail("must have four numbers");
    q = {(*rotation)[0].number(), (*rotation)[1].number(), (*rotation)[2].number(), (*rotation)[3].number()};
  }
  return composed(node.vec3("translation", Vec3(0)), q, node.vec3("scale", Vec3(1)));
}

}  // namespace roomlight::importers
