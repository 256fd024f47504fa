#include "reference/path_walk.h"

#include "base/sampling.h"
#include "trace/caustic_photons.h"

namespace roomlight {
namespace {

// Paths longer than this are not physics but a loop between perfect mirrors; at albedo 0.95 the chance to get here is
// e-13.
constexpr int kLongestPath = 4096;
constexpr int kCandidates = LightVertices::kCandidates;

// The part of light from wi that the diffuse lobe scatters.
Vec3 diffuseShare(const Bsdf& bsdf, Vec3 wi) {
  return min(bsdf.evaluateDiffuse(wi) / max(bsdf.evaluate(wi), Vec3(1e-20f)), Vec3(1));
}

// What CausticSplats bring, of a path's light: straight from suns, lamps and emissive meshes, by surfaces that throw
// light alone, to the diffuse lobe of the first that scatters.
class CausticPart {
 public:
  explicit CausticPart(bool known = false) : known_(known) {}
  // What the path keeps of such light where its ray has ended,
  Vec3 ofReached() const { return at_ == kThrown ? left_ : Vec3(1); }
  // and of what falls on a surface there.
  Vec3 ofDirect(const SurfacePoint& s) const {
    return at_ != kElsewhere && s.material && throwsLight(*s.material) &&
                   reflections_ < CausticPhotons::kMostReflections
               ? left_
               : Vec3(1);
  }
  void scatter(const SurfacePoint& s, const Bsdf& bsdf, const BsdfSample& next, bool first) {
    if (!known_) return;
    const bool throws = throwsLight(*s.material);
    if (first && !throws) {
      at_ = kFirst, left_ = next.mirror ? Vec3(1) : Vec3(1) - diffuseShare(bsdf, next.wi);
    } else if (at_ != kElsewhere) {
      at_ = throws && ++reflections_ <= CausticPhotons::kMostReflections ? kThrown : kElsewhere;
    }
  }

 private:
  bool known_;  // else paths keep it all
  Vec3 left_{1, 1, 1};
  int reflections_ = 0;
  enum : uint8_t { kFirst, kThrown, kElsewhere } at_ = kElsewhere;  // whose light the path brings
};

}  // namespace

// A surface that a path has come to.
struct PathWalk::Vertex {
  const SurfacePoint& s;
  const Bsdf& bsdf;
  std::span<const LightPart> visible;  // parts of the lights there
  float lampShare;  // of light that has light paths: what connections at earlier vertices, and there, have left to it
  Vec3 caustic{1, 1, 1};  // what the path keeps of light straight from lamps, meshes and suns
};

// Of light at one surface: what the diffuse lobe scatters, that of suns apart.
struct PathWalk::Parts {
  Vec3 diffuse, sharp;
};

// Drawn long before they are looked at, because they lie all over memory.
struct PathWalk::Candidates {
  const LightVertex* vertex[kCandidates];

  void draw(const std::vector<LightVertex>& all, Sampler& sampler) {
    for (const LightVertex*& v : vertex) {
      v = &all[std::min(static_cast<size_t>(sampler.fast1() * static_cast<float>(all.size())), all.size() - 1)];
      __builtin_prefetch(v);
    }
  }
};

// Of light at one surface, what arrives at the eye, by layers; nothing where these are not wanted.
struct PathWalk::Apart {
  PathLayers* layers;
  Vec3 factor;
  void add(const LightSample& light, Vec3 value) const {
    if (layers) layers->add(layers->lights.of(light), value * factor);
  }
  void add(const LightVertex& vertex, Vec3 value) const {
    LightSample light;
    light.lamp = vertex.lamp, light.emitter = vertex.emitter;
    add(light, value);
  }
  void addSun(Vec3 value) const {
    if (layers) layers->add(layers->lights.sun, value * factor);
  }
  void addSky(Vec3 value) const {
    if (layers) layers->add(layers->lights.sky, value * factor);
  }
};

struct PathWalk::State {
  Ray ray;
  Vec3 throughput{1, 1, 1};
  Vec3 lastPoint;  // where the ray was scattered last, for the density of light sampling there
  std::span<const LightPart> lastVisible;  // parts of the lights there
  float lastPdf = 0;  // density of the sample that gave the ray; 0: camera or mirror, emission counts in full
  bool skyKnown = false;  // the sky, if the ray sees it, is counted already
  PathLayers* layers = nullptr;
  CausticPart caustic;
  float lampShare = 1;  // of light that has light paths: what connections at earlier vertices have left to this path

  // Russian roulette by throughput from the third scattering on.
  bool survives(int scattered, float share, Sampler& sampler) {
    const float best = maxComponent(throughput) * share;
    if (!(best > 0)) return false;
    if (scattered < 3) return true;
    const float q = std::min(best, 0.98f);
    if (sampler.next1() >= q) return false;
    throughput *= 1 / q;
    return true;
  }
  void scatter(const Vertex& at, const BsdfSample& next, bool first) {
    caustic.scatter(at.s, at.bsdf, next, first);
    throughput *= next.weight;
    lastPdf = next.mirror ? 0 : next.pdf;
    lastPoint = at.s.p, lastVisible = at.visible;
    skyKnown = false;
    ray = {offsetOrigin(at.s.p, at.s.ng), next.wi, 0, kInfinity};
    lampShare = at.lampShare;
  }
};

struct PathWalk::NoRecord {
  static constexpr bool kOn = false;
};

// Sorts the light of a path by its first surface.
class PathWalk::FirstSurface {
 public:
  static constexpr bool kOn = true;
  explicit FirstSurface(FilterPixel& pixel) : pixel_(pixel) { pixel = {}; }

  bool isHere(const SurfacePoint& s, const Bsdf& bsdf) const {
    return state_ == kLooking && s.m.alpha >= 1 && s.m.transmission <= 0 && !bsdf.isMirrorOnly();
  }
  void see(const SurfacePoint& s, const Bsdf& bsdf, Vec3 throughput) {
    pixel_.albedo = throughput * bsdf.diffuseAlbedo();
    pixel_.normal = s.ns, pixel_.position = s.p;
    pixel_.roughness = s.m.roughness;
    pixel_.surface = 1;
  }
  // Light that the surface itself has gathered.
  void add(Vec3 all, const Parts& parts) {
    pixel_.diffuse += parts.diffuse, pixel_.sharp += parts.sharp,
        pixel_.specular += max(all - parts.diffuse - parts.sharp, Vec3(0));
  }
  void goOn(const Bsdf& bsdf, const BsdfSample& next) {
    state_ = kSeen, diffuse_ = next.mirror ? Vec3(0) : diffuseShare(bsdf, next.wi);
  }
  // Panes scatter sharp pictures of other things.
  void scatteredByPane() { state_ = state_ == kLooking ? kGivenUp : state_; }
  // Light from anywhere else.
  void add(Vec3 light) {
    if (state_ != kSeen) return static_cast<void>(pixel_.rest += light);
    pixel_.diffuse += light * diffuse_, pixel_.specular += light * (Vec3(1) - diffuse_);
  }

 private:
  enum State { kLooking, kSeen, kGivenUp };
  FilterPixel& pixel_;
  State state_ = kLooking;
  Vec3 diffuse_;  // of light that arrives after the first surface, what its diffuse lobe scattered
};

Vec3 PathWalk::radiance(const Ray& ray, Sampler& sampler, uint64_t& rayCount, PathLayers* layers) const {
  State path;
  path.ray = ray;
  path.layers = layers;
  path.caustic = CausticPart(causticsKnown_);
  return follow(path, sampler, rayCount, NoRecord());
}

Vec3 PathWalk::radiance(const Ray& ray, Sampler& sampler, uint64_t& rayCount, FilterPixel& seen,
                        PathLayers* layers) const {
  State path;
  path.ray = ray;
  path.layers = layers;
  path.caustic = CausticPart(causticsKnown_);
  return follow(path, sampler, rayCount, FirstSurface(seen));
}

// Pi times what an ideal white Lambertian patch there would reflect.
Vec3 PathWalk::illuminanceButSky(Vec3 p, Vec3 n, Sampler& sampler, uint64_t& rayCount) const {
  SurfacePoint s;
  s.p = p;
  s.ng = s.ns = n;
  s.m.baseColor = Vec3(1);
  const Bsdf bsdf(s.m, n, n, n);
  const Vertex at{s, bsdf, {}, 1};
  Vec3 sum = direct<false>(at, sampler, rayCount, nullptr, {}, false);
  if (vertices_) {
    Candidates candidates;
    candidates.draw(vertices_->all(), sampler);
    sum += connected<false>(at, candidates, sampler, rayCount, nullptr, {});
  }
  const BsdfSample next = bsdf.sample(sampler.next2(), sampler.next1());
  if (next.valid()) {
    State path;
    path.ray = {offsetOrigin(p, n), next.wi, 0, kInfinity};
    path.throughput = next.weight;
    path.lastPoint = p;
    path.lastPdf = next.pdf;
    path.skyKnown = true;
    sum += follow(path, sampler, rayCount, NoRecord());
  }
  return sum * kPi;
}

template <class Record>
Vec3 PathWalk::follow(State& path, Sampler& sampler, uint64_t& rayCount, Record record) const {
  Vec3 sum;
  int scattered = 0;
  Candidates candidates;
  for (int length = 0; length < kLongestPath; ++length) {
    if (vertices_) candidates.draw(vertices_->all(), sampler);
    const Hit hit = rays_.intersect(path.ray);
    ++rayCount;
    if (!hit.valid()) {
      const Vec3 sky = skyBehind(path), suns = sunsBehind(path) * path.caustic.ofReached(),
                 light = path.throughput * (sky + suns);
      const Apart apart{path.layers, path.throughput};
      apart.addSky(sky), apart.addSun(suns);
      sum += light;
      if constexpr (Record::kOn) record.add(light);
      break;
    }
    SurfacePoint s = surfaces_.at(hit, path.ray.direction);
    if (white_ && scattered == 0) s.m = whitened(s.m);
    if (const Vec3 emitted = s.emitted(); !isBlack(emitted)) {
      const int32_t emitter = lights_.emitterOf(s.instance);
      const Vec3 light = path.throughput * emitted *
                         (emissionWeight(path, s, emitter) * (emitter < 0 ? Vec3(1) : path.caustic.ofReached()));
      sum += light;
      if (path.layers && emitter >= 0)
        path.layers->add(path.layers->lights.ofEmitter[static_cast<size_t>(emitter)], light);
      if constexpr (Record::kOn) record.add(light);
    }
    const Bsdf bsdf(s.m, s.ns, s.ng, -path.ray.direction);
    const Vertex at{s, bsdf, visible_.partsAt(s.p, s.ng), lampShareAt(path, s, bsdf), path.caustic.ofDirect(s)};
    // Before the choice to go straight through: highlights on glass would be rare and bright otherwise.
    bool first = false;
    if constexpr (Record::kOn) first = record.isHere(s, bsdf);
    Vec3 here;
    if (first) {
      if constexpr (Record::kOn) {
        record.see(s, bsdf, path.throughput);
        Parts parts;
        here = lit<true>(path, at, candidates, sampler, rayCount, &parts);
        record.add(path.throughput * here, {path.throughput * parts.diffuse, path.throughput * parts.sharp});
      }
    } else {
      here = lit<false>(path, at, candidates, sampler, rayCount, nullptr);
      if constexpr (Record::kOn) record.add(path.throughput * here * s.m.alpha);
    }
    sum += path.throughput * here * s.m.alpha;
    if (passThrough(path, s, bsdf, sampler)) continue;

    const BsdfSample next = bsdf.sample(sampler.next2(), sampler.next1());
    if (!next.valid() || dot(next.wi, s.ng) <= 0) break;
    if constexpr (Record::kOn) {
      if (first) record.goOn(bsdf, next);
      if (s.m.alpha < 1 || s.m.transmission > 0) record.scatteredByPane();
    }
    path.scatter(at, next, scattered == 0);
    if (!path.survives(++scattered, vertices_ && vertices_->lightRays().hasAllLight() ? at.lampShare : 1, sampler))
      break;
  }
  return sum;
}

// Sky and sun discs along a ray that left the scene, weighted against having sampled them directly.
Vec3 PathWalk::skyBehind(const State& path) const {
  const Vec3 d = path.ray.direction;
  if (!lights_.sky().present() || path.skyKnown) return {};
  return lights_.sky().radiance(d) *
         (path.lastPdf > 0 && lights_.sky().sampled() ? misWeight(path.lastPdf, lights_.sky().pdf(d)) : 1);
}

Vec3 PathWalk::sunsBehind(const State& path) const {
  const Vec3 d = path.ray.direction;
  Vec3 sum;
  for (size_t i = 0; i < lights_.sunCount(); ++i) {
    float pdf;
    const Vec3 disc = lights_.sunDisc(i, d, pdf);
    if (pdf > 0) sum += disc * (path.lastPdf > 0 ? misWeight(path.lastPdf, pdf) : 1);
  }
  return sum;
}

// Of what a surface emits, against having sampled it directly or by connections.
float PathWalk::emissionWeight(const State& path, const SurfacePoint& s, int32_t emitter) const {
  const float w =
      path.lastPdf > 0 ? misWeight(path.lastPdf, pdfLocal(lights_, path.lastVisible, path.lastPoint, s)) : 1;
  return vertices_ && vertices_->lightRays().leaveEmitter(emitter) ? w * path.lampShare : w;
}

float PathWalk::lampShareAt(const State& path, const SurfacePoint& s, const Bsdf& bsdf) const {
  float lampShare = path.lampShare;
  if (vertices_ && path.lastPdf > 0 && LightVertices::connects(bsdf)) {
    const float inverse2 = 1 / std::max(lengthSquared(s.p - path.lastPoint), 1e-12f);
    lampShare *= 1 - LightVertices::share(path.lastPdf, -dot(s.ng, path.ray.direction), inverse2,
                                          vertices_->lightRays().densityM2(s.p, s.ng));
  }
  return lampShare;
}

// Thin glass and blended alpha: with a chance equal to what goes straight through, the ray goes on as if nothing had
// scattered it, so light sampling at the last point (which sees through glass too) keeps its weights.
bool PathWalk::passThrough(State& path, const SurfacePoint& s, const Bsdf& bsdf, Sampler& sampler) const {
  if (s.m.alpha >= 1 && s.m.transmission <= 0) return false;
  const Vec3 through = straightTransmittance(*s.material, s.m, -dot(s.ns, path.ray.direction));
  const float t = luminance(through), r = luminance(bsdf.albedo()) * s.m.alpha;
  const float chance = t + r > 0 ? t / (t + r) : 1;
  if (sampler.next1() < chance) {
    path.throughput *= through / chance;
    path.ray.origin = offsetOrigin(s.p, -s.ng);
    path.ray.tMin = 0;
    return true;
  }
  path.throughput *= s.m.alpha / (1 - chance);
  return false;
}

// By samples of lights, and by connections to light paths. Always inlined, so that the compiler fuses multiplications
// and additions as in one function.
template <bool kParts>
[[gnu::always_inline]] inline Vec3 PathWalk::lit(const State& path, const Vertex& at, const Candidates& candidates,
                                                 Sampler& sampler, uint64_t& rayCount, Parts* parts) const {
  const Apart apart{path.layers, path.throughput * at.s.m.alpha},
      apartConnected{path.layers, apart.factor * at.lampShare};
  Vec3 here = direct<kParts>(at, sampler, rayCount, parts, apart);
  if (vertices_ && !at.bsdf.isMirrorOnly()) {
    Vec3 diffuse;
    here += connected<kParts>(at, candidates, sampler, rayCount, &diffuse, apartConnected) * at.lampShare;
    if constexpr (kParts) parts->diffuse += diffuse * at.lampShare;
  }
  return here;
}

template <bool kParts>
Vec3 PathWalk::contribution(const Vertex& at, const LightSample& light, uint64_t& rayCount, Vec3* diffuse) const {
  if (!light.valid()) return {};
  const BsdfValue value = at.bsdf.value(light.wi);
  if (isBlack(value.f)) return {};
  const Vec3 f = light.pdf > 0 ? value.f * misWeight(light.pdf, value.pdf) : value.f;
  ++rayCount;
  const Vec3 all = f * light.radiance * rays_.transmittance(shadowRay(offsetOrigin(at.s.p, at.s.ng), at.s.p, light));
  if constexpr (kParts) *diffuse = all * diffuseShare(at.bsdf, light.wi);
  return all;
}

template <bool kParts>
Vec3 PathWalk::direct(const Vertex& at, Sampler& sampler, uint64_t& rayCount, Parts* parts, const Apart& apart,
                      bool skyToo) const {
  Vec3 sum, local, sun, sky;
  if (lights_.hasLocal()) {
    const Vec2 u = sampler.next2();
    const LightSample light = sampleLocal(lights_, at.visible, at.s.p, u, sampler.next1());
    const float left = vertices_ && vertices_->lightRays().leave(light) ? at.lampShare : 1;
    const Vec3 value = contribution<kParts>(at, light, rayCount, &local) * at.caustic * left;
    sum += value;
    apart.add(light, value);
    if constexpr (kParts) parts->diffuse += local * left;
  }
  for (size_t i = 0; i < lights_.sunCount(); ++i) {
    const Vec3 value = contribution<kParts>(at, lights_.sampleSun(i, sampler.next2()), rayCount, &sun) * at.caustic;
    sum += value;
    apart.addSun(value);
    if constexpr (kParts) parts->sharp += sun, sun = {};
  }
  if (skyToo && lights_.sky().sampled()) {
    const Vec3 value = contribution<kParts>(at, lights_.sampleSky(sampler.next2()), rayCount, &sky);
    sum += value;
    apart.addSky(value);
  }
  if constexpr (kParts) parts->diffuse += sky;
  return sum;
}

// Light that reaches s from one vertex of a light path, times the part of it that is had by connections. The vertex is
// one of a few candidates, resampled in proportion to an estimate of its light (Talbot, Cline & Egbert 2005).
template <bool kParts>
Vec3 PathWalk::connected(const Vertex& at, const Candidates& candidates, Sampler& sampler, uint64_t& rayCount,
                         Vec3* diffuse, const Apart& apart) const {
  const SurfacePoint& s = at.s;
  const Bsdf& bsdf = at.bsdf;
  const LightVertex* chosen = nullptr;
  float chosenWeight = 0, chosenShare = 0, total = 0;
  for (const LightVertex* candidate : candidates.vertex) {
    const LightVertex& v = *candidate;
    const float u = sampler.fast1();
    const Vec3 d = v.p - s.p;
    const float cosX = dot(d, s.ns), cosZ = -dot(d, v.ng);
    if (cosX <= 0 || cosZ <= 0 || dot(d, s.ng) <= 0) continue;
    const float inverse2 = 1 / std::max(lengthSquared(d), 1e-12f), inverse = std::sqrt(inverse2);
    const Vec3 towards = d * inverse;
    const float pdf = bsdf.pdf(towards);
    const float share = LightVertices::share(pdf, cosZ * inverse, inverse2, v.densityM2);
    const float weight = v.estimateCd(-towards) * pdf * inverse2 * share;
    if (!(weight > 0)) continue;
    total += weight;
    if (u * total < weight) chosen = &v, chosenWeight = weight, chosenShare = share;
  }
  if (!chosen) return {};
  const Vec3 from = offsetOrigin(s.p, s.ng), d = offsetOrigin(chosen->p, chosen->ng) - from;
  const Vec3 exact = chosen->p - s.p, wi = normalize(exact);
  const Vec3 f = bsdf.evaluate(wi);
  if (isBlack(f)) return {};
  // Radiance from z per flux: scattering with the cosine to the shading normal, of flux that came by the true one.
  const Vec3 fz = chosen->bsdf(-wi).evaluate(chosen->wi) / std::max(dot(chosen->ng, chosen->wi), 1e-6f);
  if (isBlack(fz)) return {};
  ++rayCount;
  // To just short of z; an end further from it would let light through the corners of closed shades.
  const Vec3 left = rays_.transmittance({from, d, 0, 1 - 1e-6f});
  const float toArea = -dot(chosen->ng, wi) / lengthSquared(exact);
  const float pick = static_cast<float>(vertices_->all().size()) * total / (chosenWeight * kCandidates);
  const Vec3 all = f * fz * chosen->flux * left * (toArea * chosenShare * pick);
  apart.add(*chosen, all);
  if constexpr (kParts) *diffuse = all * diffuseShare(bsdf, wi);
  return all;
}

}  // namespace roomlight
