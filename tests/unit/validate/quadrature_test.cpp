// The judge of the judge: quadrature against closed forms and published figures.
#include "validate/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validate/cases.h"

namespace roomlight {
namespace {

using std::numbers::pi;
using namespace quadrature;

constexpr Rectangle kUnit{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
double even(Point, Point) { return 1; }

TEST(Quadrature, aRectangleOnItsAxisIsTheClosedForm) {
  EXPECT_NEAR(illuminance({{0.5, -1, 0.5}, {0, 1, 0}}, kUnit, even), 4 * std::atan(1 / std::sqrt(5)) / std::sqrt(5),
              1e-12);
}

// Corner-aligned, parallel: F = (1/2π)[X/√(1+X²) atan(Y/√(1+X²)) + Y/√(1+Y²) atan(X/√(1+Y²))].
TEST(Quadrature, bothWaysAgreeWithTheFormulasOfRectangles) {
  const double c = 0.7, x = 1 / c, y = x, rx = std::sqrt(1 + x * x);
  const double parallel = (x / rx * std::atan(y / rx) * 2) / (2 * pi);
  EXPECT_NEAR(configurationFactor({{0, -c, 0}, {0, 1, 0}}, kUnit), parallel, 1e-12);
  EXPECT_NEAR(illuminance({{0, -c, 0}, {0, 1, 0}}, kUnit, even) / pi, parallel, 1e-9);
  // Perpendicular, distance a from the plane, width b, depth c: F = (1/2π)[atan(b/a) - a/√(a²+c²) atan(b/√(a²+c²))].
  const double a = 0.4, r = std::sqrt(a * a + 1),
               perpendicular = (std::atan(1 / a) - a / r * std::atan(1 / r)) / (2 * pi);
  EXPECT_NEAR(configurationFactor({{0, 0, -a}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), perpendicular, 1e-12);
}

TEST(Quadrature, whatSinksBelowTheHorizonIsCutOff) {
  const Element tilted{{0.5, -0.5, 0.5}, {1, 0, 0}};
  EXPECT_NEAR(configurationFactor(tilted, kUnit), illuminance(tilted, {{0.5, 0, 0}, {0.5, 0, 0}, {0, 0, 1}}, even) / pi,
              1e-9);
}

TEST(Quadrature, integralsOfPolynomialsAreExact) {
  EXPECT_NEAR(integral([](double x) { return x * x * x; }, 0, 2, 1), 4, 1e-12);
  EXPECT_NEAR(integral([](double x) { return std::sin(x); }, 0, pi), 2, 1e-12);
}

// Mean of the configuration factor over a unit face.
double formFactor(const Rectangle& to) {
  constexpr int n = 64;
  double sum = 0;
  for (int k = 0; k < n * n; ++k)
    sum += configurationFactor({{(k % n + 0.5) / n, 0, (k / n + 0.5) / n}, {0, 1, 0}}, to) / (n * n);
  return sum;
}

// Form factors of the unit cube, and its radiosity with one patch a face.
TEST(Quadrature, formFactorsOfTheCubeAreThePublishedOnes) {
  const double opposite = formFactor({{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}),
               adjacent = formFactor({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR(opposite, 0.199825, 1e-5);
  EXPECT_NEAR(adjacent, 0.200044, 1e-4);
  double floor = 1, ceiling = 0, wall = 0;
  for (int k = 0; k < 100; ++k) {
    const double f = 1 + 0.5 * (opposite * ceiling + 4 * adjacent * wall),
                 c = 0.5 * (opposite * floor + 4 * adjacent * wall),
                 w = 0.5 * (adjacent * (floor + ceiling + 2 * wall) + opposite * wall);
    floor = f, ceiling = c, wall = w;
  }
  EXPECT_NEAR(floor, 1.090909, 1e-4);
  EXPECT_NEAR(ceiling, 0.181746, 1e-4);
  EXPECT_NEAR(wall, 0.181836, 1e-4);
}

TEST(Quadrature, radiositySettlesWithFinerPatches) {
  const std::vector<Element> elements = {
      {{0.5, 0, 0.5}, {0, 1, 0}}, {{0.5, 1, 0.5}, {0, -1, 0}}, {{0, 0.5, 0.5}, {1, 0, 0}}, {{0.1, 1, 0.1}, {0, -1, 0}}};
  const std::vector<double> coarse = illuminance(unitCube(0.5, 1), elements, 6),
                            fine = illuminance(unitCube(0.5, 1), elements, 12);
  for (size_t i = 0; i < elements.size(); ++i) EXPECT_NEAR(coarse[i], fine[i], 0.005 * fine[i]) << i;
}

// A furnace: E = exitance / (1 - albedo) from all sides.
TEST(Quadrature, radiosityOfAFurnaceIsTheClosedForm) {
  std::vector<Radiosity> box = unitCube(0.5, 100);
  for (Radiosity& r : box) r.exitance = 100;
  EXPECT_NEAR(illuminance(box, {{{0.3, 0, 0.2}, {0, 1, 0}}}, 4)[0], 200, 1e-6);
}

// What is known of the set-ups from elsewhere, to the digits it is known with.
void expectOf(const ValidationCase& of, size_t first, const std::vector<double>& known, double digit) {
  for (size_t i = 0; i < known.size(); ++i)
    EXPECT_NEAR(of.quantities[first + i].expected, known[i], 0.6 * digit)
        << of.name << ", " << of.quantities[first + i].place;
}

ValidationCase find(const std::string& name) {
  for (const auto* group : {&closedFormCases(), &lampCases(), &daylightCases()}) {
    for (const MakeCase make : *group) {
      if (ValidationCase c = make(); c.name == name) return c;
    }
  }
  ADD_FAILURE() << name;
  return {};
}

TEST(ValidationCases, expectWhatIsPublished) {
  expectOf(find("CIE 171, 5.2 Lambertian"), 0, {111.11, 105.21, 90.02, 71.11, 74.36, 49.39}, 0.05);
  expectOf(find("CIE 171, 5.3"), 0, {32.68, 75.09, 81.38, 69.12, 53.41, 39.90}, 0.2);
  expectOf(find("CIE 171, 5.6 wall"), 0, {35.90, 27.99, 21.64, 16.72, 12.97}, 0.01);
  expectOf(find("CIE 171, 5.6 ceiling"), 0, {26.80, 30.94, 33.98, 35.57}, 0.01);
  expectOf(find("CIE 171, 5.7"), 0, {16.08, 16.33, 15.40, 13.33, 10.32, 7.08, 3.38, 3.63, 3.02, 0}, 0.02);
  expectOf(find("CIE 171, 5.11 sky 5"), 0,
           {0.95, 1.06, 1.79, 3.09, 3.54, 3.17, 1.27, 1.75, 2.49, 3.59, 5.19, 7.11, 7.99, 4.13}, 0.01);
}

}  // namespace
}  // namespace roomlight
