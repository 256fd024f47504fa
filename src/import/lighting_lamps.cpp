#include "import/lighting_lamps.h"

#include <fmt/format.h>

#include "base/utf8.h"
#include "import/lighting_values.h"
#include "photometry/spot.h"

namespace roomlight::importers {
namespace {

void readSpot(const JsonPlace& j, Lamp& lamp) {
  lamp.direction = readDirection(j["direction"]);
  const double outer = j.number("outerCone", 0.5, 90, 45), inner = j.number("innerCone", 0, 90, 0);
  if (inner > outer) j["innerCone"].fail("must not be larger than outerCone");
  lamp.outerConeRad = static_cast<float>(rad(outer));
  lamp.innerConeRad = static_cast<float>(rad(inner));
}

Vec3 readUp(const JsonPlace& j, Vec3 axis, Vec3 otherwise) {
  const Vec3 up = perpendicular(j.has("up") ? readDirection(j["up"]) : otherwise, axis);
  if (!isBlack(up)) return up;
  j["up"].fail("must not point along 'direction'");
  return perpendicular(std::abs(axis.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, axis);
}

void readArea(const JsonPlace& j, Lamp& lamp) {
  lamp.direction = readDirection(j["direction"]);
  lamp.widthM = static_cast<float>(j["width"].number(1e-4, 1000));
  lamp.heightM = static_cast<float>(j["height"].number(1e-4, 1000));
  lamp.up = readUp(j, lamp.direction, std::abs(lamp.direction.y) < 0.99f ? Vec3{0, 1, 0} : Vec3{0, 0, -1});
}

// The web's own flux, unless the file says another.
void readPhotometric(const JsonPlace& j, Vec3 c, double factor, const std::filesystem::path& folder,
                     PhotometricFiles& files, Lamp& lamp) {
  lamp.direction = j.has("direction") ? readDirection(j["direction"]) : Vec3{0, -1, 0};
  lamp.up = readUp(j, lamp.direction, std::abs(lamp.direction.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const double flux = j.has("flux") ? j["flux"].quantity(Unit::Lumen, 0, kMostLight) : -1;
  const std::string as = j.has("as") ? j["as"].oneOf({"point", "area"}) : "";
  const Result<PhotometricFiles::Web> web = files.read(folder / j["file"].text());
  if (!web) return j["file"].fail(fmt::format("'{}': {}", printable(j["file"].text()), printable(web.error(), 300)));
  if (as == "area" && !web.value()->hasOpening())
    return j["as"].fail("must be point: the file states no luminous opening");
  setWeb(lamp, web.value(),
         as == "point"  ? LampSize::Point
         : as == "area" ? LampSize::Area
                        : LampSize::AsStated,
         c, flux, factor);
  if (!(luminance(lamp.intensityCd) <= 1.001f * static_cast<float>(kMostLight)))
    j["flux"].fail("makes an intensity above 1e12 cd");
}

Lamp readKind(const JsonPlace& j, size_t number, const std::filesystem::path& folder, PhotometricFiles& files) {
  Lamp lamp;
  if (!j.isObject({"name",      "group",     "type",        "position", "direction",       "up",        "flux",
                   "intensity", "luminance", "temperature", "color",    "innerCone",       "outerCone", "width",
                   "height",    "file",      "as",          "dimming",  "lightLossFactor", "watts"}))
    return lamp;
  lamp.name = j.text("name", fmt::format("lamp {}", number + 1));
  lamp.group = j.text("group", "");
  lamp.position = j["position"].vector(-kFarthestM, kFarthestM);
  const Vec3 c = readColour(j);
  const double factor = j.number("dimming", 0, 1, 1) * j.number("lightLossFactor", 1e-6, 1, 1);
  const std::string type = j["type"].oneOf({"point", "spot", "area", "photometric"});
  const std::string why = "for a lamp of type " + type;
  if (type == "photometric") {
    forbid(j, {"intensity", "luminance", "innerCone", "outerCone", "width", "height"}, why);
    readPhotometric(j, c, factor, folder, files, lamp);
    return lamp;
  }
  forbid(j, {"file", "as"}, why);
  if (type == "area") {
    lamp.kind = LampKind::Area;
    forbid(j, {"intensity", "innerCone", "outerCone"}, why);
    readArea(j, lamp);
    const std::string unit = theOne(j, {"flux", "luminance"});
    const double area = static_cast<double>(lamp.widthM) * lamp.heightM;
    if (unit == "flux")
      lamp.luminanceCdM2 =
          c * static_cast<float>(j["flux"].quantity(Unit::Lumen, 0, kMostLight) / (kPi * std::max(area, 1e-8)));
    if (unit == "luminance")
      lamp.luminanceCdM2 = c * static_cast<float>(j["luminance"].quantity(Unit::CandelaPerM2, 0, kMostLight));
    if (luminance(lamp.luminanceCdM2) > 1.001 * kMostLight)
      j["flux"].fail("is more than 1e12 cd/m2 on so small an area");
    lamp.luminanceCdM2 *= static_cast<float>(factor);
    return lamp;
  }
  forbid(j, {"luminance", "width", "height", "up"}, why);
  double fluxPerCandela = 4 * kPi;
  if (type == "spot") {
    lamp.kind = LampKind::Spot;
    readSpot(j, lamp);
    fluxPerCandela = spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad));
  } else {
    forbid(j, {"direction", "innerCone", "outerCone"}, why);
  }
  const std::string unit = theOne(j, {"flux", "intensity"});
  if (unit == "flux")
    lamp.intensityCd = c * static_cast<float>(j["flux"].quantity(Unit::Lumen, 0, kMostLight) / fluxPerCandela);
  if (unit == "intensity")
    lamp.intensityCd = c * static_cast<float>(j["intensity"].quantity(Unit::Candela, 0, kMostLight));
  lamp.intensityCd *= static_cast<float>(factor);
  return lamp;
}

}  // namespace

Lamp readLamp(const JsonPlace& j, size_t number, const std::filesystem::path& folder, PhotometricFiles& files) {
  Lamp lamp = readKind(j, number, folder, files);
  if (j.has("watts")) lamp.wattsW = static_cast<float>(j["watts"].number(0, 1e6));
  return lamp;
}

}  // namespace roomlight::importers
