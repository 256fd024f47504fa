#include "bake/thin_covers.h"

#include <algorithm>
#include <mutex>

#include "base/parallel.h"
#include "trace/light_layers.h"
#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr size_t kSamples = 2000;   // of a mesh, at most
constexpr size_t kOneOf = 200;      // of all samples may have smaller gaps: what merely touches
constexpr float kLeastM = 0.00005f; // nearer ones are at one place
constexpr int kSurfaces = 4;        // along a ray
constexpr float kSameWay = 0.7f;    // cosine

// Gaps that were found, by mesh.
using Gaps = std::vector<std::vector<float>>;

class Below {
 public:
  Below(const RayScene& rays, float mostM) : rays_(rays), mostM_(mostM) {}

  // `found(mesh, gap)` of the first surface within reach behind a triangle's middle, on either side.
  template <class Found>
  void look(uint32_t instance, uint32_t triangle, const Found& found) const {
    const TriangleVertices v = worldTriangle(rays_.scene(), instance, triangle);
    const Vec3 n = cross(v.b - v.a, v.c - v.a), middle = (v.a + v.b + v.c) / 3;
    if (!(length(n) > 0)) return;
    for (const float side : {1.0f, -1.0f}) {
      const Vec3 out = normalize(n) * side;
      Ray ray{offsetOrigin(middle, -out), -out, 0, mostM_};
      for (int k = 0; k < kSurfaces; ++k) {
        const Hit hit = rays_.intersect(ray);
        if (!hit.valid()) break;
        const Vec3 p = placeAt(rays_.scene(), hit, ray.direction).p;
        const float gap = dot(middle - p, out);
        if (gap > kLeastM && facing(hit, out)) {
          found(meshOf(instance), gap), found(meshOf(hit.instance), gap);
          break;
        }
        ray.origin = offsetOrigin(p, -out), ray.tMax = mostM_ - gap;
        if (!(ray.tMax > 0)) break;
      }
    }
  }

 private:
  size_t meshOf(uint32_t instance) const { return static_cast<size_t>(rays_.scene().instances[instance].mesh); }
  bool facing(const Hit& hit, Vec3 out) const {
    const TriangleVertices v = worldTriangle(rays_.scene(), hit.instance, hit.triangle);
    const Vec3 n = cross(v.b - v.a, v.c - v.a);
    return dot(n, out) > kSameWay * length(n);
  }
  const RayScene& rays_;
  const float mostM_;
};

}  // namespace

std::vector<float> gapsOf(const RayScene& rays, float mostM) {
  const Scene& scene = rays.scene();
  Gaps gaps(scene.meshes.size());
  std::vector<size_t> samples(scene.meshes.size());
  const Below below(rays, mostM);
  std::mutex adding;
  parallelFor(scene.instances.size(), 1, [&](size_t i) {
    const auto mesh = static_cast<size_t>(scene.instances[i].mesh);
    const size_t triangles = scene.meshes[mesh].triangleCount(), step = triangles / kSamples + 1;
    std::vector<std::pair<size_t, float>> here;
    for (size_t t = 0; t < triangles; t += step)
      below.look(static_cast<uint32_t>(i), static_cast<uint32_t>(t),
                 [&](size_t of, float gap) { here.emplace_back(of, gap); });
    const std::lock_guard lock(adding);
    samples[mesh] += (triangles + step - 1) / step;
    for (const auto& [of, gap] : here) gaps[of].push_back(gap);
  });
  std::vector<float> out;
  for (size_t m = 0; m < gaps.size(); ++m) {
    const size_t skipped = samples[m] / kOneOf;
    std::sort(gaps[m].begin(), gaps[m].end());
    out.push_back(gaps[m].size() > skipped ? gaps[m][skipped] : kInfinity);
  }
  return out;
}

}  // namespace roomlight::bake
