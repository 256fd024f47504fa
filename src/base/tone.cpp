#include "base/tone.h"

#include <algorithm>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr std::pair<std::string_view, ToneCurve> kCurves[] = {{"neutral", ToneCurve::PbrNeutral},
                                                              {"agx", ToneCurve::AgX},
                                                              {"filmic", ToneCurve::Filmic},
                                                              {"clip", ToneCurve::Clip}};

// A run of pixels, a plane a primary: loops over it are vector code.
constexpr size_t kRunPixels = 1024;
struct Run {
  alignas(64) float rgb[3][kRunPixels];
};

template <Vec3 (*Curve)(Vec3), bool kGraded>
void mapRun(Run& run, float exposure, const Tone& tone) {
  const float contrast = tone.contrast, saturation = tone.saturation;
  float* __restrict r = run.rgb[0];
  float* __restrict g = run.rgb[1];
  float* __restrict b = run.rgb[2];
  for (size_t i = 0; i < kRunPixels; ++i) {
    const float x = r[i] * exposure, y = g[i] * exposure, z = b[i] * exposure;
    const Vec3 lit{x < 0 ? 0.0f : x, y < 0 ? 0.0f : y, z < 0 ? 0.0f : z};  // what is not a number stays so
    const Vec3 shown = Curve(kGraded ? curves::graded(lit, contrast, saturation) : lit);
    r[i] = srgbEncode(shown.x), g[i] = srgbEncode(shown.y), b[i] = srgbEncode(shown.z);
  }
}

using MapRun = void (*)(Run&, float, const Tone&);
template <bool kGraded>
MapRun mapRunOf(ToneCurve curve) {
  switch (curve) {
    case ToneCurve::PbrNeutral: return mapRun<curves::neutral, kGraded>;
    case ToneCurve::AgX: return mapRun<curves::agx, kGraded>;
    case ToneCurve::Filmic: return mapRun<curves::filmic, kGraded>;
    case ToneCurve::Clip: break;
  }
  return mapRun<curves::clip, kGraded>;
}

}  // namespace

std::vector<std::string> toneCurveNames() {
  std::vector<std::string> names;
  for (const auto& [name, curve] : kCurves) names.emplace_back(name);
  return names;
}

Result<ToneCurve> toneCurveFromName(std::string_view name) {
  std::string all;
  for (const auto& [known, curve] : kCurves) {
    if (name == known) return curve;
    all += (all.empty() ? "" : ", ") + std::string(known);
  }
  return Error{"unknown tone curve '" + std::string(name) + "'; there are " + all};
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

Image toneMap(Image image, float ev100, const Tone& tone) {
  const float exposure = exposureFromEv100(ev100);
  const MapRun map = tone.plain() ? mapRunOf<false>(tone.curve) : mapRunOf<true>(tone.curve);
  parallelFor((image.pixels.size() + kRunPixels - 1) / kRunPixels, 8, [&](size_t index) {
    const size_t begin = index * kRunPixels, count = std::min(kRunPixels, image.pixels.size() - begin);
    Run run{};
    for (size_t i = 0; i < count; ++i) {
      for (int c = 0; c < 3; ++c) run.rgb[c][i] = image.pixels[begin + i][c];
    }
    map(run, exposure, tone);
    for (size_t i = 0; i < count; ++i) image.pixels[begin + i] = {run.rgb[0][i], run.rgb[1][i], run.rgb[2][i]};
  });
  return image;
}

}  // namespace roomlight
