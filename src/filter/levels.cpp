#include "filter/levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "base/vec.h"

namespace roomlight {
namespace {

constexpr int kFinestLevels = 2;
constexpr size_t kBounded = 0, kNoise = 1, kPower = 2, kCross = 3, kOpen2 = 4,
                 kWeights = 5;  // what is pooled, each times the weight of its pixel
constexpr int kColours = 3, kDrawn = 3;  // parts of diffuse light: its colour, then its drawn noise
constexpr float kFine = 1.75f, kCoarse = 1.1f;  // times the noise that a level is believed to hold: in single pixels it
                                                // is seen at once, and told by fewer of them
constexpr float kExplained = 0.1f;  // times that noise as well: what openness tells of a level is pooled from many
                                    // pixels and holds little of theirs
constexpr float kOwnPart = 0.03f;  // of what is pooled around a pixel is its own
constexpr float kLeastOpen2 = 8e-4f;  // what openness differs by more is believed to tell something
constexpr float kDoubtfulSamples = 16;  // so many tell as much of a place's noise as what is around does
constexpr float kMostUnlike = 8;  // times as much noise as those around, or as little, a pixel is believed to have
constexpr float kMostOfPixel = 6;  // times the noise around: more is an outlier
// Of the noise that independent pixels would leave in each level, as variance. Pixels of a block share one
// well-distributed sequence (gather/pixel_shader), so the wider a level the less there is. Measured on walls of the
// sample homes, eight seeds.
constexpr float kOfIndependent[] = {1, 0.9f, 0.85f, 0.75f, 0.65f, 0.4f};

const float* partOf(const FilterRows& rows, int place, int part, int y) {
  return rows.line(FilterRows::light(0, place) + part, y);
}

float noisePart(int level) { return kOfIndependent[std::min(level, static_cast<int>(std::size(kOfIndependent)) - 1)]; }

using Pooled = std::array<float*, FilterRows::kPooled>;
Pooled pooledOf(FilterRows& rows, int y) {
  Pooled out;
  for (int q = 0; q < FilterRows::kPooled; ++q) out[static_cast<size_t>(q)] = rows.line(FilterRows::pool(0) + q, y);
  return out;
}

// Calls body(x, d, n, a) with what a level adds to the smoother one, in luminance, in drawn noise and in openness.
template <class Body>
void forLevel(const FilterRows& rows, int place, int y, Body&& body) {
  const float *fine[kColours + 1], *smooth[kColours + 1];
  for (int c = 0; c <= kColours; ++c) fine[c] = partOf(rows, place, c, y), smooth[c] = partOf(rows, 1 - place, c, y);
  const float *open = rows.line(FilterRows::open(place), y), *smoothOpen = rows.line(FilterRows::open(1 - place), y);
  for (int x = 0; x < rows.width(); ++x) {
    const float d = 0.2126f * (fine[0][x] - smooth[0][x]) + 0.7152f * (fine[1][x] - smooth[1][x]) +
                    0.0722f * (fine[2][x] - smooth[2][x]);
    body(x, d, fine[kDrawn][x] - smooth[kDrawn][x], open[x] - smoothOpen[x]);
  }
}

}  // namespace

bool hasOutliers(int level) { return level <= kFinestLevels; }

float drawnNoise(float variance, size_t pixel) {
  return mix64(pixel + 0x9e3779b97f4a7c15ull) & 1 ? std::sqrt(variance) : -std::sqrt(variance);
}

void takePower(FilterRows& rows, int place, int y) {
  const Pooled pooled = pooledOf(rows, y);
  const float* weight = partOf(rows, place, FilterRows::kWeight, y);
  forLevel(rows, place, y, [&](int x, float d, float n, float a) {
    const float w = weight[x];
    pooled[kBounded][x] = pooled[kPower][x] = w * d * d, pooled[kNoise][x] = w * n * n;
    pooled[kCross][x] = w * d * a, pooled[kOpen2][x] = w * a * a, pooled[kWeights][x] = w;
  });
}

void boundPower(FilterRows& rows, int place, int y) {
  const Pooled pooled = pooledOf(rows, y);
  const float *weight = partOf(rows, place, FilterRows::kWeight, y),
              *beside = rows.line(FilterRows::pool(1) + static_cast<int>(kNoise), y);
  float* trust = rows.line(FilterRows::kTrust, y);
  forLevel(rows, place, y, [&](int x, float d, float, float a) {
    // A shadow has less noise than the light around it, the more samples the surer: there its weight is larger. The
    // noise pooled so far stands for that weight times the place's own; draws that chose their weight would tell less.
    const float around = std::max(pooled[kNoise][x], 1e-30f), samples = weight[x],
                unlike = (kDoubtfulSamples + samples * beside[x] / around) / (kDoubtfulSamples + samples);
    const float w = trust[x] = samples / unlike, power = w * d * d, most = kMostOfPixel * pooled[kNoise][x];
    const bool outlier = most > 0 && power > most;
    pooled[kPower][x] = power, pooled[kBounded][x] = outlier ? most : power;
    pooled[kCross][x] = a * (outlier ? std::copysign(std::sqrt(w * most), d) : w * d);
    pooled[kOpen2][x] = w * a * a, pooled[kWeights][x] = w;
  });
}

void keepLevel(FilterRows& rows, int level, int place, int y) {
  const Pooled pooled = pooledOf(rows, y);
  const bool outliers = hasOutliers(level);
  const float* weight = outliers ? rows.line(FilterRows::kTrust, y) : partOf(rows, place, FilterRows::kWeight, y);
  const float ofIndependent = noisePart(level), doubt = (outliers ? kFine : kCoarse) * ofIndependent;
  const float *fine[kColours + 1], *smooth[kColours + 1];
  float* kept[kColours + 1];
  for (int c = 0; c <= kColours; ++c)
    fine[c] = partOf(rows, place, c, y), smooth[c] = partOf(rows, 1 - place, c, y),
    kept[c] = rows.line(FilterRows::kKept + c, y);
  const float *open = rows.line(FilterRows::open(place), y), *smoothOpen = rows.line(FilterRows::open(1 - place), y);
  for (int x = 0; x < rows.width(); ++x) {
    if (!(weight[x] > 0)) continue;
    // What openness tells of it, by how light follows it on other pixels around: by its own, a lone pixel would explain
    // itself.
    const float w = weight[x], noise = pooled[kNoise][x], most = std::sqrt(kMostOfPixel * noise / w),
                a = open[x] - smoothOpen[x];
    const float d = luminance(Vec3{fine[0][x] - smooth[0][x], fine[1][x] - smooth[1][x], fine[2][x] - smooth[2][x]}),
                bound = outliers && most > 0 ? std::clamp(d, -most, most) : d;
    const float cross = pooled[kCross][x] - kOwnPart * w * a * bound,
                open2 = std::max(0.0f, pooled[kOpen2][x] - kOwnPart * w * a * a) + kLeastOpen2 * pooled[kWeights][x];
    const float explained = cross * cross / open2, doubted = kExplained * ofIndependent * noise;
    const float told = explained > doubted ? (1 - doubted / explained) * cross / open2 * a : 0;
    const float around = luminance(Vec3{smooth[0][x], smooth[1][x], smooth[2][x]}),
                ratio = around > 0 ? told / around : 0;
    const float believed = doubt * noise;
    // As much as stands out, once it is no work of single pixels.
    const float bounded = pooled[kBounded][x],
                sure = outliers ? std::min(1.0f, bounded / std::max(believed, 1e-30f) - 1) : 1;
    const float signal = pooled[kPower][x] - believed,
                own =
                    outliers ? believed * std::clamp(pooled[kWeights][x] / w, 1 / kMostUnlike, kMostUnlike) : believed;
    const float gain = bounded > believed ? sure * signal / (signal + own) : 0;
    for (int c = 0; c <= kColours; ++c) {
      const float part = c < kColours ? ratio * smooth[c][x] : 0;
      kept[c][x] += part + gain * (fine[c][x] - smooth[c][x] - part);
    }
  }
}

void addKept(FilterRows& rows, int place, int y) {
  for (int c = 0; c <= kColours; ++c) {
    const float* kept = rows.line(FilterRows::kKept + c, y);
    float* light = rows.line(FilterRows::light(0, place) + c, y);
    for (int x = 0; x < rows.width(); ++x)
      light[x] = c < kColours ? std::max(0.0f, light[x] + kept[x]) : light[x] + kept[x];
  }
}

void takeNoise(FilterRows& rows, int place, int y) {
  const float* noise = partOf(rows, place, kDrawn, y);
  float* square = rows.line(FilterRows::pool(0), y);
  for (int x = 0; x < rows.width(); ++x) square[x] = noise[x] * noise[x];
}

}  // namespace roomlight
