#include "mix/floor_plan.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "unit/mix/layers.h"

namespace roomlight {
namespace {

FloorPlan somePlan() {
  const Switches switches = {std::vector<Vec3>(4, Vec3(1)), {0, 2}};
  FloorPlan plan = planOf(testing::someLayers(), switches, {{2, "switch.sink"}}, ".png");
  plan.width = 1920, plan.height = 1080;
  for (PlanLamp& lamp : plan.lamps) {
    for (size_t i = 0; i <= 10; ++i) lamp.opacities[i] = std::sqrt(0.1f * static_cast<float>(i));
  }
  return plan;
}

TEST(FloorPlan, slugsAreThoseOfHomeAssistant) {
  EXPECT_EQ(slugOf("Sofa lamp"), "sofa_lamp");
  EXPECT_EQ(slugOf("  Küche, Decke (2) "), "kuche_decke_2");
  EXPECT_EQ(slugOf("Großer Flur"), "grosser_flur");
  EXPECT_EQ(slugOf("灯"), "lamp");
  EXPECT_EQ(slugOf("../etc"), "etc");
}

TEST(FloorPlan, equalNamesAreNumberedAndNoneIsTheBase) {
  std::vector<LayerInfo> layers = testing::someLayers();
  layers[0].name = "Base", layers[1].name = layers[2].name = "Spot";
  const FloorPlan plan = planOf(layers, {std::vector<Vec3>(4, Vec3(1)), {0, 1, 2}}, {}, ".webp");
  EXPECT_EQ(plan.lamps[0].file, "base_2.webp");
  EXPECT_EQ(plan.lamps[1].file, "spot.webp");
  EXPECT_EQ(plan.lamps[2].file, "spot_2.webp");
  EXPECT_EQ(plan.lamps[2].entity, "light.spot_2");
}

TEST(FloorPlan, theCardIsWhatHomeAssistantReads) {
  EXPECT_EQ(
      cardOf(somePlan(), "/local/floorplan/", false),
      R"(# A card of Home Assistant (type: picture-elements), made by roomlight mix. Its pictures are served from the folder config/www.
type: picture-elements
image: "/local/floorplan/base.png"
elements:
  - type: image
    entity: light.sofa_lamp
    image: "/local/floorplan/sofa_lamp.png"
    state_filter:
      "on": opacity(100%)
      "off": opacity(0%)
      "unavailable": opacity(0%)
      "unknown": opacity(0%)
    tap_action:
      action: none
    style:
      left: 50%
      top: 50%
      width: 100%
      mix-blend-mode: screen
      pointer-events: none
  - type: image
    entity: switch.sink
    image: "/local/floorplan/kitchen_sink.png"
    state_filter:
      "on": opacity(100%)
      "off": opacity(0%)
      "unavailable": opacity(0%)
      "unknown": opacity(0%)
    tap_action:
      action: none
    style:
      left: 50%
      top: 50%
      width: 100%
      mix-blend-mode: screen
      pointer-events: none
  - type: state-icon
    entity: light.sofa_lamp
    title: "Sofa lamp"
    tap_action:
      action: toggle
    hold_action:
      action: more-info
    style:
      left: 25.00%
      top: 50.00%
  - type: state-icon
    entity: switch.sink
    title: "Kitchen sink"
    tap_action:
      action: toggle
    hold_action:
      action: more-info
    style:
      left: 50.00%
      top: 95.00%
)");
}

TEST(FloorPlan, dimmedCardsFollowSensors) {
  const FloorPlan plan = somePlan();
  const std::string card = cardOf(plan, "/local/", true), sensors = sensorsOf(plan);
  EXPECT_NE(card.find("entity: sensor.light_sofa_lamp_level\n"), std::string::npos);
  EXPECT_NE(card.find("      \"50\": opacity(71%)\n"), std::string::npos);
  EXPECT_NE(sensors.find("unique_id: \"light_sofa_lamp_level\""), std::string::npos);
  EXPECT_NE(sensors.find("is_state('switch.sink', 'on')"), std::string::npos);
}

TEST(FloorPlan, thePageNamesEveryPictureAndEscapesNames) {
  FloorPlan plan = somePlan();
  plan.lamps[0].name = "<b>\"Sofa\" & co";
  const std::string page = pageOf(plan);
  for (const char* part : {"src=\"base.png\"", "src=\"sofa_lamp.png\"", "&lt;b&gt;&quot;Sofa&quot; &amp; co",
                           "mix-blend-mode: screen", "left: 25.00%"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(page.find("<b>\""), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing from elsewhere";
}

TEST(FloorPlan, theIndexTellsErrorsAndFiles) {
  OverlayTrial trial;
  trial.errors[0] = {1.5, 2.5, 9};
  const auto index = nlohmann::json::parse(overlayIndexOf(somePlan(), trial));
  EXPECT_EQ(index.at("base"), "base.png");
  EXPECT_EQ(index.at("overlays").size(), 2u);
  EXPECT_EQ(index.at("errorInDisplaySteps").at("screen").at("rms"), 2.5);
  EXPECT_TRUE(index.at("overlays")[1].at("pixel").is_null());
}

}  // namespace
}  // namespace roomlight
