#include "gather/picture.h"

#include <algorithm>
#include <bit>
#include <mutex>
#include <optional>

#include "base/image_layers.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "filter/filter.h"
#include "gather/error_probes.h"
#include "gather/pixel_rays.h"
#include "gather/pixel_shader.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;
constexpr size_t kTilesAtOnce = 4;
constexpr size_t kPlanned =
    3;     // a plan of further rays is made anew once more than that many times the rays it knew were traced
constexpr float kFiner = 0.6f, kFinest = 0.002f;  // times the tolerance where too much error is left; no finer
constexpr float kUnfiltered =
    4;  // times the tolerance where outliers hide what noise a filter leaves: that of single pixels is asked for

Rectangle tileAt(size_t index, int width, int height) {
  const int tilesX = (width + kTile - 1) / kTile, x = static_cast<int>(index) % tilesX * kTile,
            y = static_cast<int>(index) / tilesX * kTile;
  return {x, y, std::min(width, x + kTile), std::min(height, y + kTile)};
}

// What the filter is told of one layer: what pixels see is that of the whole, light and noise its own.
FilterInput inputOfLayer(const FilterInput& whole, const std::vector<PixelCount>& counts, const LayerSums& sums,
                         size_t layer) {
  FilterInput out(whole.width, whole.height);
  out.wraps = whole.wraps, out.reflected = whole.reflected;
  parallelFor(counts.size(), 4096, [&](size_t i) {
    FilterPixel& p = out.pixels[i];
    p = whole.pixels[i];
    const auto per = [](uint32_t n) { return 1 / static_cast<float>(std::max(1u, n)); };
    const float inverse = per(counts[i].rays), diffuse = per(counts[i].gathered), specular = per(counts[i].glossy),
                albedo = std::max(luminance(p.albedo), 1e-3f);
    p.diffuse = sums.get(i, LayerSums::kDiffuse, layer) * diffuse, p.rare = {},
    p.sharp = sums.get(i, LayerSums::kSharp, layer) * inverse;
    p.specular = sums.get(i, LayerSums::kSpecular, layer) * specular,
    p.rest = sums.get(i, LayerSums::kRest, layer) * inverse;
    const Vec3 variance = sums.get(i, LayerSums::kVariance, layer);
    p.diffuseVariance = variance.x * diffuse * diffuse / (albedo * albedo),
    p.sharpVariance = variance.y * inverse * inverse / (albedo * albedo);
    p.specularVariance = variance.z * specular * specular;
  });
  return out;
}

class Gathering {
 public:
  Gathering(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, const Camera& camera,
            const PictureSettings& settings, const Progress& progress)
      : rays_(rays),
        shader_(shader),
        settings_(settings),
        progress_(progress),
        width_(settings.width),
        height_(settings.height),
        tiles_(static_cast<size_t>((width_ + kTile - 1) / kTile) * static_cast<size_t>((height_ + kTile - 1) / kTile)),
        every_(settings.filterPasses > 0 ? std::bit_floor(static_cast<uint32_t>(settings.gatherEvery)) : 1u),
        layers_(shader.layers()),
        pixelRays_(rays, camera, settings),
        keepsFragments_(settings.filterPasses > 0 && every_ == 1),
        byLayer_(layers_ ? layers_->size() : 0),
        pixelShader_(rays, lights, settings, keepsFragments_, layers_, layers_ ? &byLayer_ : nullptr),
        sums_(width_, height_),
        counts_(sums_.pixels.size()),
        fragments_(keepsFragments_ ? tiles_ : 0),
        tolerance_(settings.tolerance) {
    sums_.wraps = pixelRays_.camera().wraps(), sums_.byLevels = settings.rareApart;
    byLayer_.resize(counts_.size());
    if (settings_.filterPasses > 0) sums_.reflected.resize(counts_.size());
  }

  // Pass by pass, until no pixel needs more rays, there is no time, or the error is to be looked at.
  void gather() {
    while (result_.samples < settings_.samples) {
      const auto first = static_cast<size_t>(result_.samples);
      const bool chosen = first > 0 && tolerance_ > 0;
      if (chosen && first > kPlanned * planned_) {
        if (hasAim() && planned_ > 0) return;  // a look at the error, before more is planned
        plan(first);
      }
      const auto most = static_cast<size_t>(
          first > 0 || !(tolerance_ > 0) ? settings_.samples : std::min(settings_.samples, settings_.firstSamples));
      const size_t n = std::min(kRaysAtOnce, most - first);
      const auto asks = [&](size_t pixel) { return !chosen || needed_[pixel] > first - planned_; };
      size_t pixels = 0;
      for (size_t i = 0; i < counts_.size(); ++i) pixels += asks(i);
      const double passRays = static_cast<double>(n) * static_cast<double>(pixels);
      if (passRays == 0) return;
      const double started = watch_.seconds();
      late_ = settings_.timeLimitS > 0 && first > 0 && started + secondsOfARay_ * passRays > settings_.timeLimitS;
      if (late_) return;
      pass(first, n, asks);
      result_.samples += static_cast<int>(n);
      secondsOfARay_ = (watch_.seconds() - started) / passRays;
      if (isGivenUp()) return;
      if (first == 0 && settings_.rareApart)
        rayCount_ += findOpenness(rays_, pixelRays_.camera(), settings_.seed, sums_);
      if (progress_.stop()) return;
    }
  }

  // The picture of all samples so far. What it is made of is changed to means over each pixel's.
  void compose(FilterInput& means) {
    if (std::any_of(counts_.begin(), counts_.end(), [](const PixelCount& c) { return c.occlusion > 0; }))
      result_.occlusion = Image(width_, height_);
    parallelFor(counts_.size(), 4096, [&](size_t i) {
      means.pixels[i] = meanOf(means.pixels[i], counts_[i]);
      if (!result_.occlusion.pixels.empty())
        result_.occlusion.pixels[i] = Vec3(counts_[i].occlusion / static_cast<float>(std::max(1u, counts_[i].rays)));
    });
    result_.image = composedWith(means, -1);
  }
  void composeForGood() {
    compose(sums_);
    if (layers_) composeLayers();
  }
  void composeForNow() {
    FilterInput means = sums_;
    compose(means);
  }

  bool isGivenUp() const { return settings_.orNothing && progress_.stop(); }
  bool isLate() const { return late_; }
  bool keepsLayers() const { return layers_; }
  bool hasAim() const { return settings_.untilMse > 0; }
  bool mayGoOn() const {
    return hasAim() && !late_ && !progress_.stop() && result_.samples < settings_.samples && tolerance_ > kFinest;
  }
  // From now on less noise may be left.
  void askForMore() { tolerance_ *= kFiner, planned_ = 0; }

  GatheredPicture result() {
    result_.rays += rayCount_;
    result_.cones = coneCount_;
    return std::move(result_);
  }
  GatheredPicture& picture() { return result_; }

 private:
  // A picture of means, with what its edges show of other surfaces: of one layer, or, below 0, of all.
  Image composedWith(const FilterInput& means, int layer) {
    if (settings_.filterPasses <= 0) return composed(means);
    std::vector<Vec3> irradiance;
    Image image = filtered(means, settings_.filterPasses, nullptr, keepsFragments_ ? &irradiance : nullptr);
    parallelFor(fragments_.size(), 16,
                [&](size_t t) { addFragments(fragments_[t], layer, means, counts_, irradiance, image); });
    if (keepsFragments_ && layer < 0) boundEdges(means, image);  // layers add up to the whole (splitLike)
    return image;
  }

  void plan(size_t first) {
    if (settings_.rareApart) {
      planByOthers();
    } else {
      needed_ = raysNeeded(sums_, counts_, {}, {}, kUnfiltered * tolerance_);
    }
    planned_ = first;
  }

  // By what the filter leaves where every pixel has what those beside it found: were it to ask for more rays because it
  // found much itself, pixels that are bright by chance would get more than dark ones, and the picture be too dark.
  void planByOthers() {
    const FilteredLuminance left =
        filteredLuminance(sums_, settings_.filterPasses, [&](size_t i) { return meanBeside(sums_, counts_, i); });
    needed_ = raysNeeded(sums_, counts_, left, thinThings(fragments_, sums_, counts_), tolerance_);
  }

  // Rays `first` to `first` + n of all pixels that ask for them.
  template <class Asks>
  void pass(size_t first, size_t n, const Asks& asks) {
    std::atomic<size_t> done = 0;
    parallelRanges(tiles_, kTilesAtOnce, [&](size_t begin, size_t end) {
      GatherCounters count;
      TileWork work;
      std::vector<SurfaceLight> light;
      LayerSums layerLight(layers_ ? layers_->size() : 0);
      for (size_t tile = begin; tile < end; ++tile) {
        if (progress_.stop() && (first > 0 || settings_.orNothing)) return;
        work.clear();
        see(tile, first, n, asks, work, count);
        shade(tile, work, light, layerLight, count);
        report(first, n, ++done);
      }
      rayCount_ += count.rays;
      coneCount_ += count.cones;
    });
  }

  template <class Asks>
  void see(size_t tile, size_t first, size_t n, const Asks& asks, TileWork& work, GatherCounters& count) {
    const Rectangle r = tileAt(tile, width_, height_);
    std::array<Ray, kRaysAtOnce> some;
    for (int y = r.y0; y < r.y1; ++y) {
      for (int x = r.x0; x < r.x1; ++x) {
        const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
        if (!asks(pixel)) continue;
        const PixelSequence sequence(x, y, static_cast<uint32_t>(first), settings_.seed, every_);
        pixelShader_.see(pixelRays_.at(x, y, first, n, some), sequence,
                         {&sums_.pixels[pixel], &counts_[pixel], static_cast<uint32_t>(pixel),
                          sums_.reflected.empty() ? nullptr : &sums_.reflected[pixel]},
                         work, count);
      }
    }
    if (every_ > 1) gatherSparsely(work, r, every_, settings_.rayRoughness, static_cast<uint32_t>(n), sums_);
  }

  void shade(size_t tile, TileWork& work, std::vector<SurfaceLight>& light, LayerSums& layerLight,
             GatherCounters& count) {
    light.resize(work.shadings.size());
    if (layers_) {
      layerLight.resize(work.shadings.size());
      shader_.shadeInLayers(work.shadings, work.shadows, light, layerLight, count);
    } else {
      shader_.shade(work.shadings, work.shadows, light, count);
    }
    if (!keepsFragments_) pixelShader_.findOutshining(work, light);
    Fragments* fragments = keepsFragments_ ? &fragments_[tile] : nullptr;
    PixelShader::add(work, light, fragments);
    if (layers_) pixelShader_.addLayers(work, light, layerLight, fragments);
  }

  void report(size_t first, size_t n, size_t tilesDone) {
    if (tilesDone % 64 != 0 || !reporting_.try_lock()) return;
    const float bySamples = (static_cast<float>(first) +
                             static_cast<float>(n) * static_cast<float>(tilesDone) / static_cast<float>(tiles_)) /
                            static_cast<float>(settings_.samples);
    const float byError =
        result_.error.srgbMse > 0 ? static_cast<float>(std::min(1.0, settings_.untilMse / result_.error.srgbMse)) : 0;
    progress_.at(std::max(bySamples, byError));
    reporting_.unlock();
  }

  void composeLayers() {
    for (size_t l = 0; l < layers_->size(); ++l)
      result_.layers.push_back(composedWith(inputOfLayer(sums_, counts_, byLayer_, l), static_cast<int>(l)));
    splitLike(result_.image, result_.layers);
    result_.layerBytes = byLayer_.bytes();
    for (const Fragments& f : fragments_) result_.layerBytes += f.byLayer.size() * sizeof(Vec3);
  }

  const RayScene& rays_;
  const SurfaceShader& shader_;
  const PictureSettings& settings_;
  const Progress& progress_;
  const int width_, height_;
  const size_t tiles_;
  const uint32_t every_;  // pixels of which one gathers
  const LightLayers* const layers_;
  const PixelRays pixelRays_;
  const bool keepsFragments_;
  LayerSums byLayer_;
  const PixelShader pixelShader_;
  FilterInput sums_;
  std::vector<PixelCount> counts_;
  std::vector<Fragments> fragments_;  // of each tile
  float tolerance_;
  std::vector<uint16_t> needed_;  // rays, as planned after so many samples
  size_t planned_ = 0;
  const Stopwatch watch_;
  double secondsOfARay_ = 0;  // in the last pass
  bool late_ = false;  // the next pass would end after the limit
  std::atomic<uint64_t> rayCount_ = 0, coneCount_ = 0;
  std::mutex reporting_;
  GatheredPicture result_;
};

}  // namespace

GatheredPicture gatherPicture(const RayScene& rays, const Lights& lights, const SurfaceShader& shader,
                              const Camera& camera, const PictureSettings& settings, const Progress& progress) {
  Gathering gathering(rays, lights, shader, camera, settings, progress);
  std::optional<ErrorProbes> probes;
  for (;;) {
    gathering.gather();
    if (gathering.isGivenUp()) return {};
    const bool mayGoOn = gathering.mayGoOn();
    mayGoOn ? gathering.composeForNow() : gathering.composeForGood();
    GatheredPicture& picture = gathering.picture();
    if ((settings.tellsError || gathering.hasAim()) && !gathering.isLate()) {
      if (!probes)
        picture.rays +=
            probes.emplace(TracedScene{rays, lights}, shader, camera, settings, gathering.hasAim(), progress).rays();
      picture.error = probes->of(picture.image);
    }
    if (mayGoOn && !progress.stop() && picture.error.srgbMse > settings.untilMse) {
      gathering.askForMore();
      continue;
    }
    if (mayGoOn && gathering.keepsLayers()) gathering.composeForGood();  // so far there is the whole alone
    return gathering.result();
  }
}

}  // namespace roomlight
