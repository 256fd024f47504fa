#include "gather/ray_scatter.h"

#include "base/sampling.h"
#include "filter/filter.h"
#include "radiance/sky_guide.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr float kNothing = 1e-4f;
constexpr float kPictureShare =
    1.0f / 64;  // of layers' light from lamps comes from the picture's own samples: where it has light they have, too
constexpr float kOften = 0.25f;  // of the strongest lamp's light: what gives as much is always asked
constexpr float kDoubt = 0.125f;  // chance to ask a layer that seems not to reach a place
constexpr float kLittle = 0.15f, kSeldom = 1.0f / 16;  // of the light expected; chance to ask all the same
constexpr float kNudge = 0.05f;  // voxels
constexpr float kUnguided =
    10;  // times its mean: the most that a sample of the sky stands for, of those that no guide leads
constexpr uint64_t kLayerKey = 0x1a7e25;  // other random numbers than the picture's

}  // namespace

RayScatter::RayScatter(const Lights& lights, const Voxels& voxels, const RadianceField& field,
                       const BrightPatches& patches, const SunGloss& sunGloss, bool sampleLamps)
    : lights_(lights),
      voxels_(voxels),
      field_(field),
      patches_(patches),
      sunGloss_(sunGloss),
      sampleLamps_(sampleLamps),
      besideEmitters_(emitterSurroundings(lights, voxels.voxelSizeM)) {
  for (size_t i = 0; i < lights.lampCount(); ++i) besideLamps_.emplace_back(lights.lamp(i), voxels.voxelSizeM);
  if (field.layers.empty()) return;
  const LightLayers& layers = *field.layers.lights;
  members_.resize(layers.size());
  for (uint32_t i = 0; i < lights.lampCount(); ++i) members_[static_cast<size_t>(layers.ofLamp[i])].lamps.push_back(i);
  for (uint32_t i = 0; i < lights.emitterCount(); ++i)
    members_[static_cast<size_t>(layers.ofEmitter[i])].emitters.push_back(i);
}

void GatherWork::addToLayers(uint32_t estimate, const Lobes& light, const LightOrigin& origin) {
  const float by = part[estimate] * origin.weight;
  const size_t shading = shadingOf[estimate];
  const auto addTo = [&](LayerSums::Part lobe, Vec3 l) {
    if (isBlack(l)) return;
    if (!origin.shares) return layers->add(shading, lobe, origin.layer, l * by);
    // Without what points have taken the rest of the light is more; of that each layer has its share, less what was
    // taken of it.
    const Vec3 whole = l * (by / std::max(1 - origin.glow - origin.sun, 1e-3f));
    layers->addShares(shading, lobe, origin.shares, whole);
    if (origin.glow > 0) layers->add(shading, lobe, origin.glowOf, whole * -origin.glow);
    if (origin.sun > 0) layers->add(shading, lobe, lightLayers->sun, whole * -origin.sun);
  };
  addTo(LayerSums::kDiffuse, light.diffuse);
  addTo(LayerSums::kSpecular, light.specular);
}

void GatherWork::takeMirrored(uint32_t estimate, Vec3 specular, const LightOrigin& origin) {
  mirrored[estimate] += specular;
  if (layers) takeMirroredOfLayer(estimate, specular, origin);
}

void GatherWork::takeMirroredOfLayer(uint32_t estimate, Vec3 specular, const LightOrigin& origin) {
  const Vec3 light = specular * (part[estimate] * origin.weight);
  layers->add(shadingOf[estimate], LayerSums::kSpecular, origin.layer, -light);
  layers->add(shadingOf[estimate], LayerSums::kRest, origin.layer, light);
}

// Sends rays from a surface: to lights, and on to other surfaces.
void RayScatter::from(const GatherVertex& v, GatherWork& w) const {
  if (w.arrivals) return gatherAt(v, w);
  // What is drawn from large tables is fetched from memory while other light is asked for.
  const DrawnSky sky = drawSky(v, w);
  const BrightPatches::Candidates patches = patches_.draw(v.side, w.samplers[v.estimate]);
  lightsAt(v, sky, w);
  glowAt(v, patches, w);
  gatherAt(v, w);
}

float RayScatter::cosinePdf(const GatherVertex& v, Vec3 wi) { return std::max(0.0f, dot(wi, v.s.ns)) / kPi; }

void RayScatter::takeLight(const GatherVertex& v, const LightSample& light, bool isWide, const LightOrigin& origin,
                           bool layersOnly, GatherWork& w) const {
  if (!light.valid() || dot(light.wi, v.s.ng) <= 0) return;
  const bool blunt = v.blunt && !isWide;
  Lobes f = blunt ? v.later(*v.blunt, light.wi) : v.value(light.wi);
  if (light.pdf > 0 && !blunt) {
    // Rays that gather find the same lights; the two share them by multiple importance sampling.
    if (v.apart) {
      f.diffuse *= misWeight(light.pdf, v.guided(cosinePdf(v, light.wi), light.wi));
      f.specular *= misWeight(light.pdf, v.bsdf.pdfSpecular(light.wi));
    } else {
      const float weight =
          misWeight(light.pdf, v.guided(v.followed ? cosinePdf(v, light.wi) : v.pdf(light.wi), light.wi));
      f.diffuse *= weight, f.specular *= weight;
    }
  }
  const Lobes sum{f.diffuse * light.radiance, f.specular * light.radiance};
  const float likeIt =
      light.emitter >= 0 ? static_cast<float>(emitterSamples(v.depth)) : 1;  // samples that share a kind of light
  const float weight = w.layers || v.picture()
                           ? 1
                           : askingWeight(likeIt * luminance(sum.diffuse + sum.specular), v.estimate,
                                          w);  // what gives the picture little may be all that a layer has
  if (weight > 0 && (!isBlack(sum.diffuse) || !isBlack(sum.specular)))
    w.shadow(shadowRay(offsetOrigin(v.s.p, v.s.ng), v.s.p, light), {v.estimate,
                                                                    v.first,
                                                                    layersOnly,
                                                                    v.picture() && light.emitter >= 0,
                                                                    {sum.diffuse * weight, sum.specular * weight},
                                                                    origin});
}

// What can give little beside the light expected is seldom asked for, and counts for more then; 0: not now. `most`:
// luminance that it could give.
float RayScatter::askingWeight(float most, uint32_t estimate, GatherWork& w) {
  const float worth = most / (kLittle * w.expected[estimate]);
  if (!(worth < 1)) return 1;
  const float chance = std::max(worth, kSeldom);
  return w.samplers[estimate].fast1() < chance ? 1 / chance : 0;
}

void RayScatter::lightsAt(const GatherVertex& v, const DrawnSky& sky, GatherWork& w) const {
  Sampler& sampler = w.samplers[v.estimate];
  const LightLayers* layers = field_.layers.lights.get();
  const bool asksLayers = w.layers && v.depth <= 1;
  GatherVertex local = v;  // for suns, lamps and emissive meshes
  if (!v.first) local.factor = withoutCaustics(v.factor, v.causticsKnown);
  if (asksLayers) layersAt(local, w);
  const auto take = [&](const LightSample& light, int32_t layer, float weight = 1) {
    takeLight(local, light, light.emitter >= 0, LightOrigin::ofLayer(layer, weight), false, w);
  };
  const auto takeLocal = [&](const LightSample& light) {
    take(light, layers ? layers->of(light) : -1, asksLayers && (v.first || light.lamp >= 0) ? kPictureShare : 1);
  };
  if (v.first) {
    if (sampleLamps_ && !v.lampsKnown) takeLocal(field_.seen.sampleLamps(lights_, v.s.p, v.side, sampler));
  } else {
    if (lights_.lampCount() > 0 && !(asksLayers && w.layersAlone)) {
      const LightSample lamp = field_.seen.sampleLamps(lights_, v.s.p, v.side, sampler);
      if (!leavesToCache(v, lamp)) takeLocal(lamp);
    }
    for (size_t i = 0; i < lights_.sunCount() && !v.sunKnown; ++i)
      take(lights_.sampleSun(i, sampler.next2()), layers ? layers->sun : -1);
  }
  if (lights_.hasEmitters()) {
    const size_t n = emitterSamples(v.depth);
    std::array<Vec2, kEmitterSamples> u;
    std::array<LightSample, kEmitterSamples> some;
    const float choice = sampler.next1();
    for (size_t k = 0; k < n; ++k) u[k] = sampler.next2();
    field_.seen.sampleEmitters(lights_, v.s.p, v.side, std::span(u).first(n), choice, std::span(some).first(n));
    for (size_t k = 0; k < n; ++k) {
      if (!leavesToCache(v, some[k])) takeLocal(some[k]);
    }
  }
  if (!(sky.weight > 0)) return;
  LightSample light = skyLight(lights_, sky.sample);
  light.radiance *= sky.weight;
  takeLight(v, light, true, LightOrigin::ofLayer(layers ? layers->sky : -1), false, w);
}

// Seldom where the sky can give little beside the light expected, as by night: the draw itself, from large tables,
// costs as much as a ray.
RayScatter::DrawnSky RayScatter::drawSky(const GatherVertex& v, GatherWork& w) const {
  if (!lights_.sky().present() || v.skyKnown) return {};
  Sampler& sampler = w.samplers[v.estimate];
  DrawnSky out{{}, 1};
  if (!w.layers) {
    const float white =
        4 * kUnguided * luminance(lights_.sky().mean());  // cd/m², of a white surface that all the sky lights
    out.weight = askingWeight(
        white * luminance(v.bsdf.albedo() * (v.first ? Vec3(1) : v.factor.diffuse + v.factor.specular)), v.estimate, w);
    if (!(out.weight > 0)) return {};
  }
  const Vec2 u = sampler.next2();
  out.sample = drawSkyGuided(field_.guide, guideOfSide(field_.guide, v.side), lights_, u, sampler.next1());
  return out;
}

// A sample of each layer's lamps and emissive meshes for what the camera sees, and of its lamps for what is lit afresh
// right behind that, where the picture itself has one of them all: else a layer would have the noise of that choice.
// Layers that no slot near sees are asked now and then, so that nothing is lost.
void RayScatter::layersAt(const GatherVertex& v, GatherWork& w) const {
  Sampler sampler = w.samplers[v.estimate].forked(kLayerKey);
  const Int3 at = voxels_.voxelOf(v.s.p + v.s.ng * (kNudge * voxels_.voxelSizeM));
  const int32_t brick = at.x < 0 || at.y < 0 || at.z < 0
                            ? -1
                            : voxels_.brickAt({at.x / kBrickSize, at.y / kBrickSize, at.z / kBrickSize});
  // A meter in the air is no surface of the scene: what slots near it see says little of it.
  const uint64_t reach = brick < 0 || !v.s.material ? ~uint64_t{0} : field_.layers.reach[static_cast<size_t>(brick)];
  if (!v.first && w.layersAlone) return lampsOfMeterAt(v, reach, w);
  const bool lamps = !v.first || asksLamps(v.lampsKnown);
  for (size_t l = 0; l < members_.size(); ++l) {
    if ((members_[l].lamps.empty() || !lamps) && (members_[l].emitters.empty() || !v.first)) continue;
    float weight = 1 - kPictureShare;
    if (!((reach >> l) & 1)) {
      if (sampler.fast1() >= kDoubt) continue;
      weight /= kDoubt;
    }
    const int n = layerSamples(v.depth);
    for (int k = 0; k < n; ++k) {
      LightSample light = sampleLayer(l, v.s.p, lamps, v.first, sampler);
      light.radiance *= 1 / static_cast<float>(n), light.pdf *= static_cast<float>(n);
      if (v.first || !leavesToCache(v, light))
        takeLight(v, light, light.emitter >= 0, LightOrigin::ofLayer(static_cast<int32_t>(l), weight), true, w);
    }
  }
}

// What lamps give a place that a meter's light comes from. Those that can give little there beside the strongest are
// asked as much more rarely: with dozens of candidates most rays would go to them. Whoever reads meters by layers does
// not want the sum of all light.
void RayScatter::lampsOfMeterAt(const GatherVertex& v, uint64_t reach, GatherWork& w) const {
  thread_local std::vector<float> importance;
  importance.resize(lights_.lampCount());
  float strongest = 0;
  for (size_t i = 0; i < importance.size(); ++i)
    strongest = std::max(strongest, importance[i] = lights_.lampImportance(i, v.s.p));
  Sampler sampler = w.samplers[v.estimate].forked(kLayerKey);
  for (size_t i = 0; i < importance.size(); ++i) {
    const int32_t layer = field_.layers.lights->ofLamp[i];
    float chance = std::min(1.0f, importance[i] / (kOften * strongest));
    if (!((reach >> layer) & 1)) chance *= kDoubt;
    if (!(chance > 0) || sampler.fast1() >= chance) continue;
    LightSample light = lights_.sampleLamp(i, v.s.p, sampler.next2());
    light.radiance *= 1 / chance;
    if (!leavesToCache(v, light)) takeLight(v, light, false, LightOrigin::ofLayer(layer), true, w);
  }
}

// One of its lights, chosen by what each could give at p without shadows.
LightSample RayScatter::sampleLayer(size_t layer, Vec3 p, bool withLamps, bool withEmitters, Sampler& sampler) const {
  const Members& m = members_[layer];
  const auto weigh = [&](size_t i) {
    if (i >= m.lamps.size()) return withEmitters ? lights_.emitterImportance(m.emitters[i - m.lamps.size()], p) : 0;
    return withLamps ? lights_.lampImportance(m.lamps[i], p) : 0;
  };
  const size_t count = m.lamps.size() + m.emitters.size();
  float total = 0;
  for (size_t i = 0; i < count; ++i) total += weigh(i);
  if (!(total > 0)) return {};
  const Vec2 u = sampler.next2();
  float rest = sampler.next1();
  const size_t i = chooseByWeight(count, total, weigh, rest);
  const float chance = weigh(i) / total;
  LightSample light = i < m.lamps.size() ? lights_.sampleLamp(m.lamps[i], p, u)
                                         : lights_.sampleEmitter(m.emitters[i - m.lamps.size()], p, u, rest);
  light.radiance *= 1 / chance, light.pdf *= chance;
  return light;
}

float RayScatter::pdfEmitters(const GatherPath& path, const SurfacePoint& s) const {
  return static_cast<float>(emitterSamples(path.depth - 1)) * field_.seen.pdfEmitters(lights_, path.from, path.side, s);
}

float RayScatter::weightInLayer(const GatherPath& path, const SurfacePoint& s) const {
  const int32_t emitter = lights_.emitterOf(s.instance);
  if (emitter < 0 || path.pdf <= 0 || path.depth > 1) return 1;
  const Members& m = members_[static_cast<size_t>(field_.layers.lights->ofEmitter[static_cast<size_t>(emitter)])];
  float total = 0;
  for (const uint32_t i : m.lamps) total += asksLamps(path.lampsKnown) ? lights_.lampImportance(i, path.from) : 0;
  for (const uint32_t i : m.emitters) total += lights_.emitterImportance(i, path.from);
  const auto index = static_cast<size_t>(emitter);
  const float pdf = total > 0 ? static_cast<float>(layerSamples(path.depth - 1)) *
                                    lights_.emitterImportance(index, path.from) / total *
                                    lights_.pdfEmitter(index, path.from, s)
                              : 0;
  const float own = misWeight(path.pdf, pdf), inPicture = misWeight(path.pdf, pdfEmitters(path, s));
  return kPictureShare + (1 - kPictureShare) * own / std::max(inPicture, 1e-20f);
}

// Whether it lies in the surroundings of the lamp or emissive mesh sampled from there: what surfaces reflect of its
// light is in the cache and in LampGlow, and is not found a second time by paths that go on. Polished metal reflects
// emissive meshes as they are.
bool RayScatter::leavesToCache(const GatherVertex& v, const LightSample& light) const {
  if (!light.valid() || !v.leavesNear) return false;
  if (light.emitter >= 0)
    return !isPolishedMetal(*v.s.material) && besideEmitters_[static_cast<size_t>(light.emitter)].contains(v.s.p);
  return besideLamps_[static_cast<size_t>(light.lamp)].contains(v.s.p);
}

bool RayScatter::isCached(const GatherPath& path, uint32_t instance) const {
  const int32_t emitter = lights_.emitterOf(instance);
  return path.leavesNear && emitter >= 0 && besideEmitters_[static_cast<size_t>(emitter)].contains(path.from);
}

// Whether p lies in the surroundings of the lamp or emissive mesh whose light the point reflects.
bool RayScatter::isBeside(const GlowPoint& point, Vec3 p) const {
  return (point.lamp >= 0 && besideLamps_[static_cast<size_t>(point.lamp)].contains(p)) ||
         (point.emitter >= 0 && besideEmitters_[static_cast<size_t>(point.emitter)].contains(p));
}

int32_t RayScatter::layerOf(const LightLayers& layers, const GlowPoint& point) {
  if (BrightPatches::isSun(point)) return layers.sun;
  return point.lamp >= 0 ? layers.ofLamp[static_cast<size_t>(point.lamp)]
                         : layers.ofEmitter[static_cast<size_t>(point.emitter)];
}

// Light that bright patches reflect, as far as gathering rays leave it to points of them.
void RayScatter::glowAt(const GatherVertex& v, const BrightPatches::Candidates& drawn, GatherWork& w) const {
  if (drawn.count == 0) return;
  const GlowSample g = patches_.choose(drawn, v.s.p, v.s.ns, w.samplers[v.estimate]);
  if (!g.light.valid() || dot(g.light.wi, v.s.ng) <= 0 || (v.inGlow && isBeside(patches_.point(g.point), v.s.p)))
    return;
  const Vec3 wi = g.light.wi;
  Lobes f = v.value(wi);
  const float cosine = v.guided(cosinePdf(v, wi), wi), mixed = v.guided(v.pdf(wi), wi);
  const float density = patches_.densityAt(g.point, v.s.p, v.side);
  f.diffuse *= BrightPatches::pointShare(density, v.apart || v.followed ? cosine : mixed);
  f.specular *= v.clear && v.apart ? 0 : BrightPatches::pointShare(density, v.apart ? v.bsdf.pdfSpecular(wi) : mixed);
  if (isBlack(f.diffuse) && isBlack(f.specular)) return;
  const Vec3 radiance = g.light.radiance * sunGloss_.at(g.point, -wi);
  Lobes sum{f.diffuse * radiance, f.specular * radiance};
  if (v.first && v.causticsKnown && patches_.point(g.point).onMetal) sum.diffuse = {};
  const float weight = w.layers ? 1 : askingWeight(luminance(sum.diffuse + sum.specular), v.estimate, w);
  if (!(weight > 0)) return;
  sum.diffuse *= weight, sum.specular *= weight;
  const GlowPoint& point = patches_.point(g.point);
  const LightLayers* layers = field_.layers.lights.get();
  const int32_t layer = layers ? layerOf(*layers, point) : -1;
  if (!isBlack(sum.diffuse) || !isBlack(sum.specular))
    w.shadow(shadowRay(offsetOrigin(v.s.p, v.s.ng), v.s.p, g.light),
             {v.estimate, false, false, false, sum, LightOrigin::ofLayer(layer)});
}

void RayScatter::gatherAt(const GatherVertex& v, GatherWork& w) const {
  Sampler& sampler = w.samplers[v.estimate];
  const Vec3 origin = offsetOrigin(v.s.p, v.s.ng);
  const auto send = [&](Vec3 d, const Lobes& factor, float pdf, bool clear, float spread) {
    if (dot(d, v.s.ng) <= 0 || std::max(maxComponent(factor.diffuse), maxComponent(factor.specular)) < kNothing) return;
    w.next.push_back({{origin, d, 0, kInfinity},
                      factor,
                      v.s.p,
                      pdf,
                      v.side,
                      v.estimate,
                      static_cast<uint8_t>(v.depth + 1),
                      0,
                      clear,
                      v.skyKnown,
                      v.inGlow,
                      v.leavesNear && !isPolishedMetal(*v.s.material),
                      v.lampsKnown,
                      v.causticsKnown,
                      clear && v.picture(),
                      spread,
                      v.sunKnown || v.blunt});
  };
  if (!v.first) {
    const Vec2 u = sampler.next2();
    BsdfSample b = v.gloss > 0 ? v.bsdf.sampleSpecular(u) : v.bsdf.sample(u, sampler.next1());
    if (!b.valid()) return;
    if (v.gloss > 0) b.weight *= v.gloss;
    const float survive = std::clamp(maxComponent(b.weight), 0.05f, 1.0f);
    if (sampler.next1() >= survive) return;
    const Vec3 weight = b.weight / survive;
    return send(b.wi, {v.factor.diffuse * weight, v.factor.specular * weight}, b.mirror ? 0 : b.pdf,
                v.clear && b.mirror, v.clear && b.mirror ? 0 : kSpread);
  }
  const bool diffuseOnly = v.apart || v.followed;
  const Vec2 u = sampler.next2();
  const float choice = v.cones ? sampler.next1() : 1;
  const bool guided = v.cones && choice < v.cones->share;
  if (!diffuseOnly) {
    const BsdfSample b = guided ? BsdfSample{} : v.bsdf.sample(u, sampler.next1());
    const Vec3 d = guided ? v.cones->sample(u, choice / v.cones->share) : b.wi;
    if (guided || (b.valid() && !b.mirror)) {
      const float pdf = v.guided(guided ? v.bsdf.pdf(d) : b.pdf, d);
      if (pdf > 0) send(d, {v.bsdf.evaluateDiffuse(d) / pdf, v.bsdf.evaluateSpecular(d) / pdf}, pdf, false, kSpread);
    }
  } else if (!v.glossOnly && maxComponent(v.bsdf.diffuseAlbedo()) > kNothing) {
    const Vec3 d =
        guided ? v.cones->sample(u, choice / v.cones->share) : Frame(v.s.ns).toWorld(sampleCosineHemisphere(u));
    const float pdf = v.guided(std::max(dot(d, v.s.ns), 1e-6f) / kPi, d);
    send(d, {v.bsdf.evaluateDiffuse(d) / pdf, Vec3(0)}, pdf, false, kSpread);
  }
  if (v.apart && maxComponent(v.bsdf.specularAlbedo()) > kNothing) {
    const BsdfSample b = v.bsdf.sampleSpecular(sampler.next2());
    if (b.valid())
      send(b.wi, {Vec3(0), b.weight}, b.mirror ? 0 : b.pdf, v.clear, v.clear ? 0 : std::min(kSpread, v.s.m.roughness));
  }
}

}  // namespace roomlight
