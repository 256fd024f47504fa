#include "mix/layer_info.h"

#include <gtest/gtest.h>

#include "unit/mix/layers.h"

namespace roomlight {
namespace {

using Found = std::vector<size_t>;

TEST(LayerNames, exactThenAnyCaseThenPatternThenTheOnlyBeginning) {
  std::vector<LayerInfo> layers = testing::someLayers();
  EXPECT_EQ(findLamps(layers, "Sofa lamp").value(), Found{0});
  EXPECT_EQ(findLamps(layers, "lamp_02").value(), Found{1});
  EXPECT_EQ(findLamps(layers, "SOFA LAMP").value(), Found{0});
  EXPECT_EQ(findLamps(layers, "sof").value(), Found{0});
  EXPECT_EQ(findLamps(layers, "kitchen*").value(), (Found{1, 2}));
  EXPECT_EQ(findLamps(layers, "*").value(), (Found{0, 1, 2})) << "sun and sky are no lamps";
  EXPECT_EQ(findLamps(layers, "?ofa*p").value(), Found{0});
  layers[1].name = "Sofa";  // an exact name goes before the beginning of another
  EXPECT_EQ(findLamps(layers, "sofa").value(), Found{1});
}

TEST(LayerNames, lettersAreLettersInEveryCase) {
  std::vector<LayerInfo> layers = testing::someLayers();
  layers[0].name = "Küche Décor", layers[1].name = "ЛАМПА Ω";
  EXPECT_EQ(findLamps(layers, "KÜCHE DÉCOR").value(), Found{0});
  EXPECT_EQ(findLamps(layers, "лампа ω").value(), Found{1});
  EXPECT_EQ(findLamps(layers, "k?che d?cor").value(), Found{0}) << "? is a letter, not a byte";
  EXPECT_EQ(findLamps(layers, "KÜ").value(), Found{0});
  EXPECT_FALSE(findLamps(layers, "k??che d*").ok());
  layers[0].name = std::string(1, '\xfc');  // no UTF-8: only itself
  EXPECT_EQ(findLamps(layers, "\xfc").value(), Found{0});
  EXPECT_FALSE(findLamps(layers, "\xdc").ok());
}

TEST(LayerNames, severalNamesInAnotherCaseAreTold) {
  std::vector<LayerInfo> layers = testing::someLayers();
  layers[0].name = "Sofa", layers[1].name = "SOFA";
  EXPECT_EQ(findLamps(layers, "SOFA").value(), Found{1});
  EXPECT_EQ(findLamps(layers, "sofa").error(),
            "'sofa' may be 'Sofa', 'SOFA'; write capital and small letters as there");
}

TEST(LayerNames, wrongNamesListThoseThereAre) {
  const std::vector<LayerInfo> layers = testing::someLayers();
  EXPECT_EQ(findLamps(layers, "Hall").error(),
            "no lamp 'Hall'; there are 'Sofa lamp', 'Kitchen ceiling', 'Kitchen sink'");
  EXPECT_EQ(
      findLamps(layers, "kitchen").error(),
      "'kitchen' may be 'Kitchen ceiling', 'Kitchen sink'; write more of the name, or 'kitchen*' for all of them");
  EXPECT_FALSE(findLamps(layers, "").ok());
  EXPECT_FALSE(findLamps(layers, "Sky").ok());
  EXPECT_FALSE(findLamps(layers, "x*").ok());
}

TEST(LayerInfo, readsTheHeadersJson) {
  const std::vector<LayerInfo> layers = testing::someLayers();
  ASSERT_EQ(layers.size(), 4u);
  EXPECT_NEAR(luminance(layers[0].colour), 1, 1e-6f);
  EXPECT_EQ(layers[0].kelvin.value(), 2700);
  EXPECT_EQ(layers[0].room, "Living");
  EXPECT_FLOAT_EQ(layers[1].pixel.value().x, 0.75f);
  EXPECT_FALSE(layers[2].kelvin.has_value());
  EXPECT_TRUE(layers[3].room.empty());
  EXPECT_FALSE(isLamp(layers[3]));
  EXPECT_FALSE(layers[0].lightColour.has_value());
  const auto told = layersFromJson(
      R"({"version": 1, "layers": [{"channel": "a", "name": "A", "kind": "lamp", "lightColour": [0.5, 0.25, 0]}]})",
      "a.exr");
  EXPECT_EQ(told.value()[0].lightColour.value().y, 0.25f);
}

TEST(LayerInfo, badJsonIsOneClearLine) {
  const auto errorOf = [](const char* text) { return layersFromJson(text, "a.exr").error(); };
  EXPECT_NE(errorOf("{").find("a.exr: "), std::string::npos);
  EXPECT_EQ(errorOf(R"({"version": 2, "layers": []})"), "a.exr: is of version 2, this program reads 1");
  const auto expectError = [&](const std::string& kind, const char* part) {
    const std::string text = R"({"version": 1, "layers": [{"channel": "a", "name": "A")" + kind + "}]}";
    EXPECT_NE(errorOf(text.c_str()).find(part), std::string::npos) << text;
  };
  expectError("", "a.exr: layers[0]: key 'kind' not found");
  expectError(R"(, "kind": "moon")", "unknown kind 'moon'");
  expectError(R"(, "kind": "lamp", "colour": [1, -1, 0])", "'colour'");
  expectError(R"(, "kind": "lamp", "lightColour": [0, -1, 0])", "'lightColour'");
  expectError(R"(, "kind": "lamp", "lightColour": [0, 0])", "a.exr: layers[0]");
}

}  // namespace
}  // namespace roomlight
