#include "gather/hit_survey.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "base/parallel.h"
#include "gather/hit_cache.h"
#include "gather/layer_light.h"
#include "gather/pixel_rays.h"
#include "gather/pixel_shader.h"
#include "gather/ray_shader.h"

namespace roomlight {
namespace {

constexpr int kSurveyedPixels = 32768;  // about
constexpr int kRaysAPixel = 8;
constexpr size_t kRows = 2;             // of surveyed pixels, at once
constexpr float kRegionM = 0.6f;        // that a guide is learned for
constexpr float kClusterM = 0.4f;      // of its targets
constexpr size_t kBatch = 256;          // places lit at once
constexpr uint64_t kSurveyKey = 0x5e7e11, kLightKey = 0x5e7e12;  // other random numbers than pixels have

// The picture's camera, few pixels, a ray each.
RayGatherSettings surveySettings(const RayGatherSettings& settings) {
  RayGatherSettings few = settings;
  const double part =
      std::sqrt(std::min(1.0, kSurveyedPixels / (static_cast<double>(settings.width) * settings.height)));
  few.width = std::max(1, static_cast<int>(part * settings.width)),
  few.height = std::max(1, static_cast<int>(part * settings.height));
  few.samples = few.firstSamples = few.raysPerShading = few.fewestShadings = 1;
  few.seed = settings.seed ^ kSurveyKey;
  return few;
}

// Where rays arrive, and where they began.
struct Arrivals {
  struct Origin {
    Vec3 p, n;
  };
  std::vector<HitArrival> hits;
  std::vector<Origin> origins;
  void add(const Arrivals& more) {
    for (HitArrival hit : more.hits) hit.shading += static_cast<uint32_t>(origins.size()), hits.push_back(hit);
    origins.insert(origins.end(), more.origins.begin(), more.origins.end());
  }
};

Arrivals arrivalsOf(const RayScene& rays, const Lights& lights, const RayShader& shader, const Camera& camera,
                    const RayGatherSettings& settings, uint64_t& allRays) {
  const RayGatherSettings few = surveySettings(settings);
  const PixelRays pixelRays(rays, camera, few);
  const PixelShader pixelShader(rays, lights, few, false);
  std::vector<Arrivals> byRow(static_cast<size_t>(few.height));
  std::atomic<uint64_t> rayCount = 0;
  const auto arriveFrom = [&](size_t y, TileWork& work, GatherCounters& count) {
    work.clear();
    std::vector<FilterPixel> sums(static_cast<size_t>(few.width));
    std::vector<PixelCount> counts(sums.size());
    for (int x = 0; x < few.width; ++x) {
      std::array<Ray, kRaysAtOnce> some;
      const PixelSequence sequence(x, static_cast<int>(y), 0, few.seed);
      pixelShader.see(pixelRays.at(x, static_cast<int>(y), 0, 1, some), sequence,
                      {&sums[static_cast<size_t>(x)], &counts[static_cast<size_t>(x)], static_cast<uint32_t>(x)}, work,
                      count);
    }
    for (Shading& s : work.shadings) s.gathers = std::max(1, kRaysAPixel / settings.estimates), s.firstShadow = 0;
    shader.arrivals(work.shadings, byRow[y].hits, count);
    for (const Shading& s : work.shadings) byRow[y].origins.push_back({s.s.p, s.s.ng});
  };
  parallelRanges(byRow.size(), kRows, [&](size_t begin, size_t end) {
    GatherCounters own;
    TileWork work;
    for (size_t y = begin; y < end; ++y) arriveFrom(y, work, own);
    rayCount += own.rays;
  });
  allRays += rayCount;
  Arrivals all;
  for (const Arrivals& row : byRow) all.add(row);
  return all;
}

HitGuide guideFrom(const Arrivals& all, const RayShader& shader, const HitCache& hits) {
  std::vector<GuideRay> rays;
  for (const HitArrival& a : all.hits) {
    if (!a.first) continue;
    const Arrivals::Origin& from = all.origins[a.shading];
    GuideRay ray{from.p, from.n, a.hit.valid(), a.at.p, a.factor, 0};
    if (ray.arrives) ray.light = a.factor * shader.found(a, hits);
    rays.push_back(ray);
  }
  return HitGuide(rays, kRegionM, kClusterM);
}

// The light of places where rays arrive, one sample each.
class LitPlaces {
 public:
  LitPlaces(const RayScene& rays, const Lights& lights, const RayShader& shader, const HitSurvey& known,
            const RayGatherSettings& settings)
      : rays_(rays),
        shader_(shader),
        known_(known),
        settings_(settings),
        sharp_(rays, lights),
        suns_(lights.sunCount()) {}

  void light(const Arrivals& all, std::span<const HitCache::Chosen> chosen, std::span<LitHit> lit, HitLayers* layers,
             GatherCounters& count) const {
    std::vector<Shading> work;
    std::vector<Shadow> shadows;
    for (size_t i = 0; i < chosen.size(); ++i)
      work.push_back(prepared(all.hits[chosen[i].place], chosen[i], lit[i], shadows));
    count.rays += shadows.size();
    std::vector<SurfaceLight> light(work.size());
    LayerSums apart(layers ? shader_.layers()->size() : 0);
    if (layers) apart.resize(work.size());
    shader_.shade(work, shadows, light, layers ? &apart : nullptr, &known_, count);
    for (size_t i = 0; i < lit.size(); ++i) {
      const SurfaceLight& l = light[i];
      lit[i].even = l.diffuse, lit[i].rare = l.rare, lit[i].sharp = l.sharp, lit[i].own = l.diffuse + l.rare + l.sharp;
      if (layers) layers->take(lit[i].number, apart, i);
    }
  }

 private:
  Shading prepared(const HitArrival& a, const HitCache::Chosen& chosen, LitHit& out,
                   std::vector<Shadow>& shadows) const {
    SurfacePoint s = surfaceAt(rays_.scene(), a.hit, a.direction);
    const Vec3 origin = offsetOrigin(s.p, s.ng);
    out.at = a.at, out.slot = a.slot, out.sure = a.sure, out.rays = chosen.rays,
    out.albedo = bihemisphericalAlbedo(s.m);
    s.m = MaterialSample{};
    s.m.baseColor = Vec3(1);
    Sampler sampler(mix64(chosen.place + kLightKey), 0, settings_.seed);
    const auto firstShadow = static_cast<uint32_t>(shadows.size());
    for (size_t l = 0; l < sharp_.count(); ++l) {
      const Vec2 u = sampler.next2();
      shadows.push_back(sharp_.shadow(l, {&origin, 1}, {&u, 1}));
      if (l + suns_ < sharp_.count() || suns_ != 1) continue;
      const LightSample sun = sharp_.sample(l, s.p, u);
      out.sunLux = luminance(sun.radiance * shadows.back().left) * std::max(0.0f, dot(sun.wi, s.ns));
    }
    Shading shading{s, -a.direction, sampler, firstShadow, false};
    shading.once = true;
    return shading;
  }

  const RayScene& rays_;
  const RayShader& shader_;
  const HitSurvey& known_;  // so far: photons
  const RayGatherSettings& settings_;
  const SharpLights sharp_;
  const size_t suns_;
};

CausticMap causticsOf(const RayScene& rays, const Lights& lights, const RayShader& shader, const Arrivals& all,
                      const RayGatherSettings& settings, uint64_t& rayCount) {
  if (settings.causticPhotons <= 0) return {};
  std::vector<Vec3> seen;
  for (const Arrivals::Origin& o : all.origins) seen.push_back(o.p);
  CausticPhotons tracer({rays, lights}, seen, {shader.layers() != nullptr, settings.white}, settings.seed);
  CausticMap map(tracer.trace(static_cast<size_t>(settings.causticPhotons)), shader.layers());
  rayCount += tracer.rayCount();
  return map;
}

}  // namespace

HitSurvey surveyHits(const RayScene& rays, const Lights& lights, const RayShader& shader, const Camera& camera,
                     const RayGatherSettings& settings, const Progress& progress) {
  HitSurvey out{HitCache(settings.hitCellM, shader.voxelM()), {}, {}, 0};
  const Arrivals all = arrivalsOf(rays, lights, shader, camera, settings, out.rays);
  out.caustics = causticsOf(rays, lights, shader, all, settings, out.rays);
  if (progress.stop()) return out;
  std::vector<HitPlace> places;
  std::vector<uint32_t> placeOf;
  for (uint32_t i = 0; i < all.hits.size(); ++i) {
    if (all.hits[i].hit.valid()) places.push_back(all.hits[i].at), placeOf.push_back(i);
  }
  std::vector<HitCache::Chosen> chosen = out.hits.chosen(places, static_cast<size_t>(settings.hitSamples));
  for (HitCache::Chosen& c : chosen) c.place = placeOf[c.place];
  std::vector<LitHit> lit(chosen.size());
  for (uint32_t i = 0; i < lit.size(); ++i) lit[i].number = i;
  std::optional<HitLayers> layers;
  if (shader.layers()) layers.emplace(shader.layers()->size(), lit.size());
  const LitPlaces lighting(rays, lights, shader, out, settings);
  std::atomic<uint64_t> rayCount = 0;
  parallelRanges(chosen.size(), kBatch, [&](size_t begin, size_t end) {
    if (progress.stop()) return;
    GatherCounters own;
    lighting.light(all, std::span(chosen).subspan(begin, end - begin), std::span(lit).subspan(begin, end - begin),
                   layers ? &*layers : nullptr, own);
    rayCount += own.rays;
  });
  out.rays += rayCount;
  if (progress.stop()) return out;
  if (layers) layers->smooth(rays, out.hits, lit);
  smoothLight(rays, out.hits, lit);
  out.hits.fill(rays, lit, layers ? &*layers : nullptr);
  out.guide = guideFrom(all, shader, out.hits);
  return out;
}

}  // namespace roomlight
