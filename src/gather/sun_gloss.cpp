#include "gather/sun_gloss.h"

#include <algorithm>

#include "base/parallel.h"
#include "gather/ray_paths.h"
#include "trace/bsdf.h"

namespace roomlight {
namespace {

constexpr float kGrazing = 0.05f;  // cosine
constexpr float kFrom = 0.1f, kReach = 0.3f;  // voxels: over a point a ray starts, back to its surface
constexpr float kSameFacing = 0.7f;           // cosine

constexpr float kLeastAlbedo = 1e-3f;

float cosineOf(Vec3 n, Vec3 toSun) { return std::max(dot(n, toSun), kGrazing); }

}  // namespace

SunGloss::SunGloss(const RayScene& rays, const Voxels& voxels, const BrightPatches& patches, Vec3 toSun)
    : surfaceOf_(patches.pointCount(), -1), toSun_(toSun) {
  // Points of one slot follow one another, and share what the first of them finds.
  std::vector<size_t> first;
  for (size_t i = 0; i < surfaceOf_.size(); ++i) {
    const GlowPoint& g = patches.point(i);
    if (!BrightPatches::isSun(g)) continue;
    if (i == 0 || surfaceOf_[i - 1] < 0 || patches.point(i - 1).slot != g.slot) first.push_back(i);
    surfaceOf_[i] = static_cast<int32_t>(first.size()) - 1;
  }
  surfaces_.resize(first.size());
  parallelFor(first.size(), 256, [&](size_t k) {
    const GlowPoint& g = patches.point(first[k]);
    const FaceSlot& slot = voxels.slots[static_cast<size_t>(g.slot)];
    const Ray ray{g.p + g.n * (kFrom * voxels.voxelSizeM), -g.n, 0, kReach * voxels.voxelSizeM};
    const Hit hit = rays.intersect(ray);
    if (!hit.valid() || hit.instance != slot.instance) return;
    const SurfacePoint s = surfaceAt(rays.scene(), hit, ray.direction);
    if (dot(s.ng, g.n) < kSameFacing) return;
    Surface& out = surfaces_[k];
    out.s = s;
    out.s.m.roughness = std::max(out.s.m.roughness, kSpread);
    out.even = bihemisphericalAlbedo(out.s.m) / kPi, out.scale = Vec3(kPi) / max(slot.albedo, Vec3(kLeastAlbedo)),
    out.cosSun = cosineOf(g.n, toSun);
  });
}

// Sunlight that a surface throws on towards the viewer, less what is cached of it: the sun's illuminance is, its
// reflection by gloss and shading normals is not.
Vec3 SunGloss::bend(const SurfacePoint& surface, Vec3 n, Vec3 toSun, Vec3 wo) {
  SurfacePoint s = surface;
  s.m.roughness = std::max(s.m.roughness, kSpread);
  return Bsdf(s.m, s.ns, s.ng, wo).evaluate(toSun) / cosineOf(n, toSun) - bihemisphericalAlbedo(s.m) / kPi;
}

Vec3 SunGloss::at(size_t point, Vec3 wo) const {
  const int32_t of = surfaceOf_.empty() ? -1 : surfaceOf_[point];
  if (of < 0) return Vec3(1);
  const Surface& surface = surfaces_[static_cast<size_t>(of)];
  if (!surface.s.material || dot(wo, surface.s.ng) <= 0) return Vec3(1);
  return max(Vec3(0), Vec3(1) + (Bsdf(surface.s.m, surface.s.ns, surface.s.ng, wo).evaluate(toSun_) / surface.cosSun -
                                 surface.even) *
                                    surface.scale);
}

}  // namespace roomlight
