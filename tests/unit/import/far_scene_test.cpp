// Files whose coordinates are a country's, or whose lamps and cameras stand where none can be.
#include <gtest/gtest.h>

#include "import/import.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::TemporaryFolder;
using testing::writeFile;

Imported imported(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  writeFile(folder / name, text);
  Result<Imported> result = importScene(folder / name);
  EXPECT_TRUE(result) << result.error();
  return result ? std::move(result.value()) : Imported();
}

bool says(const Imported& imported, const std::string& text) {
  return std::any_of(imported.warnings.begin(), imported.warnings.end(),
                     [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

// A triangle by a node that stands at `x`, and a camera with a lamp at `cameraX`.
std::string gltf(double x, double cameraX) {
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "extensionsUsed": ["KHR_lights_punctual"], "extensions": {{"KHR_lights_punctual": {{"lights": [{{"type": "point", "intensity": 80}}]}}}},
    "scenes": [{{"nodes": [0, 1]}}], "nodes": [{{"mesh": 0, "translation": [{}, 0, 0]}}, {{"camera": 0, "translation": [{}, 0, 2], "extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}}],
    "cameras": [{{"name": "Eye", "type": "perspective", "perspective": {{"yfov": 1, "znear": 0.1}}}}],
    "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}], "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}}],
    "bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}})",
      x, cameraX);
}

TEST(FarScene, ofACountrysGridComesToTheOrigin) {
  const TemporaryFolder folder;
  const Imported at = imported(folder, "a.gltf", gltf(4468000, 4468001));
  const Bounds3 bounds = at.scene.bounds();
  EXPECT_NEAR(bounds.lo.x, -0.5, 1e-3);
  EXPECT_NEAR(bounds.hi.x, 0.5, 1e-3);  // exact: the node holds what is large
  ASSERT_EQ(at.scene.cameras.size(), 1u);
  EXPECT_NEAR(at.scene.cameras[0].worldFromCamera.w.x, 0.5, 1);
  EXPECT_TRUE(says(at, "moved there"));
}

TEST(FarScene, aWideSiteStaysWhereItIs) {
  const TemporaryFolder folder;
  const Imported site = imported(folder, "a.obj", "v 9000 0 0\nv 30000 0 0\nv 9000 0 20000\nf 1 2 3\n");
  EXPECT_FLOAT_EQ(site.scene.bounds().lo.x, 9000);
  EXPECT_EQ(site.unit, StatedUnit::None);
}

TEST(FarScene, camerasFarAwayAreLeftOut) {
  const TemporaryFolder folder;
  const Imported at = imported(folder, "a.gltf", gltf(0, 1e12));
  EXPECT_TRUE(at.scene.cameras.empty());
  EXPECT_TRUE(says(at, "1 camera is left out"));
  EXPECT_TRUE(says(at, "1 lamp is left out"));
  EXPECT_TRUE(at.scene.lamps.empty());
  EXPECT_EQ(at.unit, StatedUnit::Stated);
}

TEST(FarScene, isRefusedWhereItIsWiderThanAnySite) {
  const TemporaryFolder folder;
  writeFile(folder / "a.obj", "v 0 0 0\nv 1e9 0 0\nv 0 0 1\nf 1 2 3\n");
  const Result<Imported> result = importScene(folder / "a.obj");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().find("--metres-per-unit"), std::string::npos);
}

}  // namespace
}  // namespace roomlight
