#include "baselines/vxgi_sources.h"

#include <unordered_map>

#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"
#include "baselines/scene_survey.h"
#include "voxel/lattice.h"

namespace roomlight {
namespace {

float openness(const RayScene& rays, Vec3 p, Vec3 n, uint64_t key) {
  constexpr uint32_t kRays = 8;
  const Frame frame(n);
  std::array<Ray, kRays> tries;
  std::array<Vec3, kRays> left;
  for (uint32_t k = 0; k < kRays; ++k)
    tries[k] = {offsetOrigin(p, n), frame.toWorld(sampleCosineHemisphere(Sampler(key, k, 0).next2())), 0, kInfinity};
  rays.transmittance(tries, left);
  float open = 0;
  for (const Vec3 l : left) open += luminance(l) / kRays;
  return open;
}

// Of a sheet's two sides the one that counts: that which is indoors, where the other is not; else the front.
bool countsMore(const VxgiSide& a, const VxgiSide& b) {
  constexpr float kOutdoors = 0.25f;
  if (std::abs(a.open - b.open) > kOutdoors) return a.open < b.open;
  return a.front && !b.front;
}

// One radiance for all directions: the mean of the voxel's surfaces.
Vec3 isotropicRadiance(std::span<const VxgiSide> sides) {
  Vec3 sum;
  float area = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    const VxgiSide *side = &sides[i], *next = i + 1 < sides.size() ? &sides[i + 1] : nullptr;
    if (next && next->face == (side->face ^ 1)) {
      if (countsMore(*next, *side)) side = next;
      ++i;
    }
    sum += side->radiance() * side->areaM2;
    area += side->areaM2;
  }
  return area > 0 ? sum / area : Vec3(0);
}

uint64_t keyOf(const VxgiSource& s) {
  return static_cast<uint64_t>(s.level) << 48 | static_cast<uint64_t>(s.v.x) << 32 |
         static_cast<uint64_t>(s.v.y) << 16 | static_cast<uint64_t>(s.v.z);
}

}  // namespace

void addSources(const RayScene& rays, const VxgiClipmap& map, int level, const Voxels& voxels,
                const std::vector<Vec3>& directLux, VxgiSources& out) {
  std::vector<uint8_t> front(voxels.slots.size());
  parallelFor(front.size(), 1024, [&](size_t s) { front[s] = isFront(rays, voxels.slots[s], voxels.voxelSizeM); });
  const Lattice lattice = latticeOf(voxels);
  const Int3 corner = map.corner(level);
  for (const Brick& brick : voxels.bricks) {
    const Int3 at = lattice.brickOf(brick.coord);
    size_t record = brick.firstVoxel;
    for (int z = 0; z < kBrickSize; ++z) {
      for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1, ++record) {
        const int bit = std::countr_zero(bits);
        const Int3 v{at.x * kBrickSize + bit % kBrickSize - corner.x, at.y * kBrickSize + bit / kBrickSize - corner.y,
                     at.z * kBrickSize + z - corner.z};
        if (!map.contains(v) || map.isMadeOfFiner(level, v)) continue;
        const SurfaceVoxel& voxel = voxels.voxels[record];
        VxgiSource source{level, v, voxel.opacity, out.sides.size(), 0};
        for (size_t s = voxel.firstSlot,
                    end = s + static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
             s < end; ++s) {
          const FaceSlot& slot = voxels.slots[s];
          if (front[s] || isDoubleSided(rays.scene(), slot))
            out.sides.push_back({slot.position,
                                 slot.normal,
                                 slot.albedo,
                                 directLux[s],
                                 {},
                                 slot.areaM2,
                                 VxgiSide::kUnknown,
                                 slot.face,
                                 front[s] != 0});
        }
        source.count = out.sides.size() - source.first;
        out.voxels.push_back(source);
      }
    }
  }
}

void carrySides(const VxgiSources& before, VxgiSources& now) {
  std::unordered_map<uint64_t, const VxgiSource*> known;
  known.reserve(before.voxels.size());
  for (const VxgiSource& s : before.voxels) known.emplace(keyOf(s), &s);
  for (const VxgiSource& s : now.voxels) {
    const auto it = known.find(keyOf(s));
    if (it == known.end() || it->second->count != s.count) continue;
    for (size_t i = 0; i < s.count; ++i) {
      const VxgiSide& old = before.sides[it->second->first + i];
      VxgiSide& side = now.sides[s.first + i];
      if (old.face != side.face || old.front != side.front) continue;
      side.indirectLux = old.indirectLux;
      if (old.p == side.p) side.open = old.open;
    }
  }
}

void findOpenness(const RayScene& rays, VxgiSources& sources) {
  parallelFor(sources.sides.size(), 256, [&](size_t i) {
    VxgiSide& s = sources.sides[i];
    if (s.open == VxgiSide::kUnknown) s.open = openness(rays, s.p, s.n, i);
  });
}

void inject(const VxgiSources& sources, VxgiClipmap& map) {
  parallelFor(sources.voxels.size(), 1024, [&](size_t i) {
    const VxgiSource& s = sources.voxels[i];
    const Vec3 radiance = isotropicRadiance(std::span(sources.sides).subspan(s.first, s.count));
    for (int face = 0; face < 6; ++face) map.set(s.level, s.v, face, radiance, s.opacity[face / 2]);
  });
  map.buildCoarser();
}

double reflectedLight(const VxgiSources& sources) {
  double sum = 0;
  for (const VxgiSide& s : sources.sides) sum += static_cast<double>(luminance(s.radiance()) * s.areaM2);
  return sum;
}

}  // namespace roomlight
