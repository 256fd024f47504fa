// Materials, textures, lights and cameras.
#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include "unit/import/gltf_file.h"
#include "unit/import/ktx2_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using nlohmann::json;
using testing::GltfFile;
using testing::TemporaryFolder;

class GltfLook : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  GltfFile file_ = GltfFile::triangle();
  json& material_ = file_.json["materials"][0];

  Imported read() {
    auto imported = file_.import(folder_ / "a.glb");
    EXPECT_TRUE(imported) << imported.error();
    return imported ? imported.value() : Imported{};
  }
  // The index of a texture with this picture.
  int addTexture(const std::string& bytes) {
    file_.json["images"].push_back({{"bufferView", file_.addView(bytes)}, {"mimeType", "image/png"}});
    file_.json["textures"].push_back({{"source", file_.json["images"].size() - 1}});
    return static_cast<int>(file_.json["textures"].size()) - 1;
  }
};

TEST_F(GltfLook, materialFactorsAndExtensions) {
  material_ = {{"name", "glass"},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.6}}},
               {"emissiveFactor", {1, 0.5, 0}},
               {"alphaMode", "MASK"},
               {"alphaCutoff", 0.25},
               {"doubleSided", true},
               {"extensions",
                {{"KHR_materials_emissive_strength", {{"emissiveStrength", 300}}},
                 {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
                 {"KHR_materials_ior", {{"ior", 1.33}}},
                 {"KHR_materials_specular", {{"specularFactor", 0.7}, {"specularColorFactor", {1, 0.9, 0.8}}}},
                 {"KHR_materials_volume",
                  {{"thicknessFactor", 0.02}, {"attenuationDistance", 0.5}, {"attenuationColor", {0.5, 1, 1}}}}}}};
  const Imported imported = read();
  const Material& m = imported.scene.materials.at(0);
  EXPECT_EQ(m.baseColor, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_FLOAT_EQ(m.alpha, 0.4f);
  EXPECT_FLOAT_EQ(m.metallic, 0.5f);
  EXPECT_FLOAT_EQ(m.roughness, 0.6f);
  EXPECT_EQ(m.emission, Vec3(300, 150, 0));
  EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
  EXPECT_FLOAT_EQ(m.alphaCutoff, 0.25f);
  EXPECT_TRUE(m.doubleSided);
  EXPECT_FLOAT_EQ(m.transmission, 0.9f);
  EXPECT_FLOAT_EQ(m.ior, 1.33f);
  EXPECT_FLOAT_EQ(m.specular, 0.7f);
  EXPECT_EQ(m.specularColor, Vec3(1, 0.9f, 0.8f));
  EXPECT_FLOAT_EQ(m.thicknessM, 0.02f);
  EXPECT_FLOAT_EQ(m.attenuationDistanceM, 0.5f);
  EXPECT_TRUE(imported.warnings.empty());
}

TEST_F(GltfLook, unlitSurfacesAreMattPaintOfTheirColour) {
  material_["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 1};
  material_["extensions"]["KHR_materials_unlit"] = json::object();
  const Imported imported = read();
  const Material& m = imported.scene.materials.at(0);
  EXPECT_EQ(m.emission, Vec3(0));
  EXPECT_EQ(m.baseColor, Vec3(0.5f, 0.25f, 1));
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(m.specular, 0);
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_NE(imported.warnings[0].find("KHR_materials_unlit"), std::string::npos);
}

TEST_F(GltfLook, texturesOfEveryUse) {
  const int texture = addTexture(testing::pngOf(3, 2, 1));
  const json info = {{"index", texture}, {"texCoord", 1}};
  material_["pbrMetallicRoughness"] = {{"baseColorTexture", info}, {"metallicRoughnessTexture", info}};
  material_["normalTexture"] = {{"index", texture}, {"scale", 0.5}};
  material_["emissiveTexture"] = info;
  material_["extensions"]["KHR_materials_transmission"] = {{"transmissionTexture", info}};
  const Imported imported = read();
  const Material& m = imported.scene.materials.at(0);
  ASSERT_EQ(imported.scene.textures.size(), 1u);
  EXPECT_EQ(imported.scene.textures[0].width, 3);
  EXPECT_EQ(imported.scene.textures[0].height, 2);
  EXPECT_EQ(imported.scene.textures[0].rgba, std::vector<uint8_t>(24, 255));
  for (const TextureRef& ref :
       {m.baseColorTexture, m.metallicRoughnessTexture, m.emissionTexture, m.transmissionTexture}) {
    EXPECT_EQ(ref.texture, 0);
    EXPECT_EQ(ref.uvSet, 1);
  }
  EXPECT_EQ(m.normalTexture.texture, 0);
  EXPECT_FLOAT_EQ(m.normalScale, 0.5f);
}

TEST_F(GltfLook, wrapModesAndTransformOfATexture) {
  const int texture = addTexture(testing::pngOf(2, 2, 0.5f));
  file_.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  file_.json["textures"][0]["sampler"] = 0;
  const float quarter = kPi / 2;
  material_["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", texture},
      {"extensions",
       {{"KHR_texture_transform",
         {{"offset", {0.5, 0.25}}, {"rotation", quarter}, {"scale", {2, 3}}, {"texCoord", 1}}}}}};
  const Imported imported = read();
  const TextureRef& ref = imported.scene.materials.at(0).baseColorTexture;
  EXPECT_EQ(imported.scene.textures.at(0).wrapU, Wrap::ClampToEdge);
  EXPECT_EQ(imported.scene.textures.at(0).wrapV, Wrap::MirroredRepeat);
  EXPECT_EQ(ref.uvSet, 1);
  // The specification's matrix: (u, v) = (1, 0) scaled to (2, 0), turned to (0, -2), moved.
  EXPECT_NEAR(ref.m[0][0] + ref.m[0][2], 0.5f, 1e-6f);
  EXPECT_NEAR(ref.m[1][0] + ref.m[1][2], -1.75f, 1e-6f);
  EXPECT_NEAR(ref.m[0][1], 3, 1e-6f);
}

TEST_F(GltfLook, oneImageWithTwoSamplersIsTwoTextures) {
  addTexture(testing::pngOf(2, 2, 1));
  file_.json["samplers"] = {{{"wrapS", 33071}}};
  file_.json["textures"].push_back({{"source", 0}, {"sampler", 0}});
  material_["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}},
                                       {"metallicRoughnessTexture", {{"index", 1}}}};
  EXPECT_EQ(read().scene.textures.size(), 2u);
}

TEST_F(GltfLook, jpegAndWebpPictures) {
  const std::vector<uint8_t> rgba(16 * 16 * 4, 255);
  unsigned char* jpeg = nullptr;
  unsigned long jpegSize = 0;
  const tjhandle encoder = tjInitCompress();
  ASSERT_EQ(tjCompress2(encoder, rgba.data(), 16, 0, 16, TJPF_RGBA, &jpeg, &jpegSize, TJSAMP_420, 90, 0), 0);
  addTexture(std::string(reinterpret_cast<char*>(jpeg), jpegSize));
  tjFree(jpeg);
  tjDestroy(encoder);
  uint8_t* webp = nullptr;
  const size_t webpSize = WebPEncodeLosslessRGBA(rgba.data(), 16, 16, 64, &webp);
  file_.json["images"].push_back({{"bufferView", file_.addView(std::string(reinterpret_cast<char*>(webp), webpSize))}});
  WebPFree(webp);
  file_.json["textures"].push_back({{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}});
  file_.json["extensionsRequired"] = {"EXT_texture_webp"};
  material_["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}},
                                       {"metallicRoughnessTexture", {{"index", 1}}}};
  const Imported imported = read();
  ASSERT_EQ(imported.scene.textures.size(), 2u);
  EXPECT_EQ(imported.scene.textures[0].rgba, rgba);
  EXPECT_EQ(imported.scene.textures[1].rgba, rgba);
}

TEST_F(GltfLook, picturesBesideTheFileAreFoundByTheirEscapedName) {
  std::filesystem::create_directory(folder_ / "my pictures");
  testing::writeFile(folder_ / "my pictures/oak.png", testing::pngOf(1, 1, 0));
  file_.json["images"] = {{{"uri", "my%20pictures/oak.png"}}};
  file_.json["textures"] = {{{"source", 0}}};
  material_["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  EXPECT_EQ(read().scene.textures.at(0).rgba, (std::vector<uint8_t>{0, 0, 0, 255}));
}

TEST_F(GltfLook, basisPicturesAreDecoded) {
  testing::Ktx2File picture{.width = 1, .height = 1};
  picture.level = testing::BitWriter().put(0x17, 5).put(10, 8).put(20, 8).put(30, 8).put(40, 8).block();
  file_.json["images"] = {{{"bufferView", file_.addView(picture.bytes())}, {"mimeType", "image/ktx2"}}};
  file_.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  file_.json["extensionsRequired"] = {"KHR_texture_basisu"};
  material_["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  const Imported imported = read();
  EXPECT_EQ(imported.scene.textures.at(0).rgba, (std::vector<uint8_t>{10, 20, 30, 40}));
  EXPECT_TRUE(imported.warnings.empty());
}

TEST_F(GltfLook, materialsOfPicturesThatCannotBeDecodedAreNeutral) {
  file_.json["images"] = {{{"bufferView", file_.addView("DDS and more")}}};
  file_.json["textures"] = {{{"extensions", {{"MSFT_texture_dds", {{"source", 0}}}}}}};
  file_.json["extensionsRequired"] = {"MSFT_texture_dds"};
  const json info = {{"index", 0}};
  material_ = {{"pbrMetallicRoughness", {{"baseColorTexture", info}, {"metallicRoughnessTexture", info}}},
               {"normalTexture", info},
               {"emissiveTexture", info},
               {"emissiveFactor", {1, 1, 1}}};
  const Imported imported = read();
  const Material& m = imported.scene.materials.at(0);
  for (const TextureRef& ref : {m.baseColorTexture, m.metallicRoughnessTexture, m.normalTexture, m.emissionTexture})
    EXPECT_EQ(ref.texture, -1);
  EXPECT_EQ(m.baseColor, Vec3(0.6f));
  EXPECT_EQ(m.metallic, 0);
  EXPECT_TRUE(isBlack(m.emission));
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_NE(imported.warnings[0].find("kind DDS"), std::string::npos);
}

TEST_F(GltfLook, picturesOfOtherKindsHaveTheirFallback) {
  addTexture(testing::pngOf(1, 1, 1));
  file_.json["images"].push_back({{"bufferView", file_.addView("....ftypavif....")}});
  file_.json["textures"][0]["extensions"]["EXT_texture_avif"] = {{"source", 1}};
  material_["normalTexture"] = {{"index", 0}};
  const Imported imported = read();
  EXPECT_EQ(imported.scene.textures.size(), 1u);
  EXPECT_TRUE(imported.warnings.empty());
}

TEST_F(GltfLook, refinementsOfMaterialsAreOneWarning) {
  material_["extensions"] = {{"KHR_materials_clearcoat", json::object()}, {"KHR_materials_sheen", json::object()}};
  file_.json["extensionsRequired"] = {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_animation_pointer"};
  const Imported imported = read();
  EXPECT_EQ(imported.warnings, (std::vector<std::string>{"looks that are not supported show as their base material: "
                                                         "KHR_materials_clearcoat, KHR_materials_sheen (2 times)"}));
}

TEST_F(GltfLook, lightsAndCameras) {
  file_.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 50}, {"color", {1, 0.5, 0}}, {"name", "bulb"}},
      {{"type", "spot"}, {"intensity", 70}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.3}}}},
      {{"type", "directional"}, {"intensity", 1000}}};
  file_.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"aspectRatio", 1.5}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 9}}}}};
  for (int i = 0; i < 3; ++i) {
    file_.json["nodes"].push_back(
        {{"name", "n"}, {"translation", {i, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    file_.json["scenes"][0]["nodes"].push_back(i + 1);
  }
  file_.node()["camera"] = 0;
  file_.json["nodes"][1]["camera"] = 1;
  const Scene scene = read().scene;
  ASSERT_EQ(scene.lamps.size(), 2u);
  EXPECT_EQ(scene.lamps[0].name, "bulb");
  EXPECT_EQ(scene.lamps[0].intensityCd, Vec3(50, 25, 0));
  EXPECT_EQ(scene.lamps[1].kind, LampKind::Spot);
  EXPECT_FLOAT_EQ(scene.lamps[1].innerConeRad, 0.1f);
  EXPECT_FLOAT_EQ(scene.lamps[1].outerConeRad, 0.3f);
  EXPECT_EQ(scene.lamps[1].position, Vec3(1, 0, 0));
  EXPECT_EQ(scene.lamps[1].direction, Vec3(0, 0, -1));
  ASSERT_EQ(scene.suns.size(), 1u);
  EXPECT_EQ(scene.suns[0].toLight, Vec3(0, 0, 1));
  EXPECT_EQ(scene.suns[0].illuminanceLux, Vec3(1000));
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_FLOAT_EQ(scene.cameras[0].yFovRad, 0.8f);
  EXPECT_FLOAT_EQ(scene.cameras[0].aspect, 1.5f);
  EXPECT_EQ(scene.cameras[1].projection, Projection::Orthographic);
  EXPECT_FLOAT_EQ(scene.cameras[1].yMagM, 2);
}

TEST_F(GltfLook, eachKindThatCannotBeHonouredIsOneWarningWithItsCount) {
  file_.json["animations"] = json::array({json::object(), json::object()});
  file_.json["skins"] = {{{"joints", {0}}}};
  file_.node()["skin"] = 0;
  file_.json["scenes"].push_back(json::object());
  material_["extensions"] = {{"KHR_materials_clearcoat", json::object()}};
  auto primitive = file_.primitive();
  primitive["mode"] = 1;
  file_.json["meshes"][0]["primitives"].push_back(primitive);
  primitive["mode"] = 0;
  file_.json["meshes"][0]["primitives"].push_back(primitive);
  file_.primitive()["targets"] = {{{"POSITION", 0}}};
  file_.node()["scale"] = {1, 1, 1};
  file_.json["nodes"].push_back({{"scale", {0, 1, 1}}, {"mesh", 0}});
  file_.json["scenes"][0]["nodes"].push_back(1);
  const Imported imported = read();
  const char* expected[] = {"looks that are not supported show as their base material: KHR_materials_clearcoat (once)",
                            "animations are ignored, things stay where their nodes put them (2 times)",
                            "morph targets are ignored, meshes keep their base shape (once)",
                            "points and lines are ignored (2 times)",
                            "scenes other than the default one are ignored (once)",
                            "skins are ignored, meshes keep their rest pose (once)"};
  EXPECT_EQ(imported.warnings, std::vector<std::string>(std::begin(expected), std::end(expected)));
  EXPECT_EQ(imported.faults,
            std::vector<std::string>{"nodes scaled to nothing are left out with all below them (once)"});
  EXPECT_EQ(imported.faultCount, 1u);
}

}  // namespace
}  // namespace roomlight
