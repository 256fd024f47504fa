// Lamps of a lighting file that shine as a photometric file says; dimming and losses of any lamp.
#include <gtest/gtest.h>

#include "import/lighting_file.h"
#include "unit/photometry/web_files.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

class PhotometricLamp : public ::testing::Test {
 protected:
  PhotometricLamp() {
    testing::IesText ies;
    ies.width = 0.3, ies.length = 0.6;
    testing::writeFile(folder_ / "panel.ies", ies.text());
    ies.width = ies.length = 0;
    ies.tilt = "TILT=lamp.tlt\n";
    testing::writeFile(folder_ / "point.IES", ies.text());
    testing::writeFile(folder_ / "lamp.tlt", "1 2 0 90 1 0.5");
    ies.lumens = 9000;
    ies.tilt = "TILT=../secret.tlt\n";
    testing::writeFile(folder_ / "outside.ies", ies.text());
    testing::writeFile(folder_ / "strip.ldt", testing::LdtText().text());
    testing::writeFile(folder_ / "damaged.ldt", "Roomlight\n1\n9\n");
  }

  // One lamp with these keys.
  Status apply(const std::string& keys) {
    scene_ = {}, warnings_ = {};
    testing::writeFile(folder_ / "rig.json",
                       R"({"lamps": [{"type": "photometric", "position": [1, 2, 3], )" + keys + "}]}");
    return applyLightingFile(folder_ / "rig.json", scene_, &warnings_);
  }
  Lamp lamp(const std::string& keys) {
    const Status s = apply(keys);
    EXPECT_TRUE(s) << s.error();
    return s ? scene_.lamps.at(0) : Lamp{};
  }
  static double fluxLm(const Lamp& l) {
    return static_cast<double>(luminance(l.intensityCd) / l.web->peakCd) * l.web->fluxLm;
  }

  testing::TemporaryFolder folder_;
  Scene scene_;
  std::vector<std::string> warnings_;
};

TEST_F(PhotometricLamp, pointsDownWithC0AlongX) {
  const Lamp l = lamp(R"("file": "panel.ies")");
  EXPECT_EQ(l.kind, LampKind::Point);
  EXPECT_EQ(l.position, Vec3(1, 2, 3));
  EXPECT_EQ(l.direction, Vec3(0, -1, 0));
  EXPECT_EQ(l.up, Vec3(1, 0, 0));
  EXPECT_NEAR(luminance(l.intensityCd), 1000, 0.01);
  EXPECT_TRUE(l.extended);
  EXPECT_FALSE(lamp(R"("file": "panel.ies", "as": "point")").extended);
  EXPECT_FALSE(lamp(R"("file": "strip.ldt")").extended);
  const Lamp turned = lamp(R"("file": "panel.ies", "direction": [0, 0, -2], "up": [0, 3, 1])");
  EXPECT_EQ(turned.up, Vec3(0, 1, 0));
}

TEST_F(PhotometricLamp, fluxIsThatOfTheFileOrAsAskedFor) {
  EXPECT_NEAR(fluxLm(lamp(R"("file": "strip.ldt")")), 1000, 2);
  EXPECT_NEAR(fluxLm(lamp(R"("file": "strip.ldt", "flux": "500 lm")")), 500, 0.01);
  EXPECT_NEAR(
      fluxLm(lamp(
          R"("file": "strip.ldt", "flux": "500 lm", "dimming": 0.5, "lightLossFactor": 0.8, "temperature": "2700 K")")),
      200, 0.01);
  EXPECT_EQ(fluxLm(lamp(R"("file": "strip.ldt", "dimming": 0)")), 0);
}

TEST_F(PhotometricLamp, dimmingAndLossesWorkForEveryLamp) {
  testing::writeFile(folder_ / "rig.json", R"({"lamps": [
    {"type": "point", "position": [0, 0, 0], "intensity": "100 cd", "dimming": 0.5, "lightLossFactor": 0.9},
    {"type": "spot", "position": [0, 0, 0], "direction": [0, -1, 0], "intensity": "100 cd", "dimming": 0.25},
    {"type": "area", "position": [0, 0, 0], "direction": [0, -1, 0], "width": 1, "height": 1, "luminance": "100 cd/m2", "lightLossFactor": 0.7}]})");
  const Status s = applyLightingFile(folder_ / "rig.json", scene_);
  ASSERT_TRUE(s) << s.error();
  EXPECT_NEAR(luminance(scene_.lamps[0].intensityCd), 45, 1e-3);
  EXPECT_NEAR(luminance(scene_.lamps[1].intensityCd), 25, 1e-3);
  EXPECT_NEAR(luminance(scene_.lamps[2].luminanceCdM2), 70, 1e-3);
  EXPECT_NEAR(luminance(scene_.materials.back().emission), 70, 1e-3);
}

// Of lamps that burn weaker tilted; the table lies beside the file.
TEST_F(PhotometricLamp, tiltCounts) {
  EXPECT_NEAR(luminance(lamp(R"("file": "point.IES")").intensityCd), 1000, 0.01);
  EXPECT_NEAR(luminance(lamp(R"("file": "point.IES", "direction": [1, 0, 0])").intensityCd), 500, 0.1);
}

TEST_F(PhotometricLamp, oddFilesWarnWithTheirName) {
  testing::LdtText file;
  file.ratioPercent = 50;
  testing::writeFile(folder_ / "odd.ldt", file.text());
  lamp(R"("file": "odd.ldt")");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warnings_[0].substr(0, 37), "odd.ldt: the intensities add up to 99");
}

TEST_F(PhotometricLamp, mistakesNameTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {R"("flux": "1 lm")", "lamps[0]: 'file' is missing"},
      {R"("file": "none.ies")", "lamps[0].file: 'none.ies': there is no such file"},
      {R"("file": "rig.json")", "lamps[0].file: 'rig.json': unknown kind of photometric file; use .ies or .ldt"},
      {R"("file": "damaged.ldt")",
       "lamps[0].file: 'damaged.ldt': line 3: line 3, the symmetry: 9 is not a whole number from 0 to 4"},
      {R"("file": "outside.ies")",
       "lamps[0].file: 'outside.ies': line 5: TILT file: '../secret.tlt' leaves the scene's folder"},
      {R"("file": "strip.ldt", "as": "area")", "lamps[0].as: must be point: the file states no luminous opening"},
      {R"("file": "strip.ldt", "as": "disc")", "lamps[0].as: unknown 'disc'; there are point, area"},
      {R"("file": "strip.ldt", "intensity": "1 cd")",
       "lamps[0].intensity: means nothing for a lamp of type photometric"},
      {R"("file": "strip.ldt", "dimming": 1.1)", "lamps[0].dimming"},
      {R"("file": "strip.ldt", "lightLossFactor": 0)", "lamps[0].lightLossFactor"},
      {R"("file": "strip.ldt", "up": [0, 1, 0])", "lamps[0].up: must not point along 'direction'"},
  };
  for (const auto& [keys, expected] : cases) {
    const Status s = apply(keys);
    ASSERT_FALSE(s) << keys;
    EXPECT_NE(s.error().find(expected), std::string::npos) << s.error();
    EXPECT_TRUE(scene_.lamps.empty());
  }
}

}  // namespace
}  // namespace roomlight
