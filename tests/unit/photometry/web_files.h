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
  std::string edition = "IESNA:LM-63-2002\n", keywords = "[TEST] none\n[MANUFAC] Roomlight\n[LUMINAIRE] test\n",
              tilt = "TILT=NONE\n";
  int type = 1, unit = 2;
  double lumens = -1, multiplier = 1, width = 0, length = 0, height = 0, ballast = 1, ballastLamp = 1;
  std::vector<double> vertical = steps(0, 90, 5), horizontal = {0};
  Intensity candela = [](double, double g) { return 1000 * std::cos(radians(g)); };

  std::string text() const {
    std::string out = edition + keywords + tilt;
    out += fmt::format("1 {} {} {} {} {} {} {} {} {}\n{} {} 12\n", lumens, multiplier, vertical.size(),
                       horizontal.size(), type, unit, width, length, height, ballast, ballastLamp);
    out += joined(vertical) + joined(horizontal);
    for (const double h : horizontal) {
      std::vector<double> row;
      for (const double v : vertical) row.push_back(candela(h, v));
      out += joined(row);
    }
    return out;
  }
};

// An EULUMDAT file; `planes` is the whole circle, of which only what the symmetry leaves is written.
struct LdtText {
  int symmetry = 1;
  std::string name = "test", lamps = "1";
  double lumens = 1000, ratioPercent = 100, factor = 1, lengthMm = 0, widthMm = 0;
  std::vector<double> planes = steps(0, 345, 15), gammas = steps(0, 90, 5);
  Intensity candelaPerKlm = [](double, double g) { return 1000 / std::numbers::pi * std::cos(radians(g)); };

  std::string text() const {
    std::string out =
        fmt::format("Roomlight\r\n1\r\n{}\r\n{}\r\n15\r\n{}\r\n5\r\nreport\r\n{}\r\n7\r\ntest.ldt\r\ntoday\r\n",
                    symmetry, planes.size(), gammas.size(), name);
    out += fmt::format("1300\r\n200\r\n90\r\n{}\r\n{}\r\n0\r\n0\r\n0\r\n0\r\n100\r\n{}\r\n{}\r\n0\r\n1\r\n", lengthMm,
                       widthMm, ratioPercent, factor);
    out += fmt::format("{}\r\nLED\r\n{}\r\n3000 K\r\n80\r\n11\r\n", lamps, lumens);
    const auto lines = [&](const std::vector<double>& values) {
      for (const double v : values) out += fmt::format("{:.9g}\r\n", v);
    };
    lines(std::vector<double>(10, 0.5)), lines(planes), lines(gammas);
    const size_t n = planes.size();
    const size_t written = symmetry == 0 ? n : symmetry == 1 ? 1 : symmetry == 4 ? n / 4 + 1 : n / 2 + 1;
    for (size_t k = 0; k < written; ++k) {
      for (const double g : gammas) lines({candelaPerKlm(planes[(k + (symmetry == 3 ? 3 * n / 4 : 0)) % n], g)});
    }
    return out;
  }
};

}  // namespace roomlight::testing
