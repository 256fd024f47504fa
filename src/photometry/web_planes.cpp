#include "photometry/web_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomlight::photometric {

namespace {

constexpr double kSameDeg = 1e-3;
constexpr double kFinestDeg = 0.5, kCoarsestDeg = 2.5;  // of resampled webs

double rad(double deg) { return deg * std::numbers::pi / 180; }

struct Plane {
  double c;
  const std::vector<double>* candela;
};

// Each plane with its mirror images, from 0 to below 360 degrees.
std::vector<Plane> mirrored(const Planes& planes, Symmetry symmetry) {
  std::vector<Plane> out;
  const auto put = [&](double c, const std::vector<double>& candela) {
    c -= 360 * std::floor(c / 360);
    out.push_back({c > 360 - kSameDeg ? 0 : c, &candela});
  };
  const bool aboutC0 = symmetry == Symmetry::AboutC0 || symmetry == Symmetry::Quadrants;
  const bool aboutC90 = symmetry == Symmetry::AboutC90 || symmetry == Symmetry::Quadrants;
  for (size_t i = 0; i < planes.angleDeg.size(); ++i) {
    const double c = planes.angleDeg[i];
    put(c, planes.candela[i]);
    if (aboutC0) put(-c, planes.candela[i]);
    if (aboutC90) put(180 - c, planes.candela[i]);
    if (symmetry == Symmetry::Quadrants) put(180 + c, planes.candela[i]);
  }
  std::stable_sort(out.begin(), out.end(), [](const Plane& a, const Plane& b) { return a.c < b.c; });
  return out;
}

void addPlane(PhotometricWeb& web, double c, const std::vector<double>& candela) {
  web.cRad.push_back(static_cast<float>(rad(c)));
  for (const double v : candela) web.candela.push_back(static_cast<float>(v));
}

std::vector<double> between(const Plane& a, const Plane& b, double t) {
  std::vector<double> out;
  for (size_t i = 0; i < a.candela->size(); ++i) out.push_back((*a.candela)[i] * (1 - t) + (*b.candela)[i] * t);
  return out;
}

}  // namespace

void checkAngles(std::vector<double>& angles, size_t line, const std::string& what, double low, double high) {
  constexpr double kSlackDeg = 0.01;
  for (size_t i = 0; i < angles.size(); ++i) {
    if (angles[i] < low - kSlackDeg || angles[i] > high + kSlackDeg)
      damage(line, fmt::format("{} {} is not between {} and {}", what, angles[i], low, high));
    angles[i] = std::clamp(angles[i], low, high);
    if (i > 0 && angles[i] - angles[i - 1] < kSameDeg)
      damage(line, fmt::format("{}s must ascend, but {} follows {}", what, angles[i], angles[i - 1]));
  }
}

void fillWeb(Planes planes, Symmetry symmetry, PhotometricWeb& web, Oddities& odd) {
  web.cRad.clear(), web.gammaRad.clear(), web.candela.clear();
  for (const double g : planes.inPlaneDeg) web.gammaRad.push_back(static_cast<float>(rad(g)));
  if (symmetry == Symmetry::Rotation) {
    addPlane(web, 0, planes.candela[0]);
    addPlane(web, 360, planes.candela[0]);
    return sumUp(web);
  }
  if (!std::is_sorted(planes.angleDeg.begin(), planes.angleDeg.end()))
    odd.add("the planes are not in order of their angles");
  std::vector<Plane> all = mirrored(planes, symmetry);
  // Of planes written twice, as C0 is again as C360, the first counts.
  const auto differ = [](const Plane& a, const Plane& b) { return *a.candela != *b.candela; };
  for (size_t i = 1; i < all.size();) {
    if (all[i].c - all[i - 1].c > kSameDeg) {
      ++i;
      continue;
    }
    if (differ(all[i], all[i - 1]))
      odd.add(fmt::format("plane {} is there twice with different values; the first counts", all[i].c));
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const Plane& first = all.front();
  const Plane& last = all.back();
  double widest = 360 + first.c - last.c;
  for (size_t i = 1; i < all.size(); ++i) widest = std::max(widest, all[i].c - all[i - 1].c);
  if (widest > 180 + kSameDeg) damage(planes.line, fmt::format("the planes leave out {:.4g} degrees", widest));
  std::vector<double> zero = *first.candela;
  if (first.c > kSameDeg) {
    odd.add("there is no plane C0; it is interpolated");
    zero = between(last, first, (360 - last.c) / (360 - last.c + first.c));
    addPlane(web, 0, zero);
  }
  for (const Plane& p : all) addPlane(web, p.c < kSameDeg ? 0 : p.c, *p.candela);
  addPlane(web, 360, zero);
  sumUp(web);
}

void resampleWeb(const Planes& planes, System system, PhotometricWeb& web) {
  double finest = kCoarsestDeg;
  const auto look = [&](const std::vector<double>& angles) {
    for (size_t i = 1; i < angles.size(); ++i) finest = std::min(finest, angles[i] - angles[i - 1]);
  };
  look(planes.angleDeg), look(planes.inPlaneDeg);
  const double step =
      std::max(finest / 4, kFinestDeg);  // kinks at the angles of the file are rounded off by little then
  const auto rows = static_cast<size_t>(std::ceil(180 / step)), columns = 2 * rows;
  const auto interpolated = [](const std::vector<double>& at, double v) {
    const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, v);
    const auto i = static_cast<size_t>(above - at.begin()) - 1;
    return std::pair{i, std::clamp((v - at[i]) / (at[i + 1] - at[i]), 0.0, 1.0)};
  };
  const bool alike = planes.angleDeg.front() >= 0;
  const auto candela = [&](double h, double v) {
    if (alike) h = std::abs(h);
    const double slack = 1e-9;
    if (h < planes.angleDeg.front() - slack || h > planes.angleDeg.back() + slack ||
        v < planes.inPlaneDeg.front() - slack || v > planes.inPlaneDeg.back() + slack)
      return 0.0;
    const auto [i, s] = interpolated(planes.angleDeg, h);
    const auto [k, t] = interpolated(planes.inPlaneDeg, v);
    return (planes.candela[i][k] * (1 - t) + planes.candela[i][k + 1] * t) * (1 - s) +
           (planes.candela[i + 1][k] * (1 - t) + planes.candela[i + 1][k + 1] * t) * s;
  };
  const auto deg = [](double r) { return r * 180 / std::numbers::pi; };
  web.cRad.clear(), web.gammaRad.clear(), web.candela.clear();
  for (size_t g = 0; g <= rows; ++g)
    web.gammaRad.push_back(static_cast<float>(std::numbers::pi * static_cast<double>(g) / static_cast<double>(rows)));
  for (size_t c = 0; c <= columns; ++c) {
    const double phi = 2 * std::numbers::pi * static_cast<double>(c) / static_cast<double>(columns);
    web.cRad.push_back(static_cast<float>(phi));
    for (size_t g = 0; g <= rows; ++g) {
      const double gamma = std::numbers::pi * static_cast<double>(g) / static_cast<double>(rows);
      const double x = std::sin(gamma) * std::cos(phi), y = std::sin(gamma) * std::sin(phi), down = std::cos(gamma);
      const bool b = system == System::B;
      const double v = deg(std::asin(std::clamp(b ? x : -down, -1.0, 1.0)));
      const double h = deg(std::atan2(-y, b ? down : x));
      web.candela.push_back(static_cast<float>(candela(h, v)));
    }
  }
  sumUp(web);
}

namespace {

constexpr double kTolerance = 0.02;

}  // namespace

void checkFlux(const PhotometricWeb& web, const std::string& whose, Oddities& odd) {
  if (!(web.fluxLm > 0)) damage(0, "all intensities are zero; there is no light");
  if (!(web.statedFluxLm > 0)) return;
  const double ratio = web.fluxLm / web.statedFluxLm;
  if (std::abs(ratio - 1) > kTolerance)
    odd.add(fmt::format("the intensities add up to {:.6g} lm, {:.3g} % of the {:.6g} lm stated for {}", web.fluxLm,
                        100 * ratio, web.statedFluxLm, whose));
}

}  // namespace roomlight::photometric
