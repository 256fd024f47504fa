#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "import/lighting_file.h"
#include "photometry/sky_luminance.h"
#include "photometry/sun.h"
#include "trace/sky_distribution.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

class Daylight : public ::testing::Test {
 protected:
  Status apply(const std::string& json) {
    const std::filesystem::path file = folder_ / "day.json";
    std::ofstream(file) << json;
    scene_ = {};
    warnings_.clear();
    return applyLightingFile(file, scene_, &warnings_);
  }
  double luminanceAt(Vec3 d) const {
    return static_cast<double>(luminance(SkyDistribution(scene_.sky).radiance(normalize(d))));
  }
  // On level ground, from the sky alone.
  double skyLux() const {
    const SkyDistribution sky(scene_.sky);
    constexpr int kRows = 256, kColumns = 256;
    double sum = 0;
    for (int k = 0; k < kRows * kColumns; ++k) {
      const double s2 = (k / kColumns + 0.5) / kRows, bearing = 2 * std::numbers::pi * (k % kColumns + 0.5) / kColumns,
                   c = std::sqrt(1 - s2);
      sum += static_cast<double>(
          luminance(sky.radiance({static_cast<float>(c * std::sin(bearing)), static_cast<float>(std::sqrt(s2)),
                                  static_cast<float>(-c * std::cos(bearing))})));
    }
    return sum * std::numbers::pi / (kRows * kColumns);
  }

  testing::TemporaryFolder folder_;
  Scene scene_;
  std::vector<std::string> warnings_;
};

TEST_F(Daylight, overcastNeedsNothingButItsIlluminance) {
  const Status s = apply(R"({"daylight": {"sky": "overcast", "horizontalIlluminance": "10 klx", "ground": 0.3}})");
  ASSERT_TRUE(s) << s.error();
  EXPECT_TRUE(scene_.suns.empty());
  EXPECT_NEAR(skyLux(), 10'000, 20);
  EXPECT_NEAR(luminanceAt({0, 1, 0}), 9 * 10'000 / (7 * std::numbers::pi), 5);
  EXPECT_NEAR(luminanceAt({1, 0.002f, 0}) / luminanceAt({0, 1, 0}), 1 / 3.0, 0.01);
  EXPECT_NEAR(luminanceAt(normalize({0, -0.3f, 1})), 0.3 * 10'000 / std::numbers::pi, 1);
}

TEST_F(Daylight, clearSkyAndSunStandTogether) {
  const Status s = apply(
      R"({"daylight": {"sky": "clear", "latitude": 48.14, "longitude": 11.58, "time": "2026-04-10T16:30+02:00", "north": 45}})");
  ASSERT_TRUE(s) << s.error();
  ASSERT_EQ(scene_.suns.size(), 1u);
  const Moment moment = parseMoment("2026-04-10T16:30+02:00").value();
  const SunPosition p = sunPosition(moment, 48.14, 11.58);
  EXPECT_NEAR(scene_.suns[0].toLight.y, std::sin(p.altitudeRad), 1e-5);
  const double sun = sunLux(moment, p.altitudeRad);
  EXPECT_NEAR(luminance(scene_.suns[0].illuminanceLux), sun, 1);
  const double sky = skyHorizontalLux(SkyCover::Clear, p.altitudeRad);
  EXPECT_NEAR(skyLux(), sky, 0.003 * sky);
  // The glow about the sun is where the sun is, and the ground has light of both.
  const Vec3 toSun = scene_.suns[0].toLight;
  EXPECT_GT(luminanceAt(toSun), 5 * luminanceAt({-toSun.x, toSun.y, -toSun.z}));
  EXPECT_NEAR(luminanceAt({0, -1, 0}), 0.2 * (sky + sun * std::sin(p.altitudeRad)) / std::numbers::pi, 5);
}

TEST_F(Daylight, skiesHideAsMuchOfTheSunAsTheirCover) {
  const auto sunOf = [&](const std::string& sky) {
    EXPECT_TRUE(
        apply(R"({"daylight": {"latitude": 40, "longitude": 0, "time": "2026-06-21T12:00Z", "sky": )" + sky + "}}"))
        << sky;
    return scene_.suns.empty() ? 0.0 : static_cast<double>(luminance(scene_.suns[0].illuminanceLux));
  };
  EXPECT_GT(sunOf("12"), 1.7 * sunOf("7"));
  EXPECT_GT(sunOf("7"), 0);
  for (const char* sky : {"1", "2", "5", "16", "\"overcast\""}) EXPECT_EQ(sunOf(sky), 0) << sky;
}

// Twilight by Seidelmann's table (sky_luminance.h); later the light of a night with some moon.
TEST_F(Daylight, nightFallsAfterSunset) {
  const auto skyAt = [&](const std::string& time) {
    EXPECT_TRUE(apply(R"({"daylight": {"sky": "clear", "latitude": 48, "longitude": 11, "time": "2026-04-10T)" + time +
                      R"(+02:00"}})"))
        << time;
    EXPECT_TRUE(scene_.suns.empty()) << time;
    EXPECT_TRUE(warnings_.empty()) << time;
    return skyLux();
  };
  const double dusk = skyAt("20:20"), later = skyAt("20:40"), night = skyAt("23:30");
  EXPECT_GT(dusk, 4 * later);
  EXPECT_GT(later, 4 * night);
  EXPECT_NEAR(night, kNightLux, 0.01 * kNightLux);
}

TEST_F(Daylight, theAllWeatherSkyHasTheLightThatWasMeasured) {
  for (const auto& [direct, diffuse] :
       {std::pair(0.0, 180.0), std::pair(60.0, 250.0), std::pair(300.0, 220.0), std::pair(820.0, 90.0)}) {
    const Status s = apply(fmt::format(
        R"({{"daylight": {{"sky": "perez", "latitude": 48.14, "longitude": 11.58, "time": "2026-06-10T16:30+02:00",
      "directNormal": "{} W/m2", "diffuseHorizontal": "{} W/m2", "ground": 0.25}}}})",
        direct, diffuse));
    ASSERT_TRUE(s) << s.error();
    const Moment moment = parseMoment("2026-06-10T16:30+02:00").value();
    const double altitude = sunPosition(moment, 48.14, 11.58).altitudeRad;
    const PerezSky sky =
        perezSky({direct, diffuse}, std::numbers::pi / 2 - altitude, kSolarConstant * sunDistanceFactor(moment));
    EXPECT_NEAR(skyLux(), diffuse * sky.diffuseEfficacy, 0.002 * diffuse * sky.diffuseEfficacy);
    EXPECT_EQ(scene_.suns.size(), direct > 0 ? 1u : 0u);
    const double sun = scene_.suns.empty() ? 0 : static_cast<double>(luminance(scene_.suns[0].illuminanceLux));
    EXPECT_NEAR(sun, direct * sky.directEfficacy, 1e-3 * sun);
    const double ground = 0.25 * (diffuse * sky.diffuseEfficacy + sun * std::sin(altitude)) / std::numbers::pi;
    EXPECT_NEAR(luminanceAt({0, -1, 0}), ground, 0.001 * ground);
  }
}

std::string hourOf(int month, int day, int hour, int direct, int diffuse, int directLux, int diffuseLux) {
  return fmt::format("2005,{},{},{},60,?9?9?9,20.0,8.0,50,101300,0,1300,300,500,{},{},50000,{},{},9999,180,3.0,5,5\n",
                     month, day, hour, direct, diffuse, directLux, diffuseLux);
}

TEST_F(Daylight, weatherTellsPlaceAndIrradiance) {
  std::ofstream(folder_ / "town.epw")
      << "LOCATION,Town,-,DEU,IWEC,1,48.14,11.58,1.0,500\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n"
      << hourOf(6, 10, 15, 100, 300, 0, 0) << hourOf(6, 10, 16, 700, 120, 0, 0)
      << hourOf(6, 10, 17, 600, 110, 55000, 14000) << hourOf(6, 10, 23, 0, 0, 0, 0);
  // 16:30 of summer time is 15:30 of standard time, within hour 16.
  const auto at = [&](const std::string& time) {
    return apply(R"({"daylight": {"weather": "town.epw", "time": ")" + time + "\"}}");
  };
  ASSERT_TRUE(at("2026-06-10T16:30+02:00"));
  const Moment moment = parseMoment("2026-06-10T16:30+02:00").value();
  const PerezSky sky = perezSky({700, 120}, std::numbers::pi / 2 - sunPosition(moment, 48.14, 11.58).altitudeRad,
                                kSolarConstant * sunDistanceFactor(moment), precipitableWaterCm(8));
  EXPECT_NEAR(skyLux(), 120 * sky.diffuseEfficacy, 0.002 * skyLux());
  EXPECT_NEAR(luminance(scene_.suns.at(0).illuminanceLux), 700 * sky.directEfficacy, 50);
  // Where lux were given they count.
  ASSERT_TRUE(at("2026-06-10T17:30+02:00"));
  EXPECT_NEAR(skyLux(), 14000, 30);
  EXPECT_NEAR(luminance(scene_.suns.at(0).illuminanceLux), 55000, 10);
  ASSERT_TRUE(at("2026-06-10T21:30Z"));
  EXPECT_FALSE(scene_.sky.present());
  const Status none = at("2026-01-10T12:00Z");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().find("daylight.weather: has no weather of that hour"), std::string::npos) << none.error();
}

TEST_F(Daylight, whatIsWrongIsNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"daylight": {"sky": 17}})", "daylight.sky: 17 is out of range"},
      {R"({"daylight": {"sky": 2.5}})", "daylight.sky: must be a whole number"},
      {R"({"daylight": {"sky": "cloudy"}})", "daylight.sky: unknown 'cloudy'"},
      {R"({"daylight": {"sky": "clear", "horizontalIlluminance": "10 klx"}})", "daylight: 'latitude' is missing"},
      {R"({"daylight": {"sky": "overcast"}})", "daylight: 'latitude' is missing"},
      {R"({"daylight": {"sky": "perez", "direction": [0, 1, 1], "directNormal": "500 W/m2"}})",
       "daylight: 'diffuseHorizontal' is missing"},
      {R"({"daylight": {"sky": "perez", "direction": [0, 1, 1], "directNormal": "500 W/m2", "diffuseHorizontal": "0 W/m2"}})",
       "daylight: direct light without any diffuse light"},
      {R"({"daylight": {"sky": "perez", "direction": [0, 1, 1], "directNormal": "500 lx", "diffuseHorizontal": "9 W/m2"}})",
       "daylight.directNormal: '500 lx' is in lx, where W/m2 is needed"},
      {R"({"daylight": {"weather": "none.epw", "time": "2026-06-10T16:30+02:00"}})", "none.epw"},
      {R"({"daylight": {"sky": "clear", "direction": [0, 1, 1]}})", "daylight: 'sunIlluminance' is needed"},
      {R"({"daylight": {"sky": "overcast", "horizontalIlluminance": "1 lx", "ground": 1.5}})",
       "daylight.ground: 1.5 is out of range"},
      {R"({"daylight": {"sky": "overcast", "horizontalIlluminance": "1 lx"}, "sky": {"luminance": "1 cd/m2"}})",
       "sky: means nothing beside 'daylight'"},
  };
  for (const auto& [json, expected] : cases) {
    const Status s = apply(json);
    ASSERT_FALSE(s) << json;
    EXPECT_NE(s.error().find(expected), std::string::npos) << s.error();
  }
}

}  // namespace
}  // namespace roomlight
