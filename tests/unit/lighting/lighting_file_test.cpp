#include "import/lighting_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "base/image_io.h"
#include "scene/surface.h"
#include "trace/lights.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

class LightingFile : public ::testing::Test {
 protected:
  LightingFile() {
    Material glowing;
    glowing.emission = Vec3(100);
    scene_.materials.push_back(glowing);
    Lamp lamp;
    lamp.intensityCd = Vec3(5);
    scene_.lamps.push_back(lamp);
    Sun sun;
    sun.illuminanceLux = Vec3(7);
    scene_.suns.push_back(sun);
    scene_.sky.luminanceCdM2 = Vec3(9);
  }

  Status apply(const std::string& json) {
    const std::filesystem::path file = folder_ / "rig.json";
    std::ofstream(file) << json;
    return applyLightingFile(file, scene_);
  }

  testing::TemporaryFolder folder_;
  Scene scene_;
};

// Flux in lumen of a point or spot lamp by numerical integration of what the renderer sends out.
double fluxOf(const Lamp& lamp) {
  constexpr int kSteps = 400'000;
  const double widest =
      lamp.kind == LampKind::Point ? 2 : 1.02 * (1 - std::cos(static_cast<double>(lamp.outerConeRad)));  // of 1 - cos
  const Frame frame(lamp.direction);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = widest * (i + 0.5) / kSteps;
    sum += luminance(
        lampIntensity(lamp, frame.toWorld({static_cast<float>(std::sqrt(h * (2 - h))), 0, static_cast<float>(1 - h)})));
  }
  return 2 * std::numbers::pi * sum * widest / kSteps;
}

TEST_F(LightingFile, pointAndSpotLampsGiveTheFluxTheyWereGiven) {
  const Status s = apply(R"({"lamps": [
    {"name": "bulb", "type": "point", "position": [1, 2, 3], "flux": "800 lm", "temperature": "2700 K"},
    {"type": "spot", "position": [0, 2, 0], "direction": [0, -2, 0], "flux": "450 lm", "innerCone": 15, "outerCone": 30},
    {"type": "point", "position": [0, 0, 0], "intensity": "90 cd", "color": [1, 0.5, 0.25]}]})");
  ASSERT_TRUE(s) << s.error();
  ASSERT_EQ(scene_.lamps.size(), 4u);
  EXPECT_EQ(scene_.lamps[1].name, "bulb");
  EXPECT_NEAR(fluxOf(scene_.lamps[1]), 800, 0.01);
  EXPECT_GT(scene_.lamps[1].intensityCd.x, 2 * scene_.lamps[1].intensityCd.z);
  EXPECT_NEAR(fluxOf(scene_.lamps[2]), 450, 0.1);
  EXPECT_EQ(scene_.lamps[2].direction.y, -1);
  EXPECT_NEAR(luminance(scene_.lamps[3].intensityCd), 90, 1e-4);
}

TEST_F(LightingFile, narrowSpotsKeepTheirFlux) {
  const char* cones[] = {R"("innerCone": 30, "outerCone": 30)", R"("innerCone": 1, "outerCone": 1)",
                         R"("outerCone": 0.5)", R"("innerCone": 0.4, "outerCone": 0.5)"};
  for (const char* cone : cones) {
    ASSERT_TRUE(
        apply(std::string(
                  R"({"lamps": [{"type": "spot", "position": [0, 0, 0], "direction": [1, 2, 3], "flux": "1000 lm", )") +
              cone + "}]}"));
    EXPECT_NEAR(fluxOf(scene_.lamps.back()), 1000, 10) << cone;
  }
}

TEST_F(LightingFile, areaLampsBecomeEmissiveRectanglesOfTheirFlux) {
  const Status s = apply(
      R"({"lamps": [{"type": "area", "position": [0, 2, 0], "direction": [0, -1, 0], "width": 0.6, "height": 0.3, "flux": "1000 lm"}]})");
  ASSERT_TRUE(s) << s.error();
  ASSERT_EQ(scene_.meshes.size(), 1u);
  EXPECT_NEAR(luminance(scene_.materials[1].emission) * std::numbers::pi * 0.18, 1000, 0.01);
  const Bounds3 b = scene_.bounds();
  EXPECT_NEAR((b.hi.x - b.lo.x) * (b.hi.z - b.lo.z), 0.18, 1e-5);
}

TEST_F(LightingFile, sunByDirectionOrByPlaceAndTime) {
  const Status s = apply(R"({"sun": [{"direction": [0, 3, 0], "illuminance": "75 klx", "angularDiameter": 0},
    {"latitude": 50, "longitude": 10, "time": "2026-06-21T11:22Z"}, {"latitude": 50, "longitude": 10, "time": "2026-06-21T23:00Z"}]})");
  ASSERT_TRUE(s) << s.error();
  ASSERT_EQ(scene_.suns.size(), 3u) << "a sun below the horizon is none";
  EXPECT_EQ(scene_.suns[1].toLight.y, 1);
  EXPECT_EQ(luminance(scene_.suns[1].illuminanceLux), 75000);
  EXPECT_EQ(scene_.suns[1].halfAngleRad, 0);
  // Noon at the solstice: 63.4 degrees high in the south, which is +z.
  EXPECT_NEAR(scene_.suns[2].toLight.y, std::sin(63.44 * std::numbers::pi / 180), 1e-3);
  EXPECT_GT(scene_.suns[2].toLight.z, 0.44f);
  EXPECT_NEAR(scene_.suns[2].toLight.x, 0, 0.02);
  EXPECT_NEAR(luminance(scene_.suns[2].illuminanceLux), 97500, 2500);
  EXPECT_NEAR(scene_.suns[2].halfAngleRad, 0.00465, 1e-4);
}

TEST_F(LightingFile, northTurnsTheSun) {
  ASSERT_TRUE(apply(R"({"sun": {"latitude": 50, "longitude": 10, "time": "2026-06-21T11:22Z", "north": 90}})"));
  EXPECT_GT(scene_.suns[1].toLight.x, 0.44f);  // -z looks east, so south is to the right
}

TEST_F(LightingFile, skyByLuminanceOrPicture) {
  ASSERT_TRUE(apply(R"({"sky": {"luminance": "3000 cd/m2"}})"));
  EXPECT_NEAR(luminance(scene_.sky.luminanceCdM2), 3000, 0.01);
  Image sky(16, 8);
  std::fill(sky.pixels.begin(), sky.pixels.end(), Vec3(2));
  ASSERT_TRUE(writeExr(folder_ / "sky.exr", sky, {}));
  ASSERT_TRUE(apply(R"({"sky": {"image": "sky.exr", "unit": "1000 cd/m2", "rotation": 90}})"));
  EXPECT_EQ(scene_.sky.image.at(3, 3).y, 2000);
  EXPECT_NEAR(scene_.sky.rotationRad, std::numbers::pi / 2, 1e-6);
  ASSERT_TRUE(apply(R"({"sky": {"image": "sky.exr", "horizontalIlluminance": "10 klx"}})"));
  EXPECT_NEAR(scene_.sky.image.at(3, 3).y, 10000 / std::numbers::pi, 0.01) << "a uniform sky gives pi L";
}

TEST_F(LightingFile, switchesOffWhatTheSceneBrought) {
  ASSERT_TRUE(apply(R"({"scene": {"lamps": "off", "suns": "off", "sky": "off", "emission": 0.5}})"));
  EXPECT_TRUE(scene_.lamps.empty());
  EXPECT_TRUE(scene_.suns.empty());
  EXPECT_FALSE(scene_.sky.present());
  EXPECT_EQ(scene_.materials[0].emission.x, 50);
  ASSERT_TRUE(apply(R"({"scene": {"emission": "off"}})"));
  EXPECT_EQ(scene_.materials[0].emission.x, 0);
}

TEST_F(LightingFile, aFactorThatWouldOverflowTheEmissionIsAnError) {
  scene_.materials[0].emission = Vec3(1e8f);
  const Status s = apply(R"({"scene": {"lamps": "off", "emission": 1e6}})");
  ASSERT_FALSE(s);
  EXPECT_NE(s.error().find("scene.emission"), std::string::npos) << s.error();
  EXPECT_EQ(scene_.lamps.size(), 1u);
  EXPECT_EQ(scene_.materials[0].emission.x, 1e8f);
}

TEST_F(LightingFile, errorsNameFileAndPlaceAndLeaveTheSceneAlone) {
  const std::string lamp = R"("type": "point", "position": [0, 0, 0])";
  const std::string area = R"("type": "area", "position": [0, 0, 0], "direction": [0, 1, 0], "width": 1, "height": 1)";
  const std::pair<std::string, const char*> cases[] = {
      {"", "parse error"},
      {"[1]", "must be an object"},
      {R"({"lamp": []})", "unknown key 'lamp'; there are"},
      {R"({"version": 2})", "version: must be 1"},
      {R"({"lamps": {}})", "lamps: must be a list"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": 800}]})", "lamps[0].flux: has no unit; write \"800 lm\""},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "800 lx"}]})", "lamps[0].flux: '800 lx' is in lx"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "-1 lm"}]})", "out of range"},
      {R"({"lamps": [{)" + lamp + R"(}]})", "exactly one of flux, intensity"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "1 lm", "intensity": "1 cd"}]})", "exactly one of flux, intensity"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "1 lm", "width": 2}]})",
       "lamps[0].width: means nothing for a lamp of type point"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "1 lm", "temperature": "900 K"}]})", "out of range"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "1 lm", "temperature": "2700 K", "color": [1, 1, 1]}]})", "not both"},
      {R"({"lamps": [{"type": "tube", "position": [0, 0, 0], "flux": "1 lm"}]})",
       "unknown 'tube'; there are point, spot, area, photometric"},
      {R"({"lamps": [{"type": "point", "position": [0, 0], "flux": "1 lm"}]})",
       "lamps[0].position: must be a list of three numbers"},
      {R"({"lamps": [{"type": "point", "position": [0, 1e30, 0], "flux": "1 lm"}]})", "lamps[0].position[1]"},
      {R"({"lamps": [{"type": "spot", "position": [0, 0, 0], "direction": [0, 0, 0], "flux": "1 lm"}]})",
       "lamps[0].direction: must not be zero"},
      {R"({"lamps": [{"type": "spot", "position": [0, 0, 0], "direction": [0, 1, 0], "flux": "1 lm", "innerCone": 40, "outerCone": 20}]})",
       "innerCone"},
      {R"({"lamps": [{)" + area + R"(, "up": [0, 2, 0], "flux": "1 lm"}]})", "lamps[0].up"},
      {R"({"lamps": [{)" + area + R"(, "intensity": "1 cd"}]})", "lamps[0].intensity"},
      {R"({"sun": {"direction": [0, 1, 0]}})", "'illuminance' is missing"},
      {R"({"sun": {"latitude": 91, "longitude": 0, "time": "2026-06-21T11:22Z"}})", "sun.latitude"},
      {R"({"sun": {"latitude": 1, "longitude": 0, "time": "noon"}})", "sun.time: 'noon'"},
      {R"({"sun": {"direction": [0, 1, 0], "illuminance": "1 lx", "latitude": 3}})", "not both"},
      {R"({"sky": {}})", "sky: give exactly one of luminance, image"},
      {R"({"sky": {"image": "none.hdr", "unit": "1 cd/m2"}})", "none.hdr"},
      {R"({"scene": {"lamps": "dim"}})", "scene.lamps: unknown 'dim'; there are keep, off"},
      {R"({"scene": {"emission": -1}})", "scene.emission"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "1 lm", "color": [0, 0, 0]}]})", "lamps[0].color: must not be black"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "1 lm", "color": [1e-40, 0, 0]}]})",
       "lamps[0].color: must not be black"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "1e999 lm"}]})", "lamps[0].flux"},
      {R"({"lamps": [{)" + lamp + R"(, "flux": "nan lm"}]})", "lamps[0].flux"},
      {R"({"lamps": [{)" + lamp + R"(, "name": 3, "flux": "1 lm"}]})", "lamps[0].name: must be a text"},
      {R"({"lamps": [{"type": "area", "position": [0, 0, 0], "direction": [0, 1, 0], "width": 1e-4, "height": 1e-4, "flux": "1e12 lm"}]})",
       "lamps[0].flux: is more than"},
      {R"({"lamps": [{"type": "point", "position": [0, 0, 0], "flux": "1 lm"}], "lamps": []})",
       "the key 'lamps' is given twice"},
      {R"({"a\nb": 1})", "unknown key 'a b'"},
      {R"({"sky": {"luminance": "1 cd/m2", "image": "a.hdr"}})", "sky: give exactly one of luminance, image"},
      {R"({"sky": {"image": ".", "unit": "1 cd/m2"}})", "sky.image: is not a file"},
      {R"({"sky": {"luminance": "3000 lx"}})", "sky.luminance: '3000 lx' is in lx, where cd/m2 is needed"},
      {R"({"sun": [{"direction": [0, 1, 0], "illuminance": "1 lx"}, {"direction": [0, 1, 0], "illuminance": "1 lx", "angularDiameter": 91}]})",
       "sun[1].angularDiameter"},
      {R"({"scene": {"emission": 2e6}})", "scene.emission"},
      {R"({"sun": {"latitude": 1, "longitude": 0, "time": ")" + std::string(1'000'000, 'x') + "\"}}", "sun.time"},
      {R"({"sky": {"unit": "1 cd/m2", "image": ")" + std::string(1'000'000, 'x') + "\"}}", "sky.image"},
      {R"({"comment": ")" + std::string(1'000'000, 'x'), "parse error"},
      {std::string(100'000, '['), "nested more than 32 deep"},
      {std::string(100'000, '[') + std::string(100'000, ']'), "nested more than 32 deep"},
      {std::string(17 << 20, ' '), "larger than 16 MiB"},
  };
  for (const auto& [json, expected] : cases) {
    const Status s = apply(json);
    ASSERT_FALSE(s) << json.substr(0, 200);
    EXPECT_NE(s.error().find(expected), std::string::npos) << s.error();
    EXPECT_NE(s.error().find("rig.json"), std::string::npos) << s.error();
    EXPECT_EQ(s.error().find('\n'), std::string::npos) << s.error();
    EXPECT_LT(s.error().size(), 1000u);
    EXPECT_EQ(scene_.lamps.size(), 1u);
    EXPECT_EQ(scene_.suns.size(), 1u);
    EXPECT_EQ(scene_.meshes.size(), 0u);
    EXPECT_EQ(scene_.sky.luminanceCdM2.x, 9);
    EXPECT_EQ(scene_.materials[0].emission.x, 100);
  }
  EXPECT_NE(applyLightingFile(folder_ / "missing.json", scene_).error().find("no such file"), std::string::npos);
}

// As the file names them, or as people see them called.
TEST_F(LightingFile, ownLampsAndMaterialsAnswerToBothNames) {
  scene_.lamps[0].name = "Point.001";
  Material code;
  code.name = "Material.007", code.transmission = 1;
  scene_.materials.push_back(code);
  for (const char* name : {"Point.001", "Point"}) {
    scene_.lamps[0].intensityCd = Vec3(5);
    const Status s = apply(R"({"own": [{"name": ")" + std::string(name) + R"(", "dimming": 0.5}]})");
    ASSERT_TRUE(s) << s.error();
    EXPECT_FLOAT_EQ(scene_.lamps[0].intensityCd.x, 2.5f);
  }
  EXPECT_FALSE(apply(R"({"own": [{"name": "Spot"}]})"));
  const Status s = apply(R"({"glazing": [{"material": "glass", "panes": 2}]})");
  ASSERT_TRUE(s) << s.error();
  EXPECT_EQ(scene_.materials.back().glazing.panes, 2);
}

TEST_F(LightingFile, glazingMakesWindowsOfMaterials) {
  scene_.materials.resize(3);
  scene_.materials[1].name = scene_.materials[2].name = "Glass";
  scene_.materials[1].baseColor = Vec3(0.3f);
  scene_.materials[1].transmission = 0.5f;
  const Status s = apply(R"({"glazing": [{"material": "Glass", "panes": 2, "internalTransmittance": 0.9}]})");
  ASSERT_TRUE(s) << s.error();
  EXPECT_EQ(scene_.materials[0].glazing.panes, 0);
  for (size_t i = 1; i < 3; ++i) {
    const Material& m = scene_.materials[i];
    EXPECT_EQ(m.glazing.panes, 2);
    EXPECT_EQ(m.glazing.ior, 1.52f);
    const MaterialSample sample = materialAt(scene_, m, VertexValues());
    EXPECT_NEAR(straightTransmittance(m, sample, 0.6f).y, glazingLight({2, 1.52f, 0.9f}, 0.6f).transmitted, 1e-6);
    EXPECT_NEAR(bihemisphericalAlbedo(sample).y, glazingHemisphericalReflectance({2, 1.52f, 0.9f}), 1e-6);
  }
  const Status missing = apply(R"({"glazing": [{"material": "Pane"}]})");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().find("glazing[0].material: no material is called 'Pane'; there are '', 'Glass', 'Glass'"),
            std::string::npos)
      << missing.error();
}

}  // namespace
}  // namespace roomlight
