#include "look/local_exposure.h"

#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/tone.h"
#include "look/exposure.h"
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
      for (const Exposure& e : exposures) weighted += e.weights[k].values[i] * e.details[k].values[i], weights += e.weights[k].values[i];
      level.values[i] += weighted / weights;
    }
    sum = std::move(level);
  }
  return sum;
}

}  // namespace

void exposeLocally(Image& image, float ev100, float strength) {
  const float exposure = exposureFromEv100(ev100);
  Plane light(image.width, image.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float l = luminance(image.pixels[i]) * exposure;
    light.values[i] = l > kLeast ? std::min(l, 1e4f) : kMiddleGrey;  // nothing there: it asks for no exposure
  }
  Exposures exposures;
  parallelFor(exposures.size(), 1, [&](size_t i) { exposures[i] = exposureOf(light, kStops[i] * strength); });
  const Plane value = fused(exposures);
  const float most = std::exp2(kStops.front() * strength), least = std::exp2(kStops.back() * strength), before = lookedAtEv100(image);
  parallelFor(image.pixels.size(), 16384, [&](size_t i) {
    image.pixels[i] *= std::clamp(undone(std::clamp(value.values[i], 1e-4f, 0.999f)) / light.values[i], least, most);
  });
  const float kept = std::exp2(before - lookedAtEv100(image));
  for (Vec3& p : image.pixels) p *= kept;
}

}  // namespace roomlight
