#include "import/sh3d_environment.h"

#include <cctz/time_zone.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <numbers>

#include "import/lighting_daylight.h"
#include "import/sh3d_draft.h"
#include "import/sh3d_plan.h"
#include "photometry/sky_image.h"
#include "photometry/sky_luminance.h"
#include "photometry/sun.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr int kClearSky = 12, kSkyWidth = 1024;
constexpr double kSunDiameterDeg = 0.533, kDegrees = 180 / std::numbers::pi;
constexpr double kGroundMarginCm = 500, kGroundDepthCm = 1;
constexpr uint32_t kUsualGround = 0xa8a8a8;
constexpr int64_t kLatestMs = 4'102'444'800'000;  // the year 2100; the sun's formulas do not hold far beyond

Moment momentOf(int64_t wallSeconds, int offsetSeconds) {
  const std::chrono::sys_seconds at{std::chrono::seconds(wallSeconds - offsetSeconds)};
  const auto day = std::chrono::floor<std::chrono::days>(at);
  const std::chrono::year_month_day date(day);
  return {static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day())), static_cast<double>((at - day).count()) / 3600};
}

// Neither a path out of the folder of zones nor one of cctz's own notations ("file:", "libc:").
bool isZoneName(const std::string& zone) {
  if (zone.empty() || zone.size() > 100 || zone.front() == '/') return false;
  return std::all_of(zone.begin(), zone.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '/' || c == '_' || c == '-' || c == '+'; });
}

Vec3 hue(uint32_t rgb) {
  const Vec3 c = linearColour(rgb);
  return isBlack(c) ? Vec3(1) : c / luminance(c);
}

// A half sphere's picture by direction.
class SkyPicture {
 public:
  SkyPicture(const Texture& t, double xOffset) : t_(t), xOffset_(xOffset) {}

  Vec3 at(Vec3 d) const {
    const double turn =
        std::atan2(static_cast<double>(d.z), static_cast<double>(d.x)) / (2 * std::numbers::pi) - xOffset_;
    const double altitude = std::asin(std::clamp(static_cast<double>(d.y), 0.0, 1.0)) * 2 / std::numbers::pi;
    const int x = std::min(static_cast<int>((turn - std::floor(turn)) * t_.width), t_.width - 1);
    const int y = std::min(static_cast<int>((1 - altitude) * t_.height), t_.height - 1);
    const uint8_t* texel =
        t_.rgba.data() + 4 * (static_cast<size_t>(y) * static_cast<size_t>(t_.width) + static_cast<size_t>(x));
    return linearColour(static_cast<uint32_t>(texel[0]) << 16 | static_cast<uint32_t>(texel[1]) << 8 | texel[2]);
  }

 private:
  const Texture& t_;
  double xOffset_;
};

double angleRad(Vec3 a, Vec3 b) { return std::acos(std::clamp(static_cast<double>(dot(a, b)), -1.0, 1.0)); }

// The sky's picture goes once around: its left edge stands towards +x, the columns to its right turn clockwise seen
// from above, its bottom row lies at the horizon and its top row at the zenith, as the 3D view shows it. A level
// surface has `skyLux` from it. None where it is black.
Image pictureSky(const Texture& picture, double xOffset, double skyLux, Vec3 tint) {
  const SkyPicture sky(picture, xOffset);
  const double now = horizontalIlluminance([&](Vec3 d) { return static_cast<double>(luminance(sky.at(d) * tint)); });
  if (!(now > 0)) return {};
  const float factor = static_cast<float>(skyLux / now);
  Image image(kSkyWidth, kSkyWidth / 2);
  for (int y = 0; 2 * y < image.height; ++y) {
    const double altitude = std::numbers::pi * (0.5 - (y + 0.5) / image.height);
    for (int x = 0; x < image.width; ++x) {
      const double bearing = 2 * std::numbers::pi * ((x + 0.5) / image.width - 0.5);
      const Vec3 d{static_cast<float>(std::sin(bearing) * std::cos(altitude)), static_cast<float>(std::sin(altitude)),
                   static_cast<float>(-std::cos(bearing) * std::cos(altitude))};
      image.at(x, y) = sky.at(d) * tint * factor;
    }
  }
  return image;
}

// For other times than the home's: like its own, but for its sky's picture and the hue of its sun.
std::string daylightJson(const Home& home, int64_t wallSeconds, int offsetSeconds, Vec3 groundReflectance) {
  const Compass& compass = *home.compass;
  const std::chrono::sys_seconds wall{std::chrono::seconds(wallSeconds)};
  const auto day = std::chrono::floor<std::chrono::days>(wall);
  const std::chrono::year_month_day date(day);
  const auto second = static_cast<int>((wall - day).count());
  const int offset = std::abs(offsetSeconds) / 60;
  const Vec3 sky =
      hue(home.environment.skyColour.value_or(0xffffff)) * hue(home.environment.lightColour.value_or(0xffffff));
  return fmt::format(
      R"({{"sky": "clear", "latitude": {:.6f}, "longitude": {:.6f}, "north": {:.4f}, "ground": [{:.4f}, {:.4f}, {:.4f}], "color": [{:.5f}, {:.5f}, {:.5f}], "time": "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}{:02}:{:02}"}})",
      *compass.latitudeRad * kDegrees, *compass.longitudeRad * kDegrees,
      std::remainder(-compass.northRad * kDegrees, 360.0), groundReflectance.x, groundReflectance.y,
      groundReflectance.z, sky.x, sky.y, sky.z, static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
      static_cast<unsigned>(date.day()), second / 3600, second / 60 % 60, second % 60, offsetSeconds < 0 ? '-' : '+',
      offset / 60, offset % 60);
}

std::string addDaylight(const Home& home, const Paints& paints, const std::string& wantedCamera, Vec3 groundReflectance,
                        Scene& scene, Warnings& warnings) {
  const Camera* camera = cameraOfTime(home, wantedCamera);
  if (!home.compass || !home.compass->latitudeRad || !home.compass->longitudeRad || !camera || !camera->timeMs ||
      std::abs(*camera->timeMs) > kLatestMs) {
    warnings.add(
        "the home does not say where it stands, or when it is seen: there is no daylight; a lighting file can give it");
    return {};
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
  std::string otherTimes = daylightJson(home, wallSeconds, *offset, groundReflectance);
  Sun sun;
  sun.name = "sun";
  // North stands at that angle clockwise from the plan's up, -z: so -z bears the opposite angle.
  sun.toLight = towardsSun(position, -compass.northRad * kDegrees);
  sun.halfAngleRad = static_cast<float>(kSunDiameterDeg / 2 / kDegrees);
  const Vec3 tint = hue(home.environment.lightColour.value_or(0xffffff));
  sun.illuminanceLux =
      tint * (static_cast<float>(sunLux(moment, position.altitudeRad, sunExtinction(skyCover(kClearSky)))));
  const double skyLux = skyHorizontalLux(skyCover(kClearSky), position.altitudeRad);
  const Vec3 toSun = sunInSky(sun.toLight);
  const auto& use = home.environment.skyTexture;
  const Texture* picture = use ? paints.picture(use->image) : nullptr;
  if (picture) scene.sky.image = pictureSky(*picture, use->xOffset, skyLux, tint);
  if (scene.sky.image.width == 0) {
    const Vec3 mixed = hue(home.environment.skyColour.value_or(0xffffff)) * tint, colour = mixed / luminance(mixed);
    const double zenithRad = angleRad(toSun, {0, 1, 0});
    SkyColour sky(colour);
    sky.miredPerDecade = kClearSkyMiredPerDecade;
    scene.sky.image = skyImage(
        [=](Vec3 d) { return cieSkyLuminance(kClearSky, static_cast<double>(d.y), angleRad(d, toSun), zenithRad); },
        skyLux, sky);
  }
  paintGround(scene.sky.image, groundReflectance, sun.illuminanceLux * std::max(sun.toLight.y, 0.0f), kHazeRad);
  scene.sky.horizonEdge = true;
  if (position.altitudeRad > 0) scene.suns.push_back(std::move(sun));
  return otherTimes;
}

// Of the ground's material in the mean: what the ground is that the sky's lower half shows farther away.
Vec3 meanReflectance(const Scene& scene, int material) {
  const Material& m = scene.materials[static_cast<size_t>(material)];
  if (m.baseColorTexture.texture < 0) return m.baseColor;
  const Texture& t = scene.textures[static_cast<size_t>(m.baseColorTexture.texture)];
  Vec3 sum;
  const size_t texels = t.rgba.size() / 4;
  for (size_t i = 0; i < texels; ++i) {
    const uint8_t* texel = &t.rgba[4 * i];
    sum += linearColour(static_cast<uint32_t>(texel[0]) << 16 | static_cast<uint32_t>(texel[1]) << 8 | texel[2]);
  }
  return texels > 0 ? m.baseColor * sum / static_cast<float>(texels) : m.baseColor;
}

// A rectangle around the home without the rooms that lie below it.
void addGround(const Home& home, int material, Draft& draft) {
  const Bounds3 b = draft.scene.bounds();
  if (b.empty()) return;
  const double x0 = static_cast<double>(b.lo.x) * 100 - kGroundMarginCm,
               x1 = static_cast<double>(b.hi.x) * 100 + kGroundMarginCm;
  const double y0 = static_cast<double>(b.lo.z) * 100 - kGroundMarginCm,
               y1 = static_cast<double>(b.hi.z) * 100 + kGroundMarginCm;
  PlanArea area{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
  Surfaces surfaces(draft.effort, "the ground");
  for (const Room& room : home.rooms) {
    if (!isShown(home, room.level) || !(elevationOf(home, room.level) < -kGroundDepthCm)) continue;
    if (const auto outline = outlineOf(room, draft.effort)) area = surfaces.without(area, *outline);
  }
  const auto corner = [&](PlanPoint p) {
    return SurfaceCorner{toWorld(p, -kGroundDepthCm), {static_cast<float>(p.x / 100), static_cast<float>(p.y / 100)}};
  };
  for (const PlanTriangle& t : surfaces.cut(area))
    surfaces.triangle(material, corner(t[0]), corner(t[1]), corner(t[2]), {0, 1, 0});
  surfaces.finish(draft, "ground");
  ++draft.object;
}

}  // namespace

std::optional<int> utcOffsetSeconds(const std::string& zone, int64_t wallSeconds) {
  cctz::time_zone rules;
  if (!isZoneName(zone) || !cctz::load_time_zone(zone, &rules)) return {};
  const auto utc = rules.lookup(cctz::civil_second(1970, 1, 1) + wallSeconds);
  return static_cast<int>(wallSeconds - std::max(utc.pre, utc.post).time_since_epoch().count());
}

std::string addEnvironment(const Home& home, Paints& paints, const std::string& camera, Draft& draft) {
  const Environment& env = home.environment;
  Paint ground;
  ground.colour = env.groundColour.value_or(kUsualGround);
  ground.texture = env.groundTexture;
  const int material = paints.material(ground, "ground");
  std::string daylight =
      addDaylight(home, paints, camera, meanReflectance(draft.scene, material), draft.scene, draft.warnings);
  addGround(home, material, draft);
  return daylight;
}

}  // namespace roomlight::importers::sh3d
