#include "photometry/sun.h"

#include <gtest/gtest.h>

#include <cmath>
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

// Meeus, Astronomical Algorithms, example 25.a: 1992-10-13 0h TD (58 s after UTC), apparent declination -7.78507
// degrees. Seen from the pole that is the altitude.
TEST(Sun, hasThePublishedDeclination) {
  EXPECT_NEAR(sunPosition(parseMoment("1992-10-12T23:59:02Z").value(), 90, 0).altitudeRad * kDeg, -7.78507, 0.01);
  EXPECT_NEAR(sunPosition(parseMoment("1992-10-12T23:59:02Z").value(), -90, 0).altitudeRad * kDeg, 7.78507, 0.01);
}

// By another theory: longitude of the earth from the leading terms of VSOP87, nutation, aberration and apparent
// sidereal time (Meeus 1998, chapters 12, 22 and 25); it has the example of NREL SPA within 0.002 degrees.
TEST(Sun, standsWhereAFinerTheoryHasIt) {
  const struct {
    const char* where;
    const char* time;
    double latitude, longitude, altitude, bearing;
  } cases[] = {
      {"Berlin", "2026-06-21T12:00Z", 52.52, 13.405, 59.285, 203.740},
      {"Sydney", "2026-12-21T02:30Z", -33.8688, 151.2093, 76.799, 319.813},
      {"Tromso, midnight sun", "2026-06-21T22:45Z", 69.6492, 18.9553, 3.086, 359.749},
      {"Quito", "2026-03-20T18:00Z", -0.1807, -78.4678, 80.306, 271.376},
      {"Ushuaia", "2026-01-15T21:45Z", -54.8019, -68.303, 25.272, 268.968},
      {"Singapore", "2031-09-08T03:20Z", 1.3521, 103.8198, 64.031, 79.513},
      {"Honolulu", "1995-02-11T21:05Z", 21.3069, -157.8583, 46.939, 142.797},
      {"Svalbard, days before the polar night", "2040-10-20T11:00Z", 78.2232, 15.6267, 1.100, 184.380},
  };
  for (const auto& c : cases) {
    const SunPosition p = sunPosition(parseMoment(c.time).value(), c.latitude, c.longitude);
    EXPECT_NEAR(p.altitudeRad * kDeg, c.altitude, 0.02) << c.where;
    EXPECT_NEAR(p.bearingRad * kDeg, c.bearing, 0.02 / std::cos(p.altitudeRad)) << c.where;
  }
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
  for (const char* text : {"", "noon", "2026-06-21T14:30", "2026-02-29T14:30Z", "2026-13-01T14:30Z",
                           "2026-06-21T25:30Z", "1816-06-21T12:00Z", "2026-06-21T14:30+02:00x"}) {
    EXPECT_FALSE(parseMoment(text).ok()) << text;
  }
}

}  // namespace
}  // namespace roomlight
