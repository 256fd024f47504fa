// Luminaires that a glTF file names: photometric files beside it.
#include <gtest/gtest.h>

#include "unit/import/gltf_file.h"
#include "unit/photometry/web_files.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using nlohmann::json;
using testing::GltfFile;

class GltfLuminaire : public ::testing::Test {
 protected:
  GltfLuminaire() {
    testing::IesText ies;
    ies.width = ies.length = -0.2;
    testing::writeFile(folder_ / "spot.ies", ies.text());
    ies.lumens = 9000;
    testing::writeFile(folder_ / "odd.ies", ies.text());
  }
  void add(const json& node) {
    file_.json["nodes"].push_back(node);
    file_.json["scenes"][0]["nodes"].push_back(file_.json["nodes"].size() - 1);
  }
  Result<Imported> read() { return file_.import(folder_ / "a.glb"); }

  testing::TemporaryFolder folder_;
  GltfFile file_ = GltfFile::triangle();
};

TEST_F(GltfLuminaire, aNodeIsNamedAfterItsFile) {
  add({{"name", "spot.ies"}, {"translation", {1, 2, 3}}});
  add({{"name", "spot.ies.001"}, {"rotation", {-0.7071068, 0, 0, 0.7071068}}});  // a quarter turn about x: -z to -y
  const Result<Imported> imported = read();
  ASSERT_TRUE(imported) << imported.error();
  const std::vector<Lamp>& lamps = imported.value().scene.lamps;
  ASSERT_EQ(lamps.size(), 2u);
  EXPECT_EQ(lamps[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(lamps[0].direction, Vec3(0, 0, -1));
  EXPECT_EQ(lamps[0].up, Vec3(0, 1, 0));
  EXPECT_NEAR(luminance(lamps[0].intensityCd), 1000, 0.01);
  EXPECT_TRUE(lamps[0].extended);
  EXPECT_NEAR(lamps[1].direction.y, -1, 1e-5f);
  EXPECT_NEAR(lamps[1].up.z, -1, 1e-5f);
  EXPECT_EQ(lamps[0].web, lamps[1].web);
}

TEST_F(GltfLuminaire, extrasSayMore) {
  add({{"name", "left"},
       {"extras", {{"roomlight", {{"ies", "odd.ies"}, {"fluxLm", 500}, {"dimming", 0.5}, {"as", "point"}}}}}});
  const Result<Imported> imported = read();
  ASSERT_TRUE(imported) << imported.error();
  const Lamp& lamp = imported.value().scene.lamps.at(0);
  EXPECT_EQ(lamp.name, "left");
  EXPECT_FALSE(lamp.extended);
  EXPECT_NEAR(static_cast<double>(luminance(lamp.intensityCd) / lamp.web->peakCd) * lamp.web->fluxLm, 250, 0.01);
  ASSERT_EQ(imported.value().warnings.size(), 1u);
  EXPECT_EQ(imported.value().warnings[0].substr(0, 9), "odd.ies: ");
}

TEST_F(GltfLuminaire, aNameWithoutAFileIsAWarning) {
  add({{"name", "gone.ies"}});
  add({{"name", "../spot.ies"}});
  const Result<Imported> imported = read();
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_TRUE(imported.value().scene.lamps.empty());
  EXPECT_EQ(imported.value().warnings.size(), 2u);
}

TEST_F(GltfLuminaire, wrongExtrasAreErrors) {
  const std::pair<json, const char*> cases[] = {
      {{{"ies", "../spot.ies"}}, "leaves the scene's folder"},
      {{{"ies", "gone.ies"}}, "'gone.ies': there is no such file"},
      {{{"ies", "/etc/passwd"}}, "is an absolute path"},
      {{{"ies", 5}}, "nodes[1].extras.roomlight.ies"},
      {{{"dimming", 0.5}}, "nodes[1].extras.roomlight"},
      {{{"ies", "spot.ies"}, {"dimming", 2}}, "dimming"},
      {{{"ies", "spot.ies"}, {"flux", 2}}, "the key 'flux' is unknown"},
      {{{"ies", "spot.ies"}, {"as", "tube"}}, "is neither point nor area"},
  };
  for (const auto& [extras, expected] : cases) {
    file_ = GltfFile::triangle();
    add({{"name", "lamp"}, {"extras", {{"roomlight", extras}}}});
    const Result<Imported> imported = read();
    ASSERT_FALSE(imported) << extras;
    EXPECT_NE(imported.error().find(expected), std::string::npos) << imported.error();
  }
}

}  // namespace
}  // namespace roomlight
