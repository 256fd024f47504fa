#include "bake/home_places.h"

#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr int kMostSurfaces = 16;     // along one way
constexpr float kMostOff = 2;         // times what simplifying may move: its own bound is an estimate
constexpr float kSameFacing = 0.87f;  // cosine of 30°

// The place on the side that is lit, along its normal or against it.
std::optional<SurfaceElement> nearestOn(const RayScene& home, SurfaceElement place, LitSide side, float mostM) {
  std::optional<SurfaceElement> found;
  float least = kInfinity;
  Ray ray{place.position + place.normal * mostM, -place.normal, 0, 2 * mostM};
  for (int k = 0; k < kMostSurfaces; ++k) {
    const Hit hit = home.intersect(ray);
    if (!hit.valid()) break;
    const float off = std::abs(hit.t - mostM);
    if (hit.instance == side.instance && off < least && meetsBack(home.scene(), hit, ray.direction) == side.back) {
      const SurfacePlace at = placeAt(home.scene(), hit, ray.direction);
      const Instance& instance = home.scene().instances[side.instance];
      const Vec3 normal = smoothNormalAt(home.scene().meshes[static_cast<size_t>(instance.mesh)],
                                         instance.worldFromObject, {hit.triangle, hit.b1, hit.b2}, at.ng);
      found = place, least = off;
      found->position = at.p;
      if (!side.shared && dot(normal, place.normal) >= kSameFacing) found->normal = normal;
    }
    ray.tMin = std::nextafter(hit.t, kInfinity);
  }
  return found;
}

}  // namespace

void putOnHome(LitPlaces& lit, const RayScene& home, std::span<const float> movedM) {
  parallelFor(lit.places.size(), 256, [&](size_t i) {
    const LitSide side = lit.sides[i];
    const float moved = movedM[static_cast<size_t>(home.scene().instances[side.instance].mesh)];
    if (!(moved > 0)) return;
    if (const auto there = nearestOn(home, lit.places[i], side, kMostOff * moved)) lit.places[i] = *there;
  });
}

}  // namespace roomlight::bake
