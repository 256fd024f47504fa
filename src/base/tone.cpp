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

// Khronos PBR Neutral Tone Mapper, specification 1.0: colours below 0.8 keep hue and saturation, highlights roll off
// to white.
Vec3 pbrNeutral(Vec3 color) {
  constexpr float kStartCompression = 0.8f - 0.04f, kDesaturation = 0.15f;
  const float x = minComponent(color);
  const float offset = x < 0.08f ? x - 6.25f * x * x : 0.04f;
  color -= Vec3(offset);
  const float peak = maxComponent(color);
  if (peak < kStartCompression) return color;
  const float d = 1 - kStartCompression;
  const float newPeak = 1 - d * d / (peak + d - kStartCompression);
  color *= newPeak / peak;
  const float g = 1 - 1 / (kDesaturation * (peak - newPeak) + 1);
  return lerp(color, Vec3(newPeak), g);
}

// Sixth-order fit of the AgX base contrast curve (Wrensch 2023, "Minimal AgX implementation"); in and out 0..1.
float agxContrast(float x) {
  const float x2 = x * x, x4 = x2 * x2;
  return 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x - 0.00232f;
}

Vec3 agx(Vec3 color) {
  constexpr float kMinEv = -12.47393f, kMaxEv = 4.026069f;
  // Inset: pulls the primaries in, so that bright saturated light turns white instead of clipping to a hue.
  const Affine inset{{0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f},
                     {0.0784335999999992f, 0.878468636469772f, 0.0784336f},
                     {0.0792237451477643f, 0.0791661274605434f, 0.879142973793104f},
                     {0, 0, 0}};
  const Affine outset{{1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f},
                      {-0.0980208811401368f, 1.15190312990417f, -0.0980434501171241f},
                      {-0.0990297440797205f, -0.0989611768448433f, 1.15107367264116f},
                      {0, 0, 0}};
  Vec3 v = inset.vector(color);
  for (int c = 0; c < 3; ++c) {
    const float ev = std::clamp(std::log2(std::max(v[c], 1e-10f)), kMinEv, kMaxEv);
    v[c] = agxContrast((ev - kMinEv) / (kMaxEv - kMinEv));
  }
  v = outset.vector(v);
  // The curve ends in display values of a 2.2 power display; back to linear for the sRGB encoding that follows.
  for (int c = 0; c < 3; ++c) v[c] = std::pow(std::max(0.0f, v[c]), 2.2f);
  return v;
}

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve".
Vec3 filmic(Vec3 x) {
  return x * (x * 2.51f + Vec3(0.03f)) / (x * (x * 2.43f + Vec3(0.59f)) + Vec3(0.14f));
}

Vec3 applyCurve(Vec3 color, ToneCurve curve) {
  switch (curve) {
    case ToneCurve::PbrNeutral: return pbrNeutral(color);
    case ToneCurve::AgX: return agx(color);
    case ToneCurve::Filmic: return filmic(color);
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

float srgbEncode(float linear) {
  const float v = std::clamp(linear, 0.0f, 1.0f);
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

float srgbDecode(float encoded) {
  const float v = std::clamp(encoded, 0.0f, 1.0f);
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

Image toneMap(const Image& image, float ev100, ToneCurve curve) {
  Image out(image.width, image.height);
  const float exposure = exposureFromEv100(ev100);
  parallelFor(image.pixels.size(), 16384, [&](size_t i) {
    const Vec3 v = applyCurve(max(image.pixels[i] * exposure, Vec3(0)), curve);
    out.pixels[i] = {srgbEncode(v.x), srgbEncode(v.y), srgbEncode(v.z)};
  });
  return out;
}

}  // namespace roomlight
