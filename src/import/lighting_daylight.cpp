#include "import/lighting_daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "import/lighting_sky.h"
#include "import/lighting_values.h"
#include "photometry/cie_sky.h"
#include "photometry/colour_temperature.h"
#include "photometry/sky_image.h"
#include "photometry/sun.h"

namespace roomlight {
namespace {

constexpr double kSunDiameterDeg = 0.533, kGroundReflectance = 0.2;

// Where the sun stands, if the file says so.
struct When {
  bool known = false;
  std::optional<Moment> moment;  // not by direction
  Vec3 toSun{0, 1, 0};
  double altitudeRad = std::numbers::pi / 2;
};

When readWhen(const JsonPlace& j) {
  When when;
  when.known = true;
  if (j.has("direction")) {
    forbid(j, {"latitude", "longitude", "time", "north"}, "beside 'direction'");
    when.toSun = readDirection(j["direction"]);
    when.altitudeRad = std::asin(std::clamp(static_cast<double>(when.toSun.y), -1.0, 1.0));
    return when;
  }
  const double latitude = j["latitude"].number(-90, 90), longitude = j["longitude"].number(-180, 180), north = j.number("north", -360, 360, 0);
  const Result<Moment> moment = parseMoment(j["time"].text());
  if (!moment) {
    j["time"].fail(moment.error());
    return when;
  }
  const SunPosition p = sunPosition(moment.value(), latitude, longitude);
  when.moment = moment.value();
  when.toSun = towardsSun(p, north);
  when.altitudeRad = p.altitudeRad;
  return when;
}

int readCieType(const JsonPlace& j) {
  if (j.isNumber()) {
    const double type = j.number(1, kCieSkyTypes);
    if (type != std::floor(type)) j.fail("must be a whole number");
    return static_cast<int>(type);
  }
  const std::string word = j.oneOf({"overcast", "intermediate", "clear"});
  return word == "overcast" ? 16 : word == "intermediate" ? 7
                                                          : 12;
}

// What the formulas say of sky and sun, in lux: the sky on level ground, the sun on a surface that faces it.
struct DaylightLux {
  double sky = 0, sun = 0;
};

DaylightLux cieLux(const JsonPlace& j, const When& when, int type) {
  DaylightLux lux;
  const SkyCover cover = skyCover(type);
  lux.sky = j.has("horizontalIlluminance") ? j["horizontalIlluminance"].quantity(Unit::Lux, 0, 1e9) : skyHorizontalLux(cover, when.altitudeRad);
  if (j.has("sunIlluminance")) {
    lux.sun = j["sunIlluminance"].quantity(Unit::Lux, 0, 1e9);
  } else if (cover != SkyCover::Overcast) {
    lux.sun = when.moment ? sunLux(*when.moment, when.altitudeRad, sunExtinction(cover)) : 0;
    if (!when.moment) j["sunIlluminance"].fail("is needed beside 'direction'; \"0 lx\" for a sky without a sun");
  }
  return lux;
}

// Angle between a direction and the sun; a sun below the horizon makes the sky as one on it.
double angleRad(Vec3 a, Vec3 b) { return std::acos(std::clamp(static_cast<double>(dot(a, b)), -1.0, 1.0)); }

SkyFunction cieSky(int type, const When& when) {
  Vec3 sun = when.toSun;
  if (sun.y < 0) sun.y = 0, sun = length(sun) > 0 ? normalize(sun) : Vec3{0, 0, -1};
  const double zenithRad = angleRad(sun, {0, 1, 0});
  return [=](Vec3 d) { return cieSkyLuminance(type, static_cast<double>(d.y), angleRad(d, sun), zenithRad); };
}

Vec3 colourOf(const JsonPlace& j, const char* key) {
  return j.has(key) ? blackBodyColour(j[key].quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin)) : Vec3(1);
}

// The two together, with the ground that they light.
Daylight lit(const JsonPlace& j, const When& when, DaylightLux lux, const SkyFunction& luminance) {
  Daylight out;
  if (when.altitudeRad <= 0) lux.sun = 0;
  const Vec3 skyColour = readColour(j), sunColour = colourOf(j, "sunTemperature");
  out.sun.name = "sun";
  out.sun.toLight = when.toSun;
  out.sun.illuminanceLux = sunColour * static_cast<float>(lux.sun);
  out.sun.halfAngleRad = static_cast<float>(rad(kSunDiameterDeg / 2));
  const double reflectance = j.number("ground", 0, 1, kGroundReflectance);
  const Vec3 groundLux = skyColour * static_cast<float>(lux.sky) + sunColour * static_cast<float>(lux.sun * std::sin(when.altitudeRad));
  if (isBlack(groundLux)) return out;
  out.sky.image = skyImage(luminance, lux.sky, skyColour, groundLux * static_cast<float>(reflectance / std::numbers::pi));
  out.sky.horizonEdge = true;
  return out;
}

}  // namespace

Daylight readDaylight(const JsonPlace& j, const std::filesystem::path&) {
  if (!j.isObject({"sky", "latitude", "longitude", "time", "north", "direction", "horizontalIlluminance", "sunIlluminance", "ground", "temperature", "color", "sunTemperature"})) return {};
  const int type = readCieType(j["sky"]);
  // Some skies are the same at any time; the sun then needs to be known only for how much light there is.
  const bool anyTime = !dependsOnSun(type) && j.has("horizontalIlluminance") && !j.has("sunIlluminance");
  When when;
  if (!anyTime || j.has("time") || j.has("direction")) when = readWhen(j);
  return lit(j, when, cieLux(j, when, type), cieSky(type, when));
}

}  // namespace roomlight
