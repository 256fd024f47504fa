// The inner loops of the filter, for as many pixels at once as the machine's vectors hold (Highway, chosen at run
 // time).
#pragma once

#include <cstddef>

#include "base/platform/large_memory.h"

namespace roomlight {

constexpr int kFilterLights = 4;  // diffuse, sharp, specular, rare

// What the filter knows of a picture: rows of pixels, of each row one line of floats a quantity.
class FilterRows {
 public:
  // Quantities. kSeen is the luminance by which pixels are compared. Each light has two places for its colour, variance
  // and weight: a pass reads one and writes the other.
  static constexpr int kNormal = 0, kPosition = 3, kRoughness = 6, kNoise = 7, kSeen = kNoise + kFilterLights,
                       kLight = kSeen + kFilterLights, kVariance = 3, kWeight = 4, kParts = 5;
  // kReflected: normal and place of what is seen in panes, else those of the pixel.
  // Of diffuse light by levels (levels.h): what of them is kept so far, its noise, and what is pooled, in two places;
  // kTrust: weights by the noise of each place.
  static constexpr int kKept = kLight + kFilterLights * 2 * kParts, kKeptNoise = kKept + 3, kPool = kKeptNoise + 1,
                       kPooled = 6, kOpen = kPool + 2 * kPooled, kReflected = kOpen + 2, kTrust = kReflected + 6,
                       kCount = kTrust + 1;
  static constexpr int light(int k, int place) { return kLight + (2 * k + place) * kParts; }
  static constexpr int open(int place) { return kOpen + place; }
  static constexpr int pool(int place) { return kPool + kPooled * place; }

  FilterRows(int w, int h, int margin);
  int width() const { return width_; }
  int height() const { return height_; }
  // Distance between lines, and between the same lines of two rows.
  ptrdiff_t pitch() const { return pitch_; }
  ptrdiff_t rowPitch() const { return pitch_ * kCount; }
  // Pixel 0 of a row. Before it and after the last lie margins as wide as the constructor was told, of zeros once
  // cleared (normals without length, which face nothing) but for weights, which are 1.
  float* line(int quantity, int y) { return begin_ + (static_cast<ptrdiff_t>(y) * kCount + quantity) * pitch_; }
  const float* line(int quantity, int y) const {
    return begin_ + (static_cast<ptrdiff_t>(y) * kCount + quantity) * pitch_;
  }
  void clearMargins(int y);
  // Rows that are used from now on, no more than the constructor was told.
  void useRows(int h) { height_ = h; }

 private:
  int width_, height_;
  ptrdiff_t margin_, pitch_;
  LargeFloats floats_;
  float* begin_;
};

struct FilterPass {
  int step = 1;  // pixels between neighbours
  float correlated = 1;  // times the noise that passes before made of independent pixels
  int place[kFilterLights] = {};  // where each light is read
  bool filter[kFilterLights] = {};  // and whether it is filtered
  bool levels = false;  // diffuse light by surfaces alone; kVariance holds one draw of its noise then
};

// Pixels whose surface hardly any pixel near them shows keep their light for themselves: far ones that lie on what its
// plane could be on are other things, and a bright one would leave copies of itself all over the picture. findCompany()
// of all rows first, then leaveLonely(), before any pass.
constexpr int kCompanyReach = 2;  // pixels
void findCompany(FilterRows& rows, int y);
void leaveLonely(FilterRows& rows, int y);
// Makes row y ready to be compared with others. Noise: means of a light's variance over 3 x 3 pixels, for the variance
// of single pixels is itself noise. What is seen of diffuse light: means over the 3 x 3 pixels as far as they lie on
// one surface, because single pixels that differ by noise would keep their difference (as patches are compared by
// Rousselle et al. 2012). Pixels of weight 0 tell nothing of either.
void prepareRow(FilterRows& rows, const FilterPass& pass, int y);
// Filters row y, by its neighbours `step` rows and pixels away.
void filterRow(FilterRows& rows, const FilterPass& pass, int y);
// Means of what is pooled over such neighbours that lie on one surface, from `place` to the other.
void poolRow(FilterRows& rows, int step, int place, int y);

}  // namespace roomlight
