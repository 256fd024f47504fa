#include "photometry/sun.h"

#include <gtest/gtest.h>

#include <numbers>

namespace roomlight {
namespace {

constexpr double kDeg = 180 / std::numbers::pi;

// NREL SPA (Reda and Andreas 2004), appendix A.5: 2003-10-17 12:30:30 at UTC-7, 39.742476 N 105.1786 W: zenith 50.11162
// (with refraction of about 0.02), azimuth 194.34024.
TEST(Sun, standsWhereThePublishedExamplePutsIt) {
  const SunPosition p = sunPosition(parseMoment("2003-10-17T12:30:30-07:00").value(), 39.742476, -105.1786);
  EXPECT_NEAR(p.altitudeRad * kDeg, 90 - 50.1279, 0.02);
  EXPECT_NEAR(p.bearingRad * kDeg, 194.34024, 0.02);
}

// Meeus, Astronomical Algorithms, example 25.a: 1992-10-13 0h TD (58 s after UTC), apparent declination -7.78507 degrees. Seen
// from the pole that is the altitude.
TEST(Sun, hasThePublishedDeclination) {
  EXPECT_NEAR(sunPosition(parseMoment("1992-10-12T23:59:02Z").value(), 90, 0).altitudeRad * kDeg, -7.78507, 0.01);
  EXPECT_NEAR(sunPosition(parseMoment("1992-10-12T23:59:02Z").value(), -90, 0).altitudeRad * kDeg, 7.78507, 0.01);
}

TEST(Sun, southOfTheTropicsItStandsInTheNorthAtNoon) {
  const SunPosition p = sunPosition(parseMoment("2026-03-20T12:04+10:00").value(), -33.9, 151.2);
  EXPECT_LT(std::min(p.bearingRad, 2 * std::numbers::pi - p.bearingRad) * kDeg, 2);
  EXPECT_NEAR(p.altitudeRad * kDeg, 90 - 33.9, 0.5);
}

TEST(Sun, risesInTheEastAtTheEquinox) {
  const SunPosition p = sunPosition(parseMoment("2026-03-20T06:08Z").value(), 0, 0);
  EXPECT_NEAR(p.bearingRad * kDeg, 90, 0.3);
  EXPECT_NEAR(p.altitudeRad * kDeg, 0, 0.5);
}

TEST(Sun, culminatesAtTheLatitudesAngleAtTheSolstice) {
  double highest = -90;
  for (int minute = 0; minute < 24 * 60; minute += 2) {
    highest = std::max(highest, sunPosition({2026, 6, 21, minute / 60.0}, 50, 10).altitudeRad * kDeg);
  }
  EXPECT_NEAR(highest, 90 - 50 + 23.44, 0.02);
}

TEST(Sun, clearSkyLightFallsWithAltitude) {
  const Moment june{2026, 6, 21, 12};
  EXPECT_NEAR(sunLux(june, std::numbers::pi / 2), 127.5e3 * (1 - 0.034 * 0.98) * 0.8106, 500);
  EXPECT_LT(sunLux(june, 0.1), 0.2 * sunLux(june, 1.0));
  EXPECT_EQ(sunLux(june, -0.01), 0);
}

TEST(Sun, momentsNeedAnOffsetAndARealDate) {
  EXPECT_NEAR(parseMoment("2026-06-21T14:30+02:00").value().hour, 12.5, 1e-12);
  EXPECT_NEAR(parseMoment("2026-06-21T00:30:36Z").value().hour, 0.51, 1e-12);
  for (const char* text : {"", "noon", "2026-06-21T14:30", "2026-02-29T14:30Z", "2026-13-01T14:30Z", "2026-06-21T25:30Z", "1816-06-21T12:00Z", "2026-06-21T14:30+02:00x"}) {
    EXPECT_FALSE(parseMoment(text).ok()) << text;
  }
}

}  // namespace
}  // namespace roomlight
