#include "photometry/quantity.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

TEST(Quantity, readsNumbersWithTheirUnit) {
  EXPECT_EQ(parseQuantity("800 lm", Unit::Lumen).value(), 800);
  EXPECT_EQ(parseQuantity(" 1.5e3cd/m2 ", Unit::CandelaPerM2).value(), 1500);
  EXPECT_EQ(parseQuantity("3 cd/m\u00b2", Unit::CandelaPerM2).value(), 3);
  EXPECT_EQ(parseQuantity("75 klx", Unit::Lux).value(), 75000);
  EXPECT_EQ(parseQuantity("2700K", Unit::Kelvin).value(), 2700);
  EXPECT_EQ(parseQuantity("-2 cd", Unit::Candela).value(), -2);
}

TEST(Quantity, saysWhatIsWrong) {
  EXPECT_NE(parseQuantity("800", Unit::Lumen).error().find("write '800 lm'"), std::string::npos);
  EXPECT_NE(parseQuantity("800 lx", Unit::Lumen).error().find("is in lx, where lm is needed"), std::string::npos);
  EXPECT_NE(parseQuantity("800 watt", Unit::Lumen).error().find("unknown unit 'watt'"), std::string::npos);
  for (const char* text : {"", "lm", "nan lm", "inf lm", "1e999 lm"})
    EXPECT_FALSE(parseQuantity(text, Unit::Lumen).ok()) << text;
}

}  // namespace
}  // namespace roomlight
