#include "import/sh3d_environment.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "import/lighting_sky.h"
#include "import/sh3d_cameras.h"
#include "import/sh3d_surfaces.h"
#include "import/sh3d_time_zone.h"
#include "photometry/cie_sky.h"
#include "photometry/sky_image.h"
#include "photometry/sun.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr int kClearSky = 12;
constexpr double kSunDiameterDeg = 0.533, kDegrees = 180 / std::numbers::pi;
constexpr double kGroundMarginCm = 500, kGroundDepthCm = 1;
constexpr uint32_t kUsualGround = 0xa8a8a8;
constexpr int64_t kLatestMs = 4'102'444'800'000;  // the year 2100; the sun's formulas do not hold far beyond

Moment momentOf(int64_t wallSeconds, int offsetSeconds) {
  const std::chrono::sys_seconds at{std::chrono::seconds(wallSeconds - offsetSeconds)};
  const auto day = std::chrono::floor<std::chrono::days>(at);
  const std::chrono::year_month_day date(day);
  return {static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())), static_cast<int>(static_cast<unsigned>(date.day())),
          static_cast<double>((at - day).count()) / 3600};
}

Vec3 hue(uint32_t rgb) {
  const Vec3 c = linearColour(rgb);
  return isBlack(c) ? Vec3(1) : c / luminance(c);
}

double angleRad(Vec3 a, Vec3 b) { return std::acos(std::clamp(static_cast<double>(dot(a, b)), -1.0, 1.0)); }

void addDaylight(const Home& home, Vec3 groundReflectance, Scene& scene, Warnings& warnings) {
  const Camera* camera = cameraInUse(home);
  if (!home.compass || !home.compass->latitudeRad || !home.compass->longitudeRad || !camera || !camera->timeMs || std::abs(*camera->timeMs) > kLatestMs) {
    warnings.add("the home does not say where it stands, or when it is seen: there is no daylight; a lighting file can give it");
    return;
  }
  const Compass& compass = *home.compass;
  const int64_t wallSeconds = *camera->timeMs / 1000;
  auto offset = utcOffsetSeconds(compass.timeZone, wallSeconds);
  if (!offset) {
    warnings.add("the compass' time zone is unknown; the time is taken as that of the longitude");
    offset = static_cast<int>(std::lround(*compass.longitudeRad * kDegrees / 15)) * 3600;
  }
  const Moment moment = momentOf(wallSeconds, *offset);
  const SunPosition position = sunPosition(moment, *compass.latitudeRad * kDegrees, *compass.longitudeRad * kDegrees);
  if (position.altitudeRad <= 0) return;
  Sun sun;
  sun.name = "sun";
  // North stands at that angle clockwise from the plan's up, -z: so -z bears the opposite angle.
  sun.toLight = towardsSun(position, -compass.northRad * kDegrees);
  sun.halfAngleRad = static_cast<float>(kSunDiameterDeg / 2 / kDegrees);
  sun.illuminanceLux = Vec3(static_cast<float>(sunLux(moment, position.altitudeRad, sunExtinction(skyCover(kClearSky)))));
  const Vec3 colour = hue(home.environment.skyColour.value_or(0xffffff));
  const double skyLux = skyHorizontalLux(skyCover(kClearSky), position.altitudeRad);
  const Vec3 groundLux = colour * static_cast<float>(skyLux) + sun.illuminanceLux * std::max(sun.toLight.y, 0.0f);
  const Vec3 toSun = sun.toLight;
  const double zenithRad = angleRad(toSun, {0, 1, 0});
  scene.sky.image = skyImage([=](Vec3 d) { return cieSkyLuminance(kClearSky, static_cast<double>(d.y), angleRad(d, toSun), zenithRad); }, skyLux, colour,
                             groundLux * groundReflectance / kPi);
  scene.sky.horizonEdge = true;
  scene.suns.push_back(std::move(sun));
}

// A rectangle around the home without the rooms that lie below it.
void addGround(const Home& home, int material, Scene& scene, int& object) {
  const Bounds3 b = scene.bounds();
  if (b.empty()) return;
  const double x0 = static_cast<double>(b.lo.x) * 100 - kGroundMarginCm, x1 = static_cast<double>(b.hi.x) * 100 + kGroundMarginCm;
  const double y0 = static_cast<double>(b.lo.z) * 100 - kGroundMarginCm, y1 = static_cast<double>(b.hi.z) * 100 + kGroundMarginCm;
  PlanArea area{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
  for (const Room& room : home.rooms) {
    if (isShown(home, room.level) && elevationOf(home, room.level) < -kGroundDepthCm) area = subtracted(area, {room.points});
  }
  Surfaces surfaces;
  const auto corner = [&](PlanPoint p) {
    return SurfaceCorner{toWorld(p, -kGroundDepthCm), {static_cast<float>(p.x / 100), static_cast<float>(p.y / 100)}};
  };
  for (const PlanTriangle& t : trianglesOf(area)) surfaces.triangle(material, corner(t[0]), corner(t[1]), corner(t[2]), {0, 1, 0});
  surfaces.finish(scene, "ground", object++);
}

}  // namespace

void addEnvironment(const Home& home, Paints& paints, Scene& scene, int& object, Warnings& warnings) {
  const Environment& env = home.environment;
  Paint ground;
  ground.colour = env.groundColour.value_or(kUsualGround);
  ground.texture = env.groundTexture;
  const int material = paints.material(ground, "ground");
  if (env.skyTexture) warnings.add("the sky's picture is left out: the sky is a clear one of that time");
  addDaylight(home, linearColour(*ground.colour) * kWhiteReflectance, scene, warnings);
  addGround(home, material, scene, object);
}

}  // namespace roomlight::importers::sh3d
