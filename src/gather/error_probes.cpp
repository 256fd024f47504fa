#include "gather/error_probes.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "base/tone.h"
#include "gather/pixel_rays.h"

namespace roomlight {
namespace {

constexpr size_t kOneIn = 32, kFewestPixels = 512, kMostPixels = 4096;
constexpr int kFewest = 4, kMost = 8,
              kClosely = 16;  // shadings of each of the two samples: the fewer the noisier the estimate, and there is
                              // no need to know a rough picture's error well
constexpr size_t kRaysOfShading = 2;
constexpr size_t kAtOnce = 16;  // probes
constexpr size_t kFewestKnown = 16;  // pixels: of fewer nothing can be told
constexpr uint64_t kProbeKey = 0x9e0be5;  // other random numbers than the picture has
constexpr float kDarkest = 0.05f;  // of the mean luminance: below it errors count as absolute
constexpr float kMostRelative = 1,
                kMostEncoded =
                    0.5f;  // that a sample may differ by: single ones are far beyond what a picture can be off by
constexpr float kStep = 1e-3f;  // of exposed values, for a slope

// How fast the encoded value changes from an exposed one towards another; nothing is seen beyond white.
float slopeOfEncoding(float exposed, float towards) {
  if (exposed >= 1 && towards >= 1) return 0;
  if (exposed >= 1 || towards >= 1)
    return (1 - srgbEncode(std::min(exposed, towards))) / std::max(std::abs(towards - exposed), 1e-6f);
  return (srgbEncode(exposed + kStep) - srgbEncode(exposed)) / kStep;
}

float bounded(float v, float most) { return std::clamp(v, -most, most); }

// A mean of products, at least as large as its standard error: less is not known.
class MeanSquare {
 public:
  void add(double v) { sum_ += v, squares_ += v * v, ++n_; }
  size_t count() const { return n_; }
  double value() const {
    const double n = static_cast<double>(n_), mean = sum_ / n;
    return std::max(mean, std::sqrt(std::max(0.0, squares_ / n - mean * mean) / n));
  }

 private:
  double sum_ = 0, squares_ = 0;
  size_t n_ = 0;
};

}  // namespace

ErrorProbes::ErrorProbes(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
                         const PictureSettings& settings, bool closely, const Progress& progress) {
  const auto pixels = static_cast<size_t>(settings.width) * static_cast<size_t>(settings.height);
  const size_t count = std::min(pixels, std::clamp(pixels / kOneIn, kFewestPixels, kMostPixels));
  const auto shadings = static_cast<uint32_t>(closely ? kClosely : std::clamp(settings.samples / 2, kFewest, kMost));
  PictureSettings own = settings;
  own.seed = mix64(settings.seed ^ kProbeKey), own.samples = static_cast<int>(shadings * kRaysOfShading);
  // Parts of one well-distributed set would not be independent.
  PictureSettings other = own;
  other.seed = mix64(own.seed);
  const PixelRays places[2] = {{scene.rays, camera, own}, {scene.rays, camera, other}};
  const PixelShader pixelShader(scene.rays, scene.lights, own, false);
  probes_.resize(count);
  std::atomic<uint64_t> rayCount = 0;
  parallelRanges(count, kAtOnce, [&](size_t begin, size_t end) {
    if (progress.stop()) return;
    GatherCounters counters;
    TileWork work;
    std::vector<SurfaceLight> light;
    std::vector<FilterPixel> sums(2 * (end - begin));
    std::vector<PixelCount> counts(sums.size());
    for (size_t i = begin; i < end; ++i) {
      // One of as many pixels that follow one another, at random.
      const size_t first = i * pixels / count, next = (i + 1) * pixels / count;
      const size_t pixel = first + mix64(i ^ own.seed) % (next - first);
      probes_[i].pixel = static_cast<uint32_t>(pixel);
      const int x = static_cast<int>(pixel % static_cast<size_t>(settings.width)),
                y = static_cast<int>(pixel / static_cast<size_t>(settings.width));
      for (uint32_t k = 0; k < 2 * shadings; ++k) {
        const size_t which = k / shadings, sum = 2 * (i - begin) + which;
        std::array<Ray, kRaysAtOnce> some;
        pixelShader.see(places[which].at(x, y, kRaysOfShading * (k % shadings), kRaysOfShading, some),
                        PixelSequence(x, y, k, own.seed), {&sums[sum], &counts[sum], static_cast<uint32_t>(pixel)},
                        work, counters);
      }
    }
    light.resize(work.shadings.size());
    shader.shade(work.shadings, work.shadows, light, counters);
    PixelShader::add(work, light, nullptr);
    for (size_t i = begin; i < end; ++i) {
      for (size_t k = 0; k < 2; ++k) {
        const FilterPixel p = meanOf(sums[2 * (i - begin) + k], counts[2 * (i - begin) + k]);
        probes_[i].sample[k] = p.diffuse + p.rare + p.sharp + p.specular + p.rest;
      }
    }
    rayCount += counters.rays;
  });
  rays_ = rayCount;
  if (progress.stop()) probes_.clear();
}

ErrorLeft ErrorProbes::of(const Image& picture) const {
  if (probes_.empty() || picture.pixels.empty()) return {};
  double mean = 0;
  for (const Vec3& p : picture.pixels)
    mean += static_cast<double>(luminance(p)) / static_cast<double>(picture.pixels.size());
  const float darkest = kDarkest * static_cast<float>(mean) + 1e-20f,
              exposure = exposureFromEv100(automaticEv100(picture));
  MeanSquare relative, encoded;
  for (const Probe& probe : probes_) {
    const Vec3 p = picture.pixels[probe.pixel], a = p - probe.sample[0], b = p - probe.sample[1];
    if (!isFinite(a) || !isFinite(b)) continue;
    const float level = std::max(0.0f, luminance(p)) + darkest;
    relative.add(static_cast<double>(bounded(luminance(a) / level, kMostRelative) *
                                     bounded(luminance(b) / level, kMostRelative)));
    double square = 0;
    for (int c = 0; c < 3; ++c) {
      const float slope =
          exposure * slopeOfEncoding(p[c] * exposure, (probe.sample[0][c] + probe.sample[1][c]) / 2 * exposure);
      square += static_cast<double>(bounded(slope * a[c], kMostEncoded) * bounded(slope * b[c], kMostEncoded)) / 3;
    }
    encoded.add(square);
  }
  if (encoded.count() < kFewestKnown) return {};
  return {std::sqrt(relative.value()), encoded.value()};
}

}  // namespace roomlight
