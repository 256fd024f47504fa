#include "gather/picture.h"

#include <algorithm>
#include <bit>
#include <mutex>
#include <optional>

#include "base/clock.h"
#include "base/parallel.h"
#include "base/split.h"
#include "filter/filter.h"
#include "gather/error_probes.h"
#include "gather/noise_map.h"
#include "gather/openness.h"
#include "gather/pixel_rays.h"
#include "gather/sparse_gather.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;
constexpr size_t kTilesAtOnce = 4;
constexpr size_t kPlanned = 3;     // a plan of further rays is made anew once more than that many times the rays it knew were traced
constexpr float kFiner = 0.6f, kFinest = 0.002f;  // times the tolerance where too much error is left; no finer
constexpr float kUnfiltered = 4;  // times the tolerance where outliers hide what noise a filter leaves: that of single pixels is asked for

Rectangle tileAt(size_t index, int width, int height) {
  const int tilesX = (width + kTile - 1) / kTile, x = static_cast<int>(index) % tilesX * kTile, y = static_cast<int>(index) / tilesX * kTile;
  return {x, y, std::min(width, x + kTile), std::min(height, y + kTile)};
}

// What the filter is told of one layer: what pixels see is that of the whole, light and noise its own.
FilterInput inputOfLayer(const FilterInput& whole, const std::vector<PixelCount>& counts, const LayerSums& sums, size_t layer) {
  FilterInput out(whole.width, whole.height);
  parallelFor(counts.size(), 4096, [&](size_t i) {
    FilterPixel& p = out.pixels[i];
    p = whole.pixels[i];
    const auto per = [](uint32_t n) { return 1 / static_cast<float>(std::max(1u, n)); };
    const float inverse = per(counts[i].rays), diffuse = per(counts[i].gathered), specular = per(counts[i].glossy), albedo = std::max(luminance(p.albedo), 1e-3f);
    p.diffuse = sums.get(i, LayerSums::kDiffuse, layer) * diffuse, p.sharp = sums.get(i, LayerSums::kSharp, layer) * inverse;
    p.specular = sums.get(i, LayerSums::kSpecular, layer) * specular, p.rest = sums.get(i, LayerSums::kRest, layer) * inverse;
    const Vec3 variance = sums.get(i, LayerSums::kVariance, layer);
    p.diffuseVariance = variance.x * diffuse * diffuse / (albedo * albedo), p.sharpVariance = variance.y * inverse * inverse / (albedo * albedo);
    p.specularVariance = variance.z * specular * specular;
  });
  return out;
}

}  // namespace

GatheredPicture gatherPicture(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, const Camera& camera, const PictureSettings& settings,
                              const Progress& progress) {
  const int w = settings.width, h = settings.height;
  const PixelRays pixelRays(rays, camera, settings);
  const auto every = settings.filterPasses > 0 ? std::bit_floor(static_cast<uint32_t>(settings.gatherEvery)) : 1u;
  const LightLayers* layers = shader.layers();
  LayerSums byLayer(layers ? layers->size() : 0);
  byLayer.resize(static_cast<size_t>(w) * static_cast<size_t>(h));
  const bool keepsFragments = settings.filterPasses > 0 && every == 1 && !layers && !pixelRays.camera().wraps();
  const PixelShader pixelShader(rays, lights, settings, keepsFragments, layers, layers ? &byLayer : nullptr);
  GatheredPicture result;
  FilterInput sums(w, h);
  std::vector<PixelCount> counts(sums.pixels.size());
  const size_t tiles = static_cast<size_t>((w + kTile - 1) / kTile) * static_cast<size_t>((h + kTile - 1) / kTile);
  std::vector<Fragments> fragments(keepsFragments ? tiles : 0);
  std::atomic<uint64_t> rayCount = 0, coneCount = 0;
  std::mutex reporting;
  const Stopwatch watch;
  std::vector<uint16_t> needed;  // rays, as planned after so many samples
  size_t planned = 0;
  float tolerance = settings.tolerance;
  double passSeconds = 0, passRays = 0;  // of the last
  bool late = false;
  const auto aimReached = [&] {  // how far
    return result.error.srgbMse > 0 ? static_cast<float>(std::min(1.0, settings.untilMse / result.error.srgbMse)) : 0.0f;
  };
  const auto gather = [&] {  // until no pixel needs more, or there is no time
    while (result.samples < settings.samples) {
      const auto first = static_cast<size_t>(result.samples);
      const bool chosen = first > 0 && tolerance > 0;
      const auto most = static_cast<size_t>(first > 0 || !(tolerance > 0) ? settings.samples : std::min(settings.samples, settings.firstSamples));
      const size_t n = std::min(kRaysAtOnce, most - first);
      if (chosen && first > kPlanned * planned) {
        const FilteredLuminance left = settings.rareApart ? filteredLuminance(sums, settings.filterPasses, [&](size_t i) { return meanOf(sums.pixels[i], counts[i]); }) : FilteredLuminance();
        needed = raysNeeded(sums, counts, left, settings.rareApart ? tolerance : kUnfiltered * tolerance);
        planned = first;
      }
      const auto asks = [&](uint16_t further) { return further > first - planned; };
      const auto pixels = chosen ? std::count_if(needed.begin(), needed.end(), asks) : static_cast<std::ptrdiff_t>(counts.size());
      const double chosenRays = static_cast<double>(n) * static_cast<double>(pixels);
      if (chosenRays == 0) return;
      const double started = watch.seconds();
      if (settings.timeLimitS > 0 && first > 0 && started + passSeconds * chosenRays / passRays > settings.timeLimitS) return void(late = true);
      std::atomic<size_t> tilesDone = 0;
      parallelRanges(tiles, kTilesAtOnce, [&](size_t begin, size_t end) {
        GatherCounters count;
        TileWork work;
        std::vector<SurfaceLight> light;
        LayerSums layerLight(layers ? layers->size() : 0);
        std::array<Ray, kRaysAtOnce> some;
        for (size_t tile = begin; tile < end; ++tile) {
          if (progress.stop() && (first > 0 || settings.orNothing)) return;
          work.clear();
          const Rectangle r = tileAt(tile, w, h);
          for (int y = r.y0; y < r.y1; ++y) {
            for (int x = r.x0; x < r.x1; ++x) {
              const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x);
              if (chosen && !asks(needed[pixel])) continue;
              const PixelSequence sequence(x, y, static_cast<uint32_t>(first), settings.seed, every);
              pixelShader.see(pixelRays.at(x, y, first, n, some), sequence, {&sums.pixels[pixel], &counts[pixel], static_cast<uint32_t>(pixel)}, work, count);
            }
          }
          if (every > 1) gatherSparsely(work, r, every, settings.rayRoughness, static_cast<uint32_t>(n), sums);
          light.resize(work.shadings.size());
          if (layers) {
            layerLight.resize(work.shadings.size());
            shader.shadeInLayers(work.shadings, work.shadows, light, layerLight, count);
          } else {
            shader.shade(work.shadings, work.shadows, light, count);
          }
          if (!keepsFragments) pixelShader.findOutshining(work, light);
          PixelShader::add(work, light, keepsFragments ? &fragments[tile] : nullptr);
          if (layers) pixelShader.addLayers(work, light, layerLight);
          const size_t done = ++tilesDone;
          if (done % 64 == 0 && reporting.try_lock()) {
            progress.at(std::max(aimReached(), (static_cast<float>(first) + static_cast<float>(n) * static_cast<float>(done) / static_cast<float>(tiles)) / static_cast<float>(settings.samples)));
            reporting.unlock();
          }
        }
        rayCount += count.rays;
        coneCount += count.cones;
      });
      result.samples += static_cast<int>(n);
      passSeconds = watch.seconds() - started, passRays = chosenRays;
      if (first == 0 && settings.rareApart && !(settings.orNothing && progress.stop())) rayCount += findOpenness(rays, pixelRays.camera(), settings.seed, sums);
      if (progress.stop()) return;
    }
  };
  // The picture of all samples so far. What it is made of is changed to means over each pixel's.
  const auto compose = [&](FilterInput& means) {
    if (std::any_of(counts.begin(), counts.end(), [](const PixelCount& c) { return c.occlusion > 0; })) result.occlusion = Image(w, h);
    parallelFor(counts.size(), 4096, [&](size_t i) {
      means.pixels[i] = meanOf(means.pixels[i], counts[i]);
      if (!result.occlusion.pixels.empty()) result.occlusion.pixels[i] = Vec3(counts[i].occlusion / static_cast<float>(std::max(1u, counts[i].rays)));
    });
    std::vector<Vec3> irradiance;
    result.image = settings.filterPasses > 0 ? filtered(means, settings.filterPasses, pixelRays.camera().wraps(), nullptr, keepsFragments ? &irradiance : nullptr) : composed(means);
    parallelFor(fragments.size(), 16, [&](size_t t) { addFragments(fragments[t], means, counts, irradiance, result.image); });
  };
  const bool hasAim = settings.untilMse > 0 && !layers;
  std::optional<ErrorProbes> probes;
  for (;;) {
    gather();
    if (settings.orNothing && progress.stop()) return {};
    const bool mayGoOn = hasAim && !late && !progress.stop() && result.samples < settings.samples && tolerance > kFinest;
    if (mayGoOn) {
      FilterInput means = sums;
      compose(means);
    } else {
      compose(sums);
    }
    if ((settings.tellsError || hasAim) && !layers && !late) {
      if (!probes) probes.emplace(rays, lights, shader, camera, settings, hasAim, progress);
      result.error = probes->of(result.image);
    }
    if (!mayGoOn || progress.stop() || result.error.srgbMse <= settings.untilMse) break;
    tolerance *= kFiner, planned = 0;
  }
  if (layers) {
    for (size_t l = 0; l < layers->size(); ++l) {
      const FilterInput input = inputOfLayer(sums, counts, byLayer, l);
      result.layers.push_back(settings.filterPasses > 0 ? filtered(input, settings.filterPasses, pixelRays.camera().wraps()) : composed(input));
    }
    splitLike(result.image, result.layers);
    result.layerBytes = byLayer.bytes();
  }
  result.rays = rayCount + (probes ? probes->rays() : 0);
  result.cones = coneCount;
  return result;
}

}  // namespace roomlight
