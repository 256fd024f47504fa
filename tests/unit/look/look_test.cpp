#include "look/look.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

TEST(Look, everyNameHasOne) {
  for (const auto& [name, what] : lookNames()) {
    EXPECT_TRUE(displayOfLook(name)) << name;
    EXPECT_FALSE(what.empty());
  }
  EXPECT_NE(displayOfLook("moody").error().find("natural, bright, evening, technical"), std::string::npos);
}

TEST(Look, theTechnicalOneAddsNothing) {
  const Display d = displayOfLook("technical").value();
  EXPECT_TRUE(d.tone.plain());
  EXPECT_EQ(d.localExposure + d.glare + d.vignette + d.brighterEv, 0);
}

}  // namespace
}  // namespace roomlight
