#include "radiance/slot_paths.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/radiance_field.h"
#include "trace/surface_point.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;          // surfaces a ray goes through or on from
constexpr float kLift = 0.1f;           // voxels; how far points are lifted to see one another along a bent surface
constexpr float kProbeHeight = 0.3f;    // voxels
constexpr float kHiddenBehind = 0.15f;  // voxels; surfaces further behind a slot's place are not lit as it is
constexpr float kNothingLeft = 0.03f;

}  // namespace

SlotPaths::SlotPaths(const RayScene& rays, const Voxels& voxels, uint64_t seed, const Progress& progress)
    : rays_(rays), voxels_(voxels), seed_(seed), points_(voxels.slots.size()), free_(voxels.slots.size()) {
  parallelFor(voxels_.bricks.size(), 4, [&](size_t b) {
    if (!progress.stop()) place(b);
  });
}

// Points are spread over the voxel where the surface fills that. Each is looked up on the surface itself, for beside a curved
// surface the slot's plane lies behind it.
void SlotPaths::place(size_t brick) {
  const auto [first, last] = slotsOfBrick(brick);
  std::vector<Ray> rays;
  for (size_t s = first; s < last; ++s) {
    const FaceSlot& slot = voxels_.slots[s];
    rays.push_back({offsetOrigin(slot.position, slot.normal), slot.normal, 0, kProbeHeight * voxels_.voxelSizeM});
  }
  std::vector<Hit> hits(rays.size());
  rays_.intersect(rays, hits);
  for (size_t s = first; s < last; ++s) {
    const Hit& above = hits[s - first];
    free_[s] = above.valid() ? above.t : kProbeHeight * voxels_.voxelSizeM;
  }
  rays.clear();
  for (size_t s = first; s < last; ++s) appendProbes(s, rays);
  hits.resize(rays.size());
  rays_.intersect(rays, hits);
  for (size_t s = first, next = 0; s < last; ++s) {
    const FaceSlot& slot = voxels_.slots[s];
    points_[s].fill(lifted(slot.position, slot.normal));
    if (!fillsVoxel(slot)) continue;
    for (Vec3& p : points_[s]) {
      const Ray& ray = rays[next];
      const Hit& hit = hits[next++];
      if (!hit.valid() || !facesAlong(hit, slot.normal)) continue;
      const Vec3 found = ray.origin + ray.direction * hit.t;
      if (connected(s, found, slot.normal)) p = lifted(found, slot.normal);
    }
  }
}

bool SlotPaths::fillsVoxel(const FaceSlot& slot) const { return slot.areaM2 > 0.8f * voxels_.voxelSizeM * voxels_.voxelSizeM; }

Vec3 SlotPaths::lifted(Vec3 p, Vec3 n) const { return offsetOrigin(p, n) + n * (0.01f * voxels_.voxelSizeM); }

bool SlotPaths::facesAlong(const Hit& hit, Vec3 n) const {
  const TriangleVertices t = worldTriangle(rays_.scene(), hit.instance, hit.triangle);
  const Vec3 ng = cross(t.b - t.a, t.c - t.a);
  return std::abs(dot(ng, n)) > 0.7f * length(ng);
}

// Short rays down onto the slot's surface, one in each quarter of its square.
void SlotPaths::appendProbes(size_t s, std::vector<Ray>& rays) const {
  const FaceSlot& slot = voxels_.slots[s];
  if (!fillsVoxel(slot)) return;
  const Frame frame(slot.normal);
  const float h = voxels_.voxelSizeM;
  const float height = free_[s] < kProbeHeight * h ? 0.5f * free_[s] : kProbeHeight * h;
  for (uint32_t k = 0; k < kPoints; ++k) {
    Sampler sampler(s, k, seed_ + 6);
    const Vec2 u = sampler.next2();
    const float x = 0.4f * (u.x + static_cast<float>(k & 1)) - 0.4f, y = 0.4f * (u.y + static_cast<float>(k >> 1)) - 0.4f;
    rays.push_back({slot.position + (frame.t * x + frame.b * y) * h + slot.normal * height, -slot.normal, 0, height + kProbeHeight * h});
  }
}

// Whether nothing stands between the slot's place and p, both a little lifted, but not into what lies close above.
bool SlotPaths::connected(size_t s, Vec3 p, Vec3 n) const {
  const FaceSlot& slot = voxels_.slots[s];
  const float lift = std::min(kLift * voxels_.voxelSizeM, 0.5f * free_[s]);
  const Vec3 from = offsetOrigin(slot.position, slot.normal) + slot.normal * lift;
  const Vec3 to = offsetOrigin(p, n) + n * lift;
  return luminance(rays_.transmittance({from, to - from, 0, 1})) > 0.25f;
}

// Not lit as the slot's place is: behind it, or parted from it by another surface (a pane that crosses the voxel).
bool SlotPaths::isHidden(size_t s, Vec3 p, Vec3 n) const {
  const FaceSlot& slot = voxels_.slots[s];
  return dot(slot.position - p, slot.normal) > kHiddenBehind * voxels_.voxelSizeM || !connected(s, p, n);
}

// What a pane transmits is left out of its albedo; what a veil lets through between its threads is not.
Vec3 SlotPaths::albedoOfTheRest(const Hit& hit, float passes) const {
  const MaterialSample m = materialAt(rays_.scene(), hit);
  const Vec3 albedo = bihemisphericalAlbedo(m);
  return m.alpha >= 1 ? min(albedo / std::max(1e-3f, 1 - passes), Vec3(1)) : albedo;
}

Arrival SlotPaths::follow(Ray ray, Hit hit, Sampler& sampler, std::vector<HiddenReflection>* hidden) const {
  Arrival end;
  for (int k = 0; k < kMostPanes; ++k) {
    if (!hit.valid()) {
      end.escaped = true;
      return end;
    }
    const SurfacePlace s = placeAt(rays_.scene(), hit, ray.direction);
    const bool clear = letsLightThrough(*s.material);
    const Vec3 through = clear ? straightTransmittance(*s.material, materialAt(rays_.scene(), hit), std::abs(dot(s.ng, ray.direction))) : Vec3(0);
    const float passes = std::min(1.0f, luminance(through));
    if (!clear || sampler.next1() >= passes) {
      const int64_t slot = slotAtSurface(voxels_, s.p, s.ng);
      if (slot >= 0 && !isHidden(static_cast<size_t>(slot), s.p, s.ng)) {
        end.slot = slot, end.p = s.p, end.n = s.ng, end.hit = hit, end.passes = passes;
        return end;
      }
      end.left *= albedoOfTheRest(hit, passes);
      end.reflected = true;
      if (hidden) hidden->push_back({s.p, s.ng, end.left, slot});
      ray = {offsetOrigin(s.p, s.ng), Frame(s.ng).toWorld(sampleCosineHemisphere(sampler.next2())), 0, kInfinity};
    } else {
      end.left *= through / passes;
      ray.origin = offsetOrigin(s.p, -s.ng);
    }
    if (luminance(end.left) < kNothingLeft) return end;
    hit = rays_.intersect(ray);
  }
  return end;
}

std::pair<size_t, size_t> SlotPaths::slotsOfBrick(size_t brick) const {
  const auto firstVoxel = voxels_.bricks[brick].firstVoxel;
  const size_t end = brick + 1 < voxels_.bricks.size() ? voxels_.bricks[brick + 1].firstVoxel : voxels_.voxels.size();
  const auto slotBegin = [&](size_t v) { return v < voxels_.voxels.size() ? voxels_.voxels[v].firstSlot : voxels_.slots.size(); };
  return {slotBegin(firstVoxel), slotBegin(end)};
}

}  // namespace roomlight
