#include "import/lighting_lamps.h"

#include <fmt/format.h>

#include "import/lighting_json.h"
#include "photometry/spot.h"

namespace roomlight::importers {
namespace {

void readSpot(const JsonPlace& j, Lamp& lamp) {
  lamp.direction = direction(j["direction"]);
  const double outer = j.number("outerCone", 0.5, 90, 45), inner = j.number("innerCone", 0, 90, 0);
  if (inner > outer) j["innerCone"].fail("must not be larger than outerCone");
  lamp.outerConeRad = static_cast<float>(rad(outer));
  lamp.innerConeRad = static_cast<float>(rad(inner));
}

void readArea(const JsonPlace& j, Lamp& lamp) {
  lamp.direction = direction(j["direction"]);
  lamp.widthM = static_cast<float>(j["width"].number(1e-4, 1000));
  lamp.heightM = static_cast<float>(j["height"].number(1e-4, 1000));
  Vec3 up = j.has("up") ? direction(j["up"]) : std::abs(lamp.direction.y) < 0.99f ? Vec3{0, 1, 0}
                                                                                  : Vec3{0, 0, -1};
  up -= lamp.direction * dot(up, lamp.direction);
  if (length(up) < 1e-3f) {
    j["up"].fail("must not point along 'direction'");
    return;
  }
  lamp.up = normalize(up);
}

}  // namespace

Lamp readLamp(const JsonPlace& j, size_t number) {
  Lamp lamp;
  if (!j.isObject({"name", "type", "position", "direction", "up", "flux", "intensity", "luminance", "temperature", "color", "innerCone", "outerCone", "width", "height"})) return lamp;
  lamp.name = j.text("name", fmt::format("lamp {}", number + 1));
  lamp.position = j["position"].vector(-kFarthestM, kFarthestM);
  const Vec3 c = colour(j);
  const std::string type = j["type"].oneOf({"point", "spot", "area"});
  const auto forbid = [&](std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
      if (j.has(key)) j[key].fail(fmt::format("means nothing for a lamp of type {}", type));
    }
  };
  if (type == "area") {
    lamp.kind = LampKind::Area;
    forbid({"intensity", "innerCone", "outerCone"});
    readArea(j, lamp);
    const std::string unit = theOne(j, {"flux", "luminance"});
    const double area = static_cast<double>(lamp.widthM) * lamp.heightM;
    if (unit == "flux") lamp.luminanceCdM2 = c * static_cast<float>(j["flux"].quantity(Unit::Lumen, 0, kMostLight) / (kPi * std::max(area, 1e-8)));
    if (unit == "luminance") lamp.luminanceCdM2 = c * static_cast<float>(j["luminance"].quantity(Unit::CandelaPerM2, 0, kMostLight));
    if (luminance(lamp.luminanceCdM2) > 1.001 * kMostLight) j["flux"].fail("is more than 1e12 cd/m2 on so small an area");
    return lamp;
  }
  forbid({"luminance", "width", "height", "up"});
  double fluxPerCandela = 4 * kPi;
  if (type == "spot") {
    lamp.kind = LampKind::Spot;
    readSpot(j, lamp);
    fluxPerCandela = spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad));
  } else {
    forbid({"direction", "innerCone", "outerCone"});
  }
  const std::string unit = theOne(j, {"flux", "intensity"});
  if (unit == "flux") lamp.intensityCd = c * static_cast<float>(j["flux"].quantity(Unit::Lumen, 0, kMostLight) / fluxPerCandela);
  if (unit == "intensity") lamp.intensityCd = c * static_cast<float>(j["intensity"].quantity(Unit::Candela, 0, kMostLight));
  return lamp;
}

}  // namespace roomlight::importers
