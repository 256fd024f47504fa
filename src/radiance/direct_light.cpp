#include "radiance/direct_light.h"

#include <array>

#include "base/sampling.h"
#include "radiance/attenuation.h"
#include "radiance/sky_guide.h"
#include "trace/shadow_ray.h"

namespace roomlight {
namespace {

constexpr uint32_t kSkySamples = 8;

// Of each voxel of a brick and each face: 1 where a slot has rays that arrive, 2 where it has some that do not.
class Shadows {
 public:
  void add(int voxel, int face, unsigned seen) { bits_[static_cast<size_t>(voxel)] |= static_cast<uint16_t>(seen << (2 * face)); }
  // Whether neighbours inside the brick differ, or none tells. A slot's own rays must not decide on how many more it gets, or those
  // that by chance miss all light would count for too much.
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

}  // namespace

bool crosses(const Ray& ray, std::span<const Bounds3> boxes, float margin) {
  for (const Bounds3& box : boxes) {
    float t0 = ray.tMin, t1 = ray.tMax;
    for (int k = 0; k < 3; ++k) {
      const float inverse = 1 / (std::abs(ray.direction[k]) > 1e-12f ? ray.direction[k] : std::copysign(1e-12f, ray.direction[k]));
      const float a = (box.lo[k] - margin - ray.origin[k]) * inverse, b = (box.hi[k] + margin - ray.origin[k]) * inverse;
      t0 = std::max(t0, std::min(a, b)), t1 = std::min(t1, std::max(a, b));
    }
    if (t0 <= t1) return true;
  }
  return false;
}

// `sample(slot, k, p)` gives the k-th light sample of a slot at p, alone: it stands for the whole light.
template <class Sample>
bool DirectLight::anyCrosses(size_t brick, uint32_t samples, std::span<const Bounds3> near, const Sample& sample) const {
  const auto [first, last] = slotsOfBrick(voxels_, brick);
  for (size_t s = first; s < last; ++s) {
    for (uint32_t k = 0; k < samples; ++k) {
      const Vec3 p = point(s, k);
      const LightSample light = sample(s, k, p);
      if (light.valid() && dot(light.wi, voxels_.slots[s].normal) > 0 && crosses({p, light.wi, 0, light.distance}, near, 0)) return true;
    }
  }
  return false;
}

template <class Sample>
void DirectLight::trace(size_t brick, Samples samples, std::span<Vec3> lux, const Sample& sample) {
  const auto [first, last] = slotsOfBrick(voxels_, brick);
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
  const auto arrive = [&](const auto& see) {
    left.resize(rays.size());
    rays_.transmittance(rays, left);
    count_ += rays.size();
    for (size_t i = 0; i < rays.size(); ++i) {
      sum[shadows[i].slot - first] += shadows[i].lux * left[i];
      see(shadows[i].slot, left[i]);
    }
    rays.clear(), shadows.clear();
  };
  for (size_t s = first; s < last; ++s) {
    for (uint32_t k = 0; k < samples.first; ++k) collect(s, k);
  }
  if (rays.empty()) return;
  const std::vector<int> voxelOf = voxelsOfSlots(voxels_, brick);
  std::vector<uint32_t> tried(last - first, samples.first);
  Shadows seen;
  arrive([&](size_t s, Vec3 part) { seen.add(voxelOf[s - first], voxels_.slots[s].face, isBlack(part) ? 2 : 1); });
  for (size_t s = first; s < last; ++s) {
    if (!seen.differAround(voxelOf[s - first], voxels_.slots[s].face)) continue;
    tried[s - first] = samples.most;
    for (uint32_t k = samples.first; k < samples.most; ++k) collect(s, k);
  }
  arrive([](size_t, Vec3) {});
  for (size_t s = first; s < last; ++s) lux[s] += sum[s - first] / static_cast<float>(tried[s - first]);
}

bool DirectLight::lamp(const Lamp& lamp, size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  Lamp unit = lamp;
  unit.intensityCd = Vec3(1);
  const LightSurroundings around(lamp, voxels_.voxelSizeM);
  const auto sample = [&](size_t s, uint32_t k, Vec3 p) {
    if (around.contains(voxels_.slots[s].position)) return LightSample{};
    if (!lamp.extended) return sampleLamp(unit, p, {});
    Sampler sampler(paths_.key(s), k, settings_.seed + 5);
    return sampleLamp(unit, p, sampler.next2());
  };
  const auto soft = static_cast<uint32_t>(settings_.directSamples);
  const Samples samples = lamp.extended ? Samples{(soft + 1) / 2, soft} : Samples{1, perDelta()};
  if (!near.empty() && !anyCrosses(brick, samples.most, near, sample)) return false;
  trace(brick, samples, lux, sample);
  return true;
}

bool DirectLight::suns(size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  const auto sampleOf = [&](size_t i) {
    return [this, i](size_t s, uint32_t k, Vec3) {
      Sampler sampler(paths_.key(s), k, settings_.seed + 2 + 16 * i);
      return lights_.sampleSun(i, sampler.next2());
    };
  };
  bool wanted = near.empty();
  for (size_t i = 0; i < lights_.sunCount() && !wanted; ++i) wanted = anyCrosses(brick, perDelta(), near, sampleOf(i));
  for (size_t i = 0; i < lights_.sunCount() && wanted; ++i) trace(brick, {1, perDelta()}, lux, sampleOf(i));
  return wanted;
}

bool DirectLight::sky(const SkyGuide& guide, size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  if (guide.guideOfBrick.empty()) return near.empty();
  const auto& guides = guide.guideOfBrick[brick];
  const auto sample = [&](size_t s, uint32_t k, Vec3) {
    const int32_t which = guides[voxels_.slots[s].face];
    if (which < 0) return LightSample{};
    Sampler sampler(paths_.key(s), k, settings_.seed + 4);
    const Vec2 u = sampler.next2();
    return sampleSkyGuided(guide, which, lights_, u, sampler.next1());
  };
  if (!near.empty() && !anyCrosses(brick, kSkySamples, near, sample)) return false;
  trace(brick, {kSkySamples / 2, kSkySamples}, lux, sample);
  return true;
}

bool DirectLight::emitters(size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux) {
  const auto most = static_cast<uint32_t>(settings_.directSamples);
  const auto sample = [&](size_t s, uint32_t k, Vec3 p) {
    Sampler sampler(paths_.key(s), k, settings_.seed + 3);
    const Vec2 u = sampler.next2();
    const LightSample light = lights_.sampleEmitters(p, u, sampler.next1());
    return light.valid() && besideEmitters_[static_cast<size_t>(light.emitter)].contains(voxels_.slots[s].position) ? LightSample{} : light;
  };
  if (!near.empty() && !anyCrosses(brick, most, near, sample)) return false;
  trace(brick, {(most + 1) / 2, most}, lux, sample);
  return true;
}

void DirectLight::emitter(size_t index, size_t brick, std::span<Vec3> lux) {
  const auto sample = [&](size_t s, uint32_t k, Vec3 p) {
    if (besideEmitters_[index].contains(voxels_.slots[s].position)) return LightSample{};
    Sampler sampler(paths_.key(s), k, settings_.seed + 3);
    const Vec2 u = sampler.next2();
    return lights_.sampleEmitter(index, p, u, sampler.next1());
  };
  trace(brick, {1, perDelta()}, lux, sample);
}

}  // namespace roomlight
