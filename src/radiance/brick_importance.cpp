#include "radiance/brick_importance.h"

#include <array>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sampling.h"
#include "scene/surface.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

constexpr int kAcross = 192, kDown = 108;  // paths of a camera
constexpr int kMostSurfaces = 16;          // of a path
constexpr int kReadDirectly = 1;           // reflections up to a place that gathering rays of what is seen read
constexpr int kFew = 2;                    // paths that meet a brick of little importance
constexpr float kBeside = 0.25f;           // voxels: surfaces so near to a border belong to both sides

// Paths from a camera, and the bricks that they meet.
class Importons {
 public:
  Importons(const RayScene& rays, const Voxels& voxels) : rays_(rays), voxels_(voxels) {}

  struct Met {
    int32_t brick;
    int reflections;
  };
  void follow(Ray ray, Rng& random, std::vector<Met>& met) const {
    int reflections = 0;
    for (int i = 0; i < kMostSurfaces && reflections <= kReadDirectly + 1; ++i) {
      const Hit hit = rays_.intersect(ray);
      if (!hit.valid()) return;
      const Vec3 p = ray.origin + ray.direction * hit.t;
      const Vec3 n = normalize(dot(hit.ng, ray.direction) > 0 ? -hit.ng : hit.ng);
      const Vec3 beside = n * (kBeside * voxels_.voxelSizeM);
      for (const Vec3 q : {p - beside, p + beside}) met.push_back({brickOf(q), reflections});
      const Material& material = materialOf(hit);
      const bool passes = letsLightThrough(material) && random.uniform() < 0.5f;
      if (passes) {
        ray = {offsetOrigin(p, -n), ray.direction, 0, kInfinity};
        continue;
      }
      const bool mirrors = letsLightThrough(material) || isPolishedMetal(material);
      const Vec3 on = mirrors ? ray.direction - n * (2 * dot(ray.direction, n))
                              : Frame(n).toWorld(sampleCosineHemisphere(random.uniform2()));
      reflections += !mirrors;
      ray = {offsetOrigin(p, n), on, 0, kInfinity};
    }
  }

 private:
  int32_t brickOf(Vec3 p) const {
    const Int3 v = voxels_.voxelOf(p);
    return voxels_.brickAt({v.x >> 3, v.y >> 3, v.z >> 3});
  }
  const Material& materialOf(const Hit& hit) const {
    const Scene& scene = rays_.scene();
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)];
    return scene.materials[static_cast<size_t>(mesh.material)];
  }

  const RayScene& rays_;
  const Voxels& voxels_;
};

}  // namespace

BrickImportance::BrickImportance(const RayScene& rays, const Voxels& voxels, std::span<const Camera> cameras,
                                 uint64_t seed, const Progress& progress) {
  if (cameras.empty()) return;
  halvings_.assign(voxels.bricks.size(), 2);
  const Importons importons(rays, voxels);
  for (const Camera& camera : cameras) {
    const CameraRays through(camera, kAcross, kDown);
    std::array<std::vector<Importons::Met>, kDown> rows;
    parallelFor(kDown, 1, [&](size_t y) {
      for (int x = 0; x < kAcross && !progress.stop(); ++x) {
        Rng random(y * kAcross + static_cast<size_t>(x), 0, seed);
        const Ray ray =
            through.seeing(rays, static_cast<float>(x) + random.uniform(), static_cast<float>(y) + random.uniform());
        importons.follow(ray, random, rows[y]);
      }
    });
    std::vector<int> read(halvings_.size()), passedOn(halvings_.size());
    for (const auto& row : rows) {
      for (const Importons::Met& m : row) {
        if (m.brick >= 0) ++(m.reflections <= kReadDirectly ? read : passedOn)[static_cast<size_t>(m.brick)];
      }
    }
    for (size_t b = 0; b < halvings_.size(); ++b) {
      const uint8_t here = read[b] > kFew ? 0 : read[b] > 0 || passedOn[b] > kFew ? 1 : 2;
      halvings_[b] = std::min(halvings_[b], here);
    }
  }
}

}  // namespace roomlight
