// Illuminance from rectangles and inside cubes against view-factor algebra.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "reference/path_tracer.h"
#include "support/record.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr const char* kRectangles = "Illuminance from a Lambertian rectangle, lx";
constexpr double kDPi = 3.14159265358979323846;

double measure(const Scene& scene, Vec3 p, Vec3 n, int samples = 1 << 15) {
  const RayScene rays(scene);
  const Lights lights(scene);
  return luminance(measureIlluminance(rays, lights, p, n, samples, 7).illuminanceLux);
}

void expectWithinOnePercent(double measured, double expected, const std::string& group, const std::string& place) {
  test::record(group, place, "path", expected, measured);
  EXPECT_NEAR(measured, expected, 0.01 * expected) << group << ": " << place;
}

TEST(ClosedForms, UnitSquareSeenOnItsAxis) {
  Scene scene;
  test::addRectangle(scene, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1},
                     test::addMaterial(scene, test::lambertian(0, 100)));
  const double expected = 4 * 100 * std::atan(1 / std::sqrt(5.0)) / std::sqrt(5.0);
  expectWithinOnePercent(measure(scene, {0, 0, 0}, {0, 1, 0}), expected, kRectangles,
                         "unit square of 100 cd/m² on its axis at 1 m");
}

TEST(ClosedForms, CornerAlignedParallelRectangle) {
  Scene scene;
  test::addRectangle(scene, {0, 2, 0}, {1.5f, 0, 0}, {0, 0, 2.5f}, test::addMaterial(scene, test::lambertian(0, 50)));
  const double X = 1.5 / 2, Y = 2.5 / 2, sx = std::sqrt(1 + X * X), sy = std::sqrt(1 + Y * Y);
  const double f = (X / sx * std::atan(Y / sx) + Y / sy * std::atan(X / sy)) / (2 * kDPi);
  expectWithinOnePercent(measure(scene, {0, 0, 0}, {0, 1, 0}), kDPi * 50 * f, kRectangles,
                         "parallel, 1.5 m x 2.5 m at 2 m from its corner, 50 cd/m²");
}

TEST(ClosedForms, CornerAlignedPerpendicularRectangle) {
  // Element at distance a from the rectangle's plane, at its corner; width b, height c.
  const double a = 1.2, b = 2, c = 1.5;
  Scene scene;
  test::addRectangle(scene, {static_cast<float>(a), 0, 0}, {0, 0, static_cast<float>(b)}, {0, static_cast<float>(c), 0},
                     test::addMaterial(scene, test::lambertian(0, 80)));
  const double r = std::sqrt(a * a + c * c);
  const double f = (std::atan(b / a) - a / r * std::atan(b / r)) / (2 * kDPi);
  expectWithinOnePercent(measure(scene, {0, 0, 0}, {0, 1, 0}), kDPi * 80 * f, kRectangles,
                         "perpendicular, 2 m x 1.5 m at 1.2 m from its corner, 80 cd/m²");
}

// Mean exitance over a face of the unit cube whose floor emits an exitance of 1.
double cubeExitance(const Scene& scene, int face, double emitted) {
  const RayScene rays(scene);
  const Lights lights(scene);
  const int n = 24;
  double sum = 0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / n, v = (static_cast<float>(j) + 0.5f) / n;
      const Vec3 p = face == 0 ? Vec3{u, 0, v} : face == 1 ? Vec3{u, 1, v} : Vec3{0, u, v};
      const Vec3 normal = face == 0 ? Vec3{0, 1, 0} : face == 1 ? Vec3{0, -1, 0} : Vec3{1, 0, 0};
      sum +=
          luminance(measureIlluminance(rays, lights, p, normal, 512, static_cast<uint64_t>(j * n + i)).illuminanceLux);
    }
  }
  return emitted + 0.5 * sum / (n * n);
}

// View factor from a surface element (p, n) to a polygon by Lambert's contour formula; the polygon lies in front of p.
double elementToPolygon(Vec3 p, Vec3 n, const std::array<Vec3, 4>& q) {
  double sum = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Vec3 a = normalize(q[i] - p), b = normalize(q[(i + 1) % 4] - p);
    const Vec3 c = cross(a, b);
    const double sine = length(c);
    if (sine > 1e-7) sum += std::atan2(sine, static_cast<double>(dot(a, b))) * dot(n, c) / sine;
  }
  return std::abs(sum) / (2 * kDPi);
}

struct Patch {
  Vec3 centre, normal;
  std::array<Vec3, 4> corners;
  int face;
  double b = 0;
};

// The radiosity solution of the unit cube with n x n patches a face, floor exitance 1, albedo 0.5; mean exitance of
// floor, ceiling and one wall. One patch a face gives science's 1.090909, .181746, .181836; the continuous limit
// differs, because the exitance is not uniform over a face.
std::array<double, 3> cubeRadiosity(int n) {
  std::vector<Patch> patches;
  const float s = 1 / static_cast<float>(n);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, ua = (axis + 1) % 3, va = (axis + 2) % 3;
    for (int k = 0; k < n * n; ++k) {
      Patch patch;
      patch.face = face;
      patch.normal[axis] = face % 2 ? -1.0f : 1.0f;
      Vec3 corner;
      corner[axis] = face % 2 ? 1.0f : 0.0f;
      corner[ua] = static_cast<float>(k % n) * s, corner[va] = static_cast<float>(k / n) * s;
      Vec3 u, v;
      u[ua] = s, v[va] = s;
      patch.corners = {corner, corner + u, corner + u + v, corner + v};
      patch.centre = corner + (u + v) * 0.5f;
      patches.push_back(patch);
    }
  }
  const size_t count = patches.size();
  std::vector<double> f(count * count, 0);
  for (size_t i = 0; i < count; ++i) {
    for (size_t j = 0; j < count; ++j) {
      if (patches[i].face != patches[j].face)
        f[i * count + j] = elementToPolygon(patches[i].centre, patches[i].normal, patches[j].corners);
    }
  }
  for (int iteration = 0; iteration < 60; ++iteration) {
    for (size_t i = 0; i < count; ++i) {
      double e = 0;
      for (size_t j = 0; j < count; ++j) e += f[i * count + j] * patches[j].b;
      patches[i].b = (patches[i].face == 2 ? 1 : 0) + 0.5 * e;
    }
  }
  std::array<double, 3> mean{};
  for (const Patch& p : patches) {
    const int slot = p.face == 2 ? 0 : p.face == 3 ? 1 : p.face == 0 ? 2 : -1;
    if (slot >= 0) mean[static_cast<size_t>(slot)] += p.b / (n * n);
  }
  return mean;
}

TEST(ClosedForms, CubeViewFactors) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0));
  const int floor = test::addMaterial(scene, test::lambertian(0, 1 / kPi));
  test::addRoom(scene, {0, 0, 0}, {1, 1, 1}, {wall, wall, floor, wall, wall, wall});
  expectWithinOnePercent(2 * cubeExitance(scene, 1, 0), 0.199825, "Cube of six unit faces",
                         "view factor to the opposite face");
  expectWithinOnePercent(2 * cubeExitance(scene, 2, 0), 0.200044, "Cube of six unit faces",
                         "view factor to a face beside");
  const double opposite = 0.199825, adjacent = 0.200044;
  // Six uniform patches: B = M + rho F B, solved by symmetry of the four walls.
  double bf = 1, bc = 0, bw = 0;
  for (int i = 0; i < 200; ++i) {
    bf = 1 + 0.5 * (opposite * bc + 4 * adjacent * bw);
    bc = 0.5 * (opposite * bf + 4 * adjacent * bw);
    bw = 0.5 * (adjacent * (bf + bc + 2 * bw) + opposite * bw);
  }
  EXPECT_NEAR(bf, 1.090909, 2e-4);
  EXPECT_NEAR(bc, 0.181746, 2e-4);
  EXPECT_NEAR(bw, 0.181836, 2e-4);
}

TEST(ClosedForms, CubeOfSixFacesIsTheRadiositySolution) {
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(0.5f));
  const int floor = test::addMaterial(scene, test::lambertian(0.5f, 1 / kPi));
  test::addRoom(scene, {0, 0, 0}, {1, 1, 1}, {wall, wall, floor, wall, wall, wall});
  const std::array<double, 3> expected = cubeRadiosity(12);
  const char* names[] = {"floor", "ceiling", "wall"};
  for (int face = 0; face < 3; ++face) {
    const double e = expected[static_cast<size_t>(face)];
    expectWithinOnePercent(cubeExitance(scene, face, face == 0 ? 1 : 0), e, "Cube of six unit faces",
                           std::string("mean exitance, albedo 0.5, floor 1: ") + names[face]);
  }
}

}  // namespace
}  // namespace roomlight
