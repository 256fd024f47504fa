// Daylight of Sweet Home 3D's homes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "import/sh3d_environment.h"
#include "photometry/sky_image.h"
#include "photometry/sun.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;
using importers::sh3d::utcOffsetSeconds;
using std::chrono_literals::operator""y;

std::string homeAt(const std::string& timeMs, const std::string& compass) {
  return wallXml("w", 0, 0, 100, 0, 10) + "<compass x='0' y='0' diameter='1' latitude='0.8527' longitude='0.0410' " +
         compass + "/>" +
         "<observerCamera attribute='observerCamera' x='0' y='0' z='170' yaw='0' pitch='0' fieldOfView='1' time='" +
         timeMs + "'/>";
}
const std::string kObserver = "camera='observerCamera'";

// 2024-06-21 14:00 on the clock.
const std::string kAfternoon = "1718978400000";

int64_t wallSeconds(std::chrono::year_month_day day, int hour, int minute) {
  return (std::chrono::sys_days(day).time_since_epoch() + std::chrono::hours(hour) + std::chrono::minutes(minute)) /
         std::chrono::seconds(1);
}

TEST(Sh3dSky, timeZonesKnowSummerAndWinter) {
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", 1718978400), 7200);
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", 1705000000), 3600);
  EXPECT_EQ(utcOffsetSeconds("America/New_York", 1705000000), -5 * 3600);
}

// By the rule at the end of a zone's table; tables themselves stop in 2037 or at the last change of the rule.
TEST(Sh3dSky, timeZonesKnowSummersBeyondTheirTables) {
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", wallSeconds(2050y / 7 / 1, 14, 0)), 7200);
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", wallSeconds(2050y / 1 / 1, 14, 0)), 3600);
}

TEST(Sh3dSky, anHourSkippedOrRepeatedIsReadAsTheLaterMoment) {
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", wallSeconds(2024y / 3 / 31, 2, 30)), 3600);
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", wallSeconds(2024y / 10 / 27, 2, 30)), 3600);
  EXPECT_EQ(utcOffsetSeconds("America/New_York", wallSeconds(2024y / 3 / 10, 2, 30)), -5 * 3600);
  EXPECT_EQ(utcOffsetSeconds("America/New_York", wallSeconds(2024y / 11 / 3, 1, 30)), -5 * 3600);
}

TEST(Sh3dSky, whatNamesNoTimeZoneIsUnknown) {
  EXPECT_EQ(utcOffsetSeconds("UTC", 1705000000), 0);
  for (const char* zone : {"", "../../../etc/passwd", "/usr/share/zoneinfo/UTC", "file:/usr/share/zoneinfo/UTC",
                           "libc:localtime", "Europe", "Nowhere/At_All"})
    EXPECT_EQ(utcOffsetSeconds(zone, 0), std::nullopt) << zone;
}

TEST(Sh3dSky, theSunStandsByCompassAndClock) {
  const Scene scene = homeScene(homeAt(kAfternoon, "timeZone='Etc/GMT-2' northDirection='0'"), kObserver);  // UTC+2
  ASSERT_EQ(scene.suns.size(), 1u);
  const SunPosition p =
      sunPosition({2024, 6, 21, 12}, 0.8527 * 180 / std::numbers::pi, 0.0410 * 180 / std::numbers::pi);
  EXPECT_NEAR(scene.suns[0].toLight.y, std::sin(p.altitudeRad), 1e-5);
  EXPECT_NEAR(scene.suns[0].toLight.x, std::sin(p.bearingRad) * std::cos(p.altitudeRad), 1e-5);
  EXPECT_NEAR(scene.suns[0].toLight.z, -std::cos(p.bearingRad) * std::cos(p.altitudeRad),
              1e-5);  // in the south: towards the viewer
  EXPECT_GT(scene.suns[0].toLight.z, 0.2f);
  EXPECT_TRUE(scene.sky.present());
}

TEST(Sh3dSky, northTurnsTheSunWithIt) {
  // North at the plan's right, +x: the midday sun in the south stands at -x.
  const Scene scene = homeScene(homeAt(kAfternoon, "timeZone='Etc/GMT-2' northDirection='1.5707963'"), kObserver);
  ASSERT_EQ(scene.suns.size(), 1u);
  EXPECT_LT(scene.suns[0].toLight.x, -0.2f);
}

TEST(Sh3dSky, nightsHaveADarkSkyAndUnknownPlacesNone) {
  const Scene night = homeScene(homeAt("1718928000000", "timeZone='Etc/GMT-2'"), kObserver);  // midnight
  EXPECT_TRUE(night.suns.empty());
  EXPECT_NEAR(luminance(horizontalLux(night.sky.image)), 0.05, 0.001);
  const Result<Imported> nowhere = importHome(wallXml("w", 0, 0, 100, 0, 10));
  ASSERT_TRUE(nowhere.ok());
  EXPECT_TRUE(nowhere.value().scene.suns.empty());
  EXPECT_FALSE(nowhere.value().scene.sky.present());
  ASSERT_EQ(nowhere.value().warnings.size(), 1u);
  EXPECT_NE(nowhere.value().warnings[0].find("no daylight"), std::string::npos);
}

TEST(Sh3dSky, theGroundLiesAroundTheHomeAndSparesCellars) {
  const Scene scene = homeScene("<level id='c' name='c' elevation='-250' floorThickness='12' height='250'/>" +
                                roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}}, "level='c' name='cellar'"));
  EXPECT_NEAR(areaFacing(scene, "ground", {0, 1, 0}), 14 * 13 - 12, 1e-3);
}

// The stored view is seen at another time than the one in use.
TEST(Sh3dSky, theWantedCameraSaysTheTime) {
  const std::string home =
      homeAt(kAfternoon, "timeZone='Etc/GMT-2'") +
      "<camera attribute='storedCamera' name='Night' x='0' y='0' z='170' yaw='0' pitch='0' fieldOfView='1' "
      "time='1718928000000'/>"
      "<camera attribute='storedCamera' name='Timeless' x='0' y='0' z='170' yaw='0' pitch='0' fieldOfView='1'/>";
  const auto suns = [&](const std::string& camera) {
    const Result<Imported> r = importBytes(zipped({{"Home.xml", homeXml(home, kObserver)}}), {.camera = camera});
    if (!r) ADD_FAILURE() << r.error();
    return r ? r.value().scene.suns.size() : 99;
  };
  EXPECT_EQ(suns(""), 1u);
  EXPECT_EQ(suns("Night"), 0u);
  EXPECT_EQ(suns("1"), 0u);
  EXPECT_EQ(suns("observerCamera"), 1u);
  EXPECT_EQ(suns("Timeless"), 1u);
  EXPECT_EQ(suns("gone"), 1u);
}

std::string bmp2x2(const std::string& bottomLeft, const std::string& bottomRight, const std::string& topLeft,
                   const std::string& topRight) {
  const auto w = [](unsigned v) { return std::string{static_cast<char>(v), 0, 0, 0}; };
  const std::string pad(2, '\0');
  return "BM" + w(70) + w(0) + w(54) + w(40) + w(2) + w(2) + std::string("\x01\0\x18\0", 4) + w(0) + w(16) + w(0) +
         w(0) + w(0) + w(0) + bottomLeft + bottomRight + pad + topLeft + topRight + pad;
}
const std::string kBlue = std::string("\xff\0\0", 3), kRed = std::string("\0\0\xff", 3),
                  kGreen = std::string("\0\xff\0", 3), kWhite = "\xff\xff\xff";

// In cd/m² along a direction, through the conventions of Sky::image.
Vec3 skyAt(const Scene& scene, Vec3 d) {
  d = normalize(d);
  const Image& image = scene.sky.image;
  const float x = (std::atan2(d.x, -d.z) / (2 * kPi) + 0.5f) * static_cast<float>(image.width),
              y = std::acos(d.y) / kPi * static_cast<float>(image.height);
  return image.at(std::min(static_cast<int>(x), image.width - 1), std::min(static_cast<int>(y), image.height - 1));
}

TEST(Sh3dSky, aPictureOfTheSkyStandsAsInTheProgram) {
  const std::string sky =
      "<environment groundColor='FFA8A8A8' skyColor='FFCCE4FC' lightColor='FFD0D0D0' wallsAlpha='0'><texture "
      "attribute='skyTexture' name='t' image='5' width='100' height='100'/></environment>";
  const Result<Imported> with =
      importBytes(zipped({{"Home.xml", homeXml(sky + homeAt(kAfternoon, "timeZone='Etc/GMT-2'"), kObserver)},
                          {"5", bmp2x2(kRed, kGreen, kBlue, kWhite)}}));
  ASSERT_TRUE(with.ok()) << with.error();
  const Scene& scene = with.value().scene;
  ASSERT_GT(scene.sky.image.width, 0);
  // The left half begins at +x and goes by +z; it is red near the horizon and blue above.
  const Vec3 low = skyAt(scene, {0.5f, 0.2f, 1}), high = skyAt(scene, {0.1f, 2, 0.2f}),
             otherLow = skyAt(scene, {0.5f, 0.2f, -1});
  EXPECT_GT(low.x, 0);
  EXPECT_EQ(low.y + low.z, 0);
  EXPECT_GT(high.z, 0);
  EXPECT_EQ(high.x, 0);
  EXPECT_GT(otherLow.y, 0);
  EXPECT_EQ(otherLow.x, 0);
  // As much light as without the picture.
  const auto lux = [](const Scene& s) {
    double sum = 0;
    const Image& image = s.sky.image;
    for (int y = 0; 2 * y < image.height; ++y) {
      const double polar = std::numbers::pi * (y + 0.5) / image.height;
      for (int x = 0; x < image.width; ++x)
        sum += static_cast<double>(luminance(image.at(x, y))) * std::sin(polar) * std::cos(polar);
    }
    return sum * 2 * std::numbers::pi * std::numbers::pi / (image.width * static_cast<double>(image.height));
  };
  const Scene without = homeScene(homeAt(kAfternoon, "timeZone='Etc/GMT-2'"), kObserver);
  EXPECT_NEAR(lux(scene), lux(without), 0.01 * lux(without));
}

TEST(Sh3dSky, theColourOfLightTintsAndKeepsItsAmount) {
  const auto at = [](const std::string& light) {
    return homeScene("<environment lightColor='" + light + "'/>" + homeAt(kAfternoon, "timeZone='Etc/GMT-2'"),
                     kObserver);
  };
  const Scene grey = at("FF808080"), warm = at("FFFFC080");
  ASSERT_EQ(warm.suns.size(), 1u);
  EXPECT_NEAR(luminance(warm.suns[0].illuminanceLux), luminance(grey.suns[0].illuminanceLux),
              1e-4f * luminance(grey.suns[0].illuminanceLux));
  EXPECT_GT(warm.suns[0].illuminanceLux.x, 2 * warm.suns[0].illuminanceLux.z);
  EXPECT_EQ(grey.suns[0].illuminanceLux.x, grey.suns[0].illuminanceLux.z);
}

TEST(Sh3dTextures, fitTheirRoom) {
  const std::string room = roomXml({{100, 50}, {500, 50}, {500, 350}, {100, 350}}, "name='hall'");
  const std::string inside =
      "<texture attribute='floorTexture' name='t' image='5' width='20' height='20' angle='0.5' fittingArea='true'/>";
  const Result<Imported> r = importHome(room.substr(0, room.rfind("</room>")) + inside + "</room>",
                                        {{"5", bmp2x2(kRed, kGreen, kBlue, kWhite)}});
  ASSERT_TRUE(r.ok()) << r.error();
  const Scene& scene = r.value().scene;
  int checked = 0;
  for (const Instance& i : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    const TextureRef& ref = scene.materials[static_cast<size_t>(mesh.material)].baseColorTexture;
    if (ref.texture < 0) continue;
    for (size_t v = 0; v < mesh.positions.size(); ++v, ++checked) {
      const Vec2 uv = mesh.uv[0][v];
      const Vec3 p = i.worldFromObject.point(mesh.positions[v]);
      EXPECT_NEAR(ref.m[0][0] * uv.x + ref.m[0][1] * uv.y + ref.m[0][2], (p.x - 1) / 4, 1e-4);
      EXPECT_NEAR(ref.m[1][0] * uv.x + ref.m[1][1] * uv.y + ref.m[1][2], (p.z - 0.5) / 3, 1e-4);
    }
  }
  EXPECT_GT(checked, 0);
}

TEST(Sh3dPolylines, thoseOf3DAreBands) {
  const std::string points = "<point x='0' y='0'/><point x='100' y='0'/><point x='100' y='200'/>";
  const Scene scene =
      homeScene(wallXml("w", 0, 900, 100, 900, 10) + "<polyline thickness='4' color='FFFF0000' elevation='2'>" +
                points + "</polyline><polyline thickness='4' color='FFFF0000'>" + points + "</polyline>");
  // Two bands, each half a thickness longer at both ends; the second line is the plan's own.
  EXPECT_NEAR(areaFacing(scene, "line", {0, 1, 0}), (1.04 + 2.04) * 0.04, 1e-5);
  const Bounds3 b = boundsOf(scene, "line");
  EXPECT_NEAR(b.lo.y, 0.02, 1e-5);
  EXPECT_NEAR(b.hi.x, 1.02, 1e-5);
  EXPECT_NEAR(b.hi.z, 2.02, 1e-5);
}

}  // namespace
}  // namespace roomlight
