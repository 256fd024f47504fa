// Lamps and reflections after CIE 171:2006, 5.2 to 5.4 and 5.6 to 5.8: set-ups as the report has them, expected values
 // from their own integrals.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/primitives.h"
#include "validate/cases.h"

namespace roomlight {
namespace {

using std::numbers::pi;

Scene blackRoom() {
  Scene scene;
  addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, addMaterial(scene, lambertian(0))));
  return scene;
}

ValidationCase pointLampAbove() {
  ValidationCase out{
      "CIE 171, 5.2 point", "point lamp of 1000 cd, 3 m above the floor", "lx", "E = I h / d³", blackRoom(), {}};
  out.scene.lamps.push_back(pointLamp({0.5f, 3, 0.5f}, 1000));
  out.scene.lamps.back().position.y = 2.999f;
  const double h = static_cast<double>(out.scene.lamps.back().position.y);
  for (const auto& [x, y] :
       {std::pair{0.0f, 0.0f}, {0.5f, 0.0f}, {1.0f, 0.0f}, {1.5f, 0.0f}, {1.0f, 1.0f}, {1.5f, 1.5f}}) {
    const double d = std::sqrt(static_cast<double>(x * x + y * y) + h * h);
    out.quantities.push_back(reading(fmt::format("{} m, {} m from below it", x, y),
                                     {{0.5f + x, 0, 0.5f + y}, {0, 1, 0}}, 1, 1000 * h / (d * d * d)));
  }
  return out;
}

// Small enough to be a point: the integral over it differs from I cos² / d² by less than a hundred thousandth.
ValidationCase lambertianPointAbove() {
  ValidationCase out{"CIE 171, 5.2 Lambertian",
                     "Lambertian point of 1000 cd, 3 m above the floor",
                     "lx",
                     "E = I h² / d⁴",
                     blackRoom(),
                     {}};
  const float side = 0.01f, h = 2.9999f;
  addRectangle(out.scene, {0.5f - side / 2, h, 0.5f - side / 2}, {side, 0, 0}, {0, 0, side},
               addMaterial(out.scene, lambertian(0, 1000 / (side * side))));
  for (const auto& [x, y] :
       {std::pair{0.0f, 0.0f}, {0.5f, 0.0f}, {1.0f, 0.0f}, {1.5f, 0.0f}, {1.0f, 1.0f}, {1.5f, 1.5f}}) {
    const double h2 = static_cast<double>(h) * static_cast<double>(h), d2 = static_cast<double>(x * x + y * y) + h2;
    out.quantities.push_back(reading(fmt::format("{} m, {} m from below it", x, y),
                                     {{0.5f + x, 0, 0.5f + y}, {0, 1, 0}}, 1, 1000 * h2 / (d2 * d2)));
  }
  return out;
}

ValidationCase areaLampAtTheCeiling() {
  ValidationCase out{"CIE 171, 5.3", "Lambertian panel of 1 x 1 m and 1000 cd at the ceiling",
                     "lx",           "Gauss-Legendre quadrature over the panel",
                     blackRoom(),    {}};
  const float y = 2.9999f;
  addRectangle(out.scene, {1.5f, y, 1.5f}, {1, 0, 0}, {0, 0, 1}, addMaterial(out.scene, lambertian(0, 1000)));
  const quadrature::Rectangle panel{{1.5, static_cast<double>(y), 1.5}, {1, 0, 0}, {0, 0, 1}};
  const auto add = [&](const std::string& place, const SurfaceElement& e) {
    out.quantities.push_back(
        reading(place, e, 1, quadrature::illuminance(exact(e), panel, [](auto, auto) { return 1000.0; })));
  };
  for (int i = 0; i < 6; ++i) add(wallName(i), wallPoint(i));
  for (int i = 0; i < 7; ++i) add(floorName(i), floorPoint(i));
  return out;
}

ValidationCase flux() {
  ValidationCase out{"CIE 171, 5.4",
                     "a lamp of 10 000 lm in a closed black room",
                     "1",
                     "what all faces receive is what the lamp sends out",
                     blackRoom(),
                     {}};
  out.scene.lamps.push_back(pointLamp({1.3f, 1.9f, 2.4f}, 10000 / (4 * kPi)));
  Quantity q{"sum of E A / flux", {}, {}, 0, 1};
  constexpr int n = 64;
  const Vec3 size{4, 3, 4};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      for (int k = 0; k < n * n; ++k) {
        SurfaceElement e{{}, {}};
        e.position[u] = size[u] * (static_cast<float>(k % n) + 0.5f) / n,
        e.position[v] = size[v] * (static_cast<float>(k / n) + 0.5f) / n;
        e.position[axis] = far ? size[axis] : 0, e.normal = {0, 0, 0}, e.normal[axis] = far ? -1.0f : 1.0f;
        q.elements.push_back(e), q.weights.push_back(static_cast<double>(size[u] * size[v]) / (n * n) / 10000);
      }
    }
  }
  out.quantities.push_back(std::move(q));
  return out;
}

// Reflected by a ground of 4 x 4 m and albedo 0.3 that a sun at the zenith gives 1000 lx, to a wall and a ceiling
// beyond it.
ValidationCase groundReflection() {
  ValidationCase out{"CIE 171, 5.6 wall",
                     "light that sunlit ground of albedo 0.3 reflects",
                     "% of E ρ",
                     "Gauss-Legendre quadrature over the ground",
                     {},
                     {}};
  const int black = addMaterial(out.scene, lambertian(0));
  addRectangle(out.scene, cie(0, 0, 0), {0, 0, 4}, {4, 0, 0}, addMaterial(out.scene, lambertian(0.3f)));
  addRectangle(out.scene, cie(0, 4, 0.5f), {0, 2.5f, 0}, {4, 0, 0}, black);
  out.scene.suns.push_back({"sun", {0, 1, 0}, Vec3(1000), 0});
  const quadrature::Rectangle ground{{0, 0, 0}, {0, 0, 4}, {4, 0, 0}};
  const auto add = [&](const std::string& place, const SurfaceElement& e) {
    out.quantities.push_back(reading(
        place, e, 100 / 300.0, 100 * quadrature::illuminance(exact(e), ground, [](auto, auto) { return 1 / pi; })));
  };
  for (int i = 0; i < 5; ++i)
    add(fmt::format("wall, {:.2f} m up", 0.75 + 0.5 * i),
        {cie(2, 4, 0.75f + 0.5f * static_cast<float>(i)), cie(0, -1, 0)});
  return out;
}

ValidationCase ceilingOverGround() {
  ValidationCase out{"CIE 171, 5.6 ceiling",
                     "light that bright ground reflects to a ceiling",
                     "% of E ρ",
                     "Gauss-Legendre quadrature over the ground",
                     {},
                     {}};
  addRectangle(out.scene, cie(0, 0, 0), {0, 0, 4}, {4, 0, 0}, addMaterial(out.scene, lambertian(0, 1000 * 0.3f / kPi)));
  addRectangle(out.scene, cie(0, 0, 3), {4, 0, 0}, {0, 0, 4}, addMaterial(out.scene, lambertian(0)));
  const quadrature::Rectangle ground{{0, 0, 0}, {0, 0, 4}, {4, 0, 0}};
  for (int i = 0; i < 4; ++i) {
    const SurfaceElement e{cie(2, 0.25f + 0.5f * static_cast<float>(i), 3), {0, -1, 0}};
    out.quantities.push_back(
        reading(fmt::format("ceiling, {:.2f} m in", 0.25 + 0.5 * i), e, 100 / 300.0,
                100 * quadrature::illuminance(exact(e), ground, [](auto, auto) { return 1 / pi; })));
  }
  return out;
}

ValidationCase obstructedReflection() {
  ValidationCase out{"CIE 171, 5.7",
                     "light of a wall of albedo 0.6, past a black partition 1 m high",
                     "% of E ρ",
                     "Gauss-Legendre quadrature over what is visible of the wall",
                     {},
                     {}};
  addRectangle(out.scene, cie(0, 4, 0), {0, 3, 0}, {4, 0, 0}, addMaterial(out.scene, lambertian(0, 1000 * 0.6f / kPi)));
  addBox(out.scene, {0, 0, 2.5f}, {4, 1, 2.7f}, addMaterial(out.scene, lambertian(0)));
  const auto add = [&](const std::string& place, const SurfaceElement& e) {
    // The partition is as wide as the wall: it hides what lies below a line over one of its upper edges.
    const quadrature::Point p = exact(e.position);
    double hidden = 0;
    for (const double edge : {2.5, static_cast<double>(2.7f)})
      hidden = std::max(hidden, p.y + (1 - p.y) * (4 - p.z) / (edge - p.z));
    const quadrature::Rectangle visible{{0, hidden, 4}, {0, 3 - hidden, 0}, {4, 0, 0}};
    out.quantities.push_back(
        reading(place, e, 100 / 600.0,
                hidden >= 3 ? 0 : 100 * quadrature::illuminance(exact(e), visible, [](auto, auto) { return 1 / pi; })));
  };
  for (int i = 0; i < 6; ++i) add(wallName(i), wallPoint(i));
  for (int i = 0; i < 4; ++i) add(floorName(i), floorPoint(i));
  return out;
}

// Mean over a wall, which by symmetry stands for all; direct light at the points is known and taken off.
template <int kPercent>
ValidationCase cubeOfAlbedo() {
  const double albedo = kPercent / 100.0;
  ValidationCase out{fmt::format("CIE 171, 5.8 albedo {}", albedo),
                     fmt::format("indirect light in a 4 m cube of albedo {}, lamp of 10 000 lm", albedo),
                     "lx",
                     "E = ρ Φ / (96 (1 - ρ)), exact for the mean",
                     {},
                     {}};
  addRoom(out.scene, {0, 0, 0}, {4, 4, 4},
          std::vector<int>(6, addMaterial(out.scene, lambertian(static_cast<float>(albedo)))));
  out.scene.lamps.push_back(pointLamp({2, 2, 2}, 10000 / (4 * kPi)));
  Quantity q{"mean over a wall", {}, {}, 0, 10000 * albedo / (96 * (1 - albedo))};
  constexpr int n = 12;
  for (int k = 0; k < n * n; ++k) {
    const float u = 4 * (static_cast<float>(k % n) + 0.5f) / n, v = 4 * (static_cast<float>(k / n) + 0.5f) / n;
    q.elements.push_back({{u, 0, v}, {0, 1, 0}}), q.weights.push_back(1.0 / (n * n));
    const double du = static_cast<double>(u) - 2, dv = static_cast<double>(v) - 2;
    q.offset -= 10000 / (4 * pi) * 2 / std::pow(4 + du * du + dv * dv, 1.5) / (n * n);
  }
  out.quantities.push_back(std::move(q));
  return out;
}

}  // namespace

const std::vector<MakeCase>& lampCases() {
  static const std::vector<MakeCase> cases = {
      pointLampAbove,   lambertianPointAbove, areaLampAtTheCeiling, flux,
      groundReflection, ceilingOverGround,    obstructedReflection, cubeOfAlbedo<5>,
      cubeOfAlbedo<20>, cubeOfAlbedo<50>,     cubeOfAlbedo<80>,     cubeOfAlbedo<90>,
      cubeOfAlbedo<95>};
  return cases;
}

}  // namespace roomlight
