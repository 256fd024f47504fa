// The cases of `roomlight validate`: small scenes whose light is known, with what meters must read in them.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "trace/meter.h"
#include "validate/quadrature.h"

namespace roomlight {

// One value of a case: offset + the sum of weights times readings in lux.
struct Quantity {
  std::string place;
  std::vector<SurfaceElement> elements;
  std::vector<double> weights;  // one for each element
  double offset = 0;
  double expected = 0;
};

struct ValidationCase {
  std::string name;   // "CIE 171, 5.3" or of a closed form
  std::string title;
  std::string unit;   // of the quantities
  std::string basis;  // how the expected values were had
  Scene scene;
  std::vector<Quantity> quantities;
};

// Made one after the other: scenes may be large.
using MakeCase = ValidationCase (*)();

// Closed forms and furnaces; lamps and reflections of CIE 171:2006, 5.2 to 5.4 and 5.6 to 5.8; daylight of the
// same, 5.9 to 5.14.
const std::vector<MakeCase>& closedFormCases();
const std::vector<MakeCase>& lampCases();
const std::vector<MakeCase>& daylightCases();

// One reading times `scale`.
Quantity reading(const std::string& place, const SurfaceElement& element, double scale, double expected);

// Axes of CIE 171, where z is up, in ours: its (x, y, z) is (x, z, y). Rooms there are 4 x 4 x 3 m.
inline Vec3 cie(float x, float y, float z) { return {x, z, y}; }
// Points A to F of the wall at `y`, looking into the room, from 2.75 m down to 0.25 m, and G to N of the floor, from y
// = 0.25 m to 3.75 m; x = 2 m.
SurfaceElement wallPoint(int i, float y = 0);
SurfaceElement floorPoint(int i);
std::string wallName(int i);
std::string floorName(int i);

// From the program's vectors to the quadrature's.
inline quadrature::Point exact(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline quadrature::Element exact(const SurfaceElement& e) { return {exact(e.position), exact(e.normal)}; }

}  // namespace roomlight
