// KHR_materials_pbrSpecularGlossiness as metallic-roughness.
#include "import/gltf_material_parts.h"

#include <gtest/gtest.h>

#include "base/image_io.h"
#include "unit/import/gltf_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using nlohmann::json;
using testing::GltfFile;

// A surface's diffuse and mirrored shares, computed back from metallic-roughness, are those that were asked for.
TEST(SpecularGlossiness, plasticsAndMetalsReflectAsBefore) {
  const auto plastic = importers::metallicRoughnessOf({0.5f, 0.25f, 0.1f}, Vec3(0.04f));
  EXPECT_NEAR(plastic.metallic, 0, 1e-3f);
  EXPECT_NEAR(length(plastic.baseColor - Vec3(0.5f, 0.25f, 0.1f)), 0, 1e-3f);
  const auto gold = importers::metallicRoughnessOf(Vec3(0), {1, 0.77f, 0.34f});
  EXPECT_NEAR(gold.metallic, 1, 1e-3f);
  EXPECT_NEAR(length(gold.baseColor - Vec3(1, 0.77f, 0.34f)), 0, 1e-3f);
  const Vec3 diffuse(0.3f), specular(0.2f);
  const auto between = importers::metallicRoughnessOf(diffuse, specular);
  EXPECT_GT(between.metallic, 0.05f);
  EXPECT_LT(between.metallic, 0.95f);
}

class SpecularGlossinessFile : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  GltfFile file_ = GltfFile::triangle();
  json& extension_ = file_.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"];

  Scene read() {
    file_.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    const auto imported = file_.import(folder_ / "a.glb");
    EXPECT_TRUE(imported) << imported.error();
    if (!imported) return {};
    EXPECT_TRUE(imported.value().warnings.empty()) << imported.value().warnings[0];
    return imported.value().scene;
  }
  json addTexture(int width, int height, float grey) {
    file_.json["images"].push_back({{"bufferView", file_.addView(testing::pngOf(width, height, grey))}});
    file_.json["textures"].push_back({{"source", file_.json["images"].size() - 1}});
    return {{"index", file_.json["textures"].size() - 1}};
  }
};

TEST_F(SpecularGlossinessFile, factorsAlone) {
  extension_ = {
      {"diffuseFactor", {0.5, 0.25, 0.1, 0.75}}, {"specularFactor", {0.04, 0.04, 0.04}}, {"glossinessFactor", 0.25}};
  const Material m = read().materials.at(0);
  EXPECT_NEAR(m.baseColor.x, 0.5f, 1e-3f);
  EXPECT_FLOAT_EQ(m.alpha, 0.75f);
  EXPECT_NEAR(m.metallic, 0, 1e-3f);
  EXPECT_FLOAT_EQ(m.roughness, 0.75f);
}

TEST_F(SpecularGlossinessFile, aMattSurfaceMirrorsNothing) {
  extension_ = {{"specularFactor", {0, 0, 0}}};
  const Material m = read().materials.at(0);
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(m.specular, 0);
}

TEST_F(SpecularGlossinessFile, aDiffuseTextureOfPlasticStaysAsItIs) {
  extension_ = {{"diffuseTexture", addTexture(2, 2, 0.5f)}, {"specularFactor", {0, 0, 0}}};
  const Scene scene = read();
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials.at(0).baseColorTexture.texture, 0);
}

// A black diffuse picture under a grey mirrored one is a grey metal; the smaller picture is stretched over the larger
// one.
TEST_F(SpecularGlossinessFile, texturesAreConvertedTexelByTexel) {
  extension_ = {{"diffuseTexture", addTexture(1, 1, 0)},
                {"specularGlossinessTexture", addTexture(4, 2, 0.5f)},
                {"glossinessFactor", 0.5}};
  const Scene scene = read();
  const Material& m = scene.materials.at(0);
  ASSERT_GE(m.baseColorTexture.texture, 0);
  ASSERT_GE(m.metallicRoughnessTexture.texture, 0);
  const Texture& base = scene.textures[static_cast<size_t>(m.baseColorTexture.texture)];
  const Texture& rough = scene.textures[static_cast<size_t>(m.metallicRoughnessTexture.texture)];
  EXPECT_EQ(base.width, 4);
  EXPECT_EQ(base.height, 2);
  const uint8_t specular = scene.textures[1].rgba[0];
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(base.rgba[4 * i], specular, 2);
    EXPECT_EQ(base.rgba[4 * i + 3], 255);
    EXPECT_NEAR(rough.rgba[4 * i + 1], 128, 1);
    EXPECT_NEAR(rough.rgba[4 * i + 2], 255, 1);
  }
  EXPECT_EQ(m.baseColor, Vec3(1));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
}

TEST_F(SpecularGlossinessFile, materialsThatShareTheirTexturesShareTheConvertedOnes) {
  extension_ = {{"specularGlossinessTexture", addTexture(4, 4, 0.5f)}};
  for (int i = 0; i < 9; ++i) file_.json["materials"].push_back(json(file_.json["materials"][0]));
  EXPECT_EQ(read().textures.size(), 3u);
}

}  // namespace
}  // namespace roomlight
