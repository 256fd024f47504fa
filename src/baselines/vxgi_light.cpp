#include "base/parallel.h"
#include "base/sampling.h"
#include "baselines/shown_sides.h"
#include "baselines/vxgi.h"
#include "voxel/lattice.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr float kMargin = 2;  // voxels around the room, at each end of the finest level

// One side of the surfaces in a voxel.
struct Side {
  Vec3 p, n, albedo;
  Vec3 directLux, indirectLux;
  float areaM2 = 0;
  float open = 0;  // share of directions in which nothing is met
  int face = 0;
  bool front = true;
  Vec3 radiance() const { return albedo * (directLux + indirectLux) / kPi; }
};

// A voxel that surfaces are in, on the level where it is not made of finer ones.
struct Source {
  int level;
  Int3 v;  // from the level's corner
  Vec3 opacity;
  size_t first, count;  // sides
};

struct Sources {
  std::vector<Source> voxels;
  std::vector<Side> sides;
};

float openness(const RayScene& rays, Vec3 p, Vec3 n, uint64_t key) {
  constexpr uint32_t kRays = 8;
  const Frame frame(n);
  std::array<Ray, kRays> tries;
  std::array<Vec3, kRays> left;
  for (uint32_t k = 0; k < kRays; ++k) tries[k] = {offsetOrigin(p, n), frame.toWorld(sampleCosineHemisphere(Sampler(key, k, 0).next2())), 0, kInfinity};
  rays.transmittance(tries, left);
  float open = 0;
  for (const Vec3 l : left) open += luminance(l) / kRays;
  return open;
}

// The voxels of one level that are its own.
void addSources(const RayScene& rays, const VxgiClipmap& map, int level, const Voxels& voxels, const std::vector<Vec3>& directLux, Sources& out) {
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
        const Int3 v{at.x * kBrickSize + bit % kBrickSize - corner.x, at.y * kBrickSize + bit / kBrickSize - corner.y, at.z * kBrickSize + z - corner.z};
        if (!map.contains(v) || map.isMadeOfFiner(level, v)) continue;
        const SurfaceVoxel& voxel = voxels.voxels[record];
        Source source{level, v, voxel.opacity, out.sides.size(), 0};
        for (size_t s = voxel.firstSlot, end = s + static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces))); s < end; ++s) {
          const FaceSlot& slot = voxels.slots[s];
          if (front[s] || isDoubleSided(rays.scene(), slot)) out.sides.push_back({slot.position, slot.normal, slot.albedo, directLux[s], {}, slot.areaM2, 0, slot.face, front[s] != 0});
        }
        source.count = out.sides.size() - source.first;
        out.voxels.push_back(source);
      }
    }
  }
}

// Of a sheet's two sides the one that counts: that which is indoors, where the other is not; else the front.
bool countsMore(const Side& a, const Side& b) {
  constexpr float kOutdoors = 0.25f;
  if (std::abs(a.open - b.open) > kOutdoors) return a.open < b.open;
  return a.front && !b.front;
}

// One radiance for all directions: the mean of the voxel's surfaces.
Vec3 isotropicRadiance(std::span<const Side> sides) {
  Vec3 sum;
  float area = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    const Side *side = &sides[i], *next = i + 1 < sides.size() ? &sides[i + 1] : nullptr;
    if (next && next->face == (side->face ^ 1)) {
      if (countsMore(*next, *side)) side = next;
      ++i;
    }
    sum += side->radiance() * side->areaM2;
    area += side->areaM2;
  }
  return area > 0 ? sum / area : Vec3(0);
}

void inject(const Sources& sources, VxgiClipmap& map) {
  parallelFor(sources.voxels.size(), 1024, [&](size_t i) {
    const Source& s = sources.voxels[i];
    const Vec3 radiance = isotropicRadiance(std::span(sources.sides).subspan(s.first, s.count));
    for (int face = 0; face < 6; ++face) map.set(s.level, s.v, face, radiance, s.opacity[face / 2]);
  });
  map.buildCoarser();
}

double reflectedLight(const Sources& sources) {
  double sum = 0;
  for (const Side& s : sources.sides) sum += static_cast<double>(luminance(s.radiance()) * s.areaM2);
  return sum;
}

// Every voxel's light anew from that of the pass before, as the SDK's frames follow one another, until little changes.
void bounce(Sources& sources, const VxgiSettings& settings, const Progress& progress, VxgiLight& out) {
  const VxgiCones cones(settings.cones);
  const VxgiTracing tracing(settings);
  double before = reflectedLight(sources);
  while (out.bounces < settings.maxBounces && !progress.stop()) {
    parallelFor(sources.sides.size(), 256, [&](size_t i) {
      Side& s = sources.sides[i];
      s.indirectLux = traceVxgiDiffuse(out.map, s.p, s.n, s.n, cones, 0, tracing) * kPi;
    });
    inject(sources, out.map);
    ++out.bounces;
    progress.at(0.5f + 0.5f * static_cast<float>(out.bounces) / static_cast<float>(settings.maxBounces));
    const double now = reflectedLight(sources);
    out.residual = now > 0 ? std::abs(now - before) / now : 0;
    before = now;
    if (out.residual < static_cast<double>(settings.residual)) break;
  }
}

float finestVoxelM(const RayScene& rays, const Bounds3& room, const VxgiSettings& settings) {
  const float wanted = settings.voxelSizeM > 0 ? settings.voxelSizeM : std::max(1e-3f, maxComponent(room.size()) / (static_cast<float>(settings.resolution) - 2 * kMargin));
  return feasibleVoxelSizeM(rays.bounds(), wanted);
}

}  // namespace

Bounds3 roomAround(const RayScene& rays, Vec3 eye) {
  constexpr uint32_t kRays = 4096;
  constexpr size_t kLeftOut = kRays / 50;
  std::array<std::vector<float>, 3> met;
  for (uint32_t i = 0; i < kRays; ++i) {
    const Vec3 d = sampleSphere(Sampler(0, i, 0).next2());
    const Hit hit = rays.intersect({eye, d, 0, kInfinity});
    for (int k = 0; hit.valid() && k < 3; ++k) met[static_cast<size_t>(k)].push_back(eye[k] + d[k] * hit.t);
  }
  if (met[0].size() <= 2 * kLeftOut) return rays.bounds();
  Bounds3 out;
  for (int k = 0; k < 3; ++k) {
    std::vector<float>& m = met[static_cast<size_t>(k)];
    std::sort(m.begin(), m.end());
    out.lo[k] = m[kLeftOut], out.hi[k] = m[m.size() - 1 - kLeftOut];
  }
  return out;
}

VxgiLight lightVxgi(const RayScene& rays, const Lights& lights, const Bounds3& room, const VxgiSettings& settings, const Progress& progress) {
  VxgiLight out{VxgiClipmap(room.centre(), finestVoxelM(rays, room, settings), settings.resolution, settings.levels), {}, {}, 0, 0, 0, 0};
  RadianceSettings direct;
  direct.maxBounces = 0, direct.pyramid = false, direct.directSamples = settings.directSamples, direct.seed = settings.seed;
  Sources sources;
  for (int level = 0; level < settings.levels && !progress.stop(); ++level) {
    VoxelSettings voxel;
    voxel.voxelSizeM = out.map.voxelSizeM(level);
    Voxels voxels = voxelise(rays.scene(), voxel).voxels;
    RadianceField field = illuminate(rays, lights, voxels, direct, {{}, progress.cancelled});
    if (progress.stop()) return out;
    addSources(rays, out.map, level, voxels, field.irradianceLux, sources);
    out.rays += field.rays;
    if (level == 0) out.voxels = std::move(voxels), out.guide = std::move(field.guide);
    progress.at(0.5f * static_cast<float>(level + 1) / static_cast<float>(settings.levels));
  }
  parallelFor(sources.sides.size(), 256, [&](size_t i) { sources.sides[i].open = openness(rays, sources.sides[i].p, sources.sides[i].n, i); });
  out.sources = sources.voxels.size();
  float brightest = 0;
  for (const Side& s : sources.sides) brightest = std::max(brightest, maxComponent(s.radiance()));
  if (brightest > 0) out.map.setUnit(brightest / 4096);  // bounces add to it, and half floats hold sixteen times as much
  inject(sources, out.map);
  out.map.findEmpty();
  bounce(sources, settings, progress, out);
  return out;
}

}  // namespace roomlight
