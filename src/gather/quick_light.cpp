#include "gather/quick_maker.h"

#include <algorithm>

#include "base/random.h"
#include "base/sampling.h"
#include "trace/bsdf.h"
#include "trace/lamp_light.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr float kPictureRoughness = 0.3f;  // smoother: what it reflects is looked for by a ray
constexpr float kFaint = 0.01f;        // of a place's light: that of lamps that could give less is taken from slots
// Of a node on what slots do not stand for: rays that look for light, how many find none where there is none, and
// samples of lights.
constexpr uint32_t kNodeRays = 16, kDarkRays = 8, kNodeLightSamples = 4;
constexpr float kNodePixels = 12;    // between nodes, and no nearer than voxels
constexpr float kDark = 0.05f;       // of the usual light
constexpr int kMostBounces = 4;
constexpr float kMostOfUsual =
    8;    // times the usual light of the picture: what one ray may bring, so that none stands out

}  // namespace

SlotIrradiance QuickFrames::Maker::receivedAt(uint32_t instance, Vec3 p, Vec3 n) const {
  const auto moved = scene_.moved.find(instance);
  if (moved == scene_.moved.end()) return scene_.light.at(p, n);
  return scene_.light.at(moved->second.point(p), normalize(moved->second.vector(n)));
}

// Whether slots can be taken for what is seen. Dark ones may be those of another surface, which lies hidden just
// behind: the underlay of a carpet, a wall behind the frame of a door.
bool QuickFrames::Maker::standsFor(const SlotIrradiance& e) const {
  const float lux = luminance(e.soft + e.sharp);
  return lux > 0 && (e.sure || lux >= kDark * f_.usualLux_);
}

// By slots alone, for reflections and what is seen through veils: `left` of all surfaces and the sky behind one
// another. `emitted`: with what surfaces emit.
Vec3 QuickFrames::Maker::radianceAlong(Ray ray, Vec3 left, bool emitted) const {
  Vec3 sum;
  for (int k = 0; k < Rules::kMostPanes && luminance(left) > Rules::kLeastLeft; ++k) {
    const Hit hit = scene_.rays.intersect(ray);
    if (!hit.valid()) return sum + left * skyAlong(scene_.lights, ray.direction);
    const SurfacePlace place = placeAt(scene_.rays.scene(), hit, ray.direction);
    const MaterialSample m = materialAt(scene_.rays.scene(), hit);
    const SlotIrradiance e = receivedAt(hit.instance, place.p, place.ng);
    const Vec3 emission = emitted && (place.front || place.material->doubleSided) ? m.emission : Vec3(0);
    sum += left * (emission + bihemisphericalAlbedo(m) * (e.soft + e.sharp) / kPi) * m.alpha;
    const Vec3 through =
        clear_[hit.instance] ? passing(m, *place.material, std::abs(dot(place.ng, ray.direction))) : Vec3(0);
    if (isBlack(through)) break;
    left *= through;
    ray = {offsetOrigin(place.p, -place.ng), ray.direction, 0, kInfinity};
  }
  return sum;
}

// One of the lamps with size and emissive meshes, as slots have it: what falls straight on a place, lx.
Vec3 QuickFrames::Maker::sampleLocal(Vec3 p, Vec3 n, Sampler& sampler) const {
  const Lights& lights = scene_.lights;
  const LightTree::Choice chosen = lights.chooseLocal(p, sampler.next1());
  const Vec2 u = sampler.next2();
  const float choice = sampler.next1();
  if (!(chosen.chance > 0)) return {};
  const size_t lamps = lights.lampCount();
  LightSample l;
  if (chosen.index < lamps) {
    if (isSharp(lights.lamp(chosen.index))) return {};  // has a ray of its own
    l = lights.sampleLamp(chosen.index, p, u);
  } else {
    const size_t emitter = chosen.index - lamps;
    if (std::any_of(emitters_.begin(), emitters_.end(), [&](const SharpEmitter& e) { return e.index == emitter; }))
      return {};
    l = lights.sampleEmitter(emitter, p, u, choice);
  }
  const float cosine = dot(l.wi, n);
  if (!l.valid() || cosine <= 0) return {};
  const Vec3 left = scene_.rays.transmittance(shadowRay(offsetOrigin(p, n), p, l));
  return left * l.radiance * (cosine / chosen.chance);
}

// What comes along a ray but for what surfaces emit. From places without light of their own, as in a narrow gap, it
// goes on.
Vec3 QuickFrames::Maker::arriving(Ray ray, Sampler& sampler) const {
  Vec3 left(1);
  for (int bounce = 0; bounce < kMostBounces && luminance(left) > Rules::kLeastLeft; ++bounce) {
    const Hit hit = scene_.rays.intersect(ray);
    if (!hit.valid() || clear_[hit.instance]) return radianceAlong(ray, left, false);
    const SurfacePlace place = placeAt(scene_.rays.scene(), hit, ray.direction);
    const SlotIrradiance e = receivedAt(hit.instance, place.p, place.ng);
    left *= bihemisphericalAlbedo(materialAt(scene_.rays.scene(), hit));
    if (standsFor(e)) return left * (e.soft + e.sharp) / kPi;
    ray = {offsetOrigin(place.p, place.ng), Frame(place.ng).toWorld(sampleCosineHemisphere(sampler.next2())), 0,
           kInfinity};
  }
  return {};
}

// What falls on a place from all around, lx. The directions are always the same ones, so that nodes side by side agree.
Vec3 QuickFrames::Maker::gatherAround(Vec3 p, Vec3 n) const {
  Vec3 around, straight;
  const float most = f_.usualLux_ > 0 ? kMostOfUsual * f_.usualLux_ / kPi : kInfinity;
  for (uint32_t k = 0; k < kNodeRays && (k < kDarkRays || !isBlack(around)); ++k) {
    Sampler sampler(0, k, 0);
    const Vec3 d = Frame(n).toWorld(sampleCosineHemisphere(sampler.next2()));
    const Vec3 came = arriving({offsetOrigin(p, n), d, 0, kInfinity}, sampler);
    around += came * std::min(1.0f, most / std::max(luminance(came), 1e-20f));
  }
  for (uint32_t k = 0; k < kNodeLightSamples && scene_.lights.hasLocal(); ++k) {
    Sampler sampler(1, k, 0);
    straight += sampleLocal(p, n, sampler);
  }
  return around * (kPi / static_cast<float>(kNodeRays)) + straight * (1.0f / static_cast<float>(kNodeLightSamples));
}

// What slots have for a place. Where that is not to be relied on, rays look for light.
SlotIrradiance QuickFrames::Maker::receivedOrFound(const Asked& a) const {
  SlotIrradiance out = receivedAt(a.hit.instance, a.p, a.n);
  if (standsFor(out)) return out;
  const Vec3 from = offsetOrigin(a.p, a.n);
  const auto sees = [&](Vec3 node) {
    const Vec3 to = offsetOrigin(node, a.n) - from;
    const float distance = length(to);
    return !(distance > 0) || !scene_.rays.intersect({from, to / distance, 0, distance}).valid();
  };
  const float stepM = std::max(scene_.light.voxelSizeM(), kNodePixels * slope_ * length(a.p - eye_));
  out.soft =
      f_.nodes_->at({a.hit.instance, a.p, a.n, stepM}, {sees, [&](Vec3 node) { return gatherAround(node, a.n); }});
  return out;
}

// Light of one pixel but for that of suns and lamps, whose shadow rays are left in the work.
void QuickFrames::Maker::shade(uint32_t index, Work& w) const {
  Asked& a = w.asked[index];
  const Scene& scene = scene_.rays.scene();
  const Sight& sight = a.sight;
  if (sight.panes > 0 && luminance(sight.reflectance) > Rules::kLeastReflected) {
    const Vec3 d = sight.ray.direction - sight.paneNormal * (2 * dot(sight.ray.direction, sight.paneNormal));
    a.rest += radianceAlong({offsetOrigin(sight.panePlace, sight.paneNormal), d, 0, kInfinity}, sight.reflectance);
  }
  if (!a.hit.valid()) return;
  SurfacePoint s = surfaceAt(scene, a.hit, sight.ray.direction);
  if (scene_.white) s.m = whitened(s.m);
  const Vec3 wo = -sight.ray.direction;
  const Bsdf bsdf(s.m, s.ns, s.ng, wo);
  const SlotIrradiance& e = a.received;
  const Vec3 left = sight.left * s.m.alpha;
  a.albedo = left * bsdf.diffuseAlbedo();
  a.diffuse = e.soft / kPi;
  a.rest += sight.left * s.emitted();
  if (s.m.roughness < kPictureRoughness) {
    const Vec3 d = sight.ray.direction - s.ns * (2 * dot(sight.ray.direction, s.ns));
    const Vec3 share = left * bsdf.specularAlbedo();
    const Vec3 reflected =
        dot(d, s.ng) > 0 ? radianceAlong({offsetOrigin(s.p, s.ng), d, 0, kInfinity}, share) : Vec3(0);
    a.rest += isBlack(reflected) ? share * e.soft / kPi : reflected;  // what it would show may have no slot
  } else {
    a.rest += left * bsdf.specularAlbedo() * e.soft / kPi;
  }
  if (clear_[s.instance]) {
    const Vec3 through = passing(s.m, *s.material, std::abs(dot(s.ng, sight.ray.direction)));
    if (!isBlack(through))
      a.rest += radianceAlong({offsetOrigin(s.p, -s.ng), sight.ray.direction, 0, kInfinity}, sight.left * through);
  }
  const size_t lamps = scene_.lights.lampCount(), lights = lamps + scene_.lights.sunCount();
  const float faintest = kFaint * luminance(e.soft + e.sharp) / kPi;
  float all = 0, faint = 0;  // if nothing is in the way
  const auto ask = [&](LightSample l, const LightSurroundings* around) {
    const float cosine = dot(l.wi, s.ns);
    if (!l.valid() || cosine <= 0 || dot(l.wi, s.ng) <= 0) return;
    if (around) l.radiance *= shareOutside(*around, s.p, l.wi);
    const float most = luminance(l.radiance) * cosine / kPi;
    all += most;
    if (most < faintest) faint += most;
    if (most < faintest || isBlack(l.radiance)) return;
    w.shadows.push_back({index, l.radiance * (cosine / kPi), left * bsdf.evaluateSpecular(l.wi) * l.radiance});
    w.shadowRays.push_back(shadowRay(offsetOrigin(s.p, s.ng), s.p, l));
  };
  for (size_t i = 0; i < lights; ++i) {
    if (i < lamps && !isSharp(scene_.lights.lamp(i))) continue;
    ask(i < lamps ? scene_.lights.sampleLamp(i, s.p, {0.5f, 0.5f}) : scene_.lights.sampleSun(i - lamps, {0.5f, 0.5f}),
        i < lamps ? &besideLamps_[i] : nullptr);
  }
  for (size_t k = 0; k < emitters_.size(); ++k) {
    Rng random(a.pixel, f_.frame_, k);
    const Vec2 u = random.uniform2();
    ask(w.views[k].sample(s.p, u, random.uniform()), &emitters_[k].around);
  }
  if (faint > 0) a.diffuse += e.sharp * (faint / (all * kPi));
}

// For those that light the pixels of a tile.
void QuickFrames::Maker::lookAtEmitters(Work& w) const {
  w.views.clear();
  Bounds3 places;
  for (const Asked& a : w.asked) {
    if (a.hit.valid()) places.add(a.p);
  }
  if (places.empty()) return;  // sky alone
  for (const SharpEmitter& e : emitters_) w.views.emplace_back(scene_.lights, e.index, places);
}

// Within the surroundings of a source its light comes by slots (radiance/near_lights.h). Between slots inside and
// outside light is interpolated over a voxel, and so is what is asked for.
float QuickFrames::Maker::shareOutside(const LightSurroundings& around, Vec3 p, Vec3 towards) const {
  float outside = 0;
  for (const float step : {-0.375f, -0.125f, 0.125f, 0.375f}) {
    if (!around.contains(p + towards * (step * scene_.light.voxelSizeM()))) outside += 0.25f;
  }
  return outside;
}

// Pixels that are not lit take the light of the nearest in their block, or in one beside it, that is and sees the same.
void QuickFrames::Maker::lend(Work& w, Count& count) const {
  const Scene& scene = scene_.rays.scene();
  const auto width = static_cast<uint32_t>(f_.width_);
  constexpr int kBlocks = Rules::kTile / Rules::kLendWithin, kReach2 = 4 * Rules::kLendWithin * Rules::kLendWithin;
  std::array<std::vector<uint32_t>, kBlocks* kBlocks>& lit = w.litOf;
  for (auto& l : lit) l.clear();
  const auto xOf = [&](const Asked& a) { return static_cast<int>(a.pixel % width); };
  const auto yOf = [&](const Asked& a) { return static_cast<int>(a.pixel / width); };
  const auto blockOf = [&](int v) { return v % Rules::kTile / Rules::kLendWithin; };
  for (uint32_t i = 0; i < w.asked.size(); ++i) {
    if (w.asked[i].lit)
      lit[static_cast<size_t>(blockOf(yOf(w.asked[i])) * kBlocks + blockOf(xOf(w.asked[i])))].push_back(i);
  }
  for (Asked& a : w.asked) {
    if (a.lit) continue;
    const Asked* from = nullptr;
    int nearest = 1 << 20;
    Vec3 around;  // of all near ones, the nearer the more: what one of them finds of a shining mesh is chance
    float weights = 0;
    const int x = xOf(a), y = yOf(a), bx = blockOf(x), by = blockOf(y);
    for (int j = std::max(0, by - 1); j <= std::min(kBlocks - 1, by + 1); ++j) {
      for (int i = std::max(0, bx - 1); i <= std::min(kBlocks - 1, bx + 1); ++i) {
        for (const uint32_t k : lit[static_cast<size_t>(j * kBlocks + i)]) {
          const Asked& b = w.asked[k];
          const int dx = xOf(b) - x, dy = yOf(b) - y, d2 = dx * dx + dy * dy;
          if (b.hit.instance != a.hit.instance || b.sight.panes != a.sight.panes || dot(a.n, b.n) < Rules::kFacing)
            continue;
          if (d2 < nearest) nearest = d2, from = &b;
          const auto weight = static_cast<float>(std::max(1, kReach2 - d2));
          around += b.diffuse * (weight * weight), weights += weight * weight;
        }
      }
    }
    if (!from) continue;
    ++count.lent;
    if (a.hit.valid()) {
      const MaterialSample seen = materialAt(scene, a.hit), m = scene_.white ? whitened(seen) : seen;
      a.albedo = a.sight.left * m.alpha * Bsdf(m, a.n, a.n, -a.sight.ray.direction).diffuseAlbedo();
    }
    a.diffuse = around / weights, a.rest = from->rest, a.lent = true;
  }
}

void QuickFrames::Maker::lightThose(Work& w, Count& count) const {
  w.shadows.clear(), w.shadowRays.clear();
  for (const uint32_t i : w.toLight) {
    Asked& a = w.asked[i];
    if (a.hit.valid()) a.received = receivedOrFound(a);
    shade(i, w);
  }
  w.left.resize(w.shadows.size());
  scene_.rays.transmittance(w.shadowRays, w.left);
  for (size_t i = 0; i < w.shadows.size(); ++i) {
    Asked& a = w.asked[w.shadows[i].asked];
    a.diffuse += w.shadows[i].diffuse * w.left[i], a.rest += w.shadows[i].specular * w.left[i];
  }
  count.lit += w.toLight.size();
}

void QuickFrames::Maker::light(Work& w, Count& count, Image& out) const {
  lookAtEmitters(w);
  w.toLight.clear();
  for (uint32_t i = 0; i < w.asked.size(); ++i) {
    if (w.asked[i].lit) w.toLight.push_back(i);
  }
  lightThose(w, count);
  lend(w, count);
  // What has no light, and nobody near to lend it, is lit after all.
  w.toLight.clear();
  for (uint32_t i = 0; i < w.asked.size(); ++i) {
    Asked& a = w.asked[i];
    if (!a.lit && !a.lent && !a.old) a.lit = true, w.toLight.push_back(i);
  }
  lightThose(w, count);
  for (const Asked& a : w.asked) {
    if (a.lit || a.lent) {
      store(a, a.albedo * a.diffuse + a.rest, a.lit ? kLit : kLent, out);
    } else {
      store(a, *a.old, kLent, out);
      ++count.lent;
    }
  }
}

}  // namespace roomlight
