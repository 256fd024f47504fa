#include "compare/compare.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/tone.h"
#include "compare/perceived_error.h"

namespace roomlight {
namespace {

Status checkFinite(const Image& image, const char* which) {
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    if (isFinite(image.pixels[i])) continue;
    const size_t width = static_cast<size_t>(image.width);
    return Error{
        fmt::format("the {} holds a value that is not finite, at pixel ({}, {})", which, i % width, i / width)};
  }
  return Ok{};
}

Status checkPair(const Image& reference, const Image& picture) {
  if (reference.pixels.empty() || picture.pixels.empty()) return Error{"a picture without pixels cannot be compared"};
  if (Status s = checkSizes(reference.size(), picture.size()); !s.ok()) return s;
  if (Status s = checkFinite(reference, "reference"); !s.ok()) return s;
  return checkFinite(picture, "picture");
}

double meanLuminance(const Image& image) {
  double sum = 0;
  for (const Vec3& p : image.pixels) sum += static_cast<double>(luminance(p));
  return sum / static_cast<double>(image.pixels.size());
}

double meanSquaredError(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double d = static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]);
      sum += d * d;
    }
  }
  return sum / (3 * static_cast<double>(a.pixels.size()));
}

double productOfErrors(const Image& a, const Image& b, const Image& p) {
  double sum = 0;
  for (size_t i = 0; i < p.pixels.size(); ++i) {
    const Vec3 product = (a.pixels[i] - p.pixels[i]) * (b.pixels[i] - p.pixels[i]);
    for (int c = 0; c < 3; ++c) sum += static_cast<double>(product[c]);
  }
  return sum / (3 * static_cast<double>(p.pixels.size()));
}

double relativeMeanSquaredError(const Image& reference, const Image& picture, double meanLuminanceOfReference) {
  // Keeps dark pixels from ruling the mean: below a tenth of the mean luminance errors count as absolute.
  const double epsilon = 0.01 * meanLuminanceOfReference * meanLuminanceOfReference;
  double sum = 0;
  for (size_t i = 0; i < reference.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double r = reference.pixels[i][c], d = static_cast<double>(picture.pixels[i][c]) - r;
      sum += d * d / (r * r + epsilon);
    }
  }
  return sum / (3 * static_cast<double>(reference.pixels.size()));
}

double meanFlip(const Image& r, const Image& p) {
  const Plane flip = flipDifference(r, p);
  double sum = 0;
  for (const float v : flip.values) sum += static_cast<double>(v);
  return sum / static_cast<double>(flip.values.size());
}

// As a display takes it: clipped to 0..1 and sRGB-encoded, without an exposure.
Image asShown(const Image& linear) { return toneMap(linear, std::log2(1 / 1.2f), ToneCurve::Clip); }

Image differenceOfEncoded(const Image& r, const Image& p) {
  const Vec3 equal(0.5f), tooBright{0.9f, 0.05f, 0.05f}, tooDark{0.1f, 0.2f, 0.95f};
  Image out(r.width, r.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    const float d = (luminance(p.pixels[i]) - luminance(r.pixels[i])) / 0.25f;
    out.pixels[i] = lerp(equal, d > 0 ? tooBright : tooDark, std::min(std::abs(d), 1.0f));
  }
  return out;
}

Image decoded(Image encoded) {
  for (Vec3& p : encoded.pixels) p = {srgbDecode(p.x), srgbDecode(p.y), srgbDecode(p.z)};
  return encoded;
}

}  // namespace

Status checkSizes(ImageSize reference, ImageSize picture) {
  if (reference == picture) return Ok{};
  return Error{fmt::format(
      "sizes differ: the reference has {} x {} pixels, the picture {} x {}; render both with the same --size",
      reference.width, reference.height, picture.width, picture.height)};
}

Result<Report> compare(const Image& reference, const Image& picture) {
  if (Status s = checkPair(reference, picture); !s.ok()) return Error{s.error()};
  Report report;
  report.referenceMeanLuminance = meanLuminance(reference);
  if (!(report.referenceMeanLuminance > 0)) return Error{"the reference is black: no error can be related to it"};
  report.ev100 = automaticEv100(reference);
  const Image r = toneMap(reference, report.ev100, ToneCurve::Clip),
              p = toneMap(picture, report.ev100, ToneCurve::Clip);
  report.mse = meanSquaredError(r, p);
  report.relMse = relativeMeanSquaredError(reference, picture, report.referenceMeanLuminance);
  report.ssim = structuralSimilarity(luminanceOf(r), luminanceOf(p));
  report.flip = meanFlip(decoded(r), decoded(p));
  report.meanLuminanceErrorPercent = 100 * (meanLuminance(picture) / report.referenceMeanLuminance - 1);
  return report;
}

Image meanOf(const Image& a, const Image& b) {
  assert(a.width == b.width && a.height == b.height);
  Image mean = a;
  for (size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5f;
  return mean;
}

Result<Report> compare(const Image& reference, const Image& second, const Image& picture) {
  if (Status s = checkPair(reference, second); !s.ok()) return Error{s.error()};
  Result<Report> report = compare(meanOf(reference, second), picture);
  if (!report) return report;
  const auto seen = [&](const Image& image) { return toneMap(image, report.value().ev100, ToneCurve::Clip); };
  report.value().mseBeyondNoise = productOfErrors(seen(reference), seen(second), seen(picture));
  report.value().noise = blotches(reference, second, picture);
  return report;
}

Image differencePicture(const Image& reference, const Image& picture) {
  assert(checkPair(reference, picture).ok());
  const float ev100 = automaticEv100(reference);
  return differenceOfEncoded(toneMap(reference, ev100, ToneCurve::Clip), toneMap(picture, ev100, ToneCurve::Clip));
}

Result<ShownReport> compareShown(const Image& reference, const Image& picture) {
  if (Status s = checkPair(reference, picture); !s.ok()) return Error{s.error()};
  const Image r = asShown(reference), p = asShown(picture);
  return ShownReport{meanSquaredError(r, p), structuralSimilarity(luminanceOf(r), luminanceOf(p)),
                     meanFlip(reference, picture)};
}

Image differencePictureOfShown(const Image& reference, const Image& picture) {
  assert(checkPair(reference, picture).ok());
  return differenceOfEncoded(asShown(reference), asShown(picture));
}

}  // namespace roomlight
