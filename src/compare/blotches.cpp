#include "compare/perceived_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kFloor = 0.02f;      // of the mean: below, errors count as absolute
constexpr float kBright = 20;        // medians: lamps, and the sun's discs
constexpr float kReferenceRange = 0.5f, kPictureRange = 0.4f;
constexpr int kReferenceReach = 4, kPictureReach = 3;
constexpr float kFullColour = 0.05f;

Plane map(const Plane& of, const std::function<float(size_t)>& value) {
  Plane out(of.width, of.height);
  parallelFor(out.values.size(), 16384, [&](size_t i) { out.values[i] = value(i); });
  return out;
}

Plane gaussian(const Plane& in, float sigma) {
  const Kernel kernel = gaussianKernel(static_cast<double>(sigma), static_cast<int>(std::ceil(3 * sigma)));
  return convolve(in, kernel, kernel);
}

// Of a square of pixels around each, its largest value.
Plane largest(const Plane& in, int reach) {
  const auto along = [&](const Plane& of, int dx, int dy) {
    Plane out(of.width, of.height);
    parallelFor(static_cast<size_t>(of.height), 8, [&](size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < of.width; ++x) {
        float most = of.at(x, y);
        for (int k = -reach; k <= reach; ++k)
          most =
              std::max(most, of.at(std::clamp(x + k * dx, 0, of.width - 1), std::clamp(y + k * dy, 0, of.height - 1)));
        out.at(x, y) = most;
      }
    });
    return out;
  };
  return along(along(in, 1, 0), 0, 1);
}

Plane range(const Plane& in, int reach) {
  const Plane high = largest(in, reach), low = largest(map(in, [&](size_t i) { return -in.values[i]; }), reach);
  return map(in, [&](size_t i) { return high.values[i] + low.values[i]; });
}

// Normalised convolution (Knutsson & Westin 1993) of what is judged.
struct Smoothed {
  const Plane& judged;
  Plane operator()(const Plane& values, float sigma) const {
    const Plane weight = gaussian(judged, sigma),
                sum = gaussian(map(values, [&](size_t i) { return values.values[i] * judged.values[i]; }), sigma);
    return map(values, [&](size_t i) { return weight.values[i] > 0 ? sum.values[i] / weight.values[i] : 0; });
  }
};

Plane minus(const Plane& a, const Plane& b) {
  return map(a, [&](size_t i) { return a.values[i] - b.values[i]; });
}

double rootOfProduct(const Plane& a, const Plane& b, const Plane& judged) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < a.values.size(); ++i)
    sum += static_cast<double>(judged.values[i] * a.values[i] * b.values[i]),
        count += static_cast<double>(judged.values[i]);
  return count > 0 ? 100 * std::sqrt(std::max(0.0, sum / count)) : 0;
}

}  // namespace

Blotches blotches(const Image& reference, const Image& second, const Image& picture) {
  const Plane one = luminanceOf(reference), two = luminanceOf(second), p = luminanceOf(picture);
  const Plane r = map(one, [&](size_t i) { return 0.5f * (one.values[i] + two.values[i]); });
  double sum = 0;
  for (const float v : r.values) sum += static_cast<double>(v);
  const float mean = static_cast<float>(sum / static_cast<double>(r.values.size())),
              least = std::max(kFloor * mean, 1e-20f);
  std::vector<float> lit;
  std::copy_if(r.values.begin(), r.values.end(), std::back_inserter(lit), [](float v) { return v > 0; });
  if (lit.empty()) return {0, 0, 0, map(r, [](size_t) { return kNotJudged; })};
  std::nth_element(lit.begin(), lit.begin() + static_cast<ptrdiff_t>(lit.size() / 2), lit.end());
  const float brightest = kBright * lit[lit.size() / 2];
  Plane all = map(r, [](size_t) { return 1.0f; });
  const Plane soft = Smoothed{all}(r, 2);
  const auto logarithm = [&](const Plane& of) {
    return map(of, [&](size_t i) { return std::log(std::max(of.values[i], 0.0f) + least); });
  };
  const Plane edges = range(logarithm(soft), kReferenceReach), edgesSeen = range(logarithm(p), kPictureReach);
  const Plane judged = map(r, [&](size_t i) {
    return edges.values[i] < kReferenceRange && edgesSeen.values[i] < kPictureRange && r.values[i] > 0 &&
                   r.values[i] < brightest
               ? 1.0f
               : 0.0f;
  });
  const auto error = [&](const Plane& of) {
    return map(r,
               [&](size_t i) { return std::clamp((p.values[i] - of.values[i]) / (r.values[i] + least), -1.0f, 1.0f); });
  };
  const Smoothed smoothed{judged};
  const Plane e1 = error(one), e2 = error(two), fine1 = smoothed(e1, 1.5f), fine2 = smoothed(e2, 1.5f),
              middle1 = smoothed(e1, 4), middle2 = smoothed(e2, 4);
  const Plane band1 = minus(middle1, smoothed(e1, 32)), band2 = minus(middle2, smoothed(e2, 32));
  const double share = static_cast<double>(std::count(judged.values.begin(), judged.values.end(), 1.0f)) /
                       static_cast<double>(judged.values.size());
  return {
      rootOfProduct(band1, band2, judged), rootOfProduct(minus(fine1, middle1), minus(fine2, middle2), judged), share,
      map(r, [&](size_t i) { return judged.values[i] > 0 ? 0.5f * (band1.values[i] + band2.values[i]) : kNotJudged; })};
}

Image bandPicture(const Blotches& found) {
  const Vec3 right(0.5f), tooBright{0.9f, 0.05f, 0.05f}, tooDark{0.1f, 0.2f, 0.95f};
  Image out(found.band.width, found.band.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    const float e = found.band.values[i];
    if (e == kNotJudged) continue;
    out.pixels[i] = lerp(right, e > 0 ? tooBright : tooDark, std::min(std::abs(e) / kFullColour, 1.0f));
  }
  return out;
}

}  // namespace roomlight
