#include <gtest/gtest.h>

#include <algorithm>

#include "import/import.h"
#include "support/foreign_files.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::obj;
using testing::redBmp;
using testing::tableZUp;
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
  const auto imported =
      read("# a comment\r\nv 0 0 0 # corner\r\nv +1 0 0\r\nv 1 1e0 0\r\nv 0 1 0\r\nf -4 -3 \\\r\n -2 -1 # face\r\n");
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_EQ(imported.value().scene.triangleCount(), 2u);
}

TEST_F(Obj, objectsAndMaterialsMakeMeshes) {
  writeFile(folder_ / "my colours.mtl", "newmtl red\nKd 1 0 0\nnewmtl lamp\nKe 50 40 30\nKd 0 0 0\n");
  const auto imported =
      read("mtllib my colours.mtl\n" + kSquare +
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
  const auto imported =
      read("mtllib a.mtl\n" + kSquare + "usemtl glass\nf 1 2 3\nusemtl steel\nf 1 2 3\nusemtl paint\nf 1 2 3\n");
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
  writeFile(folder_ / "a.mtl",
            "newmtl m\nmap_Kd -s 2 3 -o 0.5 0.25 kd.tga\nKd 1 1 1\nmap_d mask.tga\nmap_Pm metal.tga\n");
  const auto imported = read("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1 2 3\n");
  ASSERT_TRUE(imported) << imported.error();
  const Scene& scene = imported.value().scene;
  const Material& m = scene.materials[0];
  EXPECT_EQ(scene.textures.at(static_cast<size_t>(m.baseColorTexture.texture)).rgba,
            (std::vector<uint8_t>{10, 20, 30, 0, 40, 50, 60, 128}));
  EXPECT_EQ(scene.textures.at(static_cast<size_t>(m.metallicRoughnessTexture.texture)).rgba,
            (std::vector<uint8_t>{0, 255, 255, 255, 0, 255, 7, 255}));
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
  const auto imported =
      read("mtllib a.mtl\nmtllib none.mtl\n" + kSquare +
           "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl d\nf 1 2 3\nf 1 1 2\nl 1 2\np 1\nf 1 2\n");
  ASSERT_TRUE(imported) << imported.error();
  const auto& warnings = imported.value().warnings;
  const auto has = [&](const std::string& text, const std::string& times) {
    return std::count_if(warnings.begin(), warnings.end(), [&](const std::string& w) {
             return w.find(text) != std::string::npos && w.ends_with("(" + times + ")");
           }) == 1;
  };
  EXPECT_TRUE(has("none.mtl' is missing", "once"));
  EXPECT_TRUE(has("no MTL file holds", "2 times"));
  EXPECT_TRUE(has("map_bump", "2 times"));
  EXPECT_TRUE(has("pictures are missing, a plain colour", "once"));
  EXPECT_TRUE(has("points and lines", "2 times"));
  EXPECT_EQ(warnings.size(), 5u);
}

TEST_F(Obj, smallFaultsAreMendedAndCountedApart) {
  writeFile(folder_ / "a.mtl", "newmtl a\nKd 2 0.5 -1\n");
  const auto imported = read("mtllib a.mtl\n" + kSquare + "usemtl a\nf 1 2 3\nf 1 1 2\nf 1 2\nf 3 4\n");
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_TRUE(imported.value().warnings.empty());
  EXPECT_EQ(imported.value().faults,
            (std::vector<std::string>{"triangles without area are left out (once)",
                                      "faces with fewer than three corners are ignored (2 times)",
                                      "Kd of a material is outside 0 to 1 and limited (2 times)"}));
  EXPECT_EQ(imported.value().faultCount, 5u);
}

TEST_F(Obj, damagedFilesAreOneLineThatNamesFileAndLine) {
  struct Case {
    const char *name, *text, *expected;
  };
  const Case cases[] = {
      {"empty", "", "no triangle"},
      {"nothing known", "hello\n", "no triangle"},
      {"not a number", "v 0 nan 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 4: vertex 1 is no finite place"},
      {"infinite", "v 0 0 0\nv 1e99 0 0\nf 1 2 1\n", "line 3: vertex 2"},
      {"words", "v a b c\nf 1 1 1\n", "line 2: vertex 1"},
      {"too few numbers", "v 1 2\nf 1 1 1\n", "line 2: vertex 1"},
      {"index out of range", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
       "line 4: vertex 4 does not exist, there are 3 so far"},
      {"relative index out of range", "v 0 0 0\nf -1 -2 -1\n", "line 2: vertex -2"},
      {"zero index", "v 0 0 0\nf 0 1 1\n", "line 2"},
      {"index overflow", "v 0 0 0\nf 4294967297 1 1\n", "line 2"},
      {"corner of letters", "v 0 0 0\nf a b c\n", "line 2: 'a' is not a corner"},
  };
  for (const Case& c : cases) {
    const auto imported = read(c.text);
    ASSERT_FALSE(imported) << c.name;
    EXPECT_NE(imported.error().find("a.obj: "), std::string::npos) << c.name << ": " << imported.error();
    EXPECT_NE(imported.error().find(c.expected), std::string::npos) << c.name << ": " << imported.error();
    EXPECT_EQ(imported.error().find('\n'), std::string::npos) << c.name;
  }
}

TEST_F(Obj, damagedFacesCostOnlyThemselves) {
  const auto imported = read(kSquare + "v nan 0 0\nv 1,5 0 0\nf 1 2 3\nf 1 3 4\nf 1 2 99\nf 1 2 5\nf 1//7 2//7 6//7\n");
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_EQ(imported.value().scene.triangleCount(), 2u);  // of (1.5 0 0), a decimal comma, one without area
  EXPECT_EQ(imported.value().warnings,
            (std::vector<std::string>{"faces of vertices that do not exist are left out (once)",
                                      "faces of vertices that are no finite place are left out (once)"}));
  EXPECT_EQ(imported.value().faults,
            (std::vector<std::string>{"triangles without area are left out (once)",
                                      "texture coordinates and normals that do not exist are left out (3 times)"}));
}

TEST_F(Obj, namesOfOtherMachines) {
  std::filesystem::create_directories(folder_ / "Maps");
  writeFile(folder_ / "my room.mtl", "\xef\xbb\xbfnewmtl Gr\xfcn 1\nmap_Kd D:\\work\\maps\\red one.BMP\n");
  writeFile(folder_ / "Maps/Red One.bmp", redBmp());
  const auto imported = read("mtllib C:\\x\\My Room.mtl\n" + kSquare + "o Sch\xf6n\nusemtl Gr\xfcn 1\nf 1 2 3\n");
  ASSERT_TRUE(imported) << imported.error();
  const Scene& scene = imported.value().scene;
  EXPECT_TRUE(imported.value().warnings.empty()) << imported.value().warnings[0];
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials[0].name, "Gr\xc3\xbcn 1");
  EXPECT_EQ(scene.instances[0].name, "Sch\xc3\xb6n");
}

TEST_F(Obj, severalLibrariesOnOneLine) {
  writeFile(folder_ / "a.mtl", "newmtl a\nKd 1 0 0\n");
  writeFile(folder_ / "b.mtl", "newmtl b\nKd 0 1 0\n");
  const auto imported = read("mtllib a.mtl b.mtl\n" + kSquare + "usemtl b\nf 1 2 3\nusemtl a\nf 1 2 4\n");
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_TRUE(imported.value().warnings.empty());
  EXPECT_EQ(imported.value().scene.materials[0].baseColor, Vec3(0, 1, 0));
}

TEST_F(Obj, nothingIsInvisible) {
  const std::string use = kSquare + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\n";
  const auto alphas = [&](const std::string& mtl) {
    writeFile(folder_ / "a.mtl", mtl);
    const auto imported = read("mtllib a.mtl\n" + use);
    EXPECT_TRUE(imported) << imported.error();
    return imported ? std::pair(imported.value().scene.materials[0].alpha, imported.value().scene.materials[1].alpha)
                    : std::pair(-1.0f, -1.0f);
  };
  EXPECT_EQ(alphas("newmtl a\nTr 0\nnewmtl b\nTr 0.75\n"), std::pair(1.0f, 0.25f));    // as the format says it
  EXPECT_EQ(alphas("newmtl a\nTr 1\nnewmtl b\nTr 0.25\n"), std::pair(1.0f, 0.25f));    // Tr as opacity
  EXPECT_EQ(alphas("newmtl a\nd 0\nnewmtl b\nd 0\n"), std::pair(1.0f, 1.0f));          // all of them
  EXPECT_EQ(alphas("newmtl a\nd 0\nnewmtl b\nd 1\n"), std::pair(0.0f, 1.0f));          // somebody means it
  EXPECT_EQ(alphas("newmtl a\nd 1\nTr 1\nnewmtl b\nd 1\nTr 1\n"), std::pair(1.0f, 1.0f));  // both, at odds
}

TEST_F(Obj, coloursBehindVertices) {
  const auto imported = read("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n");
  ASSERT_TRUE(imported) << imported.error();
  const Mesh& mesh = imported.value().scene.meshes[0];
  ASSERT_EQ(mesh.colors.size(), 3u);
  EXPECT_EQ(mesh.colors[0], Vec3(1, 0, 0));
  EXPECT_NEAR(mesh.colors[2].z, 0.2140f, 1e-3);  // sRGB
  EXPECT_FLOAT_EQ(imported.value().scene.materials[0].baseColor.x, 0.85f);
  const auto bytes = read("v 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
  ASSERT_TRUE(bytes) << bytes.error();
  EXPECT_EQ(bytes.value().scene.meshes[0].colors[1], Vec3(0, 1, 0));
}

TEST_F(Obj, damagedPicturesCostOnlyThemselves) {
  writeFile(folder_ / "a.mtl", "newmtl a\nKd 1 1 1\nmap_Kd a.png\n");
  writeFile(folder_ / "a.png", "\x89PNG\r\n\x1a\n and no more");
  const auto imported = read("mtllib a.mtl\n" + kSquare + "usemtl a\nf 1 2 3\n");
  ASSERT_TRUE(imported) << imported.error();
  ASSERT_EQ(imported.value().warnings.size(), 1u);
  EXPECT_NE(imported.value().warnings[0].find("plain colour"), std::string::npos);
  EXPECT_FLOAT_EQ(imported.value().scene.materials[0].baseColor.x, 0.6f);
}

TEST_F(Obj, textureCoordinatesThatAreNoneAreTold) {
  const auto imported = read(kSquare + "vt nan 0\nvt 0 1e30\nvt 0 1\nf 1/1 2/2 3/3\n");
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_EQ(imported.value().warnings,
            (std::vector<std::string>{"texture coordinates that are no finite numbers are taken as 0 (2 times)"}));
  EXPECT_EQ(imported.value().scene.meshes[0].uv[0][1].y, 0);
}

// A name is copied to every part of its object.
TEST_F(Obj, endlessNamesAreCut) {
  const auto imported =
      read("o " + std::string(100'000, 'x') + "\n" + kSquare + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
  ASSERT_TRUE(imported) << imported.error();
  ASSERT_EQ(imported.value().scene.instances.size(), 2u);
  for (const Instance& i : imported.value().scene.instances) EXPECT_LT(i.name.size(), 300u);
}

TEST_F(Obj, zUpIsFoundOrSaid) {
  const std::string table = obj(tableZUp());
  const auto guessed = read(table);
  ASSERT_TRUE(guessed) << guessed.error();
  EXPECT_NEAR(guessed.value().scene.bounds().hi.y, 0.8f, 1e-5);
  ASSERT_EQ(guessed.value().warnings.size(), 1u);
  EXPECT_NE(guessed.value().warnings[0].find("taken to be z"), std::string::npos);
  const auto said = read(table, {.upAxis = 'y'});
  ASSERT_TRUE(said);
  EXPECT_NEAR(said.value().scene.bounds().hi.y, 0.5f, 1e-5);
  EXPECT_TRUE(said.value().warnings.empty());
  EXPECT_FALSE(read(table, {.upAxis = 'w'}));
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
