#include "gather/hit_survey.h"

#include <atomic>

#include "base/parallel.h"
#include "gather/hit_smoothing.h"
#include "gather/pixel_rays.h"
#include "gather/pixel_shader.h"

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
  const double part = std::sqrt(std::min(1.0, kSurveyedPixels / (static_cast<double>(settings.width) * settings.height)));
  few.width = std::max(1, static_cast<int>(part * settings.width)), few.height = std::max(1, static_cast<int>(part * settings.height));
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
};

Arrivals arrivalsOf(const RayScene& rays, const Lights& lights, const RayShader& shader, const Camera& camera, const RayGatherSettings& settings, GatherCounters& count) {
  const RayGatherSettings few = surveySettings(settings);
  const PixelRays pixelRays(rays, camera, few);
  const PixelShader pixelShader(rays, lights, few, false);
  std::vector<Arrivals> byRow(static_cast<size_t>(few.height));
  std::atomic<uint64_t> rayCount = 0;
  parallelRanges(byRow.size(), kRows, [&](size_t begin, size_t end) {
    GatherCounters own;
    TileWork work;
    for (size_t y = begin; y < end; ++y) {
      work.clear();
      std::vector<FilterPixel> sums(static_cast<size_t>(few.width));
      std::vector<PixelCount> counts(sums.size());
      for (int x = 0; x < few.width; ++x) {
        std::array<Ray, kRaysAtOnce> some;
        const PixelSequence sequence(x, static_cast<int>(y), 0, few.seed);
        pixelShader.see(pixelRays.at(x, static_cast<int>(y), 0, 1, some), sequence, {&sums[static_cast<size_t>(x)], &counts[static_cast<size_t>(x)], static_cast<uint32_t>(x)}, work, own);
      }
      for (Shading& s : work.shadings) s.gathers = std::max(1, kRaysAPixel / settings.estimates), s.firstShadow = 0;
      shader.arrivals(work.shadings, byRow[y].hits, own);
      for (const Shading& s : work.shadings) byRow[y].origins.push_back({s.s.p, s.s.ng});
    }
    rayCount += own.rays;
  });
  count.rays += rayCount;
  Arrivals all;
  for (Arrivals& row : byRow) {
    for (HitArrival& hit : row.hits) hit.shading += static_cast<uint32_t>(all.origins.size());
    all.hits.insert(all.hits.end(), row.hits.begin(), row.hits.end());
    all.origins.insert(all.origins.end(), row.origins.begin(), row.origins.end());
  }
  return all;
}

HitGuide guideFrom(const Arrivals& all, const RayShader& shader) {
  std::vector<GuideRay> rays;
  for (const HitArrival& a : all.hits) {
    if (!a.first) continue;
    const Arrivals::Origin& from = all.origins[a.shading];
    GuideRay ray{from.p, from.n, a.hit.valid(), a.at.p, a.factor, 0};
    if (ray.arrives) ray.light = a.factor * shader.found(a);
    rays.push_back(ray);
  }
  return HitGuide(rays, kRegionM, kClusterM);
}

}  // namespace

void surveyHits(const RayScene& rays, const Lights& lights, RayShader& shader, const Camera& camera, const RayGatherSettings& settings, float voxelM, const Progress& progress, GatherCounters& count) {
  HitCache cache(settings.hitCellM, voxelM);
  const Arrivals all = arrivalsOf(rays, lights, shader, camera, settings, count);
  std::vector<HitPlace> places;
  std::vector<uint32_t> placeOf;
  for (uint32_t i = 0; i < all.hits.size(); ++i) {
    if (all.hits[i].hit.valid()) places.push_back(all.hits[i].at), placeOf.push_back(i);
  }
  std::vector<HitCache::Chosen> chosen = cache.chosen(places, static_cast<size_t>(settings.hitSamples));
  for (HitCache::Chosen& c : chosen) c.place = placeOf[c.place];
  const Scene& scene = rays.scene();
  const SharpLights sharp(rays, lights);
  const size_t suns = lights.sunCount(), firstSun = sharp.count() - suns;
  std::vector<LitHit> lit(chosen.size());
  std::atomic<uint64_t> rayCount = 0;
  parallelRanges(chosen.size(), kBatch, [&](size_t begin, size_t end) {
    if (progress.stop()) return;
    GatherCounters own;
    std::vector<Shading> work;
    std::vector<Shadow> shadows;
    for (size_t i = begin; i < end; ++i) {
      const HitArrival& a = all.hits[chosen[i].place];
      SurfacePoint s = surfaceAt(scene, a.hit, a.direction);
      const Vec3 origin = offsetOrigin(s.p, s.ng);
      LitHit& out = lit[i];
      out.at = a.at, out.slot = a.slot, out.sure = a.sure, out.rays = chosen[i].rays, out.albedo = bihemisphericalAlbedo(s.m);
      s.m = MaterialSample{};
      s.m.baseColor = Vec3(1);
      Sampler sampler(mix64(chosen[i].place + kLightKey), 0, settings.seed);
      const auto firstShadow = static_cast<uint32_t>(shadows.size());
      for (size_t l = 0; l < sharp.count(); ++l) {
        const Vec2 u = sampler.next2();
        shadows.push_back(sharp.shadow(l, {&origin, 1}, {&u, 1}));
        if (l < firstSun || suns != 1) continue;
        const LightSample sun = sharp.sample(l, s.p, u);
        out.sunLux = luminance(sun.radiance * shadows.back().left) * std::max(0.0f, dot(sun.wi, s.ns));
      }
      work.push_back({s, -a.direction, sampler, firstShadow, false});
      work.back().once = true;
    }
    own.rays += shadows.size();
    std::vector<SurfaceLight> light(work.size());
    shader.shade(work, shadows, light, own);
    for (size_t i = begin; i < end; ++i) {
      const SurfaceLight& l = light[i - begin];
      lit[i].even = l.diffuse, lit[i].rare = l.rare, lit[i].sharp = l.sharp, lit[i].own = l.diffuse + l.rare + l.sharp;
    }
    rayCount += own.rays;
  });
  count.rays += rayCount;
  if (progress.stop()) return;
  smoothLight(rays, cache, lit);
  cache.fill(rays, lit);
  shader.setHitCache(std::move(cache));
  shader.setGuide(guideFrom(all, shader));
}

}  // namespace roomlight
