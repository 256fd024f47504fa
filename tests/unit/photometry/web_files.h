// Photometric files for tests, made from closed forms of intensity.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace roomlight::testing {

using Intensity = std::function<double(double cDeg, double gammaDeg)>;

inline double radians(double deg) { return deg * std::numbers::pi / 180; }

inline std::vector<double> steps(double from, double to, double step) {
  std::vector<double> out;
  for (int i = 0; from + step * i <= to + 1e-9; ++i) out.push_back(from + step * i);
  return out;
}

inline std::string joined(const std::vector<double>& values) {
  std::string out;
  for (const double v : values) out += fmt::format("{:.9g} ", v);
  return out + "\n";
}

// An IES file as it is most often written; every part may be changed before text() is asked for.
struct IesText {
  std::string edition = "IESNA:LM-63-2002\n", keywords = "[TEST] none\n[MANUFAC] Roomlight\n[LUMINAIRE] test\n", tilt = "TILT=NONE\n";
  int type = 1, unit = 2;
  double lumens = -1, multiplier = 1, width = 0, length = 0, height = 0, ballast = 1, ballastLamp = 1;
  std::vector<double> vertical = steps(0, 90, 5), horizontal = {0};
  Intensity candela = [](double, double g) { return 1000 * std::cos(radians(g)); };

  std::string text() const {
    std::string out = edition + keywords + tilt;
    out += fmt::format("1 {} {} {} {} {} {} {} {} {}\n{} {} 12\n", lumens, multiplier, vertical.size(), horizontal.size(), type, unit, width, length, height, ballast, ballastLamp);
    out += joined(vertical) + joined(horizontal);
    for (const double h : horizontal) {
      std::vector<double> row;
      for (const double v : vertical) row.push_back(candela(h, v));
      out += joined(row);
    }
    return out;
  }
};

}  // namespace roomlight::testing
