#include "photometry/epw.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

const std::string kHeader =
    "LOCATION,Porto Alegre,RS,BRA,SWERA,839710,-30.00,-51.18,-3.0,3.0\r\nDESIGN CONDITIONS,0\r\nTYPICAL/EXTREME "
    "PERIODS,0\r\nGROUND TEMPERATURES,0\r\n"
    "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\r\nCOMMENTS 1,none\r\nCOMMENTS 2,none\r\nDATA "
    "PERIODS,1,1,Data,Sunday,1/1,12/31\r\n";
const std::string kNoon =
    "1996,3,1,12,60,?9?9?9,24.5,17.1,61,101200,1000,1400,400,800,650,210,88000,64000,24000,3000,90,2.0,4,4\r\n";

TEST(Epw, readsPlaceAndHours) {
  const Result<Epw> r = parseEpw(kHeader + kNoon);
  ASSERT_TRUE(r) << r.error();
  EXPECT_EQ(r.value().city, "Porto Alegre");
  EXPECT_EQ(r.value().latitudeDeg, -30);
  EXPECT_EQ(r.value().longitudeDeg, -51.18);
  EXPECT_EQ(r.value().utcOffsetHours, -3);
  ASSERT_EQ(r.value().hours.size(), 1u);
  const EpwHour& h = r.value().hours[0];
  EXPECT_EQ(h.directNormalWm2, 650);
  EXPECT_EQ(h.diffuseHorizontalWm2, 210);
  EXPECT_EQ(h.directNormalLux, 64000);
  EXPECT_EQ(h.diffuseHorizontalLux, 24000);
  EXPECT_EQ(h.dewPointC, 17.1);
}

TEST(Epw, findsTheHourThatEndsAfterTheMoment) {
  const Epw weather = parseEpw(kHeader + kNoon).value();
  const auto has = [&](const char* time) { return hourAt(weather, parseMoment(time).value()) != nullptr; };
  EXPECT_TRUE(has("2026-03-01T11:00-03:00"));
  EXPECT_TRUE(has("2026-03-01T14:59Z"));
  EXPECT_TRUE(has("2026-03-02T01:30+11:00")) << "another day elsewhere";
  EXPECT_FALSE(has("2026-03-01T12:00-03:00"));
  EXPECT_FALSE(has("2026-03-01T10:59-03:00"));
  const Epw newYear = parseEpw(kHeader + "1996,1,1,1" + kNoon.substr(11)).value();
  EXPECT_NE(hourAt(newYear, parseMoment("2025-12-31T23:30-04:00").value()), nullptr);
}

TEST(Epw, missingValuesAreMissing) {
  const Result<Epw> r = parseEpw(
      kHeader + "1996,3,1,12,60,?9,24.5,99.9,61,101200,1000,1400,400,800,9999,9999,999999,999900,0,3000,90,2.0,4,4\n");
  ASSERT_TRUE(r) << r.error();
  const EpwHour& h = r.value().hours[0];
  EXPECT_FALSE(h.directNormalWm2 || h.diffuseHorizontalWm2 || h.directNormalLux || h.dewPointC);
}

TEST(Epw, zeroLuxBesideIrradianceAreMissingToo) {
  const EpwHour h =
      parseEpw(kHeader + "1996,3,1,12,60,?9,24.5,9,61,101200,1000,1400,400,800,650,210,0,0,0,0,90,2.0,4,4\n")
          .value()
          .hours[0];
  EXPECT_FALSE(h.directNormalLux || h.diffuseHorizontalLux);
  EXPECT_EQ(h.directNormalWm2, 650);
}

TEST(Epw, saysInWhichLineWhatIsWrong) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "line 1: does not begin with 'LOCATION'"},
      {"{}", "line 1: does not begin with 'LOCATION'"},
      {"LOCATION,Town\n", "line 1: has 2 fields"},
      {"LOCATION,Town,a,b,c,1,95,0,0,0\n", "line 1: field 7 (latitude) is 95"},
      {kHeader, "line 8: the file ends without an hour"},
      {kHeader + kNoon + "1996,3,1\n", "line 10: has 3 fields"},
      {kHeader + "1996,inf" + kNoon.substr(6), "line 9: field 2 (month) is not a number"},
      {kHeader + "1996,13" + kNoon.substr(6), "line 9: field 2 (month) is 13"},
      {kHeader + "1996,3,1,12,60,?9,24.5,9,61,101200,1000,1400,400,800,many,210,0,0,0,0,90,2.0,4,4\n",
       "line 9: field 15 (direct normal irradiance) is not a number"},
      {kHeader + "1996,3,1,12,60,?9,24.5,9,61,101200,1000,1400,400,800,-5,210,0,0,0,0,90,2.0,4,4\n",
       "line 9: field 15 (direct normal irradiance) is -5"},
  };
  for (const auto& [text, expected] : cases) {
    const Result<Epw> r = parseEpw(text);
    ASSERT_FALSE(r) << text;
    EXPECT_NE(r.error().find(expected), std::string::npos) << r.error();
  }
}

}  // namespace
}  // namespace roomlight
