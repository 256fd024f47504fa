#include "import/triangles.h"

namespace roomlight::importers {
namespace {

// Of twice an area, in the file's units, of which nodes may make any size: edges of 1e-12, whose third powers floats
// hold.
constexpr double kSmallest = 1e-24;

}  // namespace

size_t dropDegenerate(Mesh& mesh) {
  size_t kept = 0;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
    const Vec3 ab = mesh.positions[b] - mesh.positions[a], ac = mesh.positions[c] - mesh.positions[a];
    // In doubles: the square of a small triangle's area is below what floats hold.
    const double x = double(ab.y) * ac.z - double(ab.z) * ac.y, y = double(ab.z) * ac.x - double(ab.x) * ac.z,
                 z = double(ab.x) * ac.y - double(ab.y) * ac.x;
    if (x * x + y * y + z * z < kSmallest * kSmallest) continue;
    mesh.indices[kept++] = a, mesh.indices[kept++] = b, mesh.indices[kept++] = c;
  }
  const size_t dropped = (mesh.indices.size() - kept) / 3;
  mesh.indices.resize(kept);
  return dropped;
}

size_t dropInfinite(Mesh& mesh) {
  constexpr float kFarthest = 1e12f;
  std::vector<bool> bad(mesh.positions.size());
  bool any = false;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    Vec3& p = mesh.positions[i];
    if (isFinite(p) && maxComponent(abs(p)) <= kFarthest) continue;
    p = {}, bad[i] = any = true;
  }
  if (!any) return 0;
  size_t kept = 0;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    if (bad[mesh.indices[t]] || bad[mesh.indices[t + 1]] || bad[mesh.indices[t + 2]]) continue;
    for (size_t k = 0; k < 3; ++k) mesh.indices[kept++] = mesh.indices[t + k];
  }
  const size_t dropped = (mesh.indices.size() - kept) / 3;
  mesh.indices.resize(kept);
  return dropped;
}

size_t mendCoordinates(Mesh& mesh) {
  size_t mended = 0;
  for (std::vector<Vec2>& set : mesh.uv) {
    for (Vec2& uv : set) {
      if (saysSomething(uv)) continue;
      uv = {}, ++mended;
    }
  }
  return mended;
}

}  // namespace roomlight::importers
