#include "radiance/sun_bounce.h"

#include <algorithm>
#include <atomic>

#include "base/parallel.h"
#include "radiance/slot_samples.h"
#include "scene/surface.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr uint32_t kSide = 4, kPlaces = kSide * kSide;  // where the sun is looked for on a slot
constexpr uint32_t kDiagonal = kSide + 1;  // from one of SlotPaths::kPoints places to the next
constexpr float kEven = 0.02f;     // of what the sun gives: neighbours that differ by less are lit alike
constexpr uint32_t kSamples = 12;  // of a slot

// The k-th of kPlaces places of a sheet that fills its voxel, clear of its surface.
Vec3 placeOn(const Voxels& voxels, const FaceSlot& slot, uint32_t k, Vec2 jitter) {
  const float h = voxels.voxelSizeM;
  const int axis = slot.face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3 corner = (slot.position - voxels.origin) / h;
  Vec3 p = slot.position;
  p[u] = voxels.origin[u] + h * (std::floor(corner[u]) + (static_cast<float>(k % kSide) + jitter.x) / kSide);
  p[v] = voxels.origin[v] + h * (std::floor(corner[v]) + (static_cast<float>(k / kSide) + jitter.y) / kSide);
  p[axis] -=
      ((p[u] - slot.position[u]) * slot.normal[u] + (p[v] - slot.position[v]) * slot.normal[v]) / slot.normal[axis];
  return offsetOrigin(p, slot.normal) + slot.normal * (0.01f * h);
}

bool fills(const FaceSlot& slot, float h) {
  return slot.areaM2 > 0.9f * h * h && std::abs(slot.normal[slot.face / 2]) > 0.9f;
}

// Rays always go on from polished metal, and from panes where photons bring what these throw.
bool isPolished(const Scene& scene, const FaceSlot& slot) {
  const Instance& instance = scene.instances[slot.instance];
  return throwsLight(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)]);
}

// How many places of each slot are asked: few amid others that are lit all over, none where no sun is near.
std::vector<uint8_t> placesAsked(const Scene& scene, const SlotSampling& slots, const Links& links,
                                 std::span<const Vec3> sunLux) {
  std::vector<uint8_t> places(slots.voxels.slots.size());
  parallelFor(places.size(), 8192, [&](size_t s) {
    const FaceSlot& slot = slots.voxels.slots[s];
    if (!slots.paths.isSheet(s) || !fills(slot, slots.voxels.voxelSizeM) || isPolished(scene, slot)) return;
    const float own = luminance(sunLux[s]);
    bool any = own > 0, even = own > 0;
    for (const uint32_t o : links.kin[s]) {
      const float other = luminance(sunLux[o]);
      any = any || other > 0, even = even && std::abs(other - own) < kEven * own;
    }
    places[s] = even ? SlotPaths::kPoints : any ? kPlaces : 0;
  });
  return places;
}

// Of a slot whose places are not asked: it is lit evenly.
void addEven(const SlotPaths& paths, const FaceSlot& slot, size_t s, Vec3 lux, std::vector<GlowPoint>& out) {
  const Vec3 radiance = slot.albedo * lux / kPi,
             flux = radiance * (kPi * slot.areaM2 / static_cast<float>(SlotPaths::kPoints));
  for (uint32_t k = 0; k < SlotPaths::kPoints; ++k)
    out.push_back({paths.point(s, k), slot.normal, flux, static_cast<int64_t>(s), luminance(radiance)});
}

// Rays from places of one slot to the sun, and what arrives along them.
struct SunRays {
  std::vector<Ray> ways;
  std::vector<Vec3> lux, left;

  // From so many places of slot s.
  void trace(const TracedScene& scene, const SlotSampling& slots, size_t s, uint32_t places) {
    const FaceSlot& slot = slots.voxels.slots[s];
    ways.clear(), lux.clear();
    for (uint32_t i = 0; i < places; ++i) {
      const uint32_t k = places < kPlaces ? kDiagonal * i : i;
      Sampler sampler(slots.paths.key(s), k, slots.seed + 15);
      const Vec2 jitter = sampler.next2();
      const LightSample light = scene.lights.sampleSun(0, sampler.next2());
      const Vec3 p = placeOn(slots.voxels, slot, k, jitter);
      ways.push_back(shadowRay(p, p, light));
      lux.push_back(light.radiance * std::max(0.0f, dot(light.wi, slot.normal)));
    }
    left.resize(ways.size());
    scene.rays.transmittance(ways, left);
  }

  // `slotLux` becomes the mean of what arrives.
  void addPoints(const FaceSlot& slot, size_t s, Vec3& slotLux, std::vector<GlowPoint>& out) {
    Vec3 mean;
    for (size_t i = 0; i < lux.size(); ++i) mean += (lux[i] *= left[i]) / static_cast<float>(lux.size());
    slotLux = mean;
    const bool all = std::none_of(lux.begin(), lux.end(), [](Vec3 v) { return isBlack(v); });
    const size_t step = all && lux.size() == kPlaces ? kDiagonal : 1;  // of one that is lit all over a few will do
    const float radiance = luminance(slot.albedo * mean) / kPi,
                part = static_cast<float>(all ? SlotPaths::kPoints : lux.size());
    for (size_t i = 0; i < lux.size(); i += step) {
      const Vec3 flux = slot.albedo * (all ? mean : lux[i]) * (slot.areaM2 / part);
      if (!isBlack(flux)) out.push_back({ways[i].origin, slot.normal, flux, static_cast<int64_t>(s), radiance});
    }
  }
};

}  // namespace

std::vector<GlowPoint> sunPlaces(const TracedScene& scene, const SlotSampling& slots, const Links& links,
                                 std::span<Vec3> sunLux, uint64_t& rayCount) {
  const Voxels& voxels = slots.voxels;
  const std::vector<uint8_t> places = placesAsked(scene.rays.scene(), slots, links, sunLux);
  std::vector<std::vector<GlowPoint>> ofBrick(voxels.bricks.size());
  std::atomic<uint64_t> count = 0;
  std::vector<Vec3> finer(sunLux.begin(), sunLux.end());
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    const auto [first, last] = slotsOfBrick(voxels, b);
    SunRays sun;
    for (size_t s = first; s < last; ++s) {
      const FaceSlot& slot = voxels.slots[s];
      if (places[s] == 0) {
        // Among other things in its voxel rays do not always read the slot.
        if (slots.paths.isSheet(s) && !isBlack(sunLux[s]) && !isPolished(scene.rays.scene(), slot))
          addEven(slots.paths, slot, s, sunLux[s], ofBrick[b]);
        continue;
      }
      sun.trace(scene, slots, s, places[s]);
      count += sun.ways.size();
      sun.addPoints(slot, s, finer[s], ofBrick[b]);
    }
  });
  std::copy(finer.begin(), finer.end(), sunLux.begin());
  std::vector<GlowPoint> all;
  for (const auto& of : ofBrick) all.insert(all.end(), of.begin(), of.end());
  rayCount += count;
  return all;
}

std::vector<Vec3> lightFrom(const BrightPatches& patches, const RayScene& rays, const SlotSampling& slots,
                            const Links& links, std::span<const Vec3> reflectedLx, uint64_t& rayCount) {
  const Voxels& voxels = slots.voxels;
  const SlotPaths& paths = slots.paths;
  std::vector<Vec3> lux(voxels.slots.size());
  std::atomic<uint64_t> count = 0;
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    const auto [first, last] = slotsOfBrick(voxels, b);
    const auto sideOf = [&](size_t s) { return brickSide(b, voxels.slots[s].face); };
    // What links take of the light from slot j to slot s.
    const auto linkShare = [&](size_t s, size_t j) {
      const FaceSlot &to = voxels.slots[s], &from = voxels.slots[j];
      const Vec3 way = from.position - to.position;
      const float distance = std::max(length(way), 1e-6f), cosine = std::max(0.0f, dot(way, to.normal)) / distance,
                  cosLight = -dot(way, from.normal) / distance;
      const float perSample = static_cast<float>(links.count(s)) / static_cast<float>(kSamples);
      return patches.rayShare(static_cast<int64_t>(j), luminance(reflectedLx[j]) / kPi, distance, cosLight, sideOf(s),
                              perSample * cosine / kPi);
    };
    SlotSamples samples;
    for (size_t s = first; s < last; ++s) {
      if (!patches.reaches(sideOf(s))) continue;
      for (uint32_t k = 0; k < kSamples; ++k) {
        const Vec3 p = paths.point(s, k + paths.key(s)), n = voxels.slots[s].normal;
        Sampler sampler(paths.key(s), k, slots.seed + 12);
        const GlowSample g = patches.sample(p, n, sideOf(s), sampler);
        if (!g.light.valid()) continue;
        const float share = 1 - linkShare(s, static_cast<size_t>(patches.point(g.point).slot));
        samples.ask(s, shadowRay(p, p, g.light),
                    g.light.radiance * (share * dot(g.light.wi, n) / static_cast<float>(kSamples)));
      }
    }
    for (size_t s = first; s < last; ++s) {
      const auto own = std::span(links.links).subspan(links.first[s], links.count(s));
      for (const Link& link : own) {
        const size_t j = link.slot();
        if (link.isDark() || !patches.holdsSun(static_cast<int64_t>(j))) continue;
        lux[s] += reflectedLx[j] *
                  (link.left() * Link::kUnit * (link.isBent() ? 1 : linkShare(s, j)) / static_cast<float>(own.size()));
      }
    }
    count += samples.addTo(rays, lux);
  });
  rayCount += count;
  return lux;
}

}  // namespace roomlight
