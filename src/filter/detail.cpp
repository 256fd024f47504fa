#include "filter/detail.h"

#include <algorithm>

namespace roomlight {

std::vector<int> poolSteps() { return {2, 6}; }

void keepNarrow(FilterRows& rows, const FilterPass& pass, int y) {
  const int light = FilterRows::light(0, pass.place[0]);
  for (int c = 0; c < 3; ++c) std::copy_n(rows.line(light + c, y), rows.width(), rows.line(FilterRows::kNarrow + c, y));
}

void takeDetail(FilterRows& rows, const FilterPass& pass, int y) {
  const int light = FilterRows::light(0, pass.place[0]);
  for (int c = 0; c < 3; ++c) {
    const float *narrow = rows.line(FilterRows::kNarrow + c, y), *wide = rows.line(light + c, y);
    float* out = rows.line(FilterRows::pool(0) + c, y);
    for (int x = 0; x < rows.width(); ++x) out[x] = narrow[x] - wide[x];
  }
}

void addMeanDetail(FilterRows& rows, const FilterPass& pass, int place, int y) {
  const int light = FilterRows::light(0, pass.place[0]);
  for (int c = 0; c < 3; ++c) {
    const float* mean = rows.line(FilterRows::pool(place) + c, y);
    float* wide = rows.line(light + c, y);
    for (int x = 0; x < rows.width(); ++x) wide[x] = std::max(0.0f, wide[x] + mean[x]);
  }
}

}  // namespace roomlight
