#include "import/lighting_daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/image_io.h"
#include "import/lighting_values.h"

namespace roomlight {
namespace {

// Illuminance that an equirectangular picture gives to a horizontal surface, in its own unit.
double horizontalIlluminance(const Image& image) {
  double sum = 0;
  for (int y = 0; 2 * y < image.height; ++y) {
    // Exact integral of cos over a row; of an odd number of rows the middle one counts with its upper half.
    const double low = std::sin(std::numbers::pi * y / image.height),
                 high = std::sin(std::min(0.5, (y + 1.0) / image.height) * std::numbers::pi);
    double row = 0;
    for (int x = 0; x < image.width; ++x) row += luminance(image.at(x, y));
    sum += row * 0.5 * (high * high - low * low);
  }
  return sum * 2 * std::numbers::pi / image.width;
}

void readSkyImage(const JsonPlace& j, const std::filesystem::path& folder, Sky& sky) {
  const std::filesystem::path file = folder / j["image"].text();
  // Opening a pipe or a terminal would wait for it.
  std::error_code code;
  if (std::filesystem::exists(file, code) && !std::filesystem::is_regular_file(file, code)) {
    j["image"].fail("is not a file");
    return;
  }
  Result<Image> image = readImage(file);
  if (!image) {
    j["image"].fail(image.error());
    return;
  }
  sky.image = std::move(image.value());
  double factor = 1;
  const std::string unit = theOne(j, {"unit", "horizontalIlluminance"});
  if (unit == "unit") factor = j["unit"].quantity(Unit::CandelaPerM2, 0, kMostLight);
  if (unit == "horizontalIlluminance") {
    const double now = horizontalIlluminance(sky.image);
    const double wanted = j["horizontalIlluminance"].quantity(Unit::Lux, 0, kMostLight);
    if (!(now > 0)) j["horizontalIlluminance"].fail("the picture's upper half is black");
    factor = wanted / std::max(now, 1e-30);
  }
  for (Vec3& p : sky.image.pixels) {
    p *= static_cast<float>(factor);
    if (!(minComponent(p) >= 0) || !(maxComponent(p) < kMostLight)) {
      j["image"].fail("holds values that are negative, not finite or beyond 1e12 cd/m2");
      return;
    }
  }
}

}  // namespace

Vec3 towardsSun(const SunPosition& position, double northDeg) {
  const double bearing = position.bearingRad - rad(northDeg);  // from the scene's -z axis, clockwise seen from above
  return normalize(Vec3{static_cast<float>(std::sin(bearing) * std::cos(position.altitudeRad)),
                        static_cast<float>(std::sin(position.altitudeRad)),
                        static_cast<float>(-std::cos(bearing) * std::cos(position.altitudeRad))});
}

Sun readSun(const JsonPlace& j) {
  Sun sun;
  if (!j.isObject({"name", "direction", "latitude", "longitude", "time", "north", "illuminance", "angularDiameter",
                   "temperature", "color"}))
    return sun;
  sun.name = j.text("name", "sun");
  sun.halfAngleRad = static_cast<float>(rad(j.number("angularDiameter", 0, 90, 0.533) / 2));
  const Vec3 c = readColour(j);
  double lux = 0;
  if (j.has("direction")) {
    for (const char* key : {"latitude", "longitude", "time", "north"}) {
      if (j.has(key)) j[key].fail("give 'direction' or place and time, not both");
    }
    sun.toLight = readDirection(j["direction"]);
    lux = j["illuminance"].quantity(Unit::Lux, 0, kMostLight);
  } else {
    const double latitude = j["latitude"].number(-90, 90), longitude = j["longitude"].number(-180, 180),
                 north = j.number("north", -360, 360, 0);
    const Result<Moment> moment = parseMoment(j["time"].text());
    if (!moment) {
      j["time"].fail(moment.error());
      return sun;
    }
    const SunPosition p = sunPosition(moment.value(), latitude, longitude);
    sun.toLight = towardsSun(p, north);
    lux = j.has("illuminance") ? j["illuminance"].quantity(Unit::Lux, 0, kMostLight)
                               : sunLux(moment.value(), p.altitudeRad);
    if (p.altitudeRad <= 0) lux = 0;
  }
  sun.illuminanceLux = c * static_cast<float>(lux);
  return sun;
}

Sky readSky(const JsonPlace& j, const std::filesystem::path& folder) {
  Sky sky;
  if (!j.isObject({"luminance", "temperature", "color", "image", "unit", "horizontalIlluminance", "rotation"}))
    return sky;
  sky.rotationRad = static_cast<float>(rad(j.number("rotation", -360, 360, 0)));
  const std::string kind = theOne(j, {"luminance", "image"});
  if (kind == "image") {
    forbid(j, {"temperature", "color"}, "beside 'image'");
    readSkyImage(j, folder, sky);
  } else if (kind == "luminance") {
    forbid(j, {"unit", "horizontalIlluminance"}, "beside 'luminance'");
    sky.luminanceCdM2 = readColour(j) * static_cast<float>(j["luminance"].quantity(Unit::CandelaPerM2, 0, kMostLight));
  }
  return sky;
}

}  // namespace roomlight
