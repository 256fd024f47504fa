#include "filter/levels.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace roomlight {
namespace {

constexpr int kFinestLevels = 2;
constexpr int kBounded = 0, kNoise = 1, kPower = 2;  // what is pooled
constexpr int kColours = 3, kDrawn = 3;  // parts of diffuse light: its colour, then its drawn noise
constexpr float kFine = 2, kCoarse = 1.1f;  // times the noise that a level is believed to hold: in single pixels it is seen at once, and told by fewer of them
constexpr float kMostOfPixel = 6;           // times the noise around: more is an outlier
// Of the noise that independent pixels would leave in each level, as variance. Pixels of a block share one well-distributed sequence (gather/pixel_shader), so the wider a level the less
// there is. Measured on walls of the sample homes, eight seeds.
constexpr float kOfIndependent[] = {1, 0.9f, 0.85f, 0.75f, 0.65f, 0.4f};

const float* partOf(const FilterRows& rows, int place, int part, int y) { return rows.line(FilterRows::light(0, place) + part, y); }

float noisePart(int level) { return kOfIndependent[std::min(level, static_cast<int>(std::size(kOfIndependent)) - 1)]; }

// Calls body(x, d, n) with what a level adds to the smoother one, in luminance and in drawn noise.
template <class Body>
void forLevel(const FilterRows& rows, int place, int y, Body&& body) {
  const float *fine[kColours + 1], *smooth[kColours + 1];
  for (int c = 0; c <= kColours; ++c) fine[c] = partOf(rows, place, c, y), smooth[c] = partOf(rows, 1 - place, c, y);
  for (int x = 0; x < rows.width(); ++x) {
    const float d = 0.2126f * (fine[0][x] - smooth[0][x]) + 0.7152f * (fine[1][x] - smooth[1][x]) + 0.0722f * (fine[2][x] - smooth[2][x]);
    body(x, d, fine[kDrawn][x] - smooth[kDrawn][x]);
  }
}

}  // namespace

bool hasOutliers(int level) { return level <= kFinestLevels; }

float drawnNoise(float variance, size_t pixel) { return mix64(pixel + 0x9e3779b97f4a7c15ull) & 1 ? std::sqrt(variance) : -std::sqrt(variance); }

void takePower(FilterRows& rows, int place, int y) {
  float *bounded = rows.line(FilterRows::pool(0) + kBounded, y), *noise = rows.line(FilterRows::pool(0) + kNoise, y), *power = rows.line(FilterRows::pool(0) + kPower, y);
  const float* weight = partOf(rows, place, FilterRows::kWeight, y);
  forLevel(rows, place, y, [&](int x, float d, float n) {
    const float known = weight[x] > 0 ? 1.0f : 0.0f;
    bounded[x] = power[x] = known * d * d, noise[x] = known * n * n;
  });
}

void boundPower(FilterRows& rows, int place, int y) {
  float *bounded = rows.line(FilterRows::pool(0) + kBounded, y), *power = rows.line(FilterRows::pool(0) + kPower, y);
  const float *noise = rows.line(FilterRows::pool(0) + kNoise, y), *weight = partOf(rows, place, FilterRows::kWeight, y);
  forLevel(rows, place, y, [&](int x, float d, float) {
    power[x] = weight[x] > 0 ? d * d : 0;
    bounded[x] = noise[x] > 0 ? std::min(power[x], kMostOfPixel * noise[x]) : power[x];
  });
}

void keepLevel(FilterRows& rows, int level, int place, int y) {
  const float *bounded = rows.line(FilterRows::pool(0) + kBounded, y), *noise = rows.line(FilterRows::pool(0) + kNoise, y), *power = rows.line(FilterRows::pool(0) + kPower, y);
  const float* weight = partOf(rows, place, FilterRows::kWeight, y);
  const bool outliers = hasOutliers(level);
  const float doubt = (outliers ? kFine : kCoarse) * noisePart(level);
  for (int c = 0; c <= kColours; ++c) {
    const float *fine = partOf(rows, place, c, y), *smooth = partOf(rows, 1 - place, c, y);
    float* kept = rows.line(FilterRows::kKept + c, y);
    for (int x = 0; x < rows.width(); ++x) {
      const float believed = doubt * noise[x];
      if (!(bounded[x] > believed) || !(weight[x] > 0)) continue;
      // As much as stands out, once it is no work of single pixels.
      const float sure = outliers ? std::min(1.0f, bounded[x] / std::max(believed, 1e-30f) - 1) : 1;
      kept[x] += sure * (1 - believed / power[x]) * (fine[x] - smooth[x]);
    }
  }
}

void addKept(FilterRows& rows, int place, int y) {
  for (int c = 0; c <= kColours; ++c) {
    const float* kept = rows.line(FilterRows::kKept + c, y);
    float* light = rows.line(FilterRows::light(0, place) + c, y);
    for (int x = 0; x < rows.width(); ++x) light[x] = c < kColours ? std::max(0.0f, light[x] + kept[x]) : light[x] + kept[x];
  }
}

void takeNoise(FilterRows& rows, int place, int y) {
  const float* noise = partOf(rows, place, kDrawn, y);
  float* square = rows.line(FilterRows::pool(0), y);
  for (int x = 0; x < rows.width(); ++x) square[x] = noise[x] * noise[x];
}

}  // namespace roomlight
