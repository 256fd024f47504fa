// Triangles, vertices and where they stand.
#include <gtest/gtest.h>

#include "unit/import/gltf_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::GltfFile;
using testing::TemporaryFolder;

class GltfGeometry : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  Imported read(const GltfFile& file) {
    auto imported = file.import(folder_ / "a.glb");
    EXPECT_TRUE(imported) << imported.error();
    return imported ? imported.value() : Imported{};
  }
};

void expectNear(Vec3 a, Vec3 b) { EXPECT_NEAR(length(a - b), 0, 1e-5f) << a.x << " " << a.y << " " << a.z; }

TEST_F(GltfGeometry, theSmallestFileHasOneTriangleAndNoWarning) {
  const Imported imported = read(GltfFile::triangle());
  EXPECT_EQ(imported.scene.triangleCount(), 1u);
  EXPECT_EQ(imported.scene.materials.size(), 1u);
  EXPECT_EQ(imported.scene.instances.at(0).name, "thing");
  EXPECT_EQ(imported.scene.meshes.at(0).name, "shape");
  EXPECT_TRUE(imported.warnings.empty());
}

TEST_F(GltfGeometry, primitivesWithoutMaterialAreGrey) {
  GltfFile f = GltfFile::triangle();
  f.primitive().erase("material");
  const Imported imported = read(f);
  EXPECT_EQ(imported.scene.materials.size(), 2u);
  EXPECT_EQ(imported.scene.meshes[0].material, 1);
  EXPECT_EQ(imported.warnings.size(), 1u);
}

TEST_F(GltfGeometry, nodesMultiplyTheirTransforms) {
  GltfFile f = GltfFile::triangle();
  const float s = std::sqrt(0.5f);
  f.json["nodes"] = {
      {{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {0, s, 0, s}}},  // 90 degrees about y
      {{"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 1, 1}}}};  // twice as large, 1 along z
  const Imported imported = read(f);
  const Affine& world = imported.scene.instances.at(0).worldFromObject;
  expectNear(world.point({0, 0, 0}), {11, 0, 0});
  expectNear(world.point({1, 0, 0}), {11, 0, -2});
}

TEST_F(GltfGeometry, aFileWithoutScenesShowsAllRoots) {
  GltfFile f = GltfFile::triangle();
  f.json.erase("scene");
  f.json.erase("scenes");
  f.json["nodes"].push_back({{"children", {0}}, {"translation", {0, 5, 0}}});
  const Imported imported = read(f);
  ASSERT_EQ(imported.scene.instances.size(), 1u);
  expectNear(imported.scene.instances[0].worldFromObject.w, {0, 5, 0});
}

TEST_F(GltfGeometry, instancingPlacesTheMeshManyTimes) {
  GltfFile f = GltfFile::triangle();
  const int t = f.addFloats({1, 0, 0, 2, 0, 0, 3, 0, 0}, "VEC3");
  const int r = f.addAccessor<int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0, 0, 0, 0, 32767}, 5122, "VEC4", true);
  const int s = f.addFloats({1, 1, 1, 2, 2, 2, 0, 0, 0}, "VEC3");
  f.node()["translation"] = {0, 0, 7};
  f.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", t}, {"ROTATION", r}, {"SCALE", s}};
  const Imported imported = read(f);
  ASSERT_EQ(imported.scene.instances.size(), 2u);  // the third is scaled to nothing
  EXPECT_NE(imported.scene.instances[0].object, imported.scene.instances[1].object);
  expectNear(imported.scene.instances[0].worldFromObject.point({1, 0, 0}), {2, 0, 7});
  expectNear(imported.scene.instances[1].worldFromObject.point({1, 0, 0}), {0, 0, 7});  // turned by 180 degrees
  EXPECT_EQ(imported.faults.size(), 1u);
}

TEST_F(GltfGeometry, tinyTrianglesAreKeptForNodesToScaleUp) {
  GltfFile f = GltfFile::triangle();
  f.primitive()["attributes"]["POSITION"] = f.addFloats({0, 0, 0, 1e-10f, 0, 0, 0, 1e-10f, 0}, "VEC3");
  f.node()["scale"] = {1e10, 1e10, 1e10};
  const Scene scene = read(f).scene;
  EXPECT_EQ(scene.triangleCount(), 1u);
  expectNear(scene.bounds().hi, {1, 1, 0});
}

TEST_F(GltfGeometry, trianglesWithoutAreaAreLeftOut) {
  GltfFile f = GltfFile::triangle();
  f.primitive()["attributes"]["POSITION"] = f.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0}, "VEC3");
  f.primitive()["indices"] = f.addAccessor<uint8_t>({0, 1, 2, 0, 1, 3}, 5121, "SCALAR");
  EXPECT_EQ(read(f).scene.triangleCount(), 1u);
}

TEST_F(GltfGeometry, stripsFansAndPlainListsGiveTheSameSide) {
  for (const int mode : {4, 5, 6}) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["POSITION"] = f.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    f.primitive()["mode"] = mode;
    const std::vector<uint8_t> indices = mode == 4   ? std::vector<uint8_t>{0, 1, 2, 0, 2, 3}
                                         : mode == 5 ? std::vector<uint8_t>{0, 1, 3, 2}
                                                     : std::vector<uint8_t>{0, 1, 2, 3};
    f.primitive()["indices"] = f.addAccessor(indices, 5121, "SCALAR");
    const Imported imported = read(f);
    const Mesh& mesh = imported.scene.meshes.at(0);
    ASSERT_EQ(mesh.triangleCount(), 2u) << mode;
    for (size_t t = 0; t < 6; t += 3) {
      const Vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                 c = mesh.positions[mesh.indices[t + 2]];
      EXPECT_FLOAT_EQ(cross(b - a, c - a).z, 1) << mode;
    }
  }
}

TEST_F(GltfGeometry, trianglesWithoutIndices) {
  GltfFile f = GltfFile::triangle();
  f.primitive().erase("indices");
  EXPECT_EQ(read(f).scene.triangleCount(), 1u);
}

TEST_F(GltfGeometry, onlyTheVerticesThatAPrimitiveUsesAreKept) {
  GltfFile f = GltfFile::triangle();
  std::vector<float> positions;
  for (int i = 0; i < 100; ++i)
    positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i * i), 0});
  f.primitive()["attributes"]["POSITION"] = f.addFloats(positions, "VEC3");
  f.primitive()["indices"] = f.addAccessor<uint32_t>({90, 7, 50}, 5125, "SCALAR");
  const Imported imported = read(f);
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[mesh.indices[0]], Vec3(90, 8100, 0));
  EXPECT_EQ(mesh.positions[mesh.indices[1]], Vec3(7, 49, 0));
}

TEST_F(GltfGeometry, attributesAreReadAndMadeUnit) {
  GltfFile f = GltfFile::triangle();
  auto& attributes = f.primitive()["attributes"];
  attributes["NORMAL"] = f.addFloats({0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3");
  attributes["TANGENT"] = f.addFloats({3, 0, 0, -1, 3, 0, 0, -1, 3, 0, 0, 1}, "VEC4");
  attributes["TEXCOORD_0"] = f.addAccessor<uint8_t>({0, 0, 255, 0, 0, 255}, 5121, "VEC2", true);
  attributes["TEXCOORD_1"] = f.addFloats({0, 0, 0.5f, 0, 0, 0.25f}, "VEC2");
  attributes["COLOR_0"] =
      f.addAccessor<uint16_t>({65535, 0, 0, 0, 0, 65535, 0, 65535, 0, 0, 65535, 65535}, 5123, "VEC4", true);
  const Imported imported = read(f);
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.normals.at(1), Vec3(0, 0, 1));
  EXPECT_EQ(mesh.tangents.at(1), Vec3(1, 0, 0));
  EXPECT_EQ(mesh.tangentSigns, (std::vector<float>{-1, -1, 1}));
  EXPECT_FLOAT_EQ(mesh.uv[0].at(1).x, 1);
  EXPECT_FLOAT_EQ(mesh.uv[1].at(2).y, 0.25f);
  EXPECT_EQ(mesh.colors.at(0), Vec3(1, 0, 0));
  EXPECT_EQ(mesh.colorAlphas, (std::vector<float>{0, 1, 1}));
}

TEST_F(GltfGeometry, quantizedPositionsStridedViewsAndSparseValues) {
  GltfFile f = GltfFile::triangle();
  // Eight bytes a vertex: three shorts and padding. Vertex 2 is replaced by (0, 32767, 0).
  const int accessor = f.addAccessor<int16_t>({0, 0, 0, 99, 32767, 0, 0, 99, 0, 1, 0, 99}, 5122, "VEC4", true);
  auto& json = f.json["accessors"][static_cast<size_t>(accessor)];
  json["type"] = "VEC3";
  f.json["bufferViews"][json["bufferView"].get<size_t>()]["byteStride"] = 8;
  const int indices = f.addView(std::string(1, 2));
  const int values = f.addView(std::string("\0\0\xff\x7f\0\0", 6));
  f.json["accessors"][static_cast<size_t>(accessor)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  f.primitive()["attributes"]["POSITION"] = accessor;
  f.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Imported imported = read(f);
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.positions.at(1), Vec3(1, 0, 0));
  EXPECT_EQ(mesh.positions.at(2), Vec3(0, 1, 0));
}

TEST_F(GltfGeometry, metresPerUnitScaleEverythingWithALength) {
  GltfFile f = GltfFile::triangle();
  f.json["materials"][0]["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 2}, {"attenuationDistance", 4}};
  testing::writeFile(folder_ / "a.glb", f.glb());
  const auto imported = importScene(folder_ / "a.glb", {.metresPerUnit = 0.5f});
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_FLOAT_EQ(imported.value().scene.bounds().hi.x, 0.5f);
  EXPECT_FLOAT_EQ(imported.value().scene.materials[0].thicknessM, 1);
  EXPECT_FLOAT_EQ(imported.value().scene.materials[0].attenuationDistanceM, 2);
}

}  // namespace
}  // namespace roomlight
