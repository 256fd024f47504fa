// Closed forms: rectangles of even luminance, furnaces, radiosity in a cube.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/primitives.h"
#include "validate/cases.h"

namespace roomlight {
namespace {

using std::numbers::pi;

// A panel of 1000 cd/m², corner at the origin, that looks down along -y, over points at different distances and tilts.
ValidationCase rectangle() {
  ValidationCase out{"rectangle", "Lambertian panel, 1 x 1 m, 1000 cd/m²",
                     "lx",        "Gauss-Legendre quadrature; on the axis E = 4 L atan(1/√5)/√5",
                     {},          {}};
  addRectangle(out.scene, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, addMaterial(out.scene, lambertian(0, 1000)));
  const quadrature::Rectangle panel{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  const auto add = [&](const std::string& place, const SurfaceElement& e) {
    out.quantities.push_back(
        reading(place, e, 1, quadrature::illuminance(exact(e), panel, [](auto, auto) { return 1000.0; })));
  };
  add("on the axis, 1 m below", {{0.5f, -1, 0.5f}, {0, 1, 0}});
  add("under a corner, 1 m below", {{0, -1, 0}, {0, 1, 0}});
  add("2 m aside, 1 m below", {{2.5f, -1, 0.5f}, {0, 1, 0}});
  add("0.2 m below the middle", {{0.5f, -0.2f, 0.5f}, {0, 1, 0}});
  add("upright, at right angles to it, 1 m aside", {{2, -0.5f, 0.5f}, {-1, 0, 0}});
  add("tilted", {{1.5f, -1, 1.5f}, {-0.6f, 0.8f, 0}});
  return out;
}

// Very near the globe its own surface must not shade it.
ValidationCase globe() {
  ValidationCase out{"globe", "shining sphere, radius 0.1 m, 3000 cd/m²", "lx", "E = π L (r/d)² cos θ", {}, {}};
  const Vec3 centre{8, 2.4f, 6};
  addSphere(out.scene, centre, 0.1f, addMaterial(out.scene, lambertian(0, 3000)), 64);
  for (const float aside : {0.0f, 0.05f, 0.1f, 0.2f, 0.5f, 2.0f}) {
    const double h = 0.15, d2 = h * h + static_cast<double>(aside * aside);
    out.quantities.push_back(reading(fmt::format("0.05 m above its top, {} m aside", aside),
                                     {{centre.x + aside, centre.y + 0.15f, centre.z}, {0, -1, 0}}, 1,
                                     pi * 3000 * 0.01 / d2 * h / std::sqrt(d2)));
  }
  out.quantities.push_back(
      reading("2 m below", {{centre.x, centre.y - 2, centre.z}, {0, 1, 0}}, 1, pi * 3000 * 0.01 / 4));
  return out;
}

ValidationCase furnace() {
  ValidationCase out{"furnace", "closed box, every wall shines and reflects half", "lx", "E = π Le / (1 - ρ)", {}, {}};
  addRoom(out.scene, {0, 0, 0}, {3, 2.5f, 4}, std::vector<int>(6, addMaterial(out.scene, lambertian(0.5f, 100))));
  const double expected = pi * 100 / 0.5;
  out.quantities = {reading("floor", {{1, 0, 1}, {0, 1, 0}}, 1, expected),
                    reading("wall", {{0, 1, 2}, {1, 0, 0}}, 1, expected),
                    reading("corner", {{0.05f, 0, 0.05f}, {0, 1, 0}}, 1, expected),
                    reading("in the air", {{1.5f, 1.2f, 2}, {0.6f, 0.8f, 0}}, 1, expected)};
  return out;
}

// A unit cube whose floor has an exitance of 1000 lm/m²; everything reflects half.
ValidationCase cube() {
  ValidationCase out{"cube", "unit cube of albedo 0.5, its floor shines with 1000 lm/m²",
                     "lx",   "radiosity on 12 x 12 patches a face with exact configuration factors",
                     {},     {}};
  const int grey = addMaterial(out.scene, lambertian(0.5f)),
            bright = addMaterial(out.scene, lambertian(0.5f, 1000 / kPi));
  addRoom(out.scene, {0, 0, 0}, {1, 1, 1}, {grey, grey, bright, grey, grey, grey});
  const std::pair<const char*, SurfaceElement> places[] = {
      {"middle of the floor", {{0.5f, 0, 0.5f}, {0, 1, 0}}},
      {"middle of the ceiling", {{0.5f, 1, 0.5f}, {0, -1, 0}}},
      {"ceiling, 0.1 m from a corner", {{0.1f, 1, 0.1f}, {0, -1, 0}}},
      {"middle of a wall", {{0, 0.5f, 0.5f}, {1, 0, 0}}},
      {"wall, 0.8 m up", {{0, 0.8f, 0.5f}, {1, 0, 0}}},
      {"in the air", {{0.5f, 0.5f, 0.5f}, {0, 1, 0}}}};
  std::vector<quadrature::Element> elements;
  for (const auto& [name, e] : places) elements.push_back(exact(e));
  const std::vector<double> expected = quadrature::illuminance(quadrature::unitCube(0.5, 1000), elements, 12);
  for (size_t i = 0; i < elements.size(); ++i)
    out.quantities.push_back(reading(places[i].first, places[i].second, 1, expected[i]));
  return out;
}

}  // namespace

const std::vector<MakeCase>& closedFormCases() {
  static const std::vector<MakeCase> cases = {rectangle, globe, furnace, cube};
  return cases;
}

}  // namespace roomlight
