#include "bake/daylight_hours.h"

#include <gtest/gtest.h>

namespace roomlight::bake {
namespace {

const nlohmann::json kDaylight = {
    {"sky", "clear"}, {"latitude", 48.1}, {"longitude", 11.6}, {"time", "2026-06-21T17:30+02:00"}};

TEST(DaylightHours, theOwnHourIsThatOfTheClock) {
  EXPECT_EQ(hourOf(kDaylight), 17.5);
  EXPECT_EQ(hourOf({{"sky", "overcast"}}), std::nullopt);
  EXPECT_EQ(hourOf({{"time", "noon"}}), std::nullopt);
}

TEST(DaylightHours, theSunIsHighAtNoonAndGoneAtNight) {
  const Result<DaylightHour> noon = daylightAt(kDaylight, {}, 13), evening = daylightAt(kDaylight, {}, 18.75),
                             night = daylightAt(kDaylight, {}, 2);
  ASSERT_TRUE(noon && evening && night);
  ASSERT_EQ(noon.value().suns.size(), 1u);
  ASSERT_EQ(evening.value().suns.size(), 1u);
  EXPECT_GT(noon.value().suns[0].toLight.y, evening.value().suns[0].toLight.y + 0.3f);
  EXPECT_TRUE(night.value().suns.empty());
}

TEST(DaylightHours, withoutATimeThereIsALine) {
  const Result<DaylightHour> light = daylightAt({{"sky", "overcast"}}, {}, 12);
  ASSERT_FALSE(light);
  EXPECT_EQ(light.error(), "the home's daylight has no time; give it one in a lighting file");
}

}  // namespace
}  // namespace roomlight::bake
