// Reflective shadow maps (Dachsbacher & Stamminger 2005), by rays.
#include "base/parallel.h"
#include "baselines/lpv.h"
#include "scene/surface.h"
#include "trace/surface_point.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;
constexpr size_t kRaysAtOnce = 4096;

// One map of `count` rays: start(i, sampler) is the i-th, with the flux of the whole map if it were alone.
struct Map {
  uint64_t key;
  size_t count;
  std::function<LightRay(size_t, Sampler&)> start;
};

// The surfaces that a light's ray lights: the first, and those behind panes.
void follow(const RayScene& rays, const LightRay& start, std::vector<VirtualLight>& out, uint64_t& rayCount) {
  Ray ray{start.origin, start.direction, 0, kInfinity};
  Vec3 flux = start.fluxLm;
  for (int k = 0; k < kMostPanes && !isBlack(flux); ++k) {
    const Hit hit = rays.intersect(ray);
    ++rayCount;
    if (!hit.valid()) return;
    const SurfacePoint s = surfaceAt(rays.scene(), hit, ray.direction);
    const Vec3 reflected = flux * bihemisphericalAlbedo(s.m) * s.m.alpha;
    if (!isBlack(reflected)) out.push_back({s.p, s.ng, reflected});
    flux *= passing(s.m, *s.material, std::abs(dot(s.ns, ray.direction)));
    ray.origin = offsetOrigin(s.p, -s.ng);
  }
}

std::vector<VirtualLight> trace(const RayScene& rays, const Map& map, uint64_t seed, uint64_t& rayCount) {
  std::vector<std::vector<VirtualLight>> parts((map.count + kRaysAtOnce - 1) / kRaysAtOnce);
  std::vector<uint64_t> counts(parts.size());
  parallelFor(parts.size(), 1, [&](size_t part) {
    for (size_t i = part * kRaysAtOnce; i < std::min(map.count, (part + 1) * kRaysAtOnce); ++i) {
      Sampler sampler(map.key, static_cast<uint32_t>(i), seed);
      LightRay start = map.start(i, sampler);
      start.fluxLm *= 1 / static_cast<float>(map.count);
      follow(rays, start, parts[part], counts[part]);
    }
  });
  std::vector<VirtualLight> all;
  for (size_t i = 0; i < parts.size(); ++i) {
    all.insert(all.end(), parts[i].begin(), parts[i].end());
    rayCount += counts[i];
  }
  return all;
}

// An orthographic map as wide as `home` looks from the sun; rays start beyond the whole scene.
Map sunMap(const Lights& lights, size_t sun, const Bounds3& scene, const Bounds3& home, int size) {
  const Vec3 to = lights.sampleSun(sun, {0.5f, 0.5f}).wi;
  const Frame frame(to);
  Vec3 lo(kInfinity), hi(-kInfinity);
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{i & 1 ? home.hi.x : home.lo.x, i & 2 ? home.hi.y : home.lo.y, i & 4 ? home.hi.z : home.lo.z},
        q = frame.toLocal(corner);
    lo = min(lo, q), hi = max(hi, q);
  }
  const float beyond = length(scene.size()) + length(home.centre() - scene.centre());
  return {lights.lampCount() + lights.emitterCount() + sun, static_cast<size_t>(size) * static_cast<size_t>(size),
          [=, &lights](size_t i, Sampler& sampler) {
            const auto n = static_cast<size_t>(size);
            const Vec2 inTexel = sampler.next2();
            const float u = (static_cast<float>(i % n) + inTexel.x) / static_cast<float>(size),
                        v = (static_cast<float>(i / n) + inTexel.y) / static_cast<float>(size);
            const LightSample light = lights.sampleSun(sun, sampler.next2());
            const Vec3 p = frame.toWorld({lerp(lo.x, hi.x, u), lerp(lo.y, hi.y, v), 0.5f * (lo.z + hi.z)});
            // Disc suns: every place sees the whole disc, so rays through a place come from all over it.
            return LightRay{p + light.wi * beyond, -light.wi, light.radiance * ((hi.x - lo.x) * (hi.y - lo.y))};
          }};
}

}  // namespace

uint64_t traceShadowMaps(const RayScene& rays, const Lights& lights, const Bounds3& home, const LpvSettings& settings,
                         const std::function<void(std::span<const VirtualLight>)>& take, const Progress& progress) {
  const size_t lamps = lights.lampCount(), local = lamps + lights.emitterCount(), all = local + lights.sunCount();
  const auto texels = static_cast<size_t>(settings.mapSize) * static_cast<size_t>(settings.mapSize);
  const size_t each = std::max<size_t>(
      1, std::min(texels, texels * static_cast<size_t>(settings.mostMaps) / std::max<size_t>(1, local)));
  uint64_t count = 0;
  for (size_t i = 0; i < all && !progress.stop(); ++i) {
    Map map = i < local ? Map{i, each, {}} : sunMap(lights, i - local, rays.bounds(), home, settings.mapSize);
    if (i < lamps) map.start = [&](size_t, Sampler& sampler) { return lights.sampleLampRay(i, sampler); };
    if (i >= lamps && i < local)
      map.start = [&](size_t, Sampler& sampler) { return lights.sampleEmitterRay(i - lamps, sampler); };
    take(trace(rays, map, settings.seed, count));
    progress.at(static_cast<float>(i + 1) / static_cast<float>(all));
  }
  return count;
}

}  // namespace roomlight
