#include "compare/perceived_error.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight {
namespace {

// Rec.709 to CIE XYZ as the published code has it, and white (D65), the sum of its columns.
const Affine kXyzFromRgb{{0.4123865632529917f, 0.2126368216773238f, 0.0193306201524840f},
                         {0.3575914909206254f, 0.7151829818412507f, 0.1191971636402085f},
                         {0.1804504912035637f, 0.0721801964814255f, 0.9503725870054354f},
                         {0, 0, 0}};
const Vec3 kWhite = kXyzFromRgb.vector(Vec3(1));

// Opponent space linear in XYZ, section 4.1: luminance, red-green, blue-yellow.
Vec3 opponentFromRgb(Vec3 rgb) {
  const Vec3 v = kXyzFromRgb.vector(rgb) / kWhite;
  return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}
Vec3 rgbFromOpponent(Vec3 o) {
  static const Affine kRgbFromXyz = inverse(kXyzFromRgb);
  const float y = (o.x + 16) / 116;
  return kRgbFromXyz.vector(Vec3{y + o.y / 500, y, y - o.z / 200} * kWhite);
}

// CIELAB with chroma scaled by lightness (Hunt effect), section 4.1.
Vec3 huntLabFromRgb(Vec3 rgb) {
  const auto f = [](float t) {
    constexpr float kDelta = 6.0f / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
  };
  const Vec3 v = kXyzFromRgb.vector(rgb) / kWhite;
  const float fy = f(v.y), lightness = 116 * fy - 16;
  return {lightness, 0.01f * lightness * 500 * (f(v.x) - fy), 0.01f * lightness * 200 * (fy - f(v.z))};
}

// City block in lightness, Euclid in chroma (HyAB).
float hyab(Vec3 a, Vec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// One Gaussian of a contrast sensitivity function: a sqrt(pi/b) exp(-pi² x²/b), x in degrees.
struct Sensitivity {
  double a, b;
};

Plane filterBy(const Plane& in, const std::vector<Sensitivity>& terms, double pixelsPerDegree) {
  constexpr double kLargestB = 0.04;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kLargestB / (2 * M_PI * M_PI)) * pixelsPerDegree));
  Plane out(in.width, in.height);
  std::vector<double> weights;
  double total = 0;
  for (const Sensitivity& s : terms) {
    double sum = 0;  // of the one-dimensional kernel before it is normalised
    for (int x = -radius; x <= radius; ++x)
      sum += std::exp(-M_PI * M_PI * x * x / (pixelsPerDegree * pixelsPerDegree * s.b));
    weights.push_back(s.a * std::sqrt(M_PI / s.b) * sum * sum);
    total += weights.back();
  }
  for (size_t k = 0; k < terms.size(); ++k) {
    const Kernel kernel = gaussianKernel(std::sqrt(terms[k].b / 2) / M_PI * pixelsPerDegree, radius);
    const Plane part = convolve(in, kernel, kernel);
    const auto weight = static_cast<float>(weights[k] / total);
    for (size_t i = 0; i < out.values.size(); ++i) out.values[i] += weight * part.values[i];
  }
  return out;
}

struct Seen {
  std::vector<Vec3> color;  // Hunt-adjusted CIELAB after the eye's blur
  Plane lightness;          // 0..1, not blurred: for the features
};

Seen seenPicture(const Image& image, double pixelsPerDegree) {
  Image opponent(image.width, image.height);
  parallelFor(image.pixels.size(), 8192, [&](size_t i) { opponent.pixels[i] = opponentFromRgb(image.pixels[i]); });
  Seen seen{{}, channelOf(opponent, 0)};
  const Plane achromatic = filterBy(seen.lightness, {{1, 0.0047}}, pixelsPerDegree);
  const Plane redGreen = filterBy(channelOf(opponent, 1), {{1, 0.0053}}, pixelsPerDegree);
  const Plane blueYellow = filterBy(channelOf(opponent, 2), {{34.1, 0.04}, {13.5, 0.025}}, pixelsPerDegree);
  for (float& v : seen.lightness.values) v = (v + 16) / 116;
  seen.color.resize(image.pixels.size());
  parallelFor(seen.color.size(), 8192, [&](size_t i) {
    const Vec3 rgb = rgbFromOpponent({achromatic.values[i], redGreen.values[i], blueYellow.values[i]});
    seen.color[i] = huntLabFromRgb(min(max(rgb, Vec3(0)), Vec3(1)));
  });
  return seen;
}

// Differences of colour to 0..1, section 4.1: the larger part of the range goes to differences below 0.4 of the
// largest, which is that of green and blue.
float redistribute(float difference) {
  constexpr float kExponent = 0.7f, kKnee = 0.4f, kKneeValue = 0.95f;
  static const float largest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kExponent);
  const float d = std::pow(difference, kExponent), knee = kKnee * largest;
  return d < knee ? kKneeValue / knee * d : kKneeValue + (d - knee) / (largest - knee) * (1 - kKneeValue);
}

// Makes the positive part sum to 1 and the negative to -1.
Kernel balanced(Kernel kernel) {
  float positive = 0, negative = 0;
  for (const float v : kernel) (v > 0 ? positive : negative) += std::abs(v);
  for (float& v : kernel) v /= v > 0 ? positive : negative;
  return kernel;
}

// Lengths of the gradients that detect edges and points, section 4.2.
struct Features {
  Plane edge, point;
};
Features featuresOf(const Plane& lightness, double pixelsPerDegree) {
  constexpr double kWidthDegrees = 0.082;
  const double sigma = 0.5 * kWidthDegrees * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Kernel smooth = gaussianKernel(sigma, radius);
  Kernel first = smooth, second = smooth;
  for (int x = -radius; x <= radius; ++x) {
    first[static_cast<size_t>(x + radius)] *= static_cast<float>(-x);
    second[static_cast<size_t>(x + radius)] *= static_cast<float>(x * x / (sigma * sigma) - 1);
  }
  const auto gradient = [&](const Kernel& kernel) {
    Plane x = convolve(lightness, kernel, smooth);
    const Plane y = convolve(lightness, smooth, kernel);
    for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
    return x;
  };
  return {gradient(balanced(first)), gradient(balanced(second))};
}

}  // namespace

Plane flipDifference(const Image& reference, const Image& picture, double pixelsPerDegree) {
  const Seen r = seenPicture(reference, pixelsPerDegree), p = seenPicture(picture, pixelsPerDegree);
  const Features fr = featuresOf(r.lightness, pixelsPerDegree), fp = featuresOf(p.lightness, pixelsPerDegree);
  Plane out(reference.width, reference.height);
  parallelFor(out.values.size(), 8192, [&](size_t i) {
    const float color = redistribute(hyab(r.color[i], p.color[i]));
    const float edge = std::abs(fr.edge.values[i] - fp.edge.values[i]);
    const float point = std::abs(fr.point.values[i] - fp.point.values[i]);
    const float feature = std::sqrt(std::max(edge, point) / std::sqrt(2.0f));
    out.values[i] = std::clamp(std::pow(color, 1 - std::min(feature, 1.0f)), 0.0f, 1.0f);
  });
  return out;
}

}  // namespace roomlight
