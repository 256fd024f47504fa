#include "report/plot.h"

#include <fmt/format.h>

#include <cmath>

#include "report/page.h"

namespace roomlight::report {

double Axis::at(double value) const {
  return from + ((isLogarithmic ? std::log10(value) : value) - low) / (high - low) * (to - from);
}

std::vector<double> Axis::decadeTicks() const {
  std::vector<double> list;
  for (int e = static_cast<int>(std::floor(low)); e <= static_cast<int>(std::ceil(high)); ++e) {
    for (const double m : {1.0, 2.0, 5.0}) {
      const double v = m * std::pow(10, e);
      if (m > 1 && high - low > 2.5) continue;
      if (std::log10(v) >= low - 1e-9 && std::log10(v) <= high + 1e-9) list.push_back(v);
    }
  }
  return list;
}

Axis logarithmicAxis(double least, double most, double from, double to) {
  double low = std::floor(std::log10(least) * 3) / 3, high = std::ceil(std::log10(most) * 3) / 3;
  if (high - low < 0.5) low -= 0.25, high += 0.25;
  return {low, high, from, to, true};
}

Plot::Plot(double width, double height, const std::string& label)
    : svg_(fmt::format("<svg viewBox='0 0 {} {}' role='img'{}>", width, height, attribute("aria-label", label))) {}

void Plot::add(const std::string& element, const std::string& look, const std::string& title) {
  svg_ += fmt::format("<{}{}{}", element, look.empty() ? "" : " ", look);
  svg_ += title.empty() ? "/>"
                        : fmt::format("><title>{}</title></{}>", escaped(title), element.substr(0, element.find(' ')));
}

void Plot::line(double x1, double y1, double x2, double y2, const std::string& look, const std::string& title) {
  add(fmt::format("line {} x1='{:.1f}' x2='{:.1f}' y1='{:.1f}' y2='{:.1f}'", look, x1, x2, y1, y2), {}, title);
}

void Plot::bar(double x, double y, double width, double height, const std::string& fill) {
  add(fmt::format("rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:g}' fill='{}'", x, y, width, height, fill), {},
      {});
}

void Plot::dot(double x, double y, double radius, const std::string& look, const std::string& title) {
  add(fmt::format("circle cx='{:.1f}' cy='{:.1f}' r='{:g}'", x, y, radius), look, title);
}

void Plot::path(const std::string& d, const std::string& look, const std::string& title) {
  add("path d='" + d + "'", look, title);
}

void Plot::text(double x, double y, const std::string& words, const std::string& look) {
  svg_ += fmt::format("<text x='{:.1f}' y='{:.1f}'{}{}>{}</text>", x, y, look.empty() ? "" : " ", look, escaped(words));
}

}  // namespace roomlight::report
