#include "trace/lights.h"

#include <map>

#include "base/sampling.h"
#include "photometry/spot.h"
#include "trace/mean_emission.h"
#include "trace/spherical_triangle.h"

namespace roomlight {
namespace {

// Small triangles are sampled by area: cheaper, and exact enough for floats. Both sampling and density decide by this.
bool samplesSolidAngle(float solidAngle) { return solidAngle > 1e-3f && solidAngle < 6.2f; }

// 1 - cos of a sun's angular radius, exact where the cosine itself would round to 1.
float oneMinusCos(const Sun& sun) {
  const float s = std::sin(0.5f * sun.halfAngleRad);
  return 2 * s * s;
}

// Luminance of a disc that gives its illuminance to a surface facing it: the cosine integrates to pi sin^2.
Vec3 discRadiance(const Sun& sun) {
  const float s = std::sin(sun.halfAngleRad);
  return sun.illuminanceLux / (kPi * s * s);
}

}  // namespace

Lights::Lights(const Scene& scene, bool sunApart) : scene_(scene), suns_(scene.suns), sky_(scene.sky, sunApart) {
  std::erase_if(suns_, [](const Sun& sun) { return isBlack(sun.illuminanceLux); });
  addAllLocal();
}

Lights::Lights(const Scene& scene, Lights&& before)
    : scene_(scene), suns_(std::move(before.suns_)), sky_(std::move(before.sky_)) {
  addAllLocal();
}

void Lights::addAllLocal() {
  for (const Lamp& lamp : scene_.lamps) {
    if (lamp.kind != LampKind::Area && !isBlack(lamp.intensityCd)) lamps_.push_back(lamp);
  }
  addLamps();
  emitterOfInstance_.assign(scene_.instances.size(), -1);
  MeanEmission means(scene_);
  for (uint32_t i = 0; i < scene_.instances.size(); ++i) addEmitter(i, means);
  const size_t lamps = lamps_.size(), all = lamps + emitters_.size();
  lampTree_ = treeOf(0, lamps), emitterTree_ = treeOf(lamps, all), localTree_ = treeOf(0, all);
}

void Lights::addLamps() {
  std::map<const PhotometricWeb*, std::shared_ptr<const WebSampler>> samplers;
  float flux = 0;
  for (const Lamp& lamp : lamps_) {
    std::shared_ptr<const WebSampler> sampler;
    if (lamp.web) {
      std::shared_ptr<const WebSampler>& known = samplers[lamp.web.get()];
      if (!known) known = std::make_shared<const WebSampler>(*lamp.web);
      sampler = known;
    }
    const LampDirections& directions = lampDirections_.emplace_back(lamp, sampler);
    flux += lampShare_.emplace_back(luminance(lamp.intensityCd) * directions.fluxPerCandela());
    extendedLamps_ = extendedLamps_ || lamp.extended;
  }
  lampFluxLm_ = flux;
  for (size_t i = 0; i < lamps_.size(); ++i) {
    const Lamp& lamp = lamps_[i];
    const bool point = lamp.kind == LampKind::Point;
    const float solidAngle = lampDirections_[i].fluxPerCandela(), share = lampShare_[i] /= flux;
    LampTerms terms{lamp.position,
                    lamp.direction,
                    luminance(lamp.intensityCd),
                    point ? -1 : std::cos(lamp.innerConeRad),
                    point ? -1 : std::cos(lamp.outerConeRad),
                    share / solidAngle,
                    point ? -kInfinity : 1 - solidAngle / (2 * kPi),
                    lamp.web ? &lamp : nullptr};
    if (lamp.web) terms.shinesUp = shinesUp(*lamp.web);
    if (lamp.extended)
      terms.radius2 = 0.25f * (lamp.web->sizeC0M * lamp.web->sizeC0M + lamp.web->sizeC90M * lamp.web->sizeC90M);
    lampTerms_.push_back(terms);
  }
}

void Lights::addEmitter(uint32_t index, MeanEmission& means) {
  const int meshIndex = scene_.instances[index].mesh;
  const Mesh& mesh = scene_.meshes[static_cast<size_t>(meshIndex)];
  const Material& material = scene_.materials[static_cast<size_t>(mesh.material)];
  if (isBlack(material.emission)) return;
  const std::vector<float>& mean = means.ofMesh(meshIndex);
  Emitter e;
  e.instance = index;
  e.doubleSided = material.doubleSided;
  e.even = emitsEvenly(material);
  e.emission = material.emission;
  e.slotOfTriangle.assign(mesh.triangleCount(), -1);
  Vec3 normal;
  bool flat = !material.doubleSided;
  double flux = 0;
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleVertices v = worldTriangle(scene_, index, t);
    const Vec3 twiceArea = cross(v.b - v.a, v.c - v.a);
    const float area = 0.5f * length(twiceArea);
    const float lm = kPi * area * mean[t] * (e.doubleSided ? 2.0f : 1.0f);
    if (!(lm > 0)) continue;
    // The front is counter-clockwise in object space; a mirroring transform turns the world winding around.
    const float flip = scene_.instances[index].worldFromObject.determinant() < 0 ? -1.0f : 1.0f;
    const Vec3 n = twiceArea * (flip / (2 * area));
    if (e.triangles.empty()) normal = n;
    flat =
        flat && dot(n, normal) > 0.9999f && std::abs(dot(v.a - (e.triangles.empty() ? v.a : e.centre), normal)) < 1e-3f;
    if (e.triangles.empty()) e.centre = v.a;
    e.bounds.add(v.a), e.bounds.add(v.b), e.bounds.add(v.c);
    flux += lm, e.areaM2 += area;
    e.triangles.push_back({t, lm, area, v, n});
  }
  if (e.triangles.empty()) return;
  for (EmitterTriangle& t : e.triangles) t.share /= static_cast<float>(flux);
  takePieces(e);
  e.centre = e.bounds.centre();
  e.normal = flat ? normal : Vec3(0);
  e.fluxLm = static_cast<float>(flux);
  emitterFluxLm_ += flux;
  emitterOfInstance_[index] = static_cast<int32_t>(emitters_.size());
  emitterTerms_.push_back({e.centre, e.normal, e.fluxLm / kPi, 0.0625f * lengthSquared(e.bounds.size()) + 1e-6f});
  emitters_.push_back(std::move(e));
}

void Lights::takePieces(Emitter& e) {
  std::vector<EmitterPieces::Part> parts;
  for (const EmitterTriangle& t : e.triangles) {
    Bounds3 bounds;
    bounds.add(t.v.a), bounds.add(t.v.b), bounds.add(t.v.c);
    parts.push_back({bounds, t.normal, t.share});
  }
  e.pieces = EmitterPieces(parts, e.doubleSided);
  std::vector<EmitterTriangle> ordered;
  double sum = 0;
  for (const uint32_t i : e.pieces.order()) {
    e.slotOfTriangle[e.triangles[i].triangle] = static_cast<int32_t>(ordered.size());
    ordered.push_back(e.triangles[i]);
    e.cdf.push_back(static_cast<float>(sum += static_cast<double>(e.triangles[i].share)));
  }
  e.triangles = std::move(ordered);
}

float Lights::importance(const EmitterTerms& e, Vec3 p) {
  // Nothing reaches a point behind a flat one-sided emitter; the margin keeps points in its plane.
  const Vec3 d = p - e.centre;
  if (!isBlack(e.normal) && dot(d, e.normal) < -1e-3f) return 0;
  return e.cd / std::max(lengthSquared(d), e.least2);
}

float Lights::importance(const LampTerms& lamp, Vec3 p) const {
  if (lamp.web) return webImportance(lamp, p);
  const Vec3 d = p - lamp.position;
  const float distance = length(d), cd = lamp.intensityCd / std::max(distance * distance, 1e-4f);
  return lamp.cosOuter <= -1
             ? cd
             : cd * spotFalloff(dot(d, lamp.direction) / std::max(distance, 1e-12f), lamp.cosInner, lamp.cosOuter);
}

// Zero only where no place of the lamp gives light to p.
float Lights::webImportance(const LampTerms& lamp, Vec3 p) const {
  const Vec3 d = p - lamp.position;
  const float d2 = lengthSquared(d);
  const float seen = d2 > 1e-12f ? luminance(lampIntensity(*lamp.web, d / std::sqrt(d2))) : lamp.intensityCd;
  if (lamp.radius2 <= 0) return seen / std::max(d2, 1e-4f);
  // Other places of the opening may shine to where its centre does not; none does behind it unless the web says so.
  constexpr float kElsewhere = 0.1f;
  if (!lamp.shinesUp && dot(d, lamp.direction) <= 0) return 0;
  return (seen + kElsewhere * lamp.intensityCd) / std::max(d2, 0.25f * lamp.radius2 + 1e-4f);
}

LightSample Lights::sampleLamp(size_t index, Vec3 p, Vec2 u) const {
  LightSample s = roomlight::sampleLamp(lamps_[index], p, u);
  s.lamp = static_cast<int32_t>(index);
  return s;
}

LightRay Lights::sampleLampRay(Sampler& sampler) const {
  float choice = sampler.next1();
  const Vec2 u = sampler.next2();
  size_t i = 0;
  for (; i + 1 < lamps_.size() && choice >= lampShare_[i]; ++i) choice -= lampShare_[i];
  return lampRay(i, u, lampShare_[i], sampler);
}

LightRay Lights::sampleLampRay(size_t index, Sampler& sampler) const {
  const Vec2 u = sampler.next2();
  return lampRay(index, u, 1, sampler);
}

LightRay Lights::lampRay(size_t index, Vec2 u, float chance, Sampler& sampler) const {
  const Lamp& lamp = lamps_[index];
  LightRay ray;
  float pdf = 0;
  ray.origin = lampPlace(lamp, lamp.extended ? sampler.next2() : Vec2{});
  ray.direction = lampDirections_[index].sample(u, pdf);
  ray.fluxLm = lampIntensity(lamp, ray.direction) / (pdf * chance);
  ray.lamp = static_cast<int32_t>(index);
  return ray;
}

float Lights::lampDensity(Vec3 p, Vec3 n) const {
  float density = 0;
  for (size_t i = 0; i < lampTerms_.size(); ++i) {
    const LampTerms& lamp = lampTerms_[i];
    const Vec3 d = lamp.position - p;
    const float cosine = dot(n, d);
    if (cosine <= 0) continue;
    const float inverse2 = 1 / std::max(lengthSquared(d), 1e-8f), inverse = std::sqrt(inverse2);
    if (lamp.web) {
      density += lampShare_[i] * lampDirections_[i].pdf(d * -inverse) * cosine * inverse2 * inverse;
    } else if (-dot(lamp.direction, d) * inverse > lamp.cosSpread)
      density += lamp.raysPerSr * cosine * inverse2 * inverse;
  }
  return density;
}

const Lights::EmitterTriangle& Lights::chosenTriangle(const Emitter& e, float choice) {
  const auto slot = static_cast<size_t>(std::upper_bound(e.cdf.begin(), e.cdf.end(), choice) - e.cdf.begin());
  return e.triangles[std::min(slot, e.triangles.size() - 1)];
}

Vec3 Lights::emissionAt(const Emitter& e, const EmitterTriangle& t, Vec2 b) const {
  return e.even ? e.emission : materialAt(scene_, {e.instance, t.triangle, b.x, b.y, 0, {}}).emission;
}

LightRay Lights::sampleEmitterRay(size_t index, Sampler& sampler) const {
  const Emitter& e = emitters_[index];
  const EmitterTriangle& t = chosenTriangle(e, sampler.next1());
  const TriangleVertices& v = t.v;
  const Vec2 b = sampleTriangle(sampler.next2());
  const Vec3 local = sampleCosineHemisphere(sampler.next2()),
             n = e.doubleSided && sampler.next1() < 0.5f ? -t.normal : t.normal;
  LightRay ray;
  ray.emitter = static_cast<int32_t>(index);
  ray.origin = offsetOrigin(v.a * (1 - b.x - b.y) + v.b * b.x + v.c * b.y, n);
  ray.direction = Frame(n).toWorld(local);
  ray.fluxLm = emissionAt(e, t, b) * (kPi * t.areaM2 * (e.doubleSided ? 2.0f : 1.0f) / t.share);
  return ray;
}

LightSample Lights::sampleEmitter(const Emitter& e, const EmitterPieces::Weights& pieces, Vec3 p, Vec2 u, float choice,
                                  float chance) const {
  const EmitterPieces::Choice piece = e.pieces.choose(pieces, choice);
  if (!(piece.chance > 0)) return {};
  const float before = piece.first > 0 ? e.cdf[piece.first - 1] : 0, end = e.cdf[piece.first + piece.count - 1];
  const auto begin = e.cdf.begin() + piece.first;
  const auto at = std::min<size_t>(
      static_cast<size_t>(std::upper_bound(begin, begin + piece.count, before + piece.rest * (end - before)) - begin),
      piece.count - 1);
  const EmitterTriangle& t = e.triangles[piece.first + at];
  return sampleOnTriangle(e, t, chance * piece.chance * t.share / piece.share, p, u);
}

LightSample Lights::sampleOnTriangle(const Emitter& e, const EmitterTriangle& t, float chance, Vec3 p, Vec2 u) const {
  const TriangleVertices& v = t.v;
  const Vec3 n = t.normal;
  LightSample s;
  s.emitter = emitterOfInstance_[e.instance];
  Vec2 b;
  const float solidAngle = triangleSolidAngle(p, v.a, v.b, v.c);
  if (samplesSolidAngle(solidAngle)) {
    s.wi = SphericalTriangle(p, v.a, v.b, v.c, solidAngle).sample(u);
    const float cosLight = dot(n, s.wi);
    if (cosLight == 0 || (!e.doubleSided && cosLight > 0)) return s;
    s.distance = dot(v.a - p, n) / cosLight;
    if (!(s.distance > 1e-4f)) return s;
    s.pdf = chance / solidAngle;
    const Vec3 q = p + s.wi * s.distance;
    const Vec3 twiceArea = cross(v.b - v.a, v.c - v.a);
    const float scale = 1 / lengthSquared(twiceArea);
    b = {dot(cross(v.c - q, v.a - q), twiceArea) * scale, dot(cross(v.a - q, v.b - q), twiceArea) * scale};
  } else {
    b = sampleTriangle(u);
    const Vec3 d = v.a * (1 - b.x - b.y) + v.b * b.x + v.c * b.y - p;
    const float d2 = lengthSquared(d);
    if (d2 < 1e-8f) return s;
    s.distance = std::sqrt(d2);
    s.wi = d / s.distance;
    const float cosLight = -dot(n, s.wi);
    if (!e.doubleSided && cosLight <= 0) return s;
    s.pdf = chance / t.areaM2 * d2 / std::max(std::abs(cosLight), 1e-6f);
  }
  s.radiance = emissionAt(e, t, b) / s.pdf;
  return s;
}

float Lights::pdfInEmitter(const Emitter& e, Vec3 p, const SurfacePoint& q) const {
  const int32_t slot = e.slotOfTriangle[q.triangle];
  if (slot < 0 || (!q.front && !e.doubleSided)) return 0;
  const EmitterTriangle& t = e.triangles[static_cast<size_t>(slot)];
  const TriangleVertices& v = t.v;
  const float solidAngle = triangleSolidAngle(p, v.a, v.b, v.c);
  const float chance = t.share * e.pieces.chanceOverShare(static_cast<uint32_t>(slot), p);
  if (samplesSolidAngle(solidAngle)) return chance / solidAngle;
  const Vec3 d = q.p - p;
  const float d2 = lengthSquared(d);
  const float cosLight = std::abs(dot(q.ng, d)) / std::sqrt(std::max(d2, 1e-12f));
  return chance / t.areaM2 * d2 / std::max(cosLight, 1e-6f);
}

// One by one where there are few, by groups where there are many.
LightTree::Choice Lights::choose(const Range& among, Vec3 p, float choice) const {
  if (!among.tree.empty()) {
    LightTree::Choice c = among.tree.choose(p, choice, [&](size_t i) { return localImportance(among.first + i, p); });
    c.index += among.first;
    return c;
  }
  float remembered[kMostOneByOne], total = 0;
  for (size_t i = among.first; i < among.last; ++i) total += remembered[i - among.first] = localImportance(i, p);
  if (!(total > 0)) return {};
  const size_t i = chooseByWeight(
      among.last - among.first, total, [&](size_t k) { return remembered[k]; }, choice);
  return {among.first + i, remembered[i] / total, choice};
}

float Lights::chanceOf(const Range& among, size_t index, Vec3 p) const {
  if (!among.tree.empty())
    return among.tree.chance(index - among.first, p, [&](size_t i) { return localImportance(among.first + i, p); });
  float total = 0;
  for (size_t i = among.first; i < among.last; ++i) total += localImportance(i, p);
  return total > 0 ? localImportance(index, p) / total : 0;
}

LightTree Lights::treeOf(size_t first, size_t last) const {
  if (last - first <= kMostOneByOne) return {};
  std::vector<LightTree::Light> lights;
  for (size_t i = first; i < last; ++i) {
    LightTree::Light& l = lights.emplace_back();
    if (i < lamps_.size()) {
      const LampTerms& t = lampTerms_[i];
      const Vec3 half(std::sqrt(t.radius2));
      l.bounds = {t.position - half, t.position + half}, l.intensityCd = t.intensityCd, l.axis = t.direction;
      if (!t.web && t.cosOuter > -1) l.halfAngle = lamps_[i].outerConeRad;
    } else {
      const Emitter& e = emitters_[i - lamps_.size()];
      l.bounds = e.bounds, l.intensityCd = e.fluxLm / kPi;
      if (!isBlack(e.normal)) l.axis = e.normal, l.halfAngle = 0.5f * kPi;
    }
  }
  return LightTree(lights);
}

LightSample Lights::sampleLamps(Vec3 p, Sampler& sampler) const {
  const float choice = sampler.next1();
  const Vec2 u = extendedLamps_ ? sampler.next2() : Vec2{};
  const LightTree::Choice c = choose(lampRange(), p, choice);
  if (!(c.chance > 0)) return {};
  LightSample s = sampleLamp(c.index, p, u);
  s.radiance *= 1 / c.chance;
  return s;
}

LightTree::Choice Lights::chooseEmitter(Vec3 p, float choice) const {
  LightTree::Choice c = choose(emitterRange(), p, choice);
  if (c.chance > 0) c.index -= lamps_.size();
  return c;
}

LightSample Lights::sampleEmitters(Vec3 p, Vec2 u, float choice) const {
  const LightTree::Choice c = chooseEmitter(p, choice);
  return c.chance > 0 ? sampleEmitter(emitters_[c.index], p, u, c.rest, c.chance) : LightSample{};
}

float Lights::pdfEmitters(Vec3 p, const SurfacePoint& q) const {
  const int32_t index = emitterOfInstance_[q.instance];
  if (index < 0) return 0;
  const float chance = chanceOfEmitter(static_cast<size_t>(index), p);
  return chance > 0 ? chance * pdfInEmitter(emitters_[static_cast<size_t>(index)], p, q) : 0;
}

Bounds3 Lights::sunDirections(size_t index) const {
  if (index >= suns_.size()) return sky_.spotDirections();
  const Vec3 wide(suns_[index].halfAngleRad + 1e-4f);
  return {suns_[index].toLight - wide, suns_[index].toLight + wide};
}

LightSample Lights::sampleSun(size_t index, Vec2 u) const {
  if (index >= suns_.size()) {
    const SkyDistribution::Sample d = sky_.sampleSpot(u);
    LightSample s;
    s.wi = d.d;
    const Vec3 radiance = sky_.spotRadiance(d.d, s.pdf);
    if (s.pdf > 0) s.radiance = radiance / s.pdf;
    return s;
  }
  const Sun& sun = suns_[index];
  LightSample s;
  if (sun.halfAngleRad <= 0) {
    s.wi = sun.toLight;
    s.radiance = sun.illuminanceLux;
    return s;
  }
  s.wi = Frame(sun.toLight).toWorld(sampleCone(u, oneMinusCos(sun)));
  s.pdf = conePdf(oneMinusCos(sun));
  s.radiance = discRadiance(sun) / s.pdf;
  return s;
}

Vec3 Lights::sunDisc(size_t index, Vec3 d, float& pdf) const {
  if (index >= suns_.size()) return sky_.spotRadiance(d, pdf);
  const Sun& sun = suns_[index];
  pdf = 0;
  // |d - toLight|^2 = 2 (1 - cos), without the rounding of a cosine near 1.
  if (sun.halfAngleRad <= 0 || lengthSquared(d - sun.toLight) > 2 * oneMinusCos(sun)) return {};
  pdf = conePdf(oneMinusCos(sun));
  return discRadiance(sun);
}

LightSample Lights::sampleSky(Vec2 u) const {
  const SkyDistribution::Sample d = sky_.sample(u);
  LightSample s;
  if (!(d.pdf > 0)) return s;
  s.wi = d.d;
  s.pdf = d.pdf;
  s.radiance = sky_.radiance(d.d) / d.pdf;
  return s;
}

}  // namespace roomlight
