#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "import/lighting_file.h"
#include "photometry/cie_sky.h"
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
    return applyLightingFile(file, scene_);
  }
  double luminanceAt(Vec3 d) const { return static_cast<double>(luminance(SkyDistribution(scene_.sky).radiance(normalize(d)))); }
  // On level ground, from the sky alone.
  double skyLux() const {
    const SkyDistribution sky(scene_.sky);
    constexpr int kRows = 256, kColumns = 256;
    double sum = 0;
    for (int k = 0; k < kRows * kColumns; ++k) {
      const double s2 = (k / kColumns + 0.5) / kRows, bearing = 2 * std::numbers::pi * (k % kColumns + 0.5) / kColumns, c = std::sqrt(1 - s2);
      sum += static_cast<double>(luminance(sky.radiance({static_cast<float>(c * std::sin(bearing)), static_cast<float>(std::sqrt(s2)), static_cast<float>(-c * std::cos(bearing))})));
    }
    return sum * std::numbers::pi / (kRows * kColumns);
  }

  testing::TemporaryFolder folder_;
  Scene scene_;
};

TEST_F(Daylight, overcastNeedsNothingButItsIlluminance) {
  const Status s = apply(R"({"daylight": {"sky": "overcast", "horizontalIlluminance": "10 klx", "ground": 0.3}})");
  ASSERT_TRUE(s) << s.error();
  EXPECT_TRUE(scene_.suns.empty());
  EXPECT_NEAR(skyLux(), 10'000, 20);
  EXPECT_NEAR(luminanceAt({0, 1, 0}), 9 * 10'000 / (7 * std::numbers::pi), 5);
  EXPECT_NEAR(luminanceAt({1, 0.002f, 0}) / luminanceAt({0, 1, 0}), 1 / 3.0, 0.01);
  EXPECT_NEAR(luminanceAt({0, -0.01f, 1}), 0.3 * 10'000 / std::numbers::pi, 1);
}

TEST_F(Daylight, clearSkyAndSunStandTogether) {
  const Status s = apply(R"({"daylight": {"sky": "clear", "latitude": 48.14, "longitude": 11.58, "time": "2026-04-10T16:30+02:00", "north": 45}})");
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
    EXPECT_TRUE(apply(R"({"daylight": {"latitude": 40, "longitude": 0, "time": "2026-06-21T12:00Z", "sky": )" + sky + "}}")) << sky;
    return scene_.suns.empty() ? 0.0 : static_cast<double>(luminance(scene_.suns[0].illuminanceLux));
  };
  EXPECT_GT(sunOf("12"), 1.7 * sunOf("7"));
  EXPECT_GT(sunOf("7"), 0);
  for (const char* sky : {"1", "2", "5", "16", "\"overcast\""}) EXPECT_EQ(sunOf(sky), 0) << sky;
}

TEST_F(Daylight, nightIsDark) {
  ASSERT_TRUE(apply(R"({"daylight": {"sky": "clear", "latitude": 48, "longitude": 11, "time": "2026-04-10T23:30+02:00"}})"));
  EXPECT_TRUE(scene_.suns.empty());
  EXPECT_FALSE(scene_.sky.present());
}

TEST_F(Daylight, whatIsWrongIsNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"daylight": {"sky": 17}})", "daylight.sky: 17 is out of range"},
      {R"({"daylight": {"sky": 2.5}})", "daylight.sky: must be a whole number"},
      {R"({"daylight": {"sky": "cloudy"}})", "daylight.sky: unknown 'cloudy'"},
      {R"({"daylight": {"sky": "clear", "horizontalIlluminance": "10 klx"}})", "daylight: 'latitude' is missing"},
      {R"({"daylight": {"sky": "overcast"}})", "daylight: 'latitude' is missing"},
      {R"({"daylight": {"sky": "clear", "direction": [0, 1, 1]}})", "daylight: 'sunIlluminance' is missing"},
      {R"({"daylight": {"sky": "overcast", "horizontalIlluminance": "1 lx", "ground": 1.5}})", "daylight.ground: 1.5 is out of range"},
      {R"({"daylight": {"sky": "overcast", "horizontalIlluminance": "1 lx"}, "sky": {"luminance": "1 cd/m2"}})", "sky: means nothing beside 'daylight'"},
  };
  for (const auto& [json, expected] : cases) {
    const Status s = apply(json);
    ASSERT_FALSE(s) << json;
    EXPECT_NE(s.error().find(expected), std::string::npos) << s.error();
  }
}

}  // namespace
}  // namespace roomlight
