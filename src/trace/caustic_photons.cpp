#include "trace/caustic_photons.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <unordered_set>

#include "base/parallel.h"
#include "base/sampling.h"
#include "trace/bsdf.h"

namespace roomlight {
namespace {

constexpr size_t kMostPieces = size_t{1} << 17;
constexpr float kLargestM = 0.4f, kSmallestM = 0.02f,
                kOfDistance = 0.5f;  // edges of pieces: no longer, whatever their light; so long at least, and no
 // longer than that part of the distance to the nearest lamp
constexpr size_t kAskedLights = 256;         // lamps and emissive meshes for which pieces are made that small
constexpr size_t kClusters = 2048, kClusterPieces = 16;
constexpr float kEven =
    0.01f;  // of what a light gives the pieces is taken to be even over all of them: keeps each possible
constexpr size_t kPilots = size_t{1} << 15, kFewestPilots = 4, kMostPilots = 512;
constexpr float kByPotential = 0.1f;  // of photons go where light could be without shadows
constexpr size_t kMostStarted = 2;  // for each that shall arrive
constexpr size_t kAtOnce = 512;
constexpr int kMostPanes = 16;
constexpr float kSeenM = 0.5f, kUnseen = 0.1f;  // cells of what is seen; what photons are worth elsewhere
constexpr float kLeastAlbedo = 1e-4f;
constexpr uint64_t kKey = 0x3e7a1, kPilotKey = 0x3e7a2;

// Part of a triangle of what throws light: `corner` holds barycentric weights of the triangle's vertices 1 and 2.
struct Piece {
  uint32_t instance, triangle;
  std::array<Vec2, 3> corner;
  Vec3 centre, normal;
  float areaM2;
};

// Pieces as small as lamps near them ask for, whose light varies as 1/d².
class Pieces {
 public:
  Pieces(const Scene& scene, const Lights& lights) {
    if (lights.lampCount() + lights.emitterCount() <= kAskedLights) {
      for (size_t i = 0; i < lights.lampCount(); ++i)
        near_.push_back({lights.lamp(i).position, lights.lamp(i).position});
      for (size_t i = 0; i < lights.emitterCount(); ++i) near_.push_back(lights.emitterBounds(i));
    }
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
      const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
      if (!throwsLight(scene.materials[static_cast<size_t>(mesh.material)])) continue;
      for (uint32_t t = 0; t < mesh.triangleCount(); ++t)
        add(i, t, worldTriangle(scene, i, t), {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}});
    }
  }
  std::vector<Piece> pieces;

 private:
  float toNearest(Vec3 p) const {
    float least2 = kInfinity;
    for (const Bounds3& b : near_) least2 = std::min(least2, lengthSquared(max(max(b.lo - p, p - b.hi), Vec3(0))));
    return std::sqrt(least2);
  }
  void add(uint32_t instance, uint32_t triangle, const TriangleVertices& t, const std::array<Vec2, 3>& corner) {
    const std::array<Vec3, 3> v{t.a, t.b, t.c};
    size_t longest = 0;
    for (size_t k = 1; k < 3; ++k) {
      if (lengthSquared(v[(k + 1) % 3] - v[k]) > lengthSquared(v[(longest + 1) % 3] - v[longest])) longest = k;
    }
    const Vec3 centre = (t.a + t.b + t.c) / 3, across = cross(t.b - t.a, t.c - t.a);
    const float edge = length(v[(longest + 1) % 3] - v[longest]), doubled = length(across);
    if (!(doubled > 0)) return;
    if (pieces.size() < kMostPieces && edge > kSmallestM &&
        edge > std::min(kLargestM, kOfDistance * std::max(0.0f, toNearest(centre) - edge))) {
      const size_t a = longest, b = (longest + 1) % 3, c = (longest + 2) % 3;
      const Vec3 middle = (v[a] + v[b]) * 0.5f;
      const Vec2 cornerMiddle{0.5f * (corner[a].x + corner[b].x), 0.5f * (corner[a].y + corner[b].y)};
      add(instance, triangle, {v[a], middle, v[c]}, {corner[a], cornerMiddle, corner[c]});
      add(instance, triangle, {middle, v[b], v[c]}, {cornerMiddle, corner[b], corner[c]});
      return;
    }
    pieces.push_back({instance, triangle, corner, centre, across / doubled, 0.5f * doubled});
  }

  std::vector<Bounds3> near_;
};

uint64_t cellOf(Vec3 p) {
  const auto whole = [](float v) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(v / kSeenM))) & 0x1fffff;
  };
  return whole(p.x) | whole(p.y) << 21 | whole(p.z) << 42;
}

// Its flux as if it stood for all light of what it was chosen from.
struct Flight {
  SurfacePoint s;  // that throws it, lit from `wi`
  Vec3 wi, flux;
  Ray ray;
  Sampler sampler;
  int reflections = 0, panes = 0;
  int32_t lamp = -1, emitter = -1;  // whose light it is
};

}  // namespace

class CausticPhotons::Tracer {
 public:
  Tracer(const RayScene& rays, const Lights& lights, std::span<const Vec3> seen, Wish wish, uint64_t seed)
      : rays_(rays), lights_(lights), seed_(seed), wish_(wish), pieces_(Pieces(rays.scene(), lights).pieces) {
    for (const Vec3 p : seen) seen_.insert(cellOf(p));
    const size_t most = std::max(kClusterPieces, (pieces_.size() + kClusters - 1) / kClusters);
    for (size_t i = 0; i < pieces_.size(); ++i) {
      if (i == 0 || pieces_[i].instance != pieces_[i - 1].instance || i - first_.back() >= most) first_.push_back(i);
    }
    first_.push_back(pieces_.size());
    for (size_t s = 0; s < sourceCount() && !pieces_.empty(); ++s) sources_.push_back(source(s));
    learn();
  }

  bool any() const { return any_; }
  std::vector<CausticPhoton> trace(size_t count, uint32_t round) {
    if (!any()) return {};
    const double started =
        std::min(static_cast<double>(count) / std::max(arriving_, 1e-9), static_cast<double>(kMostStarted * count));
    std::vector<CausticPhoton> photons;
    for (const Source& s : sources_) send(s, static_cast<size_t>(std::ceil(started * s.chance)), round, photons);
    return photons;
  }
  uint64_t rayCount() const { return rayCount_; }

 private:
  struct Cluster {  // pieces that follow one another
    double potential = 0;  // lm that a light could give them,
    double score = 0;  // lm that arrive of it, by what they are worth
    double arriving = 0;  // photons that arrive where it is seen, of each
    double chance = 0;
  };
  struct Source {  // a sun, all lamps, or all emissive meshes
    size_t index;
    std::vector<float> weight;  // of each piece
    std::vector<Cluster> clusters;
    double potential = 0, chance = 0;
  };

  // By pilots: how many photons go where.
  void learn() {
    double potential = 0, score = 0;
    for (const Source& s : sources_) potential += s.potential;
    if (!(potential > 0)) return;
    for (Source& s : sources_) sendPilots(s, potential);
    for (const Source& s : sources_) {
      for (const Cluster& c : s.clusters) score += c.score;
    }
    any_ = score > 0;
    if (!any_) return;
    for (Source& s : sources_) {
      for (Cluster& c : s.clusters)
        c.chance = (1 - kByPotential) * c.score / score + kByPotential * c.potential / potential, s.chance += c.chance,
        arriving_ += c.chance * c.arriving;
    }
  }

  size_t sourceCount() const { return lights_.sunCount() + 2; }

  // Half of the lamps and emissive meshes by what they could give at p, half evenly where their light is told apart:
  // else a dim one would be known by few photons.
  LightSample sampleOf(size_t source, Vec3 p, Sampler& sampler) const {
    if (source < lights_.sunCount()) return lights_.sampleSun(source, sampler.next2());
    const bool lamps = source == lights_.sunCount();
    const size_t count = lamps ? lights_.lampCount() : lights_.emitterCount();
    if (count == 0) return {};
    const float evenly = wish_.apart ? 0.5f : 0, choice = sampler.next1();
    LightTree::Choice chosen;
    if (choice < evenly) {
      chosen.index = std::min(count - 1, static_cast<size_t>(choice / evenly * static_cast<float>(count)));
      chosen.chance = lamps ? lights_.chanceOfLamp(chosen.index, p) : lights_.chanceOfEmitter(chosen.index, p);
    } else {
      const float rest = (choice - evenly) / (1 - evenly);
      chosen = lamps ? lights_.chooseLamp(p, rest) : lights_.chooseEmitter(p, rest);
      if (!(chosen.chance > 0)) return {};
    }
    const float chance = (1 - evenly) * chosen.chance + evenly / static_cast<float>(count);
    const Vec2 u = sampler.next2();
    LightSample light =
        lamps ? lights_.sampleLamp(chosen.index, p, u) : lights_.sampleEmitter(chosen.index, p, u, sampler.next1());
    light.radiance *= 1 / chance;
    return light;
  }

  // lm on a piece, about, if nothing stands between.
  float potentialOf(size_t source, const Piece& piece) const {
    if (source < lights_.sunCount()) {
      const LightSample sun = lights_.sampleSun(source, {0.5f, 0.5f});
      return luminance(sun.radiance) * std::abs(dot(sun.wi, piece.normal)) * piece.areaM2;
    }
    const bool lamps = source == lights_.sunCount();
    if ((lamps ? lights_.lampCount() : lights_.emitterCount()) == 0) return 0;
    const LightTree::Choice choice =
        lamps ? lights_.chooseLamp(piece.centre, 0.5f) : lights_.chooseEmitter(piece.centre, 0.5f);
    if (!(choice.chance > 0)) return 0;
    return piece.areaM2 *
           (lamps ? lights_.lampImportance(choice.index, piece.centre)
                  : lights_.emitterImportance(choice.index, piece.centre)) /
           choice.chance;
  }

  Source source(size_t index) const {
    Source s{index, std::vector<float>(pieces_.size()), std::vector<Cluster>(first_.size() - 1)};
    parallelFor(pieces_.size(), 256, [&](size_t i) { s.weight[i] = potentialOf(index, pieces_[i]); });
    double area = 0, sum = 0;
    for (size_t i = 0; i < pieces_.size(); ++i)
      area += static_cast<double>(pieces_[i].areaM2), sum += static_cast<double>(s.weight[i]);
    for (size_t i = 0; i < pieces_.size(); ++i)
      s.weight[i] += kEven * pieces_[i].areaM2 * static_cast<float>(sum / area);
    for (size_t c = 0; c < s.clusters.size(); ++c) {
      for (size_t i = first_[c]; i < first_[c + 1]; ++i) s.clusters[c].potential += static_cast<double>(s.weight[i]);
      s.potential += s.clusters[c].potential;
    }
    return s;
  }

  // Light of a source on a cluster, chosen by u. What stands between is not known yet.
  bool start(const Source& source, size_t cluster, Vec2 u, Flight& flight, Ray& shadow) const {
    const size_t first = first_[cluster], n = first_[cluster + 1] - first;
    const auto all = static_cast<float>(source.clusters[cluster].potential);
    const size_t i = first + chooseByWeight(
                                 n, all, [&](size_t k) { return source.weight[first + k]; }, u.x);
    const Piece& piece = pieces_[i];
    const Vec2 on = sampleTriangle(u);
    const auto mixed = [&](float a, float b, float c) { return a + (b - a) * on.x + (c - a) * on.y; };
    Hit hit{piece.instance,
            piece.triangle,
            mixed(piece.corner[0].x, piece.corner[1].x, piece.corner[2].x),
            mixed(piece.corner[0].y, piece.corner[1].y, piece.corner[2].y),
            0,
            piece.normal};
    const TriangleVertices t = worldTriangle(rays_.scene(), hit.instance, hit.triangle);
    const Vec3 p = t.a + (t.b - t.a) * hit.b1 + (t.c - t.a) * hit.b2;
    const LightSample light = sampleOf(source.index, p, flight.sampler);
    if (!light.valid()) return false;
    flight.s = surfaceAt(rays_.scene(), hit, -light.wi);
    flight.wi = light.wi, flight.lamp = light.lamp, flight.emitter = light.emitter;
    flight.flux = light.radiance * (std::max(0.0f, dot(light.wi, flight.s.ng)) * flight.s.m.alpha * piece.areaM2 * all /
                                    source.weight[i]);
    shadow = shadowRay(offsetOrigin(flight.s.p, flight.s.ng), flight.s.p, light);
    return !isBlack(flight.flux);
  }

  // Sends it on as its surface reflects it.
  static bool reflect(Flight& f) {
    if (f.reflections++ >= kMostReflections) return false;
    const Bsdf bsdf(f.s.m, f.s.ns, f.s.ng, f.wi);
    const Vec2 u = f.sampler.next2();
    const BsdfSample b = bsdf.sample(u, f.sampler.next1());
    if (!b.valid() || dot(b.wi, f.s.ng) <= 0) return false;
    f.flux *= b.weight * shadingCorrection(f.s, f.wi, b.wi);
    f.ray = {offsetOrigin(f.s.p, f.s.ng), b.wi, 0, kInfinity};
    return !isBlack(f.flux);
  }

  // Where its ray ends; false: it goes no further.
  template <class Keep>
  bool arrive(Flight& f, const Hit& hit, const Keep& keep) const {
    if (!hit.valid()) return false;
    const Vec3 d = f.ray.direction;
    SurfacePoint s = surfaceAt(rays_.scene(), hit, d);
    const Vec3 through = passing(s.m, *s.material, std::abs(dot(s.ns, d)));
    const bool polished = throwsLight(*s.material);
    const float passes = std::min(1.0f, luminance(through)),
                back = polished ? s.m.alpha * luminance(bihemisphericalAlbedo(s.m)) : 1 - passes;
    if (!polished &&
        (wish_.white ||
         maxComponent(s.m.baseColor) * (1 - s.m.metallic) * (1 - s.m.transmission) * s.m.alpha > kLeastAlbedo))
      keep(CausticPhoton{hit, s.p, s.ng, -d, f.flux, f.lamp, f.emitter}, f.sampler);
    const float chance = passes > 0 ? passes / (passes + back) : 0;
    if (chance > 0 && f.sampler.next1() < chance) {
      f.flux *= through / chance;
      f.ray.origin = offsetOrigin(s.p, -s.ng);
      return ++f.panes <= kMostPanes;
    }
    if (!polished) return false;
    f.flux *= s.m.alpha / (1 - chance);
    f.wi = -d, f.s = s;
    return reflect(f);
  }

  // Follows those of `flights` to which light comes along their `shadows`.
  template <class Keep>
  uint64_t follow(std::vector<Flight>& flights, std::span<const Ray> shadows, const Keep& keep) const {
    std::vector<Vec3> left(flights.size());
    rays_.transmittance(shadows, left);
    uint64_t count = flights.size();
    size_t live = 0;
    for (size_t i = 0; i < flights.size(); ++i) {
      flights[i].flux *= left[i];
      if (!isBlack(flights[i].flux) && reflect(flights[i])) flights[live++] = flights[i];
    }
    std::vector<Ray> way;
    std::vector<Hit> hits;
    while (live > 0) {
      way.clear();
      for (size_t i = 0; i < live; ++i) way.push_back(flights[i].ray);
      hits.resize(live);
      rays_.intersect(way, hits);
      count += live;
      size_t on = 0;
      for (size_t i = 0; i < live; ++i) {
        if (arrive(flights[i], hits[i], keep)) flights[on++] = flights[i];
      }
      live = on;
    }
    return count;
  }

  bool isSeen(Vec3 p) const { return seen_.contains(cellOf(p)); }

  // A few of each cluster tell what light arrives of it, and where.
  void sendPilots(Source& source, double potential) {
    std::atomic<uint64_t> rayCount = 0;
    parallelFor(source.clusters.size(), 4, [&](size_t c) {
      Cluster& cluster = source.clusters[c];
      if (!(cluster.potential > 0)) return;
      const size_t n = std::clamp(static_cast<size_t>(static_cast<double>(kPilots) * cluster.potential / potential),
                                  kFewestPilots, kMostPilots);
      std::vector<Flight> flights;
      std::vector<Ray> shadows;
      for (size_t k = 0; k < n; ++k) {
        Sampler sampler(mix64(kPilotKey + (source.index << 32) + c), static_cast<uint32_t>(k), seed_);
        const Vec2 u = sampler.next2();
        Flight f{{}, {}, {}, {}, sampler};
        Ray shadow;
        if (start(source, c, u, f, shadow)) flights.push_back(f), shadows.push_back(shadow);
      }
      rayCount += follow(flights, shadows, [&](const CausticPhoton& photon, Sampler&) {
        const bool seen = isSeen(photon.p);
        cluster.score += static_cast<double>(luminance(photon.fluxLm) * (seen ? 1 : kUnseen)) / static_cast<double>(n);
        cluster.arriving += (seen ? 1.0 : 0.0) / static_cast<double>(n);
      });
    });
    rayCount_ += rayCount;
  }

  void send(const Source& source, size_t count, uint32_t round, std::vector<CausticPhoton>& photons) {
    if (!(source.chance > 0)) return;
    std::vector<double> upTo;
    double sum = 0;
    for (const Cluster& c : source.clusters) upTo.push_back(sum += c.chance / source.chance);
    std::vector<std::vector<CausticPhoton>> kept((count + kAtOnce - 1) / kAtOnce);
    std::atomic<uint64_t> rayCount = 0;
    parallelFor(kept.size(), 1, [&](size_t batch) {
      std::vector<Flight> flights;
      std::vector<Ray> shadows;
      for (size_t k = batch * kAtOnce; k < std::min(count, (batch + 1) * kAtOnce); ++k) {
        Sampler sampler(mix64(kKey + source.index + (uint64_t{round} << 32)), static_cast<uint32_t>(k), seed_);
        Vec2 u = sampler.next2();
        const double choice = static_cast<double>(u.x) * sum;
        const size_t c = std::min(
            static_cast<size_t>(std::upper_bound(upTo.begin(), upTo.end(), choice) - upTo.begin()), upTo.size() - 1);
        const double before = c > 0 ? upTo[c - 1] : 0, chance = upTo[c] - before;
        u.x = std::clamp(static_cast<float>((choice - before) / chance), 0.0f, kBelowOne);
        Flight f{{}, {}, {}, {}, sampler};
        Ray shadow;
        if (!start(source, c, u, f, shadow)) continue;
        f.flux *= static_cast<float>(1 / (chance * static_cast<double>(count)));
        flights.push_back(f), shadows.push_back(shadow);
      }
      rayCount += follow(flights, shadows, [&](CausticPhoton photon, Sampler& sampler) {
        // Of what arrives where it is not seen few are kept.
        if (!isSeen(photon.p)) {
          if (sampler.fast1() >= kUnseen) return;
          photon.fluxLm = photon.fluxLm / kUnseen;
        }
        kept[batch].push_back(photon);
      });
    });
    for (const auto& of : kept) photons.insert(photons.end(), of.begin(), of.end());
    rayCount_ += rayCount;
  }

  const RayScene& rays_;
  const Lights& lights_;
  const uint64_t seed_;
  const Wish wish_;
  const std::vector<Piece> pieces_;
  std::vector<size_t> first_;  // piece of each cluster, and one past all
  std::unordered_set<uint64_t> seen_;
  std::vector<Source> sources_;
  bool any_ = false;
  double arriving_ = 0;  // photons that arrive where it is seen, of each
  uint64_t rayCount_ = 0;
};

int32_t layerOf(const CausticPhoton& photon, const LightLayers& layers) {
  if (photon.lamp >= 0) return layers.ofLamp[static_cast<size_t>(photon.lamp)];
  return photon.emitter >= 0 ? layers.ofEmitter[static_cast<size_t>(photon.emitter)] : layers.sun;
}

CausticPhotons::CausticPhotons(const TracedScene& scene, std::span<const Vec3> seen, Wish wish, uint64_t seed)
    : tracer_(std::make_unique<Tracer>(scene.rays, scene.lights, seen, wish, seed)) {}
CausticPhotons::~CausticPhotons() = default;

std::vector<CausticPhoton> CausticPhotons::trace(size_t count, uint32_t round) { return tracer_->trace(count, round); }
bool CausticPhotons::any() const { return tracer_->any(); }
uint64_t CausticPhotons::rayCount() const { return tracer_->rayCount(); }

}  // namespace roomlight
