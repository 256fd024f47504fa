#include "gather/ray_shader.h"

#include <optional>

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/sky_guide.h"

namespace roomlight {
namespace {

constexpr int kDeepest = 3;      // vertices of a path, after which the cache is read wherever it can be seen,
constexpr int kMostVertices = 8;  // and after which paths that find none, between mirrors, end
constexpr int kMostPanes = 16;
constexpr float kRare = 4;        // times the light expected: what a single find has beyond that is rare
constexpr float kFaintShare = 0.2f;    // of the light seen: less is a faint reflection, as a pane's
constexpr float kFaintCells = 3;  // that such a reflection is taken from
constexpr float kAlike = 0.5f;     // cosine between normals of a place and of a slot that may have taken its light
constexpr float kNearCells =
    2;   // first hits nearer than that many cells read none: the slot if it may be read, else they are lit afresh
constexpr float kLeastAlbedo = 1e-3f;
constexpr float kGlossy = 0.6f;  // roughness from which on a surface reflects evenly enough
constexpr float kMetal =
    0.5f;  // metallic from which on a surface reflects evenly: its lobe would find too little too rarely
constexpr float kFarM = 1000;    // away: what panes show of the sky
constexpr float kMost = 1024;    // times the light that the cache tells of: what a single path may find at most

enum Kind : uint8_t {
  kShines = 1,  // emits light
  kClearKind = 2,  // lets light through
  kMirrorKind = 4,
  kGlossyKind = 8  // the cache knows how much it reflects, not where to
};

uint8_t kindOf(const Material& m) {
  uint8_t kind = 0;
  if (!isBlack(m.emission)) kind |= kShines;
  if (letsLightThrough(m)) kind |= kClearKind;
  if (isPolishedMetal(m)) kind |= kMirrorKind;  // no part of the cache
  const bool textured = m.metallicRoughnessTexture.texture >= 0;
  if ((m.roughness < kGlossy || textured) && (m.metallic <= kMetal || textured) && m.specular > 0) kind |= kGlossyKind;
  return kind;
}

bool isFaint(const GatherPath& path) { return luminance(path.factor.diffuse + path.factor.specular) < kFaintShare; }

// What a mirror throws on others from lights that rays hardly meet is found by chance only, too rarely: it is spread
// (Kaplanyan & Dachsbacher 2013, path space regularization). None where the surface is rough enough.
std::optional<Bsdf> bluntFor(const GatherPath& path, SurfacePoint s) {
  if (s.m.roughness >= path.spread) return {};
  s.m.roughness = path.spread;
  return Bsdf(s.m, s.ns, s.ng, -path.ray.direction);
}

BrightPatches patchesOf(const RayScene& rays, const Voxels& voxels, const RadianceField& field,
                        const RayGatherSettings& settings) {
  std::vector<GlowPoint> points(field.glow.points().begin(), field.glow.points().end());
  points.insert(points.end(), field.sunPoints.begin(), field.sunPoints.end());
  return BrightPatches(rays, voxels, points, field.glowShare, settings.nearVoxels * voxels.voxelSizeM, settings.seed);
}

}  // namespace

RayShader::RayShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
                     const RayGatherSettings& settings)
    : rays_(rays),
      lights_(lights),
      voxels_(voxels),
      field_(field),
      cache_(voxels, field),
      patches_(patchesOf(rays, voxels, field, settings)),
      settings_(settings),
      sharp_(rays, lights),
      scatter_(lights, voxels, field, patches_, sunGloss_, lights.lampCount() + lights.sunCount() > sharp_.count()) {
  if (lights.sunCount() == 1) {
    const LightSample sun = lights.sampleSun(0, {0.5f, 0.5f});
    sunDirection_ = sun.wi, sunColour_ = sun.radiance / luminance(sun.radiance);
    sunGloss_ = SunGloss(rays, voxels, patches_, sunDirection_);
  }
  double sum = 0, flux = 0, area = 0;
  for (size_t i = 0; i < voxels.slots.size(); ++i) {
    const float lux = luminance(field.irradianceLux[i]), areaM2 = voxels.slots[i].areaM2;
    sum += static_cast<double>(std::sqrt(lux) * areaM2), flux += static_cast<double>(lux * areaM2),
        area += static_cast<double>(areaM2);
  }
  if (area > 0)
    leastExpected_ = static_cast<float>(0.1 * sum * sum / (area * area)) / kPi,
    meanRadiance_ = static_cast<float>(flux / area) / kPi;
  findBrightest();
  if (!field.glowShare.empty()) markGlow();
  const Scene& scene = rays.scene();
  for (const Instance& i : scene.instances)
    kind_.push_back(kindOf(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)]));
}

void RayShader::shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
                      LayerSums* layers, const HitSurvey* survey, GatherCounters& count) const {
  static const HitSurvey kNone;
  thread_local GatherWork w;
  w.clear();
  w.shaded = light, w.survey = survey ? survey : &kNone, w.rareFrom = survey ? kRare : kInfinity;
  w.layers = layers, w.lightLayers = field_.layers.lights.get(),
  w.layersAlone = layers && !work.empty() && work[0].lampsKnown;
  for (size_t i = 0; i < work.size(); ++i)
    light[i] = start(work[i], static_cast<uint32_t>(i), shadows.subspan(work[i].firstShadow, sharp_.count()), w);
  traceShadows(w);
  while (!w.next.empty()) {
    w.paths.swap(w.next);
    w.next.clear();
    follow(w);
    traceShadows(w);
  }
  size_t first = 0;
  for (size_t i = 0; i < work.size(); ++i) {
    const auto n = static_cast<size_t>(estimates(work[i]));
    sumUp(std::span(w.found).subspan(first, n), std::span(w.rare).subspan(first, n),
          std::span(w.mirrored).subspan(first, n), light[i]);
    if (n > 1) light[i].reflected.scale(1 / static_cast<float>(n));
    first += n;
  }
  count.rays += w.rayCount;
}

// The mean of estimates, and its variance from how they differ.
void RayShader::sumUp(std::span<const Lobes> found, std::span<const Vec3> rare, std::span<const Vec3> mirrored,
                      SurfaceLight& out) {
  const auto n = static_cast<float>(found.size());
  Lobes mean;
  for (size_t i = 0; i < found.size(); ++i) {
    mean.diffuse += (found[i].diffuse - rare[i]) / n, mean.specular += (found[i].specular - mirrored[i]) / n;
    out.rare += rare[i] / n, out.mirrored += mirrored[i] / n;
  }
  out.diffuse += max(mean.diffuse, Vec3(0)), out.specular += max(mean.specular, Vec3(0));
  if (found.size() < 2) return;
  for (size_t i = 0; i < found.size(); ++i) {
    const Lobes& l = found[i];
    const float d = luminance(l.diffuse - rare[i] - mean.diffuse),
                s = luminance(l.specular - mirrored[i] - mean.specular);
    out.diffuseVariance += d * d / (n * (n - 1)), out.specularVariance += s * s / (n * (n - 1));
  }
}

// Sends all paths on by one ray.
void RayShader::follow(GatherWork& w) const {
  w.rays.clear();
  for (const GatherPath& p : w.paths) w.rays.push_back(p.ray);
  w.hits.resize(w.rays.size());
  rays_.intersect(w.rays, w.hits);
  w.rayCount += w.rays.size();
  prefetch(w);
  for (size_t i = 0; i < w.paths.size(); ++i) arrive(w.paths[i], w.hits[i], w);
  resolveUnsure(w);
}

// What is read where rays arrived: of the caches, or of the surface itself.
void RayShader::prefetch(GatherWork& w) const {
  w.places.clear(), w.cells.clear(), w.surfaces.clear();
  for (size_t i = 0; i < w.rays.size(); ++i) {
    const Hit& hit = w.hits[i];
    if (!hit.valid()) continue;
    const Vec3 d = w.rays[i].direction, p = w.rays[i].origin + d * hit.t;
    w.places.push_back(p);
    if ((kind_[hit.instance] & ~kGlossyKind) == 0 && !w.paths[i].clear) {
      w.cells.push_back({p, dot(hit.ng, d) < 0 ? hit.ng : -hit.ng, hit.instance});
      if (kind_[hit.instance] == kGlossyKind) w.surfaces.push_back(hit);
    } else {
      w.surfaces.push_back(hit);
    }
  }
  prefetchSurfaces(rays_.scene(), w.surfaces);
  cache_.prefetch(w.places);
  w.survey->hits.prefetch(w.cells);
}

// Sends out everything that lights a surface, and returns what is known at once.
SurfaceLight RayShader::start(const Shading& work, uint32_t index, std::span<const Shadow> shadows,
                              GatherWork& w) const {
  const SurfacePoint& s = work.s;
  const Bsdf bsdf(s.m, s.ns, s.ng, work.wo);
  GatherVertex v{s,    bsdf,          {Vec3(1), Vec3(1)}, brickSideAt(voxels_, s.p, s.ng), 0, 0,
                 true, work.followed, apart(work),        s.m.roughness < kClear};
  v.skyKnown = work.skyKnown, v.lampsKnown = work.lampsKnown;
  v.causticsKnown = !w.survey->caustics.empty() && s.material && !throwsLight(*s.material);
  SurfaceLight out;
  out.albedo = bsdf.diffuseAlbedo();
  if (v.causticsKnown && !w.arrivals && !isBlack(out.albedo)) out.sharp += addCaustics(s, bsdf, index, w);
  Sampler sampler = work.sampler;
  for (size_t i = 0; i < sharp_.count(); ++i) {
    const LightSample light = sharp_.sample(i, s.p, sampler.next2());
    if (!light.valid() || (work.lampsKnown && light.lamp >= 0)) continue;
    Lobes f = v.value(light.wi);
    if (light.pdf > 0) f.specular *= misWeight(light.pdf, bsdf.pdfSpecular(light.wi));
    const Lobes arrives{f.diffuse * light.radiance * shadows[i].left, f.specular * light.radiance * shadows[i].left};
    out.sharp += arrives.diffuse;
    (v.picture() ? out.mirrored : out.specular) += arrives.specular;
    if (w.layers) {
      const LightLayers& layers = *field_.layers.lights;
      const int32_t layer = light.lamp >= 0 ? layers.ofLamp[static_cast<size_t>(light.lamp)] : layers.sun;
      w.layers->add(index, LayerSums::kSharp, layer, arrives.diffuse);
      w.layers->add(index, v.picture() ? LayerSums::kRest : LayerSums::kSpecular, layer, arrives.specular);
    }
    const float l = luminance(f.diffuse * light.radiance);
    out.sharpVariance += l * l * shadows[i].variance;
  }
  const int n = estimates(work);
  const float most = n > 0 ? kMost * luminance(bsdf.albedo()) * expectedRadiance(s) : 0;
  v.glossOnly = work.gathers == 0;
  const GuideCones cones =
      n > 0 && !v.glossOnly && !w.survey->guide.empty() ? w.survey->guide.at(s.p, s.ng) : GuideCones{};
  if (cones.share > 0) v.cones = &cones;
  for (int k = 0; k < n; ++k) {
    v.estimate = static_cast<uint32_t>(w.samplers.size());
    w.samplers.push_back(sampler.split(static_cast<uint32_t>(k), static_cast<uint32_t>(n)));
    w.found.push_back({});
    w.rare.push_back({});
    w.mirrored.push_back({});
    w.most.push_back(most);
    w.expected.push_back(most < kInfinity ? most / kMost : 0);
    w.shadingOf.push_back(index);
    if (w.layers) w.part.push_back(1 / static_cast<float>(n));
    scatter_.from(v, w);
  }
  return out;
}

// What photons bring is reflected by the diffuse lobe, as if all came from one side.
Vec3 RayShader::addCaustics(const SurfacePoint& s, const Bsdf& bsdf, uint32_t index, GatherWork& w) {
  constexpr float kGrazing = 0.05f;
  NearCaustics& known = w.caustics;
  if (!known.holdsAt(s.p, s.ng)) {
    known.p = s.p, known.n = s.ng;
    known.byLayer.assign(w.layers ? w.lightLayers->size() : 0, {});
    known.light = w.survey->caustics.at(s.p, s.ng, known.byLayer);
  }
  const CausticMap::Light& caustic = known.light;
  if (isBlack(caustic.lux)) return {};
  const Vec3 reflected = bsdf.evaluateDiffuse(caustic.from) / std::max(kGrazing, dot(s.ng, caustic.from));
  for (size_t l = 0; l < known.byLayer.size(); ++l)
    w.layers->add(index, LayerSums::kSharp, static_cast<int32_t>(l), reflected * known.byLayer[l]);
  return reflected * caustic.lux;
}

void RayShader::arrivals(std::span<const Shading> work, std::vector<HitArrival>& out, GatherCounters& count) const {
  thread_local GatherWork w;
  w.clear();
  static const HitSurvey kNone;
  w.arrivals = &out, w.survey = &kNone;
  const std::vector<Shadow> none(sharp_.count());
  for (size_t i = 0; i < work.size(); ++i) start(work[i], static_cast<uint32_t>(i), none, w);
  while (!w.next.empty()) {
    w.paths.swap(w.next);
    w.next.clear();
    follow(w);
  }
  count.rays += w.rayCount;
}

float RayShader::found(const HitArrival& arrival, const HitCache& hits) const {
  if (const HitCell* cell = hits.find(arrival.at)) return luminance(cell->radianceCdM2);
  return arrival.slot < 0 ? 0 : luminance(cache_.radiance(arrival.slot));
}

// Of light that falls on a surface, by the cache. A path that finds far more than all paths together should is a rare
// one: what it finds is noise rather than picture, and is bounded. A slot may lie in the dark within a thing: then
// those around it tell, and meters are read as they are.
float RayShader::expectedRadiance(const SurfacePoint& s) const {
  if (!s.material) return kInfinity;
  const SlotCache::Place place = cache_.find(s.p, s.ng);
  if (place.slot < 0) return kInfinity;
  const float own = luminance(field_.irradianceLux[static_cast<size_t>(place.slot)]) / kPi;
  return own >= meanRadiance_ ? own : std::max(leastExpected_, brightestAround(s.p));
}

void RayShader::findBrightest() {
  std::vector<float>& own = ownBrightest_;
  own.resize(voxels_.voxels.size());
  parallelFor(own.size(), 8192, [&](size_t v) {
    const SurfaceVoxel& voxel = voxels_.voxels[v];
    const auto end = voxel.firstSlot + static_cast<uint32_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
    for (uint32_t slot = voxel.firstSlot; slot < end; ++slot)
      own[v] = std::max(own[v], luminance(field_.irradianceLux[slot]) / kPi);
  });
  brightest_ = own;
  parallelFor(voxels_.bricks.size(), 64, [&](size_t b) {
    const Int3 brick = voxels_.bricks[b].coord;
    for (int i = 0; i < kBrickSize * kBrickSize * kBrickSize; ++i) {
      const Int3 at{brick.x * kBrickSize + i % kBrickSize, brick.y * kBrickSize + i / kBrickSize % kBrickSize,
                    brick.z * kBrickSize + i / (kBrickSize * kBrickSize)};
      const int64_t voxel = voxels_.voxelAt(at);
      if (voxel < 0) continue;
      float most = own[static_cast<size_t>(voxel)];
      for (int k = 0; k < 27; ++k) {
        const int64_t beside = voxels_.voxelAt({at.x + k % 3 - 1, at.y + k / 3 % 3 - 1, at.z + k / 9 - 1});
        if (beside >= 0) most = std::max(most, own[static_cast<size_t>(beside)]);
      }
      brightest_[static_cast<size_t>(voxel)] = most;
    }
  });
}

// Of the slots around p: what faces it may be all that lights it.
float RayShader::brightestAround(Vec3 p) const {
  const Int3 at = voxels_.voxelOf(p);
  if (const int64_t voxel = voxels_.voxelAt(at); voxel >= 0) return brightest_[static_cast<size_t>(voxel)];
  float most = 0;
  for (int i = 0; i < 27; ++i) {
    const int64_t beside = voxels_.voxelAt({at.x + i % 3 - 1, at.y + i / 3 % 3 - 1, at.z + i / 9 - 1});
    if (beside >= 0) most = std::max(most, ownBrightest_[static_cast<size_t>(beside)]);
  }
  return most;
}

Vec3 RayShader::skyAlong(const GatherPath& path) const {
  if (!lights_.sky().present() || path.skyKnown) return {};
  const Vec2 uv = lights_.sky().toUv(path.ray.direction);
  return lights_.sky().radianceAt(uv) *
         (path.pdf > 0
              ? misWeight(path.pdf, pdfSkyGuided(field_.guide, guideOfSide(field_.guide, path.side), lights_, uv))
              : 1);
}

Vec3 RayShader::sunsAlong(const GatherPath& path) const {
  Vec3 sum;
  for (size_t i = 0; i < lights_.sunCount() && !path.sunKnown; ++i) {
    float pdf;
    const Vec3 disc = lights_.sunDisc(i, path.ray.direction, pdf);
    if (pdf > 0) sum += disc * (path.pdf > 0 ? misWeight(path.pdf, pdf) : 1);
  }
  return sum;
}

// Of a path that leaves the scene.
void RayShader::addBackground(const GatherPath& path, GatherWork& w) const {
  if (w.arrivals) return w.arrive(path, {}, {}, -1, false);
  const LightLayers* layers = w.layers ? field_.layers.lights.get() : nullptr;
  w.add(path.estimate, path.factor, skyAlong(path), LightOrigin::ofLayer(layers ? layers->sky : -1), path.depth == 1);
  const Vec3 suns = sunsAlong(path);
  if (isBlack(suns)) return;
  const LightOrigin origin = LightOrigin::ofLayer(layers ? layers->sun : -1);
  const Lobes added = w.add(path.estimate, withoutCaustics(path.factor, path.causticsKnown && path.depth > 1), suns,
                            origin, path.depth == 1);
  if (path.picture && path.depth == 1) w.takeMirrored(path.estimate, added.specular, origin);
}

// What a path finds where its ray ends, and how it goes on from there.
void RayShader::arrive(const GatherPath& path, const Hit& hit, GatherWork& w) const {
  if (!hit.valid()) {
    w.show(path, path.ray.origin + path.ray.direction * kFarM, -path.ray.direction);
    return addBackground(path, w);
  }
  const uint8_t kind = kind_[hit.instance];
  const bool lit = path.clear && !isFaint(path);  // afresh, as the picture that is seen
  if ((kind & ~kGlossyKind) == 0 && !lit) {
    const Vec3 d = path.ray.direction, n = normalize(dot(hit.ng, d) < 0 ? hit.ng : -hit.ng);
    if (cached(path, hit, path.ray.origin + d * hit.t, n, w)) return w.show(path, path.ray.origin + d * hit.t, n);
  }
  const SurfacePoint s = surfaceAt(rays_.scene(), hit, path.ray.direction);
  if (!(kind & kClearKind)) w.show(path, s.p, s.ng);
  if ((kind & kShines) && !w.arrivals) {
    if (const Vec3 emitted = s.emitted(); !isBlack(emitted) && !scatter_.isCached(path, hit.instance)) {
      LightOrigin origin;
      if (w.layers) origin = LightOrigin::ofLayer(layerOf(hit.instance), scatter_.weightInLayer(path, s));
      const Lobes added = w.add(path.estimate, withoutCaustics(path.factor, path.causticsKnown && path.depth > 1),
                                emitted * (path.pdf > 0 ? misWeight(path.pdf, scatter_.pdfEmitters(path, s)) : 1),
                                origin, path.depth == 1);
      if (path.picture && path.depth == 1) w.takeMirrored(path.estimate, added.specular, origin);
    }
  }
  if (!(kind & kClearKind)) {
    if (lit || (kind & kMirrorKind) || !cached(path, hit, s.p, s.ng, w)) goOn(path, s, w);
    return;
  }
  // Through it or reflected, one of the two, in proportion.
  const Vec3 through = passing(s.m, *s.material, std::abs(dot(s.ns, path.ray.direction)));
  const float p = luminance(through), q = s.m.alpha * luminance(bihemisphericalAlbedo(s.m)),
              chance = p + q > 0 ? p / (p + q) : 0;
  GatherPath after = path;
  if (w.samplers[path.estimate].fast1() < chance) {
    if (++after.panes > kMostPanes) return;
    after.factor = {path.factor.diffuse * through / chance, path.factor.specular * through / chance};
    after.ray.origin = offsetOrigin(s.p, -s.ng);
    w.next.push_back(after);
  } else if (q > 0) {
    const float stays = s.m.alpha / (1 - chance);
    after.factor = {path.factor.diffuse * stays, path.factor.specular * stays};
    if (lit || (path.causticsKnown && throwsLight(*s.material)) || !cached(after, hit, s.p, s.ng, w)) goOn(after, s, w);
  }
}

// Whether the light there comes from a cache, now or, if another ray must tell, later.
bool RayShader::cached(const GatherPath& path, const Hit& hit, Vec3 p, Vec3 n, GatherWork& w) const {
  const SlotCache::Place place = cache_.find(p, n);
  if (path.depth >= kDeepest) {
    if (place.slot < 0 || w.arrivals) return true;
    if (place.trust == Trust::Sure) {
      read(path, hit, place.slot, p, n, w);
    } else {
      w.doubts.push_back({path, hit, place.slot, p, n, nullptr});
    }
    return true;
  }
  if (path.clear) return cachedFaintly(path, hit, p, n, w);
  // Light beside lamps is in the slots alone.
  const bool glows = shinesBesideLamps(place.slot), inGlow = glows || isInGlow(p, n);
  // A cache tells too little of what is near what the eye sees; of light that gets there by way of other surfaces it
// tells enough.
  const float distance = path.depth < 2 ? length(p - path.from) : kInfinity;
  if (w.arrivals) {
    if (!glows && distance < kNearCells * settings_.hitCellM) return false;
    if (!inGlow) w.arrive(path, hit, {p, n, hit.instance}, place.slot, place.trust == Trust::Sure);
    return true;
  }
  if (const HitCell* cell = inGlow ? nullptr : w.survey->hits.find({p, n, hit.instance});
      cell && distance >= kNearCells * cell->sizeM) {
    if (cell->sure && place.trust == Trust::Sure) {
      readCell(path, hit, *cell, p, n, w);
    } else {
      w.doubts.push_back({path, hit, place.slot, p, n, cell});
    }
    return true;
  }
  const bool near = distance < settings_.nearVoxels * voxels_.voxelSizeM && !glows;
  if (near || place.trust == Trust::None) return false;
  if (place.trust == Trust::Sure) {
    read(path, hit, place.slot, p, n, w);
  } else {
    w.doubts.push_back({path, hit, place.slot, p, n, nullptr});
  }
  return true;
}

// Of what is seen faintly, as by night in a pane: cells around tell, each ray of another place, so that their edges do
// not show.
bool RayShader::cachedFaintly(const GatherPath& path, const Hit& hit, Vec3 p, Vec3 n, GatherWork& w) const {
  const float distance = length(p - path.from);
  if (w.arrivals) {
    if (distance < kNearCells * settings_.hitCellM) return false;
    const SlotCache::Place place = cache_.find(p, n);
    w.arrive(path, hit, {p, n, hit.instance}, place.slot, place.trust == Trust::Sure);
    return true;
  }
  const Frame plane(n);
  Sampler& sampler = w.samplers[path.estimate];
  const float u = sampler.fast1() - 0.5f, v = sampler.fast1() - 0.5f;
  const HitCell* here = w.survey->hits.find({p, n, hit.instance});
  if (!here || distance < kNearCells * here->sizeM) return false;
  const Vec3 beside = p + (plane.toWorld({u, v, 0})) * (kFaintCells * here->sizeM);
  const HitCell* cell = w.survey->hits.find({beside, n, hit.instance});
  if (!cell) cell = here;
  // Something may stand between the place and a cell beside it.
  if (cell == here && cell->sure) {
    readCell(path, hit, *cell, p, n, w);
  } else {
    w.doubts.push_back({path, hit, -1, p, n, cell});
  }
  return true;
}

// Voxels with slots that shine beside lamps, and those around them.
void RayShader::markGlow() {
  nearGlow_.assign(voxels_.bricks.size(), {});
  for (const Brick& brick : voxels_.bricks) {
    size_t record = brick.firstVoxel;
    for (int z = 0; z < kBrickSize; ++z) {
      for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1, ++record) {
        const SurfaceVoxel& voxel = voxels_.voxels[record];
        const auto end = voxel.firstSlot + static_cast<uint32_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
        bool shines = false;
        for (uint32_t slot = voxel.firstSlot; slot < end; ++slot) shines = shines || shinesBesideLamps(slot);
        const int bit = std::countr_zero(bits);
        if (shines)
          markAround({kBrickSize * brick.coord.x + bit % kBrickSize, kBrickSize * brick.coord.y + bit / kBrickSize,
                      kBrickSize * brick.coord.z + z});
      }
    }
  }
}

void RayShader::markAround(Int3 voxel) {
  for (int k = 0; k < 27; ++k) {
    const Int3 v{voxel.x + k % 3 - 1, voxel.y + k / 3 % 3 - 1, voxel.z + k / 9 - 1};
    const int32_t brick =
        v.x < 0 || v.y < 0 || v.z < 0 ? -1 : voxels_.brickAt({v.x / kBrickSize, v.y / kBrickSize, v.z / kBrickSize});
    if (brick >= 0)
      nearGlow_[static_cast<size_t>(brick)][static_cast<size_t>(v.z % kBrickSize)] |=
          uint64_t{1} << (v.x % kBrickSize + kBrickSize * (v.y % kBrickSize));
  }
}

// False where no slot around p shines beside lamps.
bool RayShader::mayBeInGlow(Int3 v) const {
  if (nearGlow_.empty()) return false;
  if (v.x < 0 || v.y < 0 || v.z < 0) return true;
  const int32_t brick = voxels_.brickAt({v.x / kBrickSize, v.y / kBrickSize, v.z / kBrickSize});
  return brick < 0 || (nearGlow_[static_cast<size_t>(brick)][static_cast<size_t>(v.z % kBrickSize)] >>
                           (v.x % kBrickSize + kBrickSize * (v.y % kBrickSize)) &
                       1);
}

// Whether points stand for all that it reflects of a lamp which it lies near: what comes by way of other surfaces
// there, too.
bool RayShader::isInGlow(Vec3 p, Vec3 n) const {
  const Int3 v = voxels_.voxelOf(p);
  if (!mayBeInGlow(v)) return false;
  if (shinesBesideLamps(cache_.find(p, n).slot)) return true;
  // The slot found may be another one than that which took the light there.
  for (int i = 0; i < 27; ++i) {
    const int64_t found = voxels_.voxelAt({v.x + i % 3 - 1, v.y + i / 3 % 3 - 1, v.z + i / 9 - 1});
    if (found < 0) continue;
    const SurfaceVoxel& voxel = voxels_.voxels[static_cast<size_t>(found)];
    const auto end = voxel.firstSlot + static_cast<uint32_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
    for (uint32_t slot = voxel.firstSlot; slot < end; ++slot) {
      if (shinesBesideLamps(slot) && dot(voxels_.slots[slot].normal, n) > kAlike) return true;
    }
  }
  return false;
}

// Lights the surface afresh.
void RayShader::goOn(const GatherPath& path, SurfacePoint s, GatherWork& w) const {
  if (path.depth >= kMostVertices) return;
  const Bsdf bsdf(s.m, s.ns, s.ng, -path.ray.direction);
  const bool clear = path.clear && s.m.roughness < kClear;
  GatherVertex v{s,     bsdf,  path.factor, brickSideAt(voxels_, s.p, s.ng), path.estimate, path.depth, false, false,
                 false, clear, !path.clear};
  const std::optional<Bsdf> blunt = bluntFor(path, s);
  v.blunt = blunt ? &*blunt : nullptr;
  v.causticsKnown = path.causticsKnown && throwsLight(*s.material);
  v.inGlow = !path.clear && !isPolishedMetal(*s.material) && isInGlow(s.p, s.ng);
  scatter_.from(v, w);
}

// What the points of LampGlow give is left to them.
void RayShader::read(const GatherPath& path, const Hit& hit, int64_t slot, Vec3 p, Vec3 n, GatherWork& w) const {
  // The slot's albedo is that of what does not let light through, of the instance that has most of it.
  const auto i = static_cast<size_t>(slot);
  const bool own = hit.instance == cache_.instance(slot) && !(kind_[hit.instance] & kClearKind);
  const Vec3 even = own ? cache_.radiance(slot)
                        : bihemisphericalAlbedo(materialAt(rays_.scene(), hit)) * field_.irradianceLux[i] / kPi;
  const CachedLight light{even, luminance(field_.irradianceLux[i]), field_.sunLux.empty() ? 0 : field_.sunLux[i],
                          voxels_.slots[i].normal, slot};
  const LeftToPoints points = leftToPoints(path, light, p, n);
  const SlotLayers& layers = field_.layers;
  addCached(path, hit, light, points,
            {-1, w.layers ? layers.at(i) : nullptr, 1, points.glow, points.sun,
             w.layers && points.glow > 0 ? layers.glowOf[i] : -1},
            w);
}

void RayShader::readCell(const GatherPath& path, const Hit& hit, const HitCell& cell, Vec3 p, Vec3 n,
                         GatherWork& w) const {
  // In a picture noise is filtered, light told by what lies beside would be seen, and so is a texture.
  const Vec3 even =
      path.clear ? bihemisphericalAlbedo(materialAt(rays_.scene(), hit)) * cell.ownCdM2 : cell.radianceCdM2;
  const CachedLight light{even, path.clear ? cell.ownLux : cell.lux, cell.sunLux, cell.normal, cell.slot};
  const LeftToPoints points = leftToPoints(path, light, p, n);
  addCached(path, hit, light, points,
            {-1, w.layers ? w.survey->hits.shares(cell) : nullptr, 1, points.glow, points.sun, -1}, w);
}

// Of light as it is spread evenly points take their part; what the sun's differs from that is added. `origin`: of that
// spread evenly.
void RayShader::addCached(const GatherPath& path, const Hit& hit, const CachedLight& light, const LeftToPoints& points,
                          const LightOrigin& origin, GatherWork& w) const {
  Vec3 ofRay = light.even * points.ray(),
       bent = light.sunLux > 0 ? max(-light.even, sunward(path, hit, light.sunLux, light.normal)) : Vec3(0);
  bent *= 1 - points.ofSun;
  if ((kind_[hit.instance] & kGlossyKind) && path.depth < kDeepest && !path.clear && !shinesBesideLamps(light.slot)) {
    const Vec3 glossy = leaveToGloss(path, hit, light, w);
    // What the sun has in it is spread evenly all the same: its gloss is in `bent`.
    const float sun = light.lux > 0 ? std::clamp(light.sunLux / light.lux - points.sun, 0.0f, points.ray()) : 0;
    bent += sunColour_ * (luminance(light.even * glossy) * sun), ofRay *= Vec3(1) - glossy;
  }
  const Vec3 radiance = max(Vec3(0), ofRay + bent);
  const Lobes added = w.add(path.estimate, path.factor, radiance, {});
  if (!w.layers || isBlack(added.diffuse + added.specular)) return;
  // The cache's shares are of the light as it is spread evenly: what the sun's differs from that is the sun's.
  const Vec3 ofEven = ofRay / max(radiance, Vec3(1e-20f)), ofSun = Vec3(1) - ofEven;
  w.addToLayers(path.estimate, {added.diffuse * ofEven, added.specular * ofEven}, origin);
  if (!isBlack(ofSun))
    w.addToLayers(path.estimate, {added.diffuse * ofSun, added.specular * ofSun},
                  LightOrigin::ofLayer(field_.layers.lights->sun));
}

Vec3 RayShader::leaveToGloss(const GatherPath& path, const Hit& hit, const CachedLight& light, GatherWork& w) const {
  SurfacePoint s = surfaceAt(rays_.scene(), hit, path.ray.direction);
  const Vec3 all = bihemisphericalAlbedo(s.m);
  if (s.m.roughness >= kGlossy || s.m.metallic > kMetal || isInGlow(s.p, s.ng)) return {};
  const Bsdf bsdf(s.m, s.ns, s.ng, -path.ray.direction);
  const float glossy = luminance(bsdf.specularAlbedo()), sum = glossy + luminance(bsdf.diffuseAlbedo());
  if (!(glossy > 0)) return {};
  const float chance = glossy / sum;
  if (w.samplers[path.estimate].fast1() < chance) {
    GatherVertex v{s,     bsdf,  path.factor, brickSideAt(voxels_, s.p, s.ng), path.estimate, path.depth, false,
                   false, false, false};
    const std::optional<Bsdf> blunt = bluntFor(path, s);
    v.blunt = blunt ? &*blunt : nullptr;
    v.gloss = 1 / chance, v.sunKnown = lights_.sunCount() == 1;
    scatter_.from(v, w);
  }
  // The cache's albedo is a mean over a texture; a lobe reflects as much wherever that is dark.
  const float cached = light.lux > 0 ? kPi * luminance(light.even) / light.lux : 0;
  const float scale = luminance(all) / std::max(cached, kLeastAlbedo);
  return min(max(all - bsdf.diffuseAlbedo(), Vec3(0)) / max(all, Vec3(kLeastAlbedo)) * scale, Vec3(1));
}

RayShader::LeftToPoints RayShader::leftToPoints(const GatherPath& path, const CachedLight& light, Vec3 p,
                                                Vec3 n) const {
  // Of what is seen as a picture points give nothing.
  if (path.clear || !(path.pdf > 0) || patches_.empty() || light.slot < 0) return {};
  const auto i = static_cast<size_t>(light.slot);
  const float luminous = luminance(light.even);
  const float distance = length(p - path.from);
  const bool near = distance < settings_.nearVoxels * voxels_.voxelSizeM;
  const float sun = near || !patches_.holdsSun(light.slot) ? 0
                                                           : std::min(1.0f, light.sunLux / std::max(light.lux, 1e-30f)),
              glow = field_.glowShare.empty() ? 0 : field_.glowShare[i];
  const auto left = [&](float share) {
    return share > 0 ? share * (1 - patches_.rayShare(light.slot, share * luminous, distance,
                                                      -dot(n, path.ray.direction), path.side, path.pdf))
                     : 0;
  };
  const float leftOfSun = left(sun);
  return {path.inGlow ? glow : left(glow), leftOfSun, sun > 0 ? leftOfSun / sun : 0};
}

// Sunlight that a surface throws on towards the path, less what the cache spreads evenly of it.
Vec3 RayShader::sunward(const GatherPath& path, const Hit& hit, float sunLux, Vec3 normal) const {
  return sunColour_ * (sunLux * SunGloss::bend(surfaceAt(rays_.scene(), hit, path.ray.direction), normal, sunDirection_,
                                               -path.ray.direction));
}

void RayShader::resolveUnsure(GatherWork& w) const {
  w.rays.clear();
  for (const GatherWork::Doubt& d : w.doubts)
    w.rays.push_back(d.cell ? HitCache::between(*d.cell, {d.p, d.n, d.hit.instance})
                            : cache_.between(d.slot, d.p, d.n));
  w.left.resize(w.rays.size());
  rays_.transmittance(w.rays, w.left);
  w.rayCount += w.rays.size();
  for (size_t i = 0; i < w.doubts.size(); ++i) {
    const GatherWork::Doubt& d = w.doubts[i];
    const bool free = luminance(w.left[i]) > 0.25f;
    if (free && d.cell) {
      readCell(d.path, d.hit, *d.cell, d.p, d.n, w);
    } else if (free) {
      read(d.path, d.hit, d.slot, d.p, d.n, w);
    } else if (d.path.depth < kDeepest) {
      goOn(d.path, surfaceAt(rays_.scene(), d.hit, d.path.ray.direction), w);
    }
  }
  w.doubts.clear();
}

void RayShader::traceShadows(GatherWork& w) const {
  w.left.resize(w.shadowRays.size());
  rays_.transmittance(w.shadowRays, w.left);
  w.rayCount += w.shadowRays.size();
  for (size_t i = 0; i < w.shadowed.size(); ++i) {
    const GatherWork::Shadowed& s = w.shadowed[i];
    if (s.layersOnly) {
      const Lobes light{s.light.diffuse * w.left[i], s.light.specular * w.left[i]};
      w.addToLayers(s.estimate, light, s.origin);
      if (s.mirrored) w.takeMirroredOfLayer(s.estimate, light.specular, s.origin);
    } else {
      const Lobes added = w.add(s.estimate, s.light, w.left[i], s.origin, s.sure);
      if (s.mirrored) w.takeMirrored(s.estimate, added.specular, s.origin);
    }
  }
  w.shadowRays.clear(), w.shadowed.clear();
}

}  // namespace roomlight
