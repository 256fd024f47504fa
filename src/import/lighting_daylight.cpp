#include "import/lighting_daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/utf8.h"
#include "import/failure.h"
#include "import/file_access.h"
#include "import/lighting_values.h"
#include "photometry/colour_temperature.h"
#include "photometry/sky_image.h"
#include "photometry/sky_luminance.h"
#include "photometry/sun.h"

namespace roomlight {
namespace {

constexpr double kSunDiameterDeg = 0.533, kGroundReflectance = 0.2;

// Where the sun stands; in the zenith where it does not matter.
struct When {
  std::optional<Moment> moment;  // not by direction
  Vec3 toSun{0, 1, 0};
  double altitudeRad = std::numbers::pi / 2;
};

// Where the weather was measured, if nothing else is said.
When readWhen(const JsonPlace& j, const Epw* weather) {
  When when;
  if (j.has("direction")) {
    forbid(j, {"latitude", "longitude", "time", "north"}, "beside 'direction'");
    when.toSun = readDirection(j["direction"]);
    when.altitudeRad = std::asin(std::clamp(static_cast<double>(when.toSun.y), -1.0, 1.0));
    return when;
  }
  const double latitude = weather ? j.number("latitude", -90, 90, weather->latitudeDeg) : j["latitude"].number(-90, 90);
  const double longitude =
      weather ? j.number("longitude", -180, 180, weather->longitudeDeg) : j["longitude"].number(-180, 180);
  const double north = j.number("north", -360, 360, 0);
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
  const std::string word = j.oneOf({"overcast", "intermediate", "clear", "perez"});
  if (word == "overcast") return 16;
  return word == "intermediate" ? 7 : 12;
}

// What the formulas say of sky and sun, in lux: the sky on level ground, the sun on a surface that faces it.
struct DaylightLux {
  double sky = 0, sun = 0;
};

DaylightLux cieLux(const JsonPlace& j, const When& when, int type) {
  DaylightLux lux;
  const SkyCover cover = skyCover(type);
  lux.sky = j.has("horizontalIlluminance") ? j["horizontalIlluminance"].quantity(Unit::Lux, 0, 1e9)
                                           : skyHorizontalLux(cover, when.altitudeRad);
  if (j.has("sunIlluminance")) {
    lux.sun = j["sunIlluminance"].quantity(Unit::Lux, 0, 1e9);
  } else if (cover != SkyCover::Overcast) {
    lux.sun = when.moment ? sunLux(*when.moment, when.altitudeRad, sunExtinction(cover)) : 0;
    if (!when.moment) j.fail("'sunIlluminance' is needed beside 'direction'; write \"0 lx\" for a sky without a sun");
  }
  return lux;
}

double angleRad(Vec3 a, Vec3 b) { return std::acos(std::clamp(static_cast<double>(dot(a, b)), -1.0, 1.0)); }

SkyFunction cieSky(int type, const When& when) {
  const Vec3 sun = sunInSky(when.toSun);
  const double zenithRad = angleRad(sun, {0, 1, 0});
  return [=](Vec3 d) { return cieSkyLuminance(type, static_cast<double>(d.y), angleRad(d, sun), zenithRad); };
}

// What was measured: irradiance and, where a weather file has them, lux.
struct Measured {
  SkyIrradiance irradiance;
  std::optional<double> skyLux, sunLux;
  double waterCm = kUsualWaterCm;
};

Measured readMeasured(const JsonPlace& j) {
  return {
      {j["directNormal"].quantity(Unit::WattPerM2, 0, 2000), j["diffuseHorizontal"].quantity(Unit::WattPerM2, 0, 2000)},
      {},
      {},
      kUsualWaterCm};
}

Measured measuredAt(const JsonPlace& j, const Epw& weather, const Moment& moment) {
  const EpwHour* hour = hourAt(weather, moment);
  if (!hour) {
    j["weather"].fail("has no weather of that hour; see 'time'");
    return {};
  }
  if (!hour->directNormalWm2 || !hour->diffuseHorizontalWm2) {
    j["weather"].fail(fmt::format("has no irradiance of month {} day {} hour {}", hour->month, hour->day, hour->hour));
    return {};
  }
  Measured m{{*hour->directNormalWm2, *hour->diffuseHorizontalWm2},
             hour->diffuseHorizontalLux,
             hour->directNormalLux,
             kUsualWaterCm};
  if (hour->dewPointC) m.waterCm = precipitableWaterCm(*hour->dewPointC);
  return m;
}

Vec3 colourOf(const JsonPlace& j, const char* key) {
  return j.has(key) ? blackBodyColour(j[key].quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin)) : Vec3(1);
}

constexpr double kSunshineWm2 = 120;

// A number, or red, green and blue.
Vec3 groundReflectance(const JsonPlace& j) {
  if (j.has("ground") && j["ground"].isArray()) return j["ground"].vector(0, 1);
  return Vec3(static_cast<float>(j.number("ground", 0, 1, kGroundReflectance)));
}

// The two together, with the ground that they light.
Daylight lit(const JsonPlace& j, const When& when, DaylightLux lux, const SkyFunction& luminance, bool clear) {
  Daylight out;
  if (when.altitudeRad <= 0) lux.sun = 0;
  const Vec3 skyColour = readColour(j), sunColour = colourOf(j, "sunTemperature");
  out.sun.name = "sun";
  out.sun.toLight = when.toSun;
  out.sun.illuminanceLux = sunColour * static_cast<float>(lux.sun);
  out.sun.halfAngleRad = static_cast<float>(rad(kSunDiameterDeg / 2));
  const Vec3 levelSunLux = sunColour * static_cast<float>(lux.sun * std::max(std::sin(when.altitudeRad), 0.0));
  if (lux.sky <= 0 && isBlack(levelSunLux)) return out;
  SkyColour colour(skyColour);
  colour.miredPerDecade = clear ? kClearSkyMiredPerDecade : 0;
  out.sky.image = skyImage(luminance, lux.sky, colour);
  paintGround(out.sky.image, groundReflectance(j), levelSunLux, kHazeRad);
  out.sky.horizonEdge = true;
  return out;
}

// The all-weather sky of what was measured. Clear where the sun shines (WMO: from 120 W/m² on).
Daylight perezDaylight(const JsonPlace& j, const When& when, const Measured& measured) {
  if (measured.irradiance.diffuseHorizontal <= 0) {
    if (measured.irradiance.directNormal > 0)
      j.fail("direct light without any diffuse light is no sky; is one of the two missing?");
    return {};
  }
  const Vec3 sun = sunInSky(when.toSun);
  const double outsideWm2 = kSolarConstant * (when.moment ? sunDistanceFactor(*when.moment) : 1);
  const PerezSky sky = perezSky(measured.irradiance, angleRad(sun, {0, 1, 0}), outsideWm2, measured.waterCm);
  const DaylightLux lux{measured.skyLux.value_or(sky.diffuseEfficacy * measured.irradiance.diffuseHorizontal),
                        measured.sunLux.value_or(sky.directEfficacy * measured.irradiance.directNormal)};
  return lit(
      j, when, lux, [=](Vec3 d) { return perezLuminance(sky, static_cast<double>(d.y), angleRad(d, sun)); },
      measured.irradiance.directNormal > kSunshineWm2);
}

Daylight cieDaylight(const JsonPlace& j) {
  forbid(j, {"directNormal", "diffuseHorizontal"}, "beside a CIE sky; write \"sky\": \"perez\"");
  const int type = readCieType(j["sky"]);
  // Some skies are the same at any time; the sun then needs to be known only for how much light there is.
  const bool anyTime = !dependsOnSun(type) && j.has("horizontalIlluminance") && !j.has("sunIlluminance");
  When when;
  if (!anyTime || j.has("time") || j.has("direction")) when = readWhen(j, nullptr);
  return lit(j, when, cieLux(j, when, type), cieSky(type, when), skyCover(type) == SkyCover::Clear);
}

}  // namespace

std::optional<Epw> readWeather(const JsonPlace& j, const std::filesystem::path& folder) {
  const std::string name = j.text();
  try {
    const importers::Bytes bytes = importers::readWholeFile(folder / name, printable(name, 200));
    Result<Epw> weather = parseEpw({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (weather) return std::move(weather).value();
    j.fail(printable(name, 200) + ": " + weather.error());
  } catch (const importers::Failure& failure) {
    j.fail(failure.what());
  }
  return {};
}

Daylight readDaylight(const JsonPlace& j, const std::filesystem::path& folder, const Epw* weather) {
  if (!j.isObject({"sky", "latitude", "longitude", "time", "north", "direction", "horizontalIlluminance",
                   "sunIlluminance", "directNormal", "diffuseHorizontal", "weather", "ground", "temperature", "color",
                   "sunTemperature"}))
    return {};
  const bool byWeather = j.has("weather");
  if (!byWeather && !(j.has("sky") && j["sky"].isText("perez"))) return cieDaylight(j);
  forbid(j, {"horizontalIlluminance", "sunIlluminance"}, "beside measured irradiance");
  if (!byWeather) {
    const When when = readWhen(j, nullptr);
    return perezDaylight(j, when, readMeasured(j));
  }
  if (j.has("sky")) j["sky"].oneOf({"perez"});
  forbid(j, {"directNormal", "diffuseHorizontal", "direction"}, "beside 'weather'");
  std::optional<Epw> read;
  if (!weather) {
    read = readWeather(j["weather"], folder);
    if (!read) return {};
    weather = &*read;
  }
  const When when = readWhen(j, weather);
  return when.moment ? perezDaylight(j, when, measuredAt(j, *weather, *when.moment)) : Daylight{};
}

}  // namespace roomlight
