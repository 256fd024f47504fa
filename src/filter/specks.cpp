#include "filter/specks.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/vec.h"
#include "filter/filter.h"

namespace roomlight {
namespace {

constexpr float kOneSurface = 0.985f;  // cosine between normals, at least
constexpr float kPlaneTolerance = 0.004f, kSlope = 0.2f;  // metres off the plane, and of the distance along it
constexpr float kOfThings = 2;  // times as bright as all around: no noise, but a thing of one pixel
constexpr int kFewest = 6;  // neighbours on one surface: as many as beside a straight edge and one more; what lies
                            // outside of the picture counts as such

// Lines of one row.
class RowLines {
 public:
  RowLines(FilterRows& rows, int y) : at_(rows.line(0, y)), pitch_(rows.pitch()) {}
  Vec3 at(int quantity, int x) const {
    const float* p = at_ + quantity * pitch_ + x;
    return {p[0], p[pitch_], p[2 * pitch_]};
  }
  void put(int quantity, int x, Vec3 v) const {
    float* p = at_ + quantity * pitch_ + x;
    p[0] = v.x, p[pitch_] = v.y, p[2 * pitch_] = v.z;
  }
  float roughness(int x) const { return at_[FilterRows::kRoughness * pitch_ + x]; }

 private:
  float* at_;
  ptrdiff_t pitch_;
};

bool areOneSurface(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition) {
  if (dot(normal, otherNormal) < kOneSurface) return false;
  const Vec3 between = otherPosition - position;
  const float off = std::abs(dot(normal, between));
  return off <= kPlaneTolerance ||
         (off - kPlaneTolerance) * (off - kPlaneTolerance) <= kSlope * kSlope * dot(between, between);
}

struct Range {
  Vec3 least{INFINITY, INFINITY, INFINITY}, most{-INFINITY, -INFINITY, -INFINITY};
  void add(Vec3 v) { least = min(least, v), most = max(most, v); }
};

}  // namespace

void boundSpecks(FilterRows& rows, const FilterPass& pass, int y) {
  const int top = std::max(0, y - 1), bottom = std::min(rows.height() - 1, y + 1);
  const RowLines own(rows, y);
  for (int x = 0; x < rows.width(); ++x) {
    const Vec3 normal = own.at(FilterRows::kNormal, x), position = own.at(FilterRows::kPosition, x);
    Range ranges[kFilterLights];
    int beside = 0, present = 0;
    for (int j = top; j <= bottom; ++j) {
      const RowLines row(rows, j);
      for (int i = std::max(0, x - 1); i <= std::min(rows.width() - 1, x + 1); ++i) {
        if (i == x && j == y) continue;
        ++present;
        if (!areOneSurface(normal, position, row.at(FilterRows::kNormal, i), row.at(FilterRows::kPosition, i)))
          continue;
        ++beside;
        for (int k = 0; k < kFilterLights; ++k) {
          if (hasSpecks(k)) ranges[k].add(row.at(FilterRows::light(k, pass.place[k]), i));
        }
      }
    }
    for (int k = 0; k < kFilterLights; ++k) {
      if (!hasSpecks(k)) continue;
      Vec3 light = own.at(FilterRows::light(k, pass.place[k]), x);
      if (beside > 0 && beside + 8 - present >= kFewest && (k != 2 || own.roughness(x) >= kMirrorRoughness))
        light = max(ranges[k].least, min(ranges[k].most, light));
      own.put(FilterRows::light(k, 1 - pass.place[k]), x, light);
    }
  }
}

void boundEdges(const FilterInput& means, Image& image) {
  const int w = means.width, h = means.height;
  Image bounded = image;
  parallelFor(static_cast<size_t>(h), 4, [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < w; ++x) {
      const size_t i = row * static_cast<size_t>(w) + static_cast<size_t>(x);
      const FilterPixel& own = means.pixels[i];
      Range range;
      int beside = 0, present = 0;
      for (int j = std::max(0, y - 1); j <= std::min(h - 1, y + 1); ++j) {
        for (int k = x - 1; k <= x + 1; ++k) {
          const int column = means.wraps ? (k + w) % w : k;
          if (column < 0 || column >= w || (j == y && column == x)) continue;
          const size_t other = static_cast<size_t>(j) * static_cast<size_t>(w) + static_cast<size_t>(column);
          const FilterPixel& o = means.pixels[other];
          ++present;
          beside += areOneSurface(own.normal, own.position, o.normal, o.position);
          range.add(image.pixels[other]);
        }
      }
      if (present == 0 || beside + 8 - present >= kFewest) continue;
      const bool isLamp = 2 * luminance(own.rest) > luminance(image.pixels[i]);
      const Vec3 bound = max(range.least, min(range.most, image.pixels[i]));
      const bool isThing = luminance(image.pixels[i]) > kOfThings * luminance(bound);
      if (!isLamp && !isThing) bounded.pixels[i] = bound;
    }
  });
  image = std::move(bounded);
}

}  // namespace roomlight
