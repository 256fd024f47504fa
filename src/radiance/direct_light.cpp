#include "radiance/direct_light.h"

#include <array>

#include "base/sampling.h"
#include "radiance/radiance_field.h"
#include "radiance/sky_guide.h"
#include "trace/emitter_view.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr float kWide = 0.5f;  // a light's size over its distance
constexpr float kByOthers = 0.25f;  // of samples of the sky that links share: drawn as a brick's neighbours tell

// Of each voxel of a brick and each face: 1 where a slot has rays that arrive, 2 where it has some that do not.
class Shadows {
 public:
  void add(int voxel, int face, unsigned seen) {
    bits_[static_cast<size_t>(voxel)] |= static_cast<uint16_t>(seen << (2 * face));
  }
  // Whether neighbours inside the brick differ, or none tells. A slot's own rays must not decide on how many more it
  // gets, or those that by chance miss all light would count for too much.
  bool differAround(int voxel, int face) const {
    const int x = voxel % kBrickSize, y = voxel / kBrickSize % kBrickSize, z = voxel / (kBrickSize * kBrickSize);
    unsigned any = 0;
    for (int dz = std::max(0, z - 1); dz <= std::min(kBrickSize - 1, z + 1); ++dz) {
      for (int dy = std::max(0, y - 1); dy <= std::min(kBrickSize - 1, y + 1); ++dy) {
        for (int dx = std::max(0, x - 1); dx <= std::min(kBrickSize - 1, x + 1); ++dx) {
          const int other = dx + kBrickSize * (dy + kBrickSize * dz);
          if (other != voxel) any |= bits_[static_cast<size_t>(other)];
        }
      }
    }
    any = any >> (2 * face) & 3;
    return any == 0 || any == 3;
  }

 private:
  std::array<uint16_t, kBrickVoxels> bits_{};
};

struct Shadow {
  size_t slot;
  Vec3 lux;  // if nothing is in the way
};

// Numbers of the voxels of a brick that its slots lie in, in order of the slots.
std::vector<int> voxelsOfSlots(const Voxels& voxels, size_t b) {
  std::vector<int> out;
  const Brick& brick = voxels.bricks[b];
  size_t record = brick.firstVoxel;
  for (int z = 0; z < kBrickSize; ++z) {
    for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1, ++record) {
      const int slots = std::popcount(static_cast<unsigned>(voxels.voxels[record].faces));
      out.insert(out.end(), static_cast<size_t>(slots), std::countr_zero(bits) + kBrickSize * kBrickSize * z);
    }
  }
  return out;
}

// Per voxel of a brick one bit a face.
using FaceBits = std::array<uint8_t, kBrickVoxels>;

// Each voxel gets those of its neighbours inside the brick too.
FaceBits spread(const FaceBits& bits) {
  FaceBits out = bits;
  for (const size_t step : {size_t{1}, size_t{kBrickSize}, size_t{kBrickSize * kBrickSize}}) {
    const FaceBits before = out;
    for (size_t v = 0; v < bits.size(); ++v) {
      const size_t place = v / step % kBrickSize;
      if (place > 0) out[v] |= before[v - step];
      if (place + 1 < kBrickSize) out[v] |= before[v + step];
    }
  }
  return out;
}

}  // namespace

// Where a light's ray goes from a slot.
struct DirectLight::Segment {
  Vec3 direction;  // unit; zero: nowhere
  float distance = kInfinity;
};

// Whether light from somewhere in `source` might on its straight way to slots of a brick. Much quicker than the rays
// themselves.
bool DirectLight::mayCross(size_t brick, const Bounds3& source, std::span<const Bounds3> near) const {
  return mayMeetBetween(whereSlotsLie(brick), source, near);
}

// Of parallel light, from within a box of unit directions.
bool DirectLight::mayCrossFromAfar(size_t brick, const Bounds3& directions, std::span<const Bounds3> near) const {
  const Bounds3 from = whereSlotsLie(brick);
  Bounds3 all = from;
  for (const Bounds3& box : near) all.add(box);
  const float far = 2 * length(all.size());
  return mayMeetBetween(from, {from.lo + directions.lo * far, from.hi + directions.hi * far}, near);
}

Bounds3 DirectLight::whereSlotsLie(size_t brick) const {
  const Bounds3 bounds = boundsOfBrick(voxels_, brick);
  const Vec3 lifted(voxels_.voxelSizeM);
  return {bounds.lo - lifted, bounds.hi + lifted};
}

// Slots of a brick some of whose rays may cross one of the boxes; `segmentOf(slot, k, p)` is that of the k-th, from p,
// known to `off` times its length. Added to `out`, which is empty as long as there is none.
template <class SegmentOf>
void DirectLight::findCrossed(size_t brick, uint32_t samples, std::span<const Bounds3> near, float off,
                              const SegmentOf& segmentOf, Marks& out) const {
  const auto [first, last] = slotsOfBrick(voxels_, brick);
  float margin = 0;
  for (const Bounds3& box : near) {
    Bounds3 both = box;
    both.add(boundsOfBrick(voxels_, brick));
    margin = std::max(margin, off * length(both.size()));
  }
  std::vector<Bounds3> ahead;
  for (size_t s = first; s < last; ++s) {
    inFront(voxels_.slots[s], near, voxels_.voxelSizeM, ahead);
    for (uint32_t k = 0; k < samples && !ahead.empty(); ++k) {
      const Vec3 p = point(s, k);
      const Segment way = segmentOf(s, k, p);
      if (!(dot(way.direction, voxels_.slots[s].normal) > -off) || isBlack(way.direction) ||
          !crosses({p, way.direction, 0, way.distance}, ahead, margin))
        continue;
      out.resize(last - first);
      out[s - first] = kAnew;
      break;
    }
  }
}

// To slots marked, those beside them, which may now want more or fewer rays, and those beside these, whose shadows
// decide on that.
void DirectLight::markAround(size_t brick, Marks& marks) const {
  const size_t first = slotsOfBrick(voxels_, brick).first;
  const std::vector<int> voxelOf = voxelsOfSlots(voxels_, brick);
  const auto bit = [&](size_t i) { return static_cast<uint8_t>(1u << voxels_.slots[first + i].face); };
  FaceBits crossed{};
  for (size_t i = 0; i < marks.size(); ++i) {
    if (marks[i]) crossed[static_cast<size_t>(voxelOf[i])] |= bit(i);
  }
  const FaceBits beside = spread(crossed), beyond = spread(beside);
  for (size_t i = 0; i < marks.size(); ++i) {
    const auto v = static_cast<size_t>(voxelOf[i]);
    marks[i] = beside[v] & bit(i) ? kAnew : beyond[v] & bit(i) ? kShadowOnly : kAsItIs;
  }
}

// Adds to what slots have. `marks`: which; empty: all.
template <class Sample>
void DirectLight::trace(size_t brick, Samples samples, const Marks& marks, std::span<Vec3> lux, const Sample& sample) {
  samples = {importance_.raysOf(brick, samples.first), importance_.raysOf(brick, samples.most)};
  const auto [first, last] = slotsOfBrick(voxels_, brick);
  const auto markOf = [&, start = first](size_t s) { return marks.empty() ? kAnew : marks[s - start]; };
  std::vector<Ray> rays;
  std::vector<Shadow> shadows;
  std::vector<Vec3> left, sum(last - first);
  const auto collect = [&](size_t s, uint32_t k) {
    const FaceSlot& slot = voxels_.slots[s];
    const Vec3 p = point(s, k);
    const LightSample light = sample(s, k, p);
    if (!light.valid()) return;
    const float a = attenuation(settings_.attenuation, slot.normal, light.wi);
    if (a <= 0 || dot(light.wi, slot.normal) <= 0) return;
    rays.push_back(shadowRay(p, p, light));
    shadows.push_back({s, light.radiance * a});
  };
  const auto arrive = [&, start = first](const auto& see) {
    left.resize(rays.size());
    rays_.transmittance(rays, left);
    count_ += rays.size();
    for (size_t i = 0; i < rays.size(); ++i) {
      sum[shadows[i].slot - start] += shadows[i].lux * left[i];
      see(shadows[i].slot, left[i]);
    }
    rays.clear(), shadows.clear();
  };
  for (size_t s = first; s < last; ++s) {
    for (uint32_t k = 0; k < samples.first && markOf(s) != kAsItIs; ++k) collect(s, k);
  }
  const std::vector<int> voxelOf = voxelsOfSlots(voxels_, brick);
  std::vector<uint32_t> tried(last - first, samples.first);
  Shadows seen;
  arrive([&, start = first](size_t s, Vec3 part) {
    seen.add(voxelOf[s - start], voxels_.slots[s].face, isBlack(part) ? 2 : 1);
  });
  for (size_t s = first; s < last; ++s) {
    if (markOf(s) != kAnew || !seen.differAround(voxelOf[s - first], voxels_.slots[s].face)) continue;
    tried[s - first] = samples.most;
    for (uint32_t k = samples.first; k < samples.most; ++k) collect(s, k);
  }
  arrive([](size_t, Vec3) {});
  for (size_t s = first; s < last; ++s) {
    if (markOf(s) == kAnew) lux[s] += sum[s - first] / static_cast<float>(tried[s - first]);
  }
}

// Slots to be traced have nothing before.
void DirectLight::clear(size_t brick, const Marks& marks, std::span<Vec3> lux) const {
  const auto [first, last] = slotsOfBrick(voxels_, brick);
  for (size_t s = first; s < last; ++s) {
    if (marks.empty() || marks[s - first] == kAnew) lux[s] = {};
  }
}

// One light anew: all of it, or what `findMarks(Marks&)` finds.
template <class FindMarks, class Sample>
void DirectLight::renew(size_t brick, Samples samples, std::span<const Bounds3> near, std::span<Vec3> lux,
                        const FindMarks& findMarks, const Sample& sample) {
  Marks marks;
  if (!near.empty()) {
    findMarks(marks);
    if (marks.empty()) return;
    markAround(brick, marks);
  }
  clear(brick, marks, lux);
  trace(brick, samples, marks, lux, sample);
}

// The ways that light samples go.
template <class Sample>
auto DirectLight::ways(const Sample& sample) {
  return [&sample](size_t s, uint32_t k, Vec3 p) {
    const LightSample light = sample(s, k, p);
    return light.valid() ? Segment{light.wi, light.distance} : Segment{};
  };
}

void DirectLight::lamp(const Lamp& lamp, size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  Lamp unit = lamp;
  unit.intensityCd = Vec3(1);
  const LightSurroundings around(lamp, voxels_.voxelSizeM);
  const float reachM = lamp.extended ? 0.5f * std::hypot(lamp.web->sizeC0M, lamp.web->sizeC90M) : 0;
  const auto sample = [&](size_t s, uint32_t k, Vec3 p) {
    if (dot(lamp.position - p, voxels_.slots[s].normal) + reachM <= 0)
      return LightSample{};  // behind it, before the web is looked up
    if (around.contains(voxels_.slots[s].position)) return LightSample{};
    if (!lamp.extended) return sampleLamp(unit, p, {});
    Sampler sampler(paths_.key(s), k, settings_.seed + 5);
    return sampleLamp(unit, p, sampler.next2());
  };
  const auto soft = static_cast<uint32_t>(settings_.directSamples);
  const Samples samples = lamp.extended ? Samples{(soft + 1) / 2, soft} : Samples{1, perDelta()};
  const Vec3 half(reachM);
  const auto findMarks = [&](Marks& marks) {
    if (mayCross(brick, {lamp.position - half, lamp.position + half}, near))
      findCrossed(brick, samples.most, near, 0, ways(sample), marks);
  };
  renew(brick, samples, near, lux, findMarks, sample);
}

void DirectLight::lamps(std::span<const LightSurroundings> around, size_t brick, std::span<Vec3> lux) {
  const auto most = static_cast<uint32_t>(settings_.directSamples);
  const auto sample = [&](size_t s, uint32_t k, Vec3 p) {
    Sampler sampler(paths_.key(s), k, settings_.seed + 5);
    const LightSample light = seen_.sampleLamps(lights_, p, brickSide(brick, voxels_.slots[s].face), sampler);
    return light.valid() && around[static_cast<size_t>(light.lamp)].contains(voxels_.slots[s].position) ? LightSample{}
                                                                                                        : light;
  };
  trace(brick, {(most + 1) / 2, most}, {}, lux, sample);
}

void DirectLight::suns(size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  const auto sampleOf = [&](size_t i) {
    return [this, i](size_t s, uint32_t k, Vec3) {
      Sampler sampler(paths_.key(s), k, settings_.seed + 2 + 16 * i);
      return lights_.sampleSun(i, sampler.next2());
    };
  };
  Marks marks;
  if (!near.empty()) {
    for (size_t i = 0; i < lights_.sunCount(); ++i) {
      if (mayCrossFromAfar(brick, lights_.sunDirections(i), near))
        findCrossed(brick, perDelta(), near, 0, ways(sampleOf(i)), marks);
    }
    if (marks.empty()) return;
    markAround(brick, marks);
  }
  clear(brick, marks, lux);
  for (size_t i = 0; i < lights_.sunCount(); ++i) trace(brick, {1, perDelta()}, marks, lux, sampleOf(i));
}

LightSample DirectLight::skySample(const SkyGuide& guide, int32_t which, size_t s, uint32_t k) const {
  if (which < 0) return {};
  Sampler sampler(paths_.key(s), k, settings_.seed + 4);
  const Vec2 u = sampler.next2();
  return sampleSkyGuided(guide, which, lights_, u, sampler.next1());
}

void DirectLight::keepWays(const SkyGuide& guide, size_t brick, SkyDirections& ways) const {
  const auto [first, last] = slotsOfBrick(voxels_, brick);
  for (size_t s = first; s < last; ++s) {
    for (uint32_t k = 0; k < kSkySamples; ++k) {
      const LightSample light = skySample(guide, guide.guideOfBrick[brick][voxels_.slots[s].face], s, k);
      ways[s][k] = light.valid() ? SkyDirection(light.wi) : SkyDirection();
    }
  }
}

void DirectLight::sky(const SkyGuide& guide, size_t brick, std::span<const Bounds3> near, SkyDirections& ways,
                      std::span<Vec3> lux) {
  if (guide.guideOfBrick.empty()) return;
  if (near.empty()) keepWays(guide, brick, ways);
  const auto findMarks = [&](Marks& marks) {
    findCrossed(
        brick, kSkySamples, near, SkyDirection::kOff,
        [&](size_t s, uint32_t k, Vec3) { return Segment{ways[s][k].direction()}; }, marks);
  };
  renew(brick, {kSkySamples / 2, kSkySamples}, near, lux, findMarks, [&](size_t s, uint32_t k, Vec3) {
    return skySample(guide, guide.guideOfBrick[brick][voxels_.slots[s].face], s, k);
  });
}

void DirectLight::skyWithLinks(const SharedSky& guide, size_t brick, std::span<Vec3> lux) {
  if (guide.own.guideOfBrick.empty()) return;
  const auto guideOf = [&](const SkyGuide& of, size_t s) { return of.guideOfBrick[brick][voxels_.slots[s].face]; };
  // Links a steradian, and the part of the light in a direction that is theirs.
  const auto density = [&](size_t s, Vec3 d) {
    return static_cast<float>(guide.links.count(s)) * std::max(0.0f, dot(d, voxels_.slots[s].normal)) / kPi;
  };
  const auto ofLinks = [&](float links, float ofOthers) {
    return links > 0 ? links / (links + static_cast<float>(kSkySamples) * ofOthers) : 0;
  };
  trace(brick, {kSkySamples / 2, kSkySamples}, {}, lux, [&](size_t s, uint32_t k, Vec3) {
    const int32_t own = guideOf(guide.own, s), others = guideOf(guide.others, s);
    if (own < 0) return LightSample{};
    Sampler sampler(paths_.key(s), k, settings_.seed + 4);
    const Vec2 u = sampler.next2();
    const float choice = sampler.next1();
    SkyDistribution::Sample drawn = sampler.next1() < kByOthers
                                        ? drawSkyGuided(guide.others, others, lights_, u, choice)
                                        : drawSkyGuided(guide.own, own, lights_, u, choice);
    const float ofOthers = pdfSkyGuided(guide.others, others, lights_, drawn.uv);
    drawn.pdf = (1 - kByOthers) * pdfSkyGuided(guide.own, own, lights_, drawn.uv) + kByOthers * ofOthers;
    LightSample light = skyLight(lights_, drawn);
    if (light.valid()) light.radiance *= 1 - ofLinks(density(s, light.wi), ofOthers);
    return light;
  });
  size_t rays = 0;
  std::array<bool, 6> faces;
  for (size_t f = 0; f < faces.size(); ++f) faces[f] = guide.own.guideOfBrick[brick][f] >= 0;
  for (const SkyLink& l : linksToSky(slots_, brick, guide.links, faces, rays)) {
    const size_t s = l.link.slot;
    const float a = attenuation(settings_.attenuation, voxels_.slots[s].normal, l.direction),
                links = density(s, l.direction);
    if (!(a > 0 && links > 0)) continue;
    const float part = ofLinks(links, pdfSkyGuided(guide.others, guideOf(guide.others, s), lights_, l.direction));
    lux[s] += lights_.sky().radiance(l.direction) * l.left * (a * part / links);
  }
  count_ += rays;
}

void DirectLight::emitters(size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  const auto most = static_cast<uint32_t>(settings_.directSamples);
  const auto sample = [&](size_t s, uint32_t k, Vec3 p) {
    Sampler sampler(paths_.key(s), k, settings_.seed + 3);
    const Vec2 u = sampler.next2();
    const LightSample light =
        seen_.sampleEmitters(lights_, p, brickSide(brick, voxels_.slots[s].face), u, sampler.next1());
    return light.valid() && besideEmitters_[static_cast<size_t>(light.emitter)].contains(voxels_.slots[s].position)
               ? LightSample{}
               : light;
  };
  const auto findMarks = [&](Marks& marks) {
    bool may = false;
    for (size_t i = 0; i < lights_.emitterCount() && !may; ++i) may = mayCross(brick, lights_.emitterBounds(i), near);
    if (may) findCrossed(brick, most, near, 0, ways(sample), marks);
  };
  renew(brick, {(most + 1) / 2, most}, near, lux, findMarks, sample);
}

// Large ones have wide half-shadows.
DirectLight::Samples DirectLight::samplesOf(const Bounds3& source, const Bounds3& slots) const {
  const Vec3 apart = max(max(slots.lo - source.hi, source.lo - slots.hi), Vec3(0));
  const auto soft = static_cast<uint32_t>(settings_.directSamples);
  if (lengthSquared(source.size()) > kWide * kWide * lengthSquared(apart)) return {(soft + 1) / 2, soft};
  return {1, perDelta()};
}

void DirectLight::emitter(size_t index, size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  const Bounds3 &bounds = lights_.emitterBounds(index), slots = whereSlotsLie(brick);
  const EmitterView view(lights_, index, slots);
  const Vec3 middle = bounds.centre(), half = bounds.size() * 0.5f;
  const auto sample = [&](size_t s, uint32_t k, Vec3 p) {
    const FaceSlot& slot = voxels_.slots[s];
    if (dot(middle - p, slot.normal) + dot(half, abs(slot.normal)) <= 0)
      return LightSample{};  // all of it behind the slot
    if (besideEmitters_[index].contains(slot.position)) return LightSample{};
    Sampler sampler(paths_.key(s), k, settings_.seed + 3);
    const Vec2 u = sampler.next2();
    return view.sample(p, u, sampler.next1());
  };
  const Samples samples = samplesOf(bounds, slots);
  const auto findMarks = [&](Marks& marks) {
    if (!view.dark() && mayCross(brick, bounds, near)) findCrossed(brick, samples.most, near, 0, ways(sample), marks);
  };
  renew(brick, samples, near, lux, findMarks, sample);
}

}  // namespace roomlight
