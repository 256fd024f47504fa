#include "study/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/html.h"
#include "engine/settings.h"

namespace roomlight {
namespace {

// Okabe & Ito 2008 and Tol 2021, told apart by people with any colour vision.
constexpr std::array<const char*, 8> kColours = {"#0072b2", "#d55e00", "#e69f00", "#009e73",
                                                 "#cc79a7", "#56b4e9", "#882255", "#999933"};
constexpr double kWidth = 560, kHeight = 300, kLeft = 54, kRight = 12, kTop = 10, kBottom = 34;
constexpr double kLeastError = 1e-9;  // that a logarithmic axis shows

struct Axis {
  double low, high, from, to;  // logarithms of values, and where they are drawn
  double at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
};

Axis axisOf(double least, double most, double from, double to) {
  double low = std::floor(std::log10(least) * 3) / 3, high = std::ceil(std::log10(most) * 3) / 3;
  if (high - low < 0.5) low -= 0.25, high += 0.25;
  return {low, high, from, to};
}

// 1, 2 and 5 times powers of ten within the axis; powers alone where it is long.
std::vector<double> ticks(const Axis& a) {
  std::vector<double> list;
  for (int e = static_cast<int>(std::floor(a.low)); e <= static_cast<int>(std::ceil(a.high)); ++e) {
    for (const double m : {1.0, 2.0, 5.0}) {
      const double v = m * std::pow(10, e);
      if (m > 1 && a.high - a.low > 2.5) continue;
      if (std::log10(v) >= a.low - 1e-9 && std::log10(v) <= a.high + 1e-9) list.push_back(v);
    }
  }
  return list;
}

std::string grid(const Axis& x, const Axis& y) {
  std::string s;
  for (const double v : ticks(x)) {
    s += fmt::format(
        "<line class='grid' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/><text x='{0:.1f}' y='{3}' "
        "text-anchor='middle'>{4:g}</text>",
        x.at(v), kTop, kHeight - kBottom, kHeight - kBottom + 15, v);
  }
  for (const double v : ticks(y)) {
    s += fmt::format(
        "<line class='grid' x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}'/><text x='{3}' y='{4:.1f}' "
        "text-anchor='end'>{5:g}</text>",
        kLeft, kWidth - kRight, y.at(v), kLeft - 6, y.at(v) + 4, v);
  }
  return s + fmt::format("<text x='{}' y='{}' text-anchor='end'>seconds</text>", kWidth - kRight, kHeight - 4);
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
  for (const StudyCurve& c : one.curves) {
    for (const StudyPoint& p : c.points) {
      const double s = std::max(p.seconds, 1e-3);
      leastS = std::min(leastS, s), mostS = std::max(mostS, s), leastE = std::min(leastE, errorOf(p)),
      mostE = std::max(mostE, errorOf(p));
    }
  }
  for (const StudyExternal& e : one.externals) {
    leastS = std::min(leastS, std::max(e.seconds, 1e-3)), mostS = std::max(mostS, e.seconds);
    leastE = std::min(leastE, std::max(e.mseBeyondNoise, kLeastError)), mostE = std::max(mostE, e.mseBeyondNoise);
  }
  if (mostS <= 0) return "<p>nothing measured</p>";
  const Axis x = axisOf(leastS, mostS, kLeft, kWidth - kRight),
             y = axisOf(std::max(leastE, mostE * 1e-4), mostE, kHeight - kBottom, kTop);
  const auto placeOf = [&](double secondsTaken, double error) {
    return std::pair{
        x.at(std::max(secondsTaken, 1e-3)),
        std::min(y.at(std::pow(10, std::max(y.low, std::log10(std::max(error, kLeastError))))), kHeight - kBottom)};
  };
  std::string s = fmt::format("<svg viewBox='0 0 {} {}' role='img' aria-label='Error over time, {}'>", kWidth, kHeight,
                              htmlEscaped(one.scene + ", " + one.light)) +
                  grid(x, y);
  for (size_t i = 0; i < one.curves.size(); ++i) {
    const StudyCurve& c = one.curves[i];
    if (c.points.empty()) continue;
    const std::string colour = colourOf(one.curves, i);
    std::string path, dots;
    const StudyPoint& settled = settledPoint(c);
    for (const StudyPoint& p : c.points) {
      const auto [px, py] = placeOf(p.seconds, errorOf(p));
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
      dots += fmt::format(
          "<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}' stroke='{}'><title>{}: {} samples, {:.2f} s, mse beyond "
          "noise {:.5f}</title></circle>",
          px, py, &p == &settled ? 5 : 3, &p == &settled ? colour : "#fff", colour, htmlEscaped(c.technique), p.samples,
          p.seconds, p.mseBeyondNoise);
    }
    const bool dashed = c.technique.find(',') != std::string::npos;
    s += fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='2'{}/>", path, colour,
                     dashed ? " stroke-dasharray='5 3'" : "") +
         dots;
  }
  for (const StudyExternal& e : one.externals) {
    const auto [px, py] = placeOf(e.seconds, e.mseBeyondNoise);
    s += fmt::format(
        "<path d='M{0:.1f} {1:.1f}l6 6l-6 6l-6 -6z' fill='#111'><title>{2}: {3:.2f} s, mse beyond noise "
        "{4:.5f}</title></path><text x='{5:.1f}' y='{6:.1f}'>{2}</text>",
        px, py - 6, htmlEscaped(e.name), e.seconds, e.mseBeyondNoise, px + 9, py + 4);
  }
  return s + "</svg>";
}

std::string barsSvg(const std::vector<Bar>& bars, const std::string& unit) {
  constexpr double kName = 170, kBar = 300, kRow = 24;
  const auto cone = std::find_if(bars.begin(), bars.end(), [](const Bar& b) {
    return b.name == technique::kCone && b.value > 0 && b.published > 0;
  });
  const double scale = cone == bars.end() ? 0 : cone->value / cone->published;
  double most = 1e-9;
  for (const Bar& b : bars) most = std::max({most, b.value, b.published * scale});
  std::string s =
      fmt::format("<svg viewBox='0 0 {} {}' role='img'>", kWidth, kRow * static_cast<double>(bars.size()) + 4);
  for (size_t i = 0; i < bars.size(); ++i) {
    const Bar& b = bars[i];
    const double y = kRow * static_cast<double>(i) + 3, length = kBar * b.value / most;
    s += fmt::format(
        "<text x='{}' y='{:.1f}' text-anchor='end'>{}</text><rect x='{}' y='{:.1f}' width='{:.1f}' height='17' "
        "fill='{}'/>",
        kName - 8, y + 13, htmlEscaped(b.name), kName, y, std::max(1.0, length), b.colour);
    const double end = std::max(length, b.published * scale / most * kBar);
    if (b.published > 0 && scale > 0)
      s += fmt::format(
          "<line class='published' x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}'><title>published, in ratio: "
          "{3:g}</title></line>",
          kName + b.published * scale / most * kBar, y - 2, y + 19, b.published);
    s += fmt::format("<text x='{:.1f}' y='{:.1f}'>{:.3g} {}</text>", kName + end + 6, y + 13, b.value, unit);
  }
  return s + "</svg>";
}

}  // namespace roomlight
