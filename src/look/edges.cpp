#include "look/edges.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/tone.h"

namespace roomlight {
namespace {

constexpr float kLeastContrast = 2, kFullContrast = 4;  // of the two sides
// A few rays do not find less than a thirtieth of a pixel: what is a hundred times darker than its neighbour is a
// thing by itself.
constexpr float kLeastShare = 0.003f, kFullShare = 0.012f;
constexpr float kUneven = 0.05f;  // how far the bright side may differ from one pixel to the next

// The eight neighbours, around the pixel: the opposite of number k is k + 4.
constexpr std::array<std::array<int, 2>, 8> kAround = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

struct Neighbours {
  const Plane& luminances;
  int x, y;

  // -1: outside of the picture.
  float at(size_t number) const {
    const auto [dx, dy] = kAround[number % kAround.size()];
    const int qx = x + dx, qy = y + dy;
    if (qx < 0 || qy < 0 || qx >= luminances.width || qy >= luminances.height) return -1;
    return luminances.values[index(number)];
  }
  size_t index(size_t number) const {
    const auto [dx, dy] = kAround[number % kAround.size()];
    return static_cast<size_t>(y + dy) * static_cast<size_t>(luminances.width) + static_cast<size_t>(x + dx);
  }
  size_t brightest() const {
    size_t best = 0;
    for (size_t k = 1; k < kAround.size(); ++k) {
      if (at(k) > at(best)) best = k;
    }
    return best;
  }
  // The middle one of the three opposite: the others may be parts of the edge, or of a third thing.
  size_t opposite(size_t number) const {
    std::array<size_t, 3> three = {number + 3, number + 4, number + 5};
    std::sort(three.begin(), three.end(), [&](size_t a, size_t b) { return at(a) < at(b); });
    return three[1];
  }
};

float smoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

Vec3 leftOver(const EdgePixel& e, const Image& light) {
  return max(light.pixels[e.pixel] - light.pixels[e.bright] * e.share, Vec3(0)) / (1 - e.share);
}

// How far a pixel is no mixture of the two sides, but shows a third thing: light that some channel lacks once the
// bright side's share is taken from it. 0 or less: none.
float missingLight(const EdgePixel& e, const Image& light) {
  return -minComponent(light.pixels[e.pixel] - light.pixels[e.bright] * e.share) / (1 - e.share);
}

float fade(float value, float from, float width) {
  return 1 - std::clamp((value - from) / std::max(width, 1e-20f), 0.0f, 1.0f);
}

// Of each pixel of row y whether it may be an edge: by the range of the nine pixels, in loops without branches.
class Candidates {
 public:
  explicit Candidates(int width)
      : width_(static_cast<size_t>(width)), most_(width_ + 2), least_(width_ + 2), may_(width_) {}

  const std::vector<uint8_t>& of(const Plane& luminances, int y) {
    const float* own = luminances.values.data() + static_cast<size_t>(y) * width_;
    const float* above = y > 0 ? own - width_ : own;
    const float* below = y + 1 < luminances.height ? own + width_ : own;
    float* most = most_.data() + 1;
    float* least = least_.data() + 1;
    for (size_t x = 0; x < width_; ++x) {
      most[x] = std::max(own[x], std::max(above[x], below[x]));
      least[x] = std::min(own[x], std::min(above[x], below[x]));
    }
    most_.front() = most_[1], most_.back() = most_[width_];
    least_.front() = least_[1], least_.back() = least_[width_];
    for (size_t x = 0; x < width_; ++x) {
      const float high = std::max(most_[x], std::max(most_[x + 1], most_[x + 2])),
                  low = std::min(least_[x], std::min(least_[x + 1], least_[x + 2]));
      may_[x] = high > kLeastContrast * low;
    }
    return may_;
  }

 private:
  size_t width_;
  std::vector<float> most_, least_;  // of three in a column; a place more on either side
  std::vector<uint8_t> may_;
};

void findInRow(const Image& light, const Plane& luminances, int y, Candidates& candidates,
               std::vector<EdgePixel>& out) {
  const auto row = static_cast<size_t>(y) * static_cast<size_t>(light.width);
  const std::vector<uint8_t>& may = candidates.of(luminances, y);
  for (int x = 0; x < light.width; ++x) {
    if (!may[static_cast<size_t>(x)]) continue;
    const Neighbours around{luminances, x, y};
    const size_t pixel = row + static_cast<size_t>(x), bright = around.brightest();
    const float own = luminances.values[pixel], high = around.at(bright);
    if (!(high > own) || !std::isfinite(high)) continue;
    const size_t dark = around.opposite(bright);
    const float low = around.at(dark);
    if (!(low >= 0 && own > low && high > kLeastContrast * low)) continue;
    EdgePixel e{};
    e.pixel = static_cast<uint32_t>(pixel), e.bright = static_cast<uint32_t>(around.index(bright)),
    e.dark = static_cast<uint32_t>(around.index(dark));
    e.share = (own - low) / (high - low);
    e.weight = smoothStep(kLeastContrast, kFullContrast, high / std::max(low, 1e-6f * high)) *
               smoothStep(kLeastShare, kFullShare, e.share);
    if (!(e.share < 1)) continue;
    const float uneven = kUneven * e.share * high / (1 - e.share), missing = missingLight(e, light);
    e.weight *= fade(missing, 2 * uneven, low + 2 * uneven);
    if (!(e.weight > 0)) continue;
    e.darkLight = light.pixels[e.dark];
    // What is left over is the small difference of two large amounts: where it may be unevenness, so is its colour.
    e.ownColour = std::min(1.0f, low / std::max(uneven, 1e-20f)) * fade(missing, 0, low);
    e.rest = lerp(e.darkLight, leftOver(e, light), e.ownColour);
    out.push_back(e);
  }
}

}  // namespace

std::vector<EdgePixel> edgePixels(const Image& light) {
  Plane luminances(light.width, light.height);
  parallelFor(light.pixels.size(), 16384, [&](size_t i) { luminances.values[i] = luminance(light.pixels[i]); });
  std::vector<std::vector<EdgePixel>> rows(static_cast<size_t>(light.height));
  parallelRanges(rows.size(), 16, [&](size_t begin, size_t end) {
    Candidates candidates(light.width);
    for (size_t y = begin; y < end; ++y) findInRow(light, luminances, static_cast<int>(y), candidates, rows[y]);
  });
  size_t count = 0;
  for (const std::vector<EdgePixel>& row : rows) count += row.size();
  std::vector<EdgePixel> all;
  all.reserve(count);
  for (std::vector<EdgePixel>& row : rows) {
    all.insert(all.end(), row.begin(), row.end());
    row = {};
  }
  return all;
}

std::vector<EdgePixel> edgesIn(const Image& light, std::vector<EdgePixel> edges) {
  parallelFor(edges.size(), 1024, [&](size_t i) {
    EdgePixel& e = edges[i];
    e.darkLight = light.pixels[e.dark];
    e.rest = lerp(e.darkLight, leftOver(e, light), e.ownColour);
  });
  return edges;
}

Image retouchedRests(const std::vector<EdgePixel>& edges, const Plane& gains, const Image& retouched) {
  Image rests(static_cast<int>(edges.size()), 1);
  parallelFor(edges.size(), 1024, [&](size_t i) {
    const EdgePixel& e = edges[i];
    const float gain = gains.values.empty() ? 1.0f : gains.values[e.dark];
    // What glare adds there, it adds to both.
    rests.pixels[i] = max(retouched.pixels[e.dark] + (e.rest - e.darkLight) * gain, Vec3(0));
  });
  return rests;
}

Vec3 shownEdge(const EdgePixel& e, Vec3 own, Vec3 bright, Vec3 rest) {
  Vec3 shown;
  for (int c = 0; c < 3; ++c) {
    const float both = lerp(srgbDecode(rest[c]), srgbDecode(bright[c]), e.share);
    shown[c] = srgbEncode(lerp(srgbDecode(own[c]), both, e.weight));
  }
  return shown;
}

void showEdges(Image& shown, const std::vector<EdgePixel>& edges, const Image& rests) {
  std::vector<Vec3> mixed(edges.size());
  parallelFor(edges.size(), 1024, [&](size_t i) {
    const EdgePixel& e = edges[i];
    mixed[i] = shownEdge(e, shown.pixels[e.pixel], shown.pixels[e.bright], rests.pixels[i]);
  });
  for (size_t i = 0; i < edges.size(); ++i) shown.pixels[edges[i].pixel] = mixed[i];
}

}  // namespace roomlight
