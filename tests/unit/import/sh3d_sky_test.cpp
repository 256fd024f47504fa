// Daylight of Sweet Home 3D's homes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "import/sh3d_time_zone.h"
#include "photometry/sun.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;
using importers::sh3d::utcOffsetSeconds;

std::string homeAt(const std::string& timeMs, const std::string& compass) {
  return wallXml("w", 0, 0, 100, 0, 10) + "<compass x='0' y='0' diameter='1' latitude='0.8527' longitude='0.0410' " + compass + "/>" +
         "<observerCamera attribute='observerCamera' x='0' y='0' z='170' yaw='0' pitch='0' fieldOfView='1' time='" + timeMs + "'/>";
}
const std::string kObserver = "camera='observerCamera'";

// 2024-06-21 14:00 on the clock.
const std::string kAfternoon = "1718978400000";

TEST(Sh3dSky, timeZonesKnowSummerAndWinter) {
  if (!utcOffsetSeconds("Europe/Paris", 0)) GTEST_SKIP() << "no time zones on this machine";
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", 1718978400), 7200);
  EXPECT_EQ(utcOffsetSeconds("Europe/Paris", 1705000000), 3600);
  EXPECT_EQ(utcOffsetSeconds("America/New_York", 1705000000), -5 * 3600);
  EXPECT_EQ(utcOffsetSeconds("UTC", 1705000000), 0);
  EXPECT_EQ(utcOffsetSeconds("../../../etc/passwd", 0), std::nullopt);
  EXPECT_EQ(utcOffsetSeconds("Nowhere/At_All", 0), std::nullopt);
}

TEST(Sh3dSky, theSunStandsByCompassAndClock) {
  const Scene scene = homeScene(homeAt(kAfternoon, "timeZone='Etc/GMT-2' northDirection='0'"), kObserver);  // UTC+2
  ASSERT_EQ(scene.suns.size(), 1u);
  const SunPosition p = sunPosition({2024, 6, 21, 12}, 0.8527 * 180 / std::numbers::pi, 0.0410 * 180 / std::numbers::pi);
  EXPECT_NEAR(scene.suns[0].toLight.y, std::sin(p.altitudeRad), 1e-5);
  EXPECT_NEAR(scene.suns[0].toLight.x, std::sin(p.bearingRad) * std::cos(p.altitudeRad), 1e-5);
  EXPECT_NEAR(scene.suns[0].toLight.z, -std::cos(p.bearingRad) * std::cos(p.altitudeRad), 1e-5);  // in the south: towards the viewer
  EXPECT_GT(scene.suns[0].toLight.z, 0.2f);
  EXPECT_TRUE(scene.sky.present());
}

TEST(Sh3dSky, northTurnsTheSunWithIt) {
  // North at the plan's right, +x: the midday sun in the south stands at -x.
  const Scene scene = homeScene(homeAt(kAfternoon, "timeZone='Etc/GMT-2' northDirection='1.5707963'"), kObserver);
  ASSERT_EQ(scene.suns.size(), 1u);
  EXPECT_LT(scene.suns[0].toLight.x, -0.2f);
}

TEST(Sh3dSky, nightsAndUnknownPlacesHaveNoDaylight) {
  const Scene night = homeScene(homeAt("1718928000000", "timeZone='Etc/GMT-2'"), kObserver);  // midnight
  EXPECT_TRUE(night.suns.empty());
  EXPECT_FALSE(night.sky.present());
  const Result<Imported> nowhere = importHome(wallXml("w", 0, 0, 100, 0, 10));
  ASSERT_TRUE(nowhere.ok());
  EXPECT_TRUE(nowhere.value().scene.suns.empty());
  ASSERT_EQ(nowhere.value().warnings.size(), 1u);
  EXPECT_NE(nowhere.value().warnings[0].find("no daylight"), std::string::npos);
}

TEST(Sh3dSky, theGroundLiesAroundTheHomeAndSparesCellars) {
  const Scene scene = homeScene("<level id='c' name='c' elevation='-250' floorThickness='12' height='250'/>" +
                                roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}}, "level='c' name='cellar'"));
  EXPECT_NEAR(areaFacing(scene, "ground", {0, 1, 0}), 14 * 13 - 12, 1e-3);
}

}  // namespace
}  // namespace roomlight
