#include "compare/compare.h"

#include <fmt/format.h>

#include "base/tone.h"

namespace roomlight {
namespace {

float luma(Vec3 v) { return luminance(v); }

// Mean structural similarity over 8x8 windows at every fourth pixel, constants for a range of 1.
double structuralSimilarity(const Image& a, const Image& b) {
  constexpr int kWindow = 8;
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  double sum = 0;
  size_t windows = 0;
  for (int y = 0; y + kWindow <= a.height; y += 4) {
    for (int x = 0; x + kWindow <= a.width; x += 4) {
      double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
      for (int k = 0; k < kWindow * kWindow; ++k) {
        const double va = luma(a.at(x + k % kWindow, y + k / kWindow)), vb = luma(b.at(x + k % kWindow, y + k / kWindow));
        ma += va, mb += vb, aa += va * va, bb += vb * vb, ab += va * vb;
      }
      const double n = kWindow * kWindow;
      ma /= n, mb /= n;
      const double sa = aa / n - ma * ma, sb = bb / n - mb * mb, sab = ab / n - ma * mb;
      sum += (2 * ma * mb + c1) * (2 * sab + c2) / ((ma * ma + mb * mb + c1) * (sa + sb + c2));
      ++windows;
    }
  }
  return windows ? sum / static_cast<double>(windows) : 1;
}

}  // namespace

Result<Report> compare(const Image& reference, const Image& picture) {
  if (reference.width != picture.width || reference.height != picture.height) {
    return Error{fmt::format("the pictures differ in size: {}x{} and {}x{}; render both with the same --size", reference.width,
                             reference.height, picture.width, picture.height)};
  }
  double meanReference = 0, meanPicture = 0;
  for (size_t i = 0; i < reference.pixels.size(); ++i) {
    if (!isFinite(reference.pixels[i]) || !isFinite(picture.pixels[i])) {
      return Error{fmt::format("pixel ({}, {}) is not finite", i % static_cast<size_t>(reference.width), i / static_cast<size_t>(reference.width))};
    }
    meanReference += luminance(reference.pixels[i]);
    meanPicture += luminance(picture.pixels[i]);
  }
  const double n = static_cast<double>(reference.pixels.size());
  meanReference /= n, meanPicture /= n;
  const float ev = automaticEv100(reference);
  const Image a = toneMap(reference, ev, ToneCurve::Clip), b = toneMap(picture, ev, ToneCurve::Clip);
  Report report;
  for (size_t i = 0; i < reference.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double d = a.pixels[i][c] - b.pixels[i][c];
      report.mse += d * d;
      const double r = reference.pixels[i][c], l = picture.pixels[i][c] - r;
      report.relMse += l * l / (r * r + 0.01 * meanReference * meanReference + 1e-30);
    }
  }
  report.mse /= 3 * n;
  report.relMse /= 3 * n;
  report.ssim = structuralSimilarity(a, b);
  report.meanLuminanceErrorPercent = meanReference > 0 ? 100 * (meanPicture - meanReference) / meanReference : 0;
  return report;
}

Image differencePicture(const Image& reference, const Image& picture) {
  const float ev = automaticEv100(reference);
  const Image a = toneMap(reference, ev, ToneCurve::Clip), b = toneMap(picture, ev, ToneCurve::Clip);
  Image out(a.width, a.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = min(abs(a.pixels[i] - b.pixels[i]) * 4.0f, Vec3(1));
  return out;
}

}  // namespace roomlight
