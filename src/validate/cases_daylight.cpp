// Daylight through openings and panes after CIE 171:2006, 5.5 and 5.9 to 5.14. Skies are those of ISO 15469:2004,
// written down a second time in double precision, so that pictures of skies, their sampling and what openings let in
// are all judged.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "photometry/sky_image.h"
#include "scene/primitives.h"
#include "scene/surface.h"
#include "validate/cases.h"

namespace roomlight {
namespace {

using quadrature::Point;
using quadrature::Rectangle;
using std::numbers::pi;

constexpr double kHorizontalLux = 10000, kGroundAlbedo = 0.3;
constexpr double kSunAltitude = pi / 3;  // towards +z, where the facade looks

// Gradation and indicatrix of the standard's types 1 to 15.
struct CieSky {
  double a, b, c, d, e;
};
constexpr CieSky kSkies[] = {{4, -.7, 0, -1, 0},       {4, -.7, 2, -1.5, .15},  {1.1, -.8, 0, -1, 0},
                             {1.1, -.8, 2, -1.5, .15}, {0, -1, 0, -1, 0},       {0, -1, 2, -1.5, .15},
                             {0, -1, 5, -2.5, .3},     {0, -1, 10, -3, .45},    {-1, -.55, 2, -1.5, .15},
                             {-1, -.55, 5, -2.5, .3},  {-1, -.55, 10, -3, .45}, {-1, -.32, 10, -3, .45},
                             {-1, -.32, 16, -3, .3},   {-1, -.15, 16, -3, .3},  {-1, -.15, 24, -2.8, .15}};

// Luminance of type 1 to 16 along d, relative.
double relativeLuminance(int type, Point d) {
  const double cosZ = std::max(d.y, 1e-6);
  if (type == 16) return (1 + 2 * cosZ) / 3;
  const CieSky& s = kSkies[type - 1];
  const double chi = std::acos(std::clamp(d.y * std::sin(kSunAltitude) + d.z * std::cos(kSunAltitude), -1.0, 1.0));
  return (1 + s.a * std::exp(s.b / cosZ)) *
         (1 + s.c * (std::exp(s.d * chi) - std::exp(s.d * pi / 2)) + s.e * std::cos(chi) * std::cos(chi));
}

// A sky that gives kHorizontalLux, over ground of albedo kGroundAlbedo.
class Daylight {
 public:
  explicit Daylight(int type) : type_(type) {
    const auto ring = [&](double zenith) {
      return std::sin(zenith) * std::cos(zenith) *
             quadrature::integral(
                 [&](double azimuth) {
                   return relativeLuminance(type_, {std::sin(zenith) * std::sin(azimuth), std::cos(zenith),
                                                    std::sin(zenith) * std::cos(azimuth)});
                 },
                 0, 2 * pi, 8);
    };
    scale_ = kHorizontalLux / quadrature::integral(ring, 0, pi / 2, 32);
  }
  double luminance(Point d) const {
    return d.y > 0 ? scale_ * relativeLuminance(type_, d) : kGroundAlbedo * kHorizontalLux / pi;
  }
  Sky sky() const {
    Sky out;
    out.image = skyImage(
        [&](Vec3 d) {
          return relativeLuminance(type_,
                                   {static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)});
        },
        kHorizontalLux, Vec3(1));
    paintGround(out.image, Vec3(static_cast<float>(kGroundAlbedo)), Vec3(0), 0);
    out.horizonEdge = true;
    return out;
  }

 private:
  const int type_;
  double scale_ = 1;
};

// 6 mm of clear glass: transmittance of a slab, s and p polarised light apart, with all reflections inside.
constexpr double kIor = 1.52, kInternal = 0.96;
double slab(double cosine) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (kIor * kIor)), a = std::pow(kInternal, 1 / inside);
  const auto through = [&](double r) { return (1 - r) * (1 - r) * a / (1 - r * r * a * a); };
  const double s = (cosine - kIor * inside) / (cosine + kIor * inside),
               p = (kIor * cosine - inside) / (kIor * cosine + inside);
  return (through(s * s) + through(p * p)) / 2;
}

int addGlass(Scene& scene) {
  Material glass = lambertian(1);
  glass.name = "glass";
  glaze(glass, {1, static_cast<float>(kIor), static_cast<float>(kInternal)});
  return addMaterial(scene, glass);
}

// 100 E / E_hz.
Quantity percent(const std::string& place, const SurfaceElement& e, double expectedLux) {
  return reading(place, e, 100 / kHorizontalLux, 100 * expectedLux / kHorizontalLux);
}

const char* const kBasis = "luminance of the sky integrated over what is visible of the opening";

// A black room with an opening of that edge in the middle of its roof.
ValidationCase roof(int type, float edge, bool glazed = false) {
  const std::string what = glazed ? "glazed " : "";
  ValidationCase out{fmt::format("CIE 171, 5.{} {} m, sky {}", glazed ? "10" : "9", edge, type),
                     fmt::format("{}roof opening of {} x {} m under CIE sky {}", what, edge, edge, type),
                     "% of E_hz",
                     kBasis,
                     {},
                     {}};
  const int black = addMaterial(out.scene, lambertian(0));
  const float lo = 2 - edge / 2, hi = 2 + edge / 2;
  addRoom(out.scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, black));
  out.scene.instances.erase(out.scene.instances.begin() + 3);  // the ceiling
  if (edge < 4) {
    addRectangle(out.scene, {0, 3, 0}, {4, 0, 0}, {0, 0, lo}, black);
    addRectangle(out.scene, {0, 3, hi}, {4, 0, 0}, {0, 0, 4 - hi}, black);
    addRectangle(out.scene, {0, 3, lo}, {lo, 0, 0}, {0, 0, edge}, black);
    addRectangle(out.scene, {hi, 3, lo}, {4 - hi, 0, 0}, {0, 0, edge}, black);
  }
  if (glazed) addRectangle(out.scene, {lo, 3, lo}, {edge, 0, 0}, {0, 0, edge}, addGlass(out.scene));
  const Daylight day(type);
  out.scene.sky = day.sky();
  const double low = static_cast<double>(lo), size = static_cast<double>(edge);
  const auto add = [&](const std::string& place, const SurfaceElement& e) {
    out.quantities.push_back(
        percent(place, e,
                quadrature::illuminance(
                    exact(e), {{low, 3, low}, {size, 0, 0}, {0, 0, size}},
                    [&](Point, Point d) { return day.luminance(d) * (glazed ? slab(d.y) : 1); }, 40)));
  };
  for (int i = 0; i < 6; ++i) add(wallName(i), wallPoint(i));
  for (int i = 0; i < 4; ++i) add(floorName(i), floorPoint(i));
  return out;
}

// What an element sees through a part of the height of an opening.
struct Part {
  double low, high;  // m above the floor
  double luminance;  // cd/m², even; below 0: of sky and ground
};

// What stands before a facade.
struct Outlook {
  void (*build)(Scene&);                                      // null: nothing does
  std::vector<Part> (*parts)(double depthM, double heightM);  // seen from so far behind the facade and so high
};

// A black room whose wall at y = 4 m has an opening of 2 x 1 m, 1 m up.
ValidationCase facade(const std::string& name, const std::string& title, int type, const Outlook& outlook,
                      bool glazed = false) {
  ValidationCase out{name, title, "% of E_hz", kBasis, {}, {}};
  const int black = addMaterial(out.scene, lambertian(0));
  addRoom(out.scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, black));
  out.scene.instances.erase(out.scene.instances.begin() + 5);  // the facade
  for (const auto& [x, y, w, h] : {std::array{0.0f, 0.0f, 4.0f, 1.0f},
                                   {0.0f, 2.0f, 4.0f, 1.0f},
                                   {0.0f, 1.0f, 1.0f, 1.0f},
                                   {3.0f, 1.0f, 1.0f, 1.0f}})
    addRectangle(out.scene, {x, y, 4}, {0, h, 0}, {w, 0, 0}, black);
  if (outlook.build) outlook.build(out.scene);
  if (glazed) addRectangle(out.scene, {1, 1, 4}, {2, 0, 0}, {0, 1, 0}, addGlass(out.scene));
  const Daylight day(type);
  out.scene.sky = day.sky();
  const auto add = [&](const std::string& place, const SurfaceElement& e) {
    const Point p = exact(e.position);
    double lux = 0;
    for (Part part : outlook.parts(4 - p.z, p.y)) {
      part.low = std::clamp(part.low, 1.0, 2.0), part.high = std::clamp(part.high, 1.0, 2.0);
      // Cut where the horizon is.
      for (const auto& [from, to] : {std::pair{part.low, std::clamp(p.y, part.low, part.high)},
                                     {std::clamp(p.y, part.low, part.high), part.high}}) {
        if (to - from < 1e-12) continue;
        lux += quadrature::illuminance(
            exact(e), {{1, from, 4}, {2, 0, 0}, {0, to - from, 0}},
            [&](Point, Point d) {
              return (part.luminance < 0 ? day.luminance(d) : part.luminance) * (glazed ? slab(d.z) : 1);
            },
            24);
      }
    }
    out.quantities.push_back(percent(place, e, lux));
  };
  for (int i = 0; i < 6; ++i) add(wallName(i), wallPoint(i));
  for (int i = 0; i < 8; ++i) add(floorName(i), floorPoint(i));
  return out;
}

template <int kType>
ValidationCase smallRoof() {
  return roof(kType, 1);
}
template <int kType>
ValidationCase largeRoof() {
  return roof(kType, 4);
}

template <int kType>
ValidationCase glazedRoof() {
  return roof(kType, 1, true);
}

template <int kType, bool kGlazed>
ValidationCase window() {
  return facade(fmt::format("CIE 171, 5.{} sky {}", kGlazed ? 12 : 11, kType),
                fmt::format("{}facade opening of 2 x 1 m under CIE sky {} over ground of albedo 0.3",
                            kGlazed ? "glazed " : "", kType),
                kType,
                {nullptr,
                 [](double, double) {
                   return std::vector<Part>{{1, 2, -1}};
                 }},
                kGlazed);
}

// The room of 5.11 with surfaces that reflect: what the sky gives to each patch, and radiosity.
ValidationCase greyRoom() {
  ValidationCase out{"daylit grey room",
                     "facade opening of 2 x 1 m, sky 16; floor 0.3, walls 0.5, ceiling 0.7",
                     "% of E_hz",
                     "light of sky and ground on patches by quadrature, radiosity on 12 x 12 of them a surface",
                     {},
                     {}};
  const auto of = [&](double albedo) { return addMaterial(out.scene, lambertian(static_cast<float>(albedo))); };
  const double floor = 0.3, walls = 0.5, ceiling = 0.7;
  const int grey = of(walls);
  addRoom(out.scene, {0, 0, 0}, {4, 3, 4}, {grey, grey, of(floor), of(ceiling), grey, grey});
  out.scene.instances.erase(out.scene.instances.begin() + 5);
  using quadrature::Radiosity;
  std::vector<Radiosity> surfaces = {{{{0, 0, 0}, {0, 0, 4}, {4, 0, 0}}, floor, 0},
                                     {{{0, 3, 0}, {4, 0, 0}, {0, 0, 4}}, ceiling, 0},
                                     {{{0, 0, 0}, {0, 3, 0}, {0, 0, 4}}, walls, 0},
                                     {{{4, 0, 0}, {0, 0, 4}, {0, 3, 0}}, walls, 0},
                                     {{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, walls, 0}};
  for (const auto& [x, y, w, h] :
       {std::array{0.0, 0.0, 4.0, 1.0}, {0.0, 2.0, 4.0, 1.0}, {0.0, 1.0, 1.0, 1.0}, {3.0, 1.0, 1.0, 1.0}}) {
    addRectangle(out.scene, {static_cast<float>(x), static_cast<float>(y), 4}, {0, static_cast<float>(h), 0},
                 {static_cast<float>(w), 0, 0}, grey);
    surfaces.push_back({{{x, y, 4}, {0, h, 0}, {w, 0, 0}}, walls, 0});
  }
  const Daylight day(16);
  out.scene.sky = day.sky();
  const auto direct = [&](const quadrature::Element& e) {
    if (e.position.z >= 4) return 0.0;
    const double cut = std::clamp(e.position.y, 1.0, 2.0);
    double lux = 0;
    for (const auto& [from, to] : {std::pair{1.0, cut}, {cut, 2.0}}) {
      if (to - from > 1e-12)
        lux += quadrature::illuminance(
            e, {{1, from, 4}, {2, 0, 0}, {0, to - from, 0}}, [&](Point, Point d) { return day.luminance(d); }, 12);
    }
    return lux;
  };
  std::vector<SurfaceElement> elements;
  std::vector<std::string> names;
  for (int i = 0; i < 6; ++i) elements.push_back(wallPoint(i)), names.push_back(wallName(i));
  for (int i = 0; i < 8; ++i) elements.push_back(floorPoint(i)), names.push_back(floorName(i));
  elements.push_back({{2, 0.85f, 2}, {0, 1, 0}}), names.push_back("work plane, middle");
  elements.push_back({{2, 3, 2}, {0, -1, 0}}), names.push_back("ceiling, middle");
  std::vector<quadrature::Element> at;
  for (const SurfaceElement& e : elements) at.push_back(exact(e));
  const std::vector<double> reflected = quadrature::illuminance(surfaces, at, 12, direct);
  for (size_t i = 0; i < at.size(); ++i)
    out.quantities.push_back(percent(names[i], elements[i], direct(at[i]) + reflected[i]));
  return out;
}

// Sunlight through a pane, by its angle of incidence.
ValidationCase clearGlass() {
  ValidationCase out{"CIE 171, 5.5",
                     "sunlight through 6 mm of clear glass, by angle of incidence",
                     "% of the light before it",
                     "slab of glass with s and p polarised light apart",
                     {},
                     {}};
  const int glass = addGlass(out.scene), black = addMaterial(out.scene, lambertian(0));
  out.scene.suns.push_back({"sun", {0, 1, 0}, Vec3(10000), 0});
  // A pane for each angle, all under one sun; so far apart that each meter sees its own.
  for (int i = 0; i <= 8; ++i) {
    const double angle = 10 * i * pi / 180;
    const Vec3 middle{static_cast<float>(20 * i), 1, 0},
        along{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0};
    addRectangle(out.scene, middle - along * 5 - Vec3{0, 0, 5}, {0, 0, 10}, along * 10, glass);
    addRectangle(out.scene, middle - Vec3{0.5f, 6, 0.5f}, {0, 0, 1}, {1, 0, 0}, black);
    out.quantities.push_back(reading(fmt::format("{}°", 10 * i), {middle - Vec3{0.13f, 6, -0.21f}, {0, 1, 0}}, 0.01,
                                     100 * slab(std::cos(angle))));
  }
  return out;
}

// Height on the facade where a line from (depth, height) meets it on its way to a point `out` beyond it and `up` high.
double crossing(double depth, double height, double out, double up) {
  return height + (up - height) * depth / (depth + out);
}

constexpr double kShelfDepth = 1, kShelfHeight = 2.5;
ValidationCase shelfAbove() {
  return facade("CIE 171, 5.13", "the same under a black horizontal mask, 0.5 m above it and 1 m deep, sky 5", 5,
                {[](Scene& scene) {
                   addRectangle(scene, {-100, static_cast<float>(kShelfHeight), 4}, {204, 0, 0},
                                {0, 0, static_cast<float>(kShelfDepth)}, 0);
                 },
                 [](double depth, double height) {
                   return std::vector<Part>{{1, crossing(depth, height, kShelfDepth, kShelfHeight), -1}};
                 }});
}

constexpr double kMaskDistance = 6, kMaskHeight = 4.5, kMaskLuminance = 200;
ValidationCase maskOpposite() {
  return facade("CIE 171, 5.14", "the same with a bright vertical mask 6 m before it, 4.5 m high, sky 5", 5,
                {[](Scene& scene) {
                   const int bright = addMaterial(scene, lambertian(0, static_cast<float>(kMaskLuminance)));
                   addRectangle(scene, {-1000, 0, 4 + static_cast<float>(kMaskDistance)},
                                {0, static_cast<float>(kMaskHeight), 0}, {2004, 0, 0}, bright);
                 },
                 [](double depth, double height) {
                   const double foot = crossing(depth, height, kMaskDistance, 0),
                                top = crossing(depth, height, kMaskDistance, kMaskHeight);
                   return std::vector<Part>{{1, foot, -1}, {foot, top, kMaskLuminance}, {top, 2, -1}};
                 }});
}

}  // namespace

const std::vector<MakeCase>& daylightCases() {
  static const std::vector<MakeCase> cases = {
      clearGlass,       smallRoof<1>,      smallRoof<5>,      smallRoof<12>,     smallRoof<16>,     largeRoof<3>,
      largeRoof<8>,     largeRoof<13>,     largeRoof<16>,     glazedRoof<1>,     glazedRoof<8>,     glazedRoof<16>,
      window<1, false>, window<2, false>,  window<4, false>,  window<5, false>,  window<6, false>,  window<7, false>,
      window<9, false>, window<10, false>, window<11, false>, window<14, false>, window<15, false>, window<16, false>,
      window<1, true>,  window<5, true>,   window<12, true>,  window<16, true>,  shelfAbove,        maskOpposite,
      greyRoom};
  return cases;
}

}  // namespace roomlight
