// The tone curves themselves, inline and without branches: loops over pixels become vector code. In: exposed linear
// light, not negative.
#pragma once

#include <cmath>

#include "base/fast_math.h"
#include "base/vec.h"

namespace roomlight {

// IEC 61966-2-1; input clipped to 0..1; what is not a number stays so.
inline float srgbEncode(float linear) {
  const float low = linear < 0 ? 0.0f : linear, v = low > 1 ? 1.0f : low;
  const float power = 1.055f * fastPow(v < 1e-6f ? 1e-6f : v, 1 / 2.4f) - 0.055f;
  return v > 0.0031308f ? power : 12.92f * v;
}

namespace curves {

inline float largest(Vec3 v) {
  const float m = v.x > v.y ? v.x : v.y;
  return m > v.z ? m : v.z;
}
inline float smallest(Vec3 v) {
  const float m = v.x < v.y ? v.x : v.y;
  return m < v.z ? m : v.z;
}

inline Vec3 clip(Vec3 color) { return color; }

// Contrast about middle grey and saturation, both without a change of hue.
inline Vec3 graded(Vec3 color, float contrast, float saturation) {
  constexpr float kMiddleGrey = 0.18f;
  const float y = luminance(color), relative = y * (1 / kMiddleGrey);
  const float gain = fastPow(relative < 1e-6f ? 1e-6f : relative, contrast - 1);
  const float grey = y * gain * (1 - saturation);
  const Vec3 v = color * (gain * saturation) + Vec3(grey);
  return {v.x > 0 ? v.x : 0.0f, v.y > 0 ? v.y : 0.0f, v.z > 0 ? v.z : 0.0f};
}

// Khronos PBR Neutral Tone Mapper, specification 1.0: colours below 0.8 keep hue and saturation, highlights roll off to
// white.
inline Vec3 neutral(Vec3 color) {
  constexpr float kStartCompression = 0.8f - 0.04f, kDesaturation = 0.15f;
  const float x = smallest(color);
  const Vec3 c = color - Vec3(x < 0.08f ? x - 6.25f * x * x : 0.04f);
  // Below the start the curve is the identity; so it is at the start itself.
  const float brightest = largest(c), peak = brightest > kStartCompression ? brightest : kStartCompression;
  const float d = 1 - kStartCompression;
  const float newPeak = 1 - d * d / (peak + d - kStartCompression);
  const float g = 1 - 1 / (kDesaturation * (peak - newPeak) + 1);
  return c * ((1 - g) * newPeak / peak) + Vec3(newPeak * g);
}

// Sixth-order fit of the AgX base contrast curve (Wrensch 2023, "Minimal AgX implementation"); in and out 0..1.
inline float agxContrast(float x) {
  // Horner's way, so that the large terms do not cancel among rounding errors.
  return x * (x * (x * (x * (x * (15.5f * x - 40.14f) + 31.96f) - 6.868f) + 0.4298f) + 0.1191f) - 0.00232f;
}

inline Vec3 agx(Vec3 color) {
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
  const auto contrast = [](float v) {
    const float ev = fastLog2(v > 1e-10f ? v : 1e-10f);
    const float held = ev < kMinEv ? kMinEv : ev > kMaxEv ? kMaxEv : ev;
    return agxContrast((held - kMinEv) / (kMaxEv - kMinEv));
  };
  const Vec3 v = inset.vector(color);
  const Vec3 w = outset.vector({contrast(v.x), contrast(v.y), contrast(v.z)});
  // The curve ends in display values of a 2.2 power display; back to linear for the sRGB encoding that follows.
  const auto linear = [](float e) { return e > 1e-6f ? fastPow(e, 2.2f) : 0.0f; };
  return {linear(w.x), linear(w.y), linear(w.z)};
}

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve", of the largest channel; the others keep their ratio to it, and
// towards the shoulder all of them go to white.
inline Vec3 filmic(Vec3 color) {
  constexpr float kShoulder = 0.7f;
  const float brightest = largest(color), x = brightest > 1e-6f ? brightest : 1e-6f;
  const float shown = x * (x * 2.51f + 0.03f) / (x * (x * 2.43f + 0.59f) + 0.14f), peak = shown < 1 ? shown : 1.0f;
  const float beyond = peak > kShoulder ? (peak - kShoulder) / (1 - kShoulder) : 0.0f, white = beyond * beyond;
  return color * ((1 - white) * peak / x) + Vec3(white * peak);
}

}  // namespace curves

// Noise that hides the bands of 8 bits: 0 to 1, even over small neighbourhoods: interleaved gradient noise (Jimenez
// 2014, "Next generation post processing in Call of Duty").
inline float ditherAt(int x, int y) {
  const float inner = 0.06711056f * static_cast<float>(x) + 0.00583715f * static_cast<float>(y);
  const float v = 52.9829189f * (inner - std::floor(inner));
  return v - std::floor(v);
}

}  // namespace roomlight
