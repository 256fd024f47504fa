// Presets of quality, and how single settings go before them.
#include "engine/settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/technique.h"

namespace roomlight {
namespace {

RenderSettings read(const std::string& text, const std::string& quality = "") {
  const Result<RenderSettings> settings = settingsFromJson(text, "s.json", {}, quality);
  EXPECT_TRUE(settings.ok()) << settings.error();
  return settings.ok() ? settings.value() : RenderSettings();
}

TEST(Quality, goodIsWhatSettingsAreByDefault) {
  RenderSettings good;
  good.radiance.links = 3;
  ASSERT_TRUE(applyQuality("good", good));
  EXPECT_EQ(settingsToJson(good), settingsToJson({}));
}

TEST(Quality, eachDoesMoreThanTheOneBefore) {
  int samples = 0;
  for (const auto& [name, explanation] : qualities()) {
    RenderSettings s;
    ASSERT_TRUE(applyQuality(name, s));
    EXPECT_TRUE(checkSettings(s)) << name;
    EXPECT_EQ(s.quality, name);
    EXPECT_GT(s.hybrid.samples, samples);
    samples = s.hybrid.samples;
  }
}

TEST(Quality, singleSettingsGoBeforeItWhereverTheyStand) {
  for (const char* text :
       {R"({"quality": "draft", "radiance": {"links": 77}})", R"({"radiance": {"links": 77}, "quality": "draft"})"}) {
    const RenderSettings s = read(text);
    EXPECT_EQ(s.radiance.links, 77);
    EXPECT_EQ(s.voxel.sizeFactor, read(R"({"quality": "draft"})").voxel.sizeFactor);
  }
}

TEST(Quality, theOneAskedForGoesBeforeThatOfTheText) {
  const RenderSettings s = read(R"({"quality": "draft", "radiance": {"links": 77}})", "best");
  EXPECT_EQ(s.quality, "best");
  EXPECT_EQ(s.radiance.links, 77);
  EXPECT_GT(s.blendUntilMse, 0);
  EXPECT_EQ(s.voxel.sizeFactor, 1);
}

TEST(Quality, settingsThatWereWrittenAreReadBack) {
  RenderSettings best;
  ASSERT_TRUE(applyQuality("best", best));
  EXPECT_EQ(settingsToJson(read(settingsToJson(best))), settingsToJson(best));
}

TEST(Settings, techniquesWithSettingsOfTheirOwnHaveAGroupOfTheirName) {
  for (const Technique* t : techniques()) {
    const std::string text = fmt::format(R"({{"{}": {{"noSuchMember": 1}}}})", t->name);
    EXPECT_NE(settingsFromJson(text, "s.json").error().find(fmt::format("/{}/noSuchMember: unknown key", t->name)),
              std::string::npos)
        << t->name;
  }
  EXPECT_NE(settingsFromJson(R"({"gather": {}})", "s.json").error().find("/gather: unknown key; there are"),
            std::string::npos);
}

TEST(Quality, unknownNamesAreErrorsThatListTheKnown) {
  RenderSettings s;
  EXPECT_EQ(applyQuality("perfect", s).error(), "quality: unknown name 'perfect'; there are draft, good, best");
  EXPECT_EQ(settingsFromJson(R"({"quality": "perfect"})", "s.json").error(),
            "s.json: quality: unknown name 'perfect'; there are draft, good, best");
  s.quality = "perfect";
  EXPECT_FALSE(checkSettings(s));
}

}  // namespace
}  // namespace roomlight
