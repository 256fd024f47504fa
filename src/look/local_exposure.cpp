#include "look/local_exposure.h"

#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/tone.h"
#include "look/pyramid.h"

namespace roomlight {
namespace {

constexpr float kMiddleGrey = 0.18f, kStops = 2;
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

Exposure exposureOf(const Plane& light, float ev) {
  Plane value(light.width, light.height), weight(light.width, light.height);
  const float factor = std::exp2(ev);
  for (size_t i = 0; i < light.values.size(); ++i) {
    value.values[i] = shown(light.values[i] * factor);
    const float off = (value.values[i] - 0.5f) / kSigma;
    weight.values[i] = std::exp(-0.5f * off * off) + 1e-6f;
  }
  Exposure e{gaussianPyramid(std::move(value), kSmallest), gaussianPyramid(std::move(weight), kSmallest)};
  for (size_t k = 0; k + 1 < e.details.size(); ++k) {
    const Plane coarse = doubled(e.details[k + 1], e.details[k].width, e.details[k].height);
    for (size_t i = 0; i < coarse.values.size(); ++i) e.details[k].values[i] -= coarse.values[i];
  }
  return e;
}

Plane fused(const std::array<Exposure, 3>& exposures) {
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
  const float exposure = exposureFromEv100(ev100), stops = kStops * strength;
  Plane light(image.width, image.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float l = luminance(image.pixels[i]) * exposure;
    light.values[i] = l > kLeast ? std::min(l, 1e4f) : kLeast;
  }
  std::array<Exposure, 3> exposures;
  parallelFor(exposures.size(), 1, [&](size_t i) { exposures[i] = exposureOf(light, stops * (static_cast<float>(i) - 1)); });
  const Plane value = fused(exposures);
  const float most = std::exp2(stops);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float wanted = undone(std::clamp(value.values[i], 0.0f, 0.999f));
    image.pixels[i] *= std::clamp(wanted / light.values[i], 1 / most, most);
  }
}

}  // namespace roomlight
