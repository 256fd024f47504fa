#include "baselines/vxgi_cache.h"

#include "base/parallel.h"
#include "voxel/lattice.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr float kMargin = 2;  // voxels around the room, at each end of the finest level

float finestVoxelM(const RayScene& rays, const Bounds3& room, const VxgiSettings& settings) {
  const float wanted =
      settings.voxelSizeM > 0
          ? settings.voxelSizeM
          : std::max(1e-3f, maxComponent(room.size()) / (static_cast<float>(settings.resolution) - 2 * kMargin));
  return feasibleVoxelSizeM(rays.bounds(), wanted);
}

RadianceSettings directOnly(const VxgiSettings& settings) {
  RadianceSettings out;
  out.maxBounces = 0, out.pyramid = false, out.directSamples = settings.directSamples, out.seed = settings.seed;
  return out;
}

}  // namespace

VxgiCache::VxgiCache(const RayScene& rays, const Lights& lights, const Bounds3& room, const VxgiSettings& settings,
                     const Progress& progress)
    : settings_(settings),
      light_{VxgiClipmap(room.centre(), finestVoxelM(rays, room, settings), settings.resolution, settings.levels),
             {},
             {},
             0,
             0,
             0,
             0} {
  for (int level = 0; level < settings.levels; ++level) {
    if (progress.stop()) return;
    VoxelSettings voxel;
    voxel.voxelSizeM = light_.map.voxelSizeM(level);
    levels_.push_back(
        std::make_unique<Level>(rays, lights, voxel, directOnly(settings), Progress{{}, progress.cancelled}));
    progress.at(0.5f * static_cast<float>(level + 1) / static_cast<float>(settings.levels));
  }
  if (progress.stop()) return;
  gatherSources(rays);
  bounce(settings.maxBounces, progress);
}

void VxgiCache::update(const RayScene& rays, const Lights& lights, const SceneChange& change,
                       const Progress& progress) {
  std::vector<uint32_t> changed = change.moved;
  changed.insert(changed.end(), change.glow.begin(), change.glow.end());
  light_.rays = 0;
  for (const auto& level : levels_) {
    if (progress.stop()) return;
    if (changed.empty()) {
      level->direct.relight(rays, lights, level->voxelisation.voxels, {{}, progress.cancelled});
    } else {
      const std::vector<Bounds3> places = followMoves(level->voxelisation, rays.scene(), change);
      level->direct.update(rays, lights, level->voxelisation.voxels, places, {{}, progress.cancelled});
    }
  }
  if (progress.stop()) return;
  gatherSources(rays);
  bounce(settings_.bouncesAtOnce > 0 ? std::min(settings_.bouncesAtOnce, settings_.maxBounces) : settings_.maxBounces,
         progress);
}

void VxgiCache::gatherSources(const RayScene& rays) {
  VxgiSources now;
  for (size_t level = 0; level < levels_.size(); ++level) {
    const Level& l = *levels_[level];
    addSources(rays, light_.map, static_cast<int>(level), l.voxelisation.voxels, l.direct.field().irradianceLux, now);
    light_.rays += l.direct.field().rays;
  }
  light_.voxels = levels_.front()->voxelisation.voxels, light_.guide = levels_.front()->direct.field().guide;
  carrySides(sources_, now);
  findOpenness(rays, now);
  sources_ = std::move(now);
  light_.sources = sources_.voxels.size();
  float brightest = 0;
  for (const VxgiSide& s : sources_.sides) brightest = std::max(brightest, maxComponent(s.radiance()));
  if (brightest > 0)
    light_.map.setUnit(brightest / 4096);  // bounces add to it, and half floats hold sixteen times as much
  light_.map.clear();
  inject(sources_, light_.map);
  light_.map.findEmpty();
}

// Every voxel's light anew from that of the pass before, as the SDK's frames follow one another, until little changes.
void VxgiCache::bounce(int most, const Progress& progress) {
  const VxgiCones cones(settings_.cones);
  const VxgiTracing tracing(settings_);
  double before = reflectedLight(sources_);
  settled_ = most >= settings_.maxBounces;
  for (light_.bounces = 0; light_.bounces < most && !progress.stop();) {
    parallelFor(sources_.sides.size(), 256, [&](size_t i) {
      VxgiSide& s = sources_.sides[i];
      s.indirectLux = traceVxgiDiffuse(light_.map, {s.p, s.n, s.n}, cones, 0, tracing) * kPi;
    });
    inject(sources_, light_.map);
    ++light_.bounces;
    progress.at(0.5f + 0.5f * static_cast<float>(light_.bounces) / static_cast<float>(most));
    const double now = reflectedLight(sources_);
    light_.residual = now > 0 ? std::abs(now - before) / now : 0;
    before = now;
    if (light_.residual < static_cast<double>(settings_.residual)) {
      settled_ = true;
      break;
    }
  }
}

}  // namespace roomlight
