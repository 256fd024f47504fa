#include "scene/object_measures.h"

#include <array>
#include <map>

namespace roomlight {
namespace {

constexpr double kUpright = 0.01;  // cosine between front and vertical

// In doubles: a volume is a small difference of large terms.
struct Point {
  double x, y, z;
};
Point difference(Vec3 a, Vec3 b) { return {double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z}; }
Point product(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

// Area by plane, positive where fronts look along the plane's normal. Planes 2 mm apart or 0.002 of a unit normal count
// as one; the bins' borders are no round numbers, as those of plans are.
class Planes {
 public:
  void add(Point at, Point n, double areaM2) {
    const double sign = n.x > 1e-4 || (n.x > -1e-4 && (n.y > 1e-4 || (n.y > -1e-4 && n.z > 0))) ? 1 : -1;
    const auto bin = [&](double v) { return std::llround(sign * v * 500 + 0.2371); };
    areas_[{bin(n.x), bin(n.y), bin(n.z), bin(at.x * n.x + at.y * n.y + at.z * n.z)}] += sign * areaM2;
  }
  double netAreaM2() const {
    double sum = 0;
    for (const auto& [plane, area] : areas_) sum += std::abs(area);
    return sum;
  }

 private:
  std::map<std::array<long long, 4>, double> areas_;
};

void add(ObjectMeasures& o, Planes& planes, Vec3 origin, Vec3 a, Vec3 b, Vec3 c) {
  const Point n = product(difference(b, a), difference(c, a)), from = difference(a, origin);
  const double twice = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  (std::abs(n.y) <= kUpright * twice ? o.areaUprightM2 : n.y > 0 ? o.areaUpM2 : o.areaDownM2) += twice / 2;
  o.volumeM3 += (from.x * n.x + from.y * n.y + from.z * n.z) / 6;
  if (twice > 0) planes.add(from, {n.x / twice, n.y / twice, n.z / twice}, twice / 2);
  ++o.triangles;
  o.bounds.add(a), o.bounds.add(b), o.bounds.add(c);
}

}  // namespace

std::vector<ObjectMeasures> measureObjects(const Scene& scene) {
  std::vector<ObjectMeasures> out;
  std::map<std::pair<int, std::string>, size_t> numbers;
  std::vector<Vec3> origins;  // near the object
  std::vector<Planes> planes;
  for (const Instance& i : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    if (mesh.indices.empty()) continue;
    const auto at = [&](size_t k) { return i.worldFromObject.point(mesh.positions[mesh.indices[k]]); };
    const auto [entry, isNew] = numbers.try_emplace({i.object, i.name}, out.size());
    if (isNew) {
      out.emplace_back();
      out.back().name = i.name, out.back().object = i.object;
      origins.push_back(at(0)), planes.emplace_back();
    }
    // A mirroring transform turns fronts around.
    const bool mirrored = i.worldFromObject.determinant() < 0;
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      add(out[entry->second], planes[entry->second], origins[entry->second], at(t), at(mirrored ? t + 2 : t + 1),
          at(mirrored ? t + 1 : t + 2));
    }
  }
  for (size_t i = 0; i < out.size(); ++i) out[i].netAreaM2 = planes[i].netAreaM2();
  return out;
}

}  // namespace roomlight
