#include <gtest/gtest.h>

#include <algorithm>

#include "import/import.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::TemporaryFolder;
using testing::writeFile;

class Obj : public ::testing::Test {
 protected:
  TemporaryFolder folder_;

  Result<Imported> read(const std::string& text, const ImportOptions& options = {}) {
    writeFile(folder_ / "a.obj", text);
    return importScene(folder_ / "a.obj", options);
  }
  // A 2x1 uncompressed TGA picture with alpha.
  void writePicture(const std::string& name, std::array<uint8_t, 4> left, std::array<uint8_t, 4> right) {
    std::string tga = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 32, 0x28};
    for (const auto& p : {left, right}) {
      for (const int c : {2, 1, 0, 3}) tga += static_cast<char>(p[static_cast<size_t>(c)]);
    }
    writeFile(folder_ / name, tga);
  }
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(Obj, readsPositionsNormalsAndTextureCoordinates) {
  const auto imported = read(kSquare + "vt 0 0\nvt 1 0.25\nvn 0 0 2\nf 1/1/1 2/2/1 3/2/1\n");
  ASSERT_TRUE(imported) << imported.error();
  const Scene& scene = imported.value().scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.normals.at(0), Vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(mesh.uv[0].at(1).y, 0.75f);  // v = 0 is the top row
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_TRUE(imported.value().warnings.empty());
}

TEST_F(Obj, understandsRelativeIndicesJoinedLinesCommentsAndWindowsLineEnds) {
  const auto imported = read("# a comment\r\nv 0 0 0 # corner\r\nv +1 0 0\r\nv 1 1e0 0\r\nv 0 1 0\r\nf -4 -3 \\\r\n -2 -1 # face\r\n");
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_EQ(imported.value().scene.triangleCount(), 2u);
}

TEST_F(Obj, objectsAndMaterialsMakeMeshes) {
  writeFile(folder_ / "my colours.mtl", "newmtl red\nKd 1 0 0\nnewmtl lamp\nKe 50 40 30\nKd 0 0 0\n");
  const auto imported = read("mtllib my colours.mtl\n" + kSquare +
                             "o chair\nusemtl red\nf 1 2 3\ng seat\nusemtl lamp\nf 1 3 4\no table\nusemtl red\nf 1 2 3 4\n");
  ASSERT_TRUE(imported) << imported.error();
  const Scene& scene = imported.value().scene;
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[0].object, scene.instances[1].object);
  EXPECT_NE(scene.instances[0].object, scene.instances[2].object);
  EXPECT_EQ(scene.instances[2].name, "table");
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].baseColor, Vec3(1, 0, 0));
  EXPECT_EQ(scene.materials[1].emission, Vec3(50, 40, 30));
}

TEST_F(Obj, readsMaterialValues) {
  writeFile(folder_ / "a.mtl",
            "newmtl glass\nKd 0.5 0.5 0.5\nd 0.25\nNi 1.52\nKs 1 1 1\nNs 998\n"
            "newmtl steel\nKd 0.6 0.6 0.6\nPr 0.3\nPm 1\n"
            "newmtl paint\nKd 0.7 0.7 0.7\nTr 0.5\n");
  const auto imported = read("mtllib a.mtl\n" + kSquare + "usemtl glass\nf 1 2 3\nusemtl steel\nf 1 2 3\nusemtl paint\nf 1 2 3\n");
  ASSERT_TRUE(imported) << imported.error();
  const auto& m = imported.value().scene.materials;
  EXPECT_FLOAT_EQ(m[0].alpha, 0.25f);
  EXPECT_EQ(m[0].alphaMode, AlphaMode::Blend);
  EXPECT_FLOAT_EQ(m[0].ior, 1.52f);
  EXPECT_NEAR(m[0].roughness, std::pow(2 / 1000.0, 0.25), 1e-6);
  EXPECT_FLOAT_EQ(m[1].roughness, 0.3f);
  EXPECT_FLOAT_EQ(m[1].metallic, 1);
  EXPECT_FLOAT_EQ(m[2].alpha, 0.5f);
  EXPECT_FLOAT_EQ(m[2].specular, 0);
}

TEST_F(Obj, combinesPictures) {
  writePicture("kd.tga", {10, 20, 30, 255}, {40, 50, 60, 255});
  writePicture("mask.tga", {0, 0, 0, 255}, {128, 128, 128, 255});
  writePicture("metal.tga", {255, 255, 255, 255}, {7, 7, 7, 255});
  writeFile(folder_ / "a.mtl", "newmtl m\nmap_Kd -s 2 3 -o 0.5 0.25 kd.tga\nKd 1 1 1\nmap_d mask.tga\nmap_Pm metal.tga\n");
  const auto imported = read("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1 2 3\n");
  ASSERT_TRUE(imported) << imported.error();
  const Scene& scene = imported.value().scene;
  const Material& m = scene.materials[0];
  EXPECT_EQ(scene.textures.at(static_cast<size_t>(m.baseColorTexture.texture)).rgba, (std::vector<uint8_t>{10, 20, 30, 0, 40, 50, 60, 128}));
  EXPECT_EQ(scene.textures.at(static_cast<size_t>(m.metallicRoughnessTexture.texture)).rgba, (std::vector<uint8_t>{0, 255, 255, 255, 0, 255, 7, 255}));
  EXPECT_FLOAT_EQ(m.metallic, 1);
  // The file's v = 0 (the scene's 1) reads the file's 0.25, which is the scene's 0.75.
  EXPECT_FLOAT_EQ(m.baseColorTexture.m[1][1] * 1 + m.baseColorTexture.m[1][2], 0.75f);
  EXPECT_FLOAT_EQ(m.baseColorTexture.m[0][0], 2);
}

TEST_F(Obj, unitsScaleTheInstances) {
  const auto imported = read(kSquare + "f 1 2 3\n", {.metresPerUnit = 0.01f});
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_FLOAT_EQ(imported.value().scene.bounds().hi.x, 0.01f);
}

TEST_F(Obj, whatCannotBeHonouredIsOneWarningAKind) {
  writeFile(folder_ / "a.mtl", "newmtl a\nmap_Kd missing.png\nmap_bump b.png\nnewmtl b\nmap_bump b.png\n");
  const auto imported = read("mtllib a.mtl\nmtllib none.mtl\n" + kSquare +
                             "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl d\nf 1 2 3\nf 1 1 2\nl 1 2\np 1\nf 1 2\n");
  ASSERT_TRUE(imported) << imported.error();
  const auto& warnings = imported.value().warnings;
  const auto has = [&](const std::string& text, const std::string& times) {
    return std::count_if(warnings.begin(), warnings.end(), [&](const std::string& w) { return w.find(text) != std::string::npos && w.ends_with("(" + times + ")"); }) == 1;
  };
  EXPECT_TRUE(has("none.mtl' is missing", "once"));
  EXPECT_TRUE(has("no MTL file holds", "2 times"));
  EXPECT_TRUE(has("map_bump", "2 times"));
  EXPECT_TRUE(has("pictures that MTL files name are missing", "once"));
  EXPECT_TRUE(has("points and lines", "2 times"));
  EXPECT_TRUE(has("fewer than three", "once"));
  EXPECT_EQ(warnings.size(), 6u);
}

TEST_F(Obj, damagedFilesAreOneLineThatNamesFileAndLine) {
  struct Case {
    const char *name, *text, *expected;
  };
  const Case cases[] = {
      {"empty", "", "no triangle"},
      {"nothing known", "hello\n", "no triangle"},
      {"not a number", "v 0 nan 0\n", "line 1: 'nan' is not a finite number"},
      {"infinite", "v 0 0 0\nv 1e99 0 0\n", "line 2"},
      {"words", "v a b c\n", "line 1"},
      {"too few numbers", "v 1 2\n", "line 1: a vertex needs 3 numbers"},
      {"index out of range", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: vertex 4 does not exist, there are 3 so far"},
      {"relative index out of range", "v 0 0 0\nf -1 -2 -1\n", "line 2: vertex -2"},
      {"zero index", "v 0 0 0\nf 0 1 1\n", "line 2"},
      {"index overflow", "v 0 0 0\nf 4294967297 1 1\n", "line 2"},
      {"no normal", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n", "line 4: normal 1"},
      {"corner of letters", "v 0 0 0\nf a b c\n", "line 2: 'a' is not a corner"},
      {"library outside", "mtllib ../a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "leaves the scene's folder"},
      {"library absolute", "mtllib /etc/passwd\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "absolute"},
      {"library on a drive", "mtllib C:\\a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "elsewhere"},
  };
  for (const Case& c : cases) {
    const auto imported = read(c.text);
    ASSERT_FALSE(imported) << c.name;
    EXPECT_NE(imported.error().find("a.obj: "), std::string::npos) << c.name << ": " << imported.error();
    EXPECT_NE(imported.error().find(c.expected), std::string::npos) << c.name << ": " << imported.error();
    EXPECT_EQ(imported.error().find('\n'), std::string::npos) << c.name;
  }
}

TEST_F(Obj, binaryGarbageAndNulAreRefused) {
  EXPECT_FALSE(read(std::string("v 0 0 0\0 1\n", 11)));
  EXPECT_FALSE(read(std::string(3 << 20, 'x')));
}

TEST_F(Obj, tooManyTrianglesAreRefused) {
  EXPECT_FALSE(read(kSquare + "f 1 2 3 4\n", {.maxTriangles = 1}));
  EXPECT_TRUE(read(kSquare + "f 1 2 3 4\n", {.maxTriangles = 2}));
}

}  // namespace
}  // namespace roomlight
