// Plots of a study as inline SVG.
#pragma once

#include <string>

#include "study/study.h"

namespace roomlight {

// Colour of the i-th technique, the same in every plot: "#rrggbb". The judge's is grey.
std::string colourOf(const std::vector<StudyCurve>& curves, size_t i);

// Error beyond noise over seconds, both logarithmic; the point where each settles is filled.
std::string curvesSvg(const StudyCase& one);

struct Bar {
  std::string name, colour;
  double value = 0, published = 0;  // published: 0: none
};
// Lying bars, the longest over the whole width, each with its number; a tick where the published value stands in ratio
// to that of the bar `cone`, none without that bar.
std::string barsSvg(const std::vector<Bar>& bars, const std::string& unit);

}  // namespace roomlight
