#include "study/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/settings.h"
#include "report/plot.h"

namespace roomlight {
namespace {

using report::Axis, report::logarithmicAxis, report::Plot;

// Okabe & Ito 2008 and Tol 2021, told apart by people with any colour vision.
constexpr std::array<const char*, 8> kColours = {"#0072b2", "#d55e00", "#e69f00", "#009e73",
                                                 "#cc79a7", "#56b4e9", "#882255", "#999933"};
constexpr double kWidth = 560, kHeight = 300, kLeft = 54, kRight = 12, kTop = 10, kBottom = 34;
constexpr double kLeastError = 1e-9;  // that a logarithmic axis shows

void grid(Plot& plot, const Axis& x, const Axis& y) {
  for (const double v : x.decadeTicks()) {
    plot.line(x.at(v), kTop, x.at(v), kHeight - kBottom, "class='grid'");
    plot.text(x.at(v), kHeight - kBottom + 15, fmt::format("{:g}", v), "text-anchor='middle'");
  }
  for (const double v : y.decadeTicks()) {
    plot.line(kLeft, y.at(v), kWidth - kRight, y.at(v), "class='grid'");
    plot.text(kLeft - 6, y.at(v) + 4, fmt::format("{:g}", v), "text-anchor='end'");
  }
  plot.text(kWidth - kRight, kHeight - 4, "seconds", "text-anchor='end'");
}

// Each point of a curve as a dot, over the line through all; `placeOf`: from seconds and error to the drawing.
void draw(Plot& plot, const StudyCurve& c, const std::string& colour, const auto& placeOf) {
  std::string line;
  for (const StudyPoint& p : c.points) {
    const auto [x, y] = placeOf(p.seconds, errorOf(p));
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x, y);
  }
  const bool isDashed = c.technique.find(',') != std::string::npos;
  plot.path(line, fmt::format("fill='none' stroke='{}' stroke-width='2'{}", colour,
                              isDashed ? " stroke-dasharray='5 3'" : ""));
  for (const StudyPoint& p : c.points) {
    const auto [x, y] = placeOf(p.seconds, errorOf(p));
    const bool isSettled = &p == &settledPoint(c);
    plot.dot(x, y, isSettled ? 5 : 3, fmt::format("fill='{}' stroke='{}'", isSettled ? colour : "#fff", colour),
             fmt::format("{}: {} samples, {:.2f} s, mse beyond noise {:.5f}", c.technique, p.samples, p.seconds,
                         p.mseBeyondNoise));
  }
}

}  // namespace

std::string colourOf(const std::vector<StudyCurve>& curves, size_t i) {
  if (curves[i].kind == "judge") return "#777777";
  size_t n = 0;
  for (size_t k = 0; k < i; ++k) n += curves[k].kind != "judge";
  return kColours[n % kColours.size()];
}

std::string curvesSvg(const StudyCase& one) {
  double leastS = 1e30, mostS = 0, leastE = 1e30, mostE = 0;
  const auto hold = [&](double secondsTaken, double error) {
    leastS = std::min(leastS, std::max(secondsTaken, 1e-3)), mostS = std::max({mostS, secondsTaken, 1e-3});
    leastE = std::min(leastE, std::max(error, kLeastError)), mostE = std::max({mostE, error, kLeastError});
  };
  for (const StudyCurve& c : one.curves) {
    for (const StudyPoint& p : c.points) hold(p.seconds, errorOf(p));
  }
  for (const StudyExternal& e : one.externals) hold(e.seconds, e.mseBeyondNoise);
  if (mostS <= 0) return "<p>nothing measured</p>";
  const Axis x = logarithmicAxis(leastS, mostS, kLeft, kWidth - kRight),
             y = logarithmicAxis(std::max(leastE, mostE * 1e-4), mostE, kHeight - kBottom, kTop);
  const auto placeOf = [&](double secondsTaken, double error) {
    return std::pair{
        x.at(std::max(secondsTaken, 1e-3)),
        std::min(y.at(std::pow(10, std::max(y.low, std::log10(std::max(error, kLeastError))))), kHeight - kBottom)};
  };
  Plot plot(kWidth, kHeight, "Error over time, " + one.scene + ", " + one.light);
  grid(plot, x, y);
  for (size_t i = 0; i < one.curves.size(); ++i) {
    if (!one.curves[i].points.empty()) draw(plot, one.curves[i], colourOf(one.curves, i), placeOf);
  }
  for (const StudyExternal& e : one.externals) {
    const auto [px, py] = placeOf(e.seconds, e.mseBeyondNoise);
    plot.path(fmt::format("M{:.1f} {:.1f}l6 6l-6 6l-6 -6z", px, py - 6), "fill='#111'",
              fmt::format("{}: {:.2f} s, mse beyond noise {:.5f}", e.name, e.seconds, e.mseBeyondNoise));
    plot.text(px + 9, py + 4, e.name);
  }
  return plot.svg();
}

std::string barsSvg(const std::vector<Bar>& bars, const std::string& unit) {
  constexpr double kName = 170, kBar = 300, kRow = 24;
  const auto cone = std::find_if(bars.begin(), bars.end(), [](const Bar& b) {
    return b.name == technique::kCone && b.value > 0 && b.published > 0;
  });
  const double scale = cone == bars.end() ? 0 : cone->value / cone->published;
  double most = 1e-9;
  for (const Bar& b : bars) most = std::max({most, b.value, b.published * scale});
  Plot plot(kWidth, kRow * static_cast<double>(bars.size()) + 4);
  for (size_t i = 0; i < bars.size(); ++i) {
    const Bar& b = bars[i];
    const double y = kRow * static_cast<double>(i) + 3, length = kBar * b.value / most,
                 tick = kBar * b.published * scale / most;
    plot.text(kName - 8, y + 13, b.name, "text-anchor='end'");
    plot.bar(kName, y, std::max(1.0, length), 17, b.colour);
    if (tick > 0)
      plot.line(kName + tick, y - 2, kName + tick, y + 19, "class='published'",
                fmt::format("published, in ratio: {:g}", b.published));
    plot.text(kName + std::max(length, tick) + 6, y + 13, fmt::format("{:.3g} {}", b.value, unit));
  }
  return plot.svg();
}

}  // namespace roomlight
