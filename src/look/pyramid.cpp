#include "look/pyramid.h"

#include <algorithm>

namespace roomlight {
namespace {

int held(int i, int count) { return std::clamp(i, 0, count - 1); }

}  // namespace

Plane halved(const Plane& p) {
  constexpr float kBinomial[] = {1 / 16.0f, 4 / 16.0f, 6 / 16.0f, 4 / 16.0f, 1 / 16.0f};
  Plane across((p.width + 1) / 2, p.height), out(across.width, (p.height + 1) / 2);
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < across.width; ++x) {
      float sum = 0;
      for (int k = -2; k <= 2; ++k) sum += kBinomial[k + 2] * p.at(held(2 * x + k, p.width), y);
      across.at(x, y) = sum;
    }
  }
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      float sum = 0;
      for (int k = -2; k <= 2; ++k) sum += kBinomial[k + 2] * across.at(x, held(2 * y + k, p.height));
      out.at(x, y) = sum;
    }
  }
  return out;
}

// The binomial filter on every other place: at places between two, half of each; at the others 1, 6 and 1 eighths.
Plane doubled(const Plane& p, int width, int height) {
  Plane across(width, p.height), out(width, height);
  const auto between = [](float before, float here, float after, bool odd) {
    return odd ? 0.5f * (here + after) : 0.125f * (before + 6 * here + after);
  };
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int c = x / 2;
      across.at(x, y) =
          between(p.at(held(c - 1, p.width), y), p.at(held(c, p.width), y), p.at(held(c + 1, p.width), y), x % 2 == 1);
    }
  }
  for (int y = 0; y < height; ++y) {
    const int c = y / 2;
    for (int x = 0; x < width; ++x)
      out.at(x, y) = between(across.at(x, held(c - 1, p.height)), across.at(x, held(c, p.height)),
                             across.at(x, held(c + 1, p.height)), y % 2 == 1);
  }
  return out;
}

std::vector<Plane> gaussianPyramid(Plane plane, int least) {
  std::vector<Plane> levels = {std::move(plane)};
  while (std::min(levels.back().width, levels.back().height) > least) levels.push_back(halved(levels.back()));
  return levels;
}

}  // namespace roomlight
