#include "look/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/tone.h"
#include "look/pyramid.h"

namespace roomlight {
namespace {

constexpr float kMiddleGrey = 0.18f;
constexpr std::array kStops = {2.0f, 0.0f, -2.6f, -5.2f};  // windows are farther from the middle than corners are
constexpr float kSigma = 0.2f;  // of what counts as well exposed
constexpr int kSmallest = 6;    // shorter side of the coarsest level
constexpr float kLeast = 1e-5f;

// Half at middle grey, even in stops around it, and easily undone.
float shown(float light) { return light / (light + kMiddleGrey); }
float undone(float value) { return kMiddleGrey * value / (1 - value); }

// One exposure as a pyramid of differences, and of the weights that each place gives it.
struct Exposure {
  std::vector<Plane> details, weights;
};

float weightOf(float value) {
  const float off = (value - 0.5f) / kSigma;
  return std::exp(-0.5f * off * off) + 1e-6f;
}

Exposure exposureOf(const Plane& light, float ev) {
  Plane value(light.width, light.height), weight(light.width, light.height);
  const float factor = std::exp2(ev);
  for (size_t i = 0; i < light.values.size(); ++i) {
    value.values[i] = shown(light.values[i] * factor);
    weight.values[i] = weightOf(value.values[i]);
  }
  Exposure e{gaussianPyramid(std::move(value), kSmallest), gaussianPyramid(std::move(weight), kSmallest)};
  for (size_t k = 0; k + 1 < e.details.size(); ++k) {
    const Plane coarse = doubled(e.details[k + 1], e.details[k].width, e.details[k].height);
    for (size_t i = 0; i < coarse.values.size(); ++i) e.details[k].values[i] -= coarse.values[i];
  }
  return e;
}

using Exposures = std::array<Exposure, kStops.size()>;

Plane fused(const Exposures& exposures) {
  Plane sum;
  for (size_t k = exposures[0].details.size(); k-- > 0;) {
    const Plane& size = exposures[0].details[k];
    Plane level = sum.width > 0 ? doubled(sum, size.width, size.height) : Plane(size.width, size.height);
    for (size_t i = 0; i < level.values.size(); ++i) {
      float weighted = 0, weights = 0;
      for (const Exposure& e : exposures)
        weighted += e.weights[k].values[i] * e.details[k].values[i], weights += e.weights[k].values[i];
      level.values[i] += weighted / weights;
    }
    sum = std::move(level);
  }
  return sum;
}

// Where there is nothing, it asks for no exposure.
float heldLight(float light) { return light > kLeast ? std::min(light, 1e4f) : kMiddleGrey; }

// Exposed for middle grey.
Plane lightOf(const Image& image, float ev100) {
  const float exposure = exposureFromEv100(ev100);
  Plane light(image.width, image.height);
  parallelFor(image.pixels.size(), 16384,
              [&](size_t i) { light.values[i] = heldLight(luminance(image.pixels[i]) * exposure); });
  return light;
}

Plane fusedOf(const Plane& light, float strength) {
  Exposures exposures;
  parallelFor(exposures.size(), 1, [&](size_t i) { exposures[i] = exposureOf(light, kStops[i] * strength); });
  return fused(exposures);
}

// What brings light to where it shall be shown.
struct GainOf {
  float most, least;
  explicit GainOf(float strength)
      : most(std::exp2(kStops.front() * strength)), least(std::exp2(kStops.back() * strength)) {}
  float operator()(float light, float wanted) const {
    return std::clamp(undone(std::clamp(wanted, 1e-4f, 0.999f)) / light, least, most);
  }
};

// What is looked at keeps its exposure.
void keepMetered(const Image& before, Plane& gains) {
  Image after(before.width, before.height);
  for (size_t i = 0; i < before.pixels.size(); ++i) after.pixels[i] = before.pixels[i] * gains.values[i];
  const float kept = std::exp2(lookedAtEv100(before) - lookedAtEv100(after));
  for (float& g : gains.values) g *= kept;
}

// --- Frames: fused at a quarter of the size, and brought to pixels by what is a line within each window there (He, Sun
// & Tang 2013, "Guided image filtering"; He & Sun 2015, "Fast guided filter").

constexpr int kQuarter = 4;
constexpr int kRadius = 2;  // pixels of the small picture to either side
constexpr float kEpsilon = 2e-3f;  // regularisation: the variance of what counts as one surface

Image quartered(const Image& image) {
  Image out((image.width + kQuarter - 1) / kQuarter, (image.height + kQuarter - 1) / kQuarter);
  parallelFor(static_cast<size_t>(out.height), 4, [&](size_t row) {
    const int y0 = static_cast<int>(row) * kQuarter, y1 = std::min(y0 + kQuarter, image.height);
    for (int x = 0; x < out.width; ++x) {
      Vec3 sum;
      const int x0 = x * kQuarter, x1 = std::min(x0 + kQuarter, image.width);
      for (int y = y0; y < y1; ++y) {
        for (int i = x0; i < x1; ++i) sum += image.at(i, y);
      }
      out.at(x, static_cast<int>(row)) = sum / static_cast<float>((x1 - x0) * (y1 - y0));
    }
  });
  return out;
}

Plane boxFiltered(const Plane& p) {
  Plane across(p.width, p.height), out(p.width, p.height);
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      const int x0 = std::max(0, x - kRadius), x1 = std::min(p.width - 1, x + kRadius);
      float sum = 0;
      for (int i = x0; i <= x1; ++i) sum += p.at(i, y);
      across.at(x, y) = sum / static_cast<float>(x1 - x0 + 1);
    }
  }
  for (int y = 0; y < p.height; ++y) {
    const int y0 = std::max(0, y - kRadius), y1 = std::min(p.height - 1, y + kRadius);
    for (int i = y0; i <= y1; ++i) {
      for (int x = 0; x < p.width; ++x) out.at(x, y) += across.at(x, i);
    }
    for (int x = 0; x < p.width; ++x) out.at(x, y) /= static_cast<float>(y1 - y0 + 1);
  }
  return out;
}

// Of the target, as a line over the guide.
struct GuidedCoefficients {
  Plane slope, offset;
};

GuidedCoefficients guidedCoefficients(const Plane& guide, const Plane& target) {
  Plane squares(guide.width, guide.height), products(guide.width, guide.height);
  for (size_t i = 0; i < guide.values.size(); ++i)
    squares.values[i] = guide.values[i] * guide.values[i], products.values[i] = guide.values[i] * target.values[i];
  const Plane mean = boxFiltered(guide), meanTarget = boxFiltered(target), meanSquare = boxFiltered(squares),
              meanProduct = boxFiltered(products);
  GuidedCoefficients lines{Plane(guide.width, guide.height), Plane(guide.width, guide.height)};
  for (size_t i = 0; i < guide.values.size(); ++i) {
    const float m = mean.values[i], variance = std::max(0.0f, meanSquare.values[i] - m * m);
    lines.slope.values[i] = (meanProduct.values[i] - m * meanTarget.values[i]) / (variance + kEpsilon);
    lines.offset.values[i] = meanTarget.values[i] - lines.slope.values[i] * m;
  }
  return {boxFiltered(lines.slope), boxFiltered(lines.offset)};
}

// Where a pixel's middle lies in the small picture.
struct BilinearTap {
  int low, high;
  float share;
  BilinearTap(int i, int count) {
    const float at = std::clamp((static_cast<float>(i) + 0.5f) / kQuarter - 0.5f, 0.0f, static_cast<float>(count - 1));
    low = static_cast<int>(at), high = std::min(low + 1, count - 1), share = at - static_cast<float>(low);
  }
};

}  // namespace

Plane localExposure(const Image& image, float ev100, float strength) {
  const Plane light = lightOf(image, ev100), wanted = fusedOf(light, strength);
  const GainOf gainOf(strength);
  Plane gains(image.width, image.height);
  parallelFor(gains.values.size(), 16384,
              [&](size_t i) { gains.values[i] = gainOf(light.values[i], wanted.values[i]); });
  keepMetered(image, gains);
  return gains;
}

Plane quickLocalExposure(const Image& image, float ev100, float strength) {
  if (image.pixels.empty()) return {};
  const Image small = quartered(image);
  const Plane light = lightOf(small, ev100), target = fusedOf(light, strength);
  const GainOf gainOf(strength);
  Plane guide(small.width, small.height), metered(small.width, small.height);
  for (size_t i = 0; i < light.values.size(); ++i)
    guide.values[i] = shown(light.values[i]), metered.values[i] = gainOf(light.values[i], target.values[i]);
  const float first = metered.values[0];
  keepMetered(small, metered);
  const float kept = metered.values[0] / first, exposure = exposureFromEv100(ev100);
  const GuidedCoefficients lines = guidedCoefficients(guide, target);
  std::vector<BilinearTap> columns;
  for (int x = 0; x < image.width; ++x) columns.emplace_back(x, small.width);
  Plane gains(image.width, image.height);
  parallelFor(static_cast<size_t>(image.height), 8, [&](size_t row) {
    const int y = static_cast<int>(row);
    const BilinearTap v(y, small.height);
    std::vector<float> slopes(static_cast<size_t>(small.width)), offsets(slopes.size());
    for (int x = 0; x < small.width; ++x) {
      slopes[static_cast<size_t>(x)] = std::lerp(lines.slope.at(x, v.low), lines.slope.at(x, v.high), v.share);
      offsets[static_cast<size_t>(x)] = std::lerp(lines.offset.at(x, v.low), lines.offset.at(x, v.high), v.share);
    }
    for (int x = 0; x < image.width; ++x) {
      const BilinearTap& u = columns[static_cast<size_t>(x)];
      const auto low = static_cast<size_t>(u.low), high = static_cast<size_t>(u.high);
      const float slope = slopes[low] + u.share * (slopes[high] - slopes[low]),
                  offset = offsets[low] + u.share * (offsets[high] - offsets[low]);
      const float l = heldLight(luminance(image.at(x, y)) * exposure);
      gains.at(x, y) = kept * gainOf(l, slope * shown(l) + offset);
    }
  });
  return gains;
}

}  // namespace roomlight
