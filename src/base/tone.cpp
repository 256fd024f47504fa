#include "base/tone.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr std::pair<std::string_view, ToneCurve> kCurves[] = {{"neutral", ToneCurve::PbrNeutral},
                                                              {"agx", ToneCurve::AgX},
                                                              {"filmic", ToneCurve::Filmic},
                                                              {"clip", ToneCurve::Clip}};

Vec3 applyCurve(Vec3 color, ToneCurve curve) {
  switch (curve) {
    case ToneCurve::PbrNeutral: return curves::neutral(color);
    case ToneCurve::AgX: return curves::agx(color);
    case ToneCurve::Filmic: return curves::filmic(color);
    case ToneCurve::Clip: break;
  }
  return color;
}

}  // namespace

Result<ToneCurve> toneCurveFromName(std::string_view name) {
  for (const auto& [known, curve] : kCurves) {
    if (name == known) return curve;
  }
  return Error{fmt::format("unknown tone curve '{}'; there are neutral, agx, filmic, clip", name)};
}

std::string_view toneCurveName(ToneCurve curve) {
  for (const auto& [name, known] : kCurves) {
    if (curve == known) return name;
  }
  return "";
}

float exposureFromEv100(float ev100) { return 1.0f / (1.2f * std::exp2(ev100)); }

float automaticEv100(const Image& luminanceImage) {
  // Black pixels (a void behind a window, no light at all) have no logarithm and say nothing about the room.
  std::vector<float> logs;
  logs.reserve(luminanceImage.pixels.size());
  for (const Vec3& p : luminanceImage.pixels) {
    const float l = luminance(p);
    if (l > 0 && std::isfinite(l)) logs.push_back(std::log2(l));
  }
  if (logs.empty()) return 0;
  std::sort(logs.begin(), logs.end());
  const size_t cut = logs.size() / 100;
  double sum = 0;
  for (size_t i = cut; i < logs.size() - cut; ++i) sum += static_cast<double>(logs[i]);
  const double meanLog = sum / static_cast<double>(logs.size() - 2 * cut);
  return static_cast<float>(meanLog - std::log2(0.18 * 1.2));
}

float srgbDecode(float encoded) {
  const float v = std::clamp(encoded, 0.0f, 1.0f);
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

Image toneMap(const Image& image, float ev100, const Tone& tone) {
  Image out(image.width, image.height);
  const float exposure = exposureFromEv100(ev100);
  parallelFor(image.pixels.size(), 16384, [&](size_t i) {
    const Vec3 light = max(image.pixels[i] * exposure, Vec3(0));
    const Vec3 v = applyCurve(tone.plain() ? light : curves::graded(light, tone.contrast, tone.saturation), tone.curve);
    out.pixels[i] = {srgbEncode(v.x), srgbEncode(v.y), srgbEncode(v.z)};
  });
  return out;
}

}  // namespace roomlight
