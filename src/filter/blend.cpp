#include "filter/blend.h"

#include <cmath>
#include <cstdint>

#include "base/parallel.h"
#include "base/tone.h"

namespace roomlight {
namespace {

constexpr int kSteps = 4;                          // 1, 3, 9 and 27 pixels between neighbours
constexpr float kDarkest = 0.05f;                  // of the mean luminance: below it errors count as absolute
constexpr float kPlaneTolerance = 0.02f, kSlope = 0.5f, kLeastFacing = 0.3f;  // as in the filter
constexpr float kBrightnessTolerance = 0.5f;       // natural logarithm of a ratio
constexpr float kDoubt = 1;  // standard deviations of an error's estimate that are taken off it

struct Neighbour {
  int x, y;
};
constexpr Neighbour kNeighbours[8] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};

// How much of each neighbour belongs to a pixel's window, 255 all.
using Weights = std::array<uint8_t, 8>;

// Relative error of the first picture as samples have it, and the variance of that; means over channels.
struct Seen {
  Vec3 error;
  float variance = 0;
  float centre = 0;  // the part of a window's mean that is its middle
};

// Mean squares: of an error beyond noise, of noise, and the variance of the former as an estimate.
struct Power {
  float error = 0, noise = 0, uncertainty = 0;
};

class Blender {
 public:
  Blender(const Image& first, const Image& mean, const Image& variance, const FilterInput& guide);
  Blend result() const;

 private:
  size_t at(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(w_) + static_cast<size_t>(x); }
  template <class Body>
  void forAll(Body&& body) const {  // body(x, y, index)
    parallelFor(static_cast<size_t>(h_), 8, [&](size_t y) {
      for (int x = 0; x < w_; ++x) body(x, static_cast<int>(y), at(x, static_cast<int>(y)));
    });
  }
  // body(index, weight) for each pixel of a window of 3 x 3, `step` pixels apart; weights are 1 for the pixel itself.
  template <class Body>
  void forWindow(int x, int y, int k, Body&& body) const {
    const Weights& weights = weights_[static_cast<size_t>(k)][at(x, y)];
    const int step = kStep[k];
    body(at(x, y), 1.0f);
    for (size_t i = 0; i < 8; ++i) {
      if (weights[i])
        body(at(x + kNeighbours[i].x * step, y + kNeighbours[i].y * step),
             static_cast<float>(weights[i]) * (1.0f / 255));
    }
  }
  void findScale(const Image& first);
  void findWeights(const FilterInput& guide);
  std::vector<Seen> coarser(const std::vector<Seen>& fine, int k) const;
  std::vector<Power> pooled(std::vector<Power> values, int k) const;

  static constexpr int kStep[kSteps] = {1, 3, 9, 27};
  const Image& first_;
  int w_, h_;
  std::vector<float> scale_, brightness_;  // luminance that errors are relative to, and its logarithm
  std::vector<Weights> weights_[kSteps];
  std::vector<Seen> seen_;
};

Blender::Blender(const Image& first, const Image& mean, const Image& variance, const FilterInput& guide)
    : first_(first),
      w_(first.width),
      h_(first.height),
      scale_(first.pixels.size()),
      brightness_(first.pixels.size()),
      seen_(first.pixels.size()) {
  findScale(first);
  findWeights(guide);
  forAll([&](int, int, size_t i) {
    const Vec3 v = variance.pixels[i];
    seen_[i] = {(mean.pixels[i] - first.pixels[i]) / scale_[i], (v.x + v.y + v.z) / (3 * scale_[i] * scale_[i]), 1};
  });
}

void Blender::findScale(const Image& first) {
  double sum = 0;
  for (const Vec3& p : first.pixels) sum += static_cast<double>(luminance(p));
  const float darkest = kDarkest * static_cast<float>(sum / static_cast<double>(first.pixels.size())) + 1e-20f;
  forAll([&](int x, int y, size_t i) {
    float around = 0, count = 0;
    for (int qy = std::max(0, y - 1); qy <= std::min(h_ - 1, y + 1); ++qy) {
      for (int qx = std::max(0, x - 1); qx <= std::min(w_ - 1, x + 1); ++qx)
        around += luminance(first.at(qx, qy)), count += 1;
    }
    scale_[i] = around / count + darkest;
    brightness_[i] = std::log(scale_[i]);
  });
}

void Blender::findWeights(const FilterInput& guide) {
  for (int k = 0; k < kSteps; ++k) {
    std::vector<Weights>& all = weights_[k];
    all.resize(seen_.size());
    forAll([&](int x, int y, size_t i) {
      const FilterPixel& own = guide.pixels[i];
      for (size_t n = 0; n < 8; ++n) {
        const int qx = x + kNeighbours[n].x * kStep[k], qy = y + kNeighbours[n].y * kStep[k];
        if (qx < 0 || qy < 0 || qx >= w_ || qy >= h_) continue;
        const FilterPixel& other = guide.pixels[at(qx, qy)];
        const float facing = dot(own.normal, other.normal);
        if (own.surface <= 0 || other.surface <= 0 || facing < kLeastFacing) continue;
        const Vec3 between = other.position - own.position;
        const float off = std::max(std::abs(dot(own.normal, between)), std::abs(dot(other.normal, between))) /
                          (kPlaneTolerance + kSlope * length(between));
        const float ratio = std::abs(brightness_[at(qx, qy)] - brightness_[i]) / kBrightnessTolerance;
        const float a = std::max(0.0f, 1 - 0.125f * (off + ratio)), b = a * a * facing;  // (1 - x/8)^8, about e^-x
        all[i][n] = static_cast<uint8_t>(255 * b * b * b * b + 0.5f);
      }
    });
  }
}

// Means over windows three times as wide. Their parts do not overlap, so variances add.
std::vector<Seen> Blender::coarser(const std::vector<Seen>& fine, int k) const {
  std::vector<Seen> out(fine.size());
  forAll([&](int x, int y, size_t i) {
    Seen sum;
    float total = 0;
    forWindow(x, y, k, [&](size_t q, float weight) {
      sum.error += fine[q].error * weight, sum.variance += fine[q].variance * weight * weight, total += weight;
    });
    out[i] = {sum.error / total, sum.variance / (total * total), 1 / total};
  });
  return out;
}

// Means over the windows of a level and of the next, and their uncertainty.
std::vector<Power> Blender::pooled(std::vector<Power> values, int k) const {
  for (int step = std::min(k, kSteps - 1); step <= std::min(k + 1, kSteps - 1); ++step) {
    std::vector<Power> out(values.size());
    forAll([&](int x, int y, size_t i) {
      Power sum;
      float total = 0;
      forWindow(x, y, step, [&](size_t q, float weight) {
        const Power& p = values[q];
        sum.error += p.error * weight, sum.noise += p.noise * weight,
            sum.uncertainty += p.uncertainty * weight * weight;
        total += weight;
      });
      const float inverse = 1 / total;
      out[i] = {sum.error * inverse, sum.noise * inverse, sum.uncertainty * inverse * inverse};
    });
    values.swap(out);
  }
  return values;
}

// Mean square of what an error up or down does to an encoded value.
float encodedSquare(float value, float error) {
  const float own = srgbEncode(value), up = srgbEncode(value + error) - own, down = own - srgbEncode(value - error);
  return (up * up + down * down) / 2;
}

Blend Blender::result() const {
  std::vector<Seen> levels[kSteps + 1];
  levels[0] = seen_;
  for (int k = 0; k < kSteps; ++k) levels[k + 1] = coarser(levels[k], k);

  std::vector<Vec3> believed(seen_.size());
  std::vector<Power> last;
  std::vector<float> shares(seen_.size());
  std::vector<Power> certain(seen_.size());
  for (int k = kSteps; k >= 0; --k) {
    const std::vector<Seen>& level = levels[k];
    std::vector<Power> powers(seen_.size());
    forAll([&](int, int, size_t i) {
      // What is believed holds some of the same noise.
      const float shared = k < kSteps ? shares[i] * levels[k + 1][i].centre : 0;
      const float error = lengthSquared(level[i].error - believed[i]) / 3 - (1 - 2 * shared) * level[i].variance;
      powers[i] = {error, level[i].variance, error * error};
    });
    powers = pooled(std::move(powers), k);
    forAll([&](int, int, size_t i) {
      // A bright sample is told by its own variance, a pixel that missed such samples by its neighbours'.
      const Power& p = powers[i];
      const float noise = std::max(p.noise, level[i].variance), error = p.error - kDoubt * std::sqrt(p.uncertainty);
      const float share = error > 0 ? error / (error + noise) : 0;
      believed[i] += (level[i].error - believed[i]) * share;
      shares[i] = share;
      certain[i] = {std::max(0.0f, error), p.noise, 0};
    });
    if (k == 0) last = std::move(powers);
  }

  Blend out;
  out.image = first_;
  forAll([&](int, int, size_t i) { out.image.pixels[i] = max(first_.pixels[i] + believed[i] * scale_[i], Vec3(0)); });
  // Errors that remain: what stands out, or what wider windows say, where chance has less of a part.
  last = pooled(std::move(last), 2);
  const float exposure = exposureFromEv100(automaticEv100(out.image));
  double relative = 0, encoded = 0;
  for (size_t i = 0; i < shares.size(); ++i) {
    const float kept = 1 - shares[i], error = kept * kept * std::max(certain[i].error, last[i].error) +
                                              shares[i] * shares[i] * certain[i].noise;
    relative += static_cast<double>(error);
    encoded += static_cast<double>(
        encodedSquare(luminance(out.image.pixels[i]) * exposure, std::sqrt(error) * scale_[i] * exposure));
  }
  const double n = static_cast<double>(shares.size());
  out.relativeError = std::sqrt(relative / n);
  out.srgbMse = encoded / n;
  return out;
}

}  // namespace

Blend blend(const Image& first, const Image& mean, const Image& variance, const FilterInput& guide) {
  return Blender(first, mean, variance, guide).result();
}

}  // namespace roomlight
