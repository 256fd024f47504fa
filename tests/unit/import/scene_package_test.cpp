// Scenes in folders and zip files, files under wrong names, and files that scenes name.
#include "import/scene_package.h"

#include <gtest/gtest.h>

#include "import/failure.h"
#include "import/file_access.h"
#include "import/scene_kind.h"
#include "support/foreign_files.h"
#include "support/homes.h"
#include "unit/import/gltf_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using namespace testing;
using namespace importers;

std::string picked(const std::vector<PackedFile>& files) {
  try {
    return pickScene(files);
  } catch (const Failure& f) {
    return std::string("! ") + f.what();
  }
}

TEST(PickScene, prefersKindThenPlaceThenSize) {
  EXPECT_EQ(picked({{"readme.txt", 1}, {"deep/down/a.gltf", 5}, {"a.obj", 900}}), "deep/down/a.gltf");
  EXPECT_EQ(picked({{"x/a.obj", 900}, {"b.obj", 5}}), "b.obj");
  EXPECT_EQ(picked({{"a.obj", 900}, {"b.obj", 5}}), "a.obj");
  EXPECT_EQ(picked({{"source/room.fbx", 9}, {"textures/a.png", 9}}), "source/room.fbx");
  EXPECT_EQ(picked({{"glTF/box.gltf", 9}, {"glTF-Binary/box.glb", 9}}), "glTF-Binary/box.glb");  // the same in two ways
  EXPECT_EQ(picked({{"a.obj", 900}, {"b.obj", 500}}), "! holds 2 scenes, name the one to open: 'a.obj', 'b.obj'");
  EXPECT_NE(picked({{"a.txt", 1}}).find("holds no scene"), std::string::npos);
  EXPECT_NE(picked({{"room.skp", 1}}).find("SketchUp"), std::string::npos);
}

class ScenePackage : public ::testing::Test {
 protected:
  std::string error(const std::string& name) {
    const Result<Imported> r = importScene(folder_ / name);
    return r ? "" : r.error();
  }
  TemporaryFolder folder_;
  std::string mtl_ = "newmtl m\nKd 0.1 0.2 0.3\nmap_Kd D:\\work\\RED.bmp\n";
  std::string obj_ = "mtllib C:/x/Room.MTL\nusemtl m\n" + obj(turnedYUp(tableZUp()));
};

TEST_F(ScenePackage, aFolderOpensWithItsCompanions) {
  std::filesystem::create_directories(folder_ / "room/source");
  std::filesystem::create_directories(folder_ / "room/textures");
  writeFile(folder_ / "room/source/room.obj", obj_);
  writeFile(folder_ / "room/source/room.mtl", mtl_);
  writeFile(folder_ / "room/textures/red.bmp", redBmp());
  const Result<Imported> r = importScene(folder_ / "room");
  ASSERT_TRUE(r) << r.error();
  EXPECT_EQ(r.value().scene.textures.size(), 1u);
  EXPECT_TRUE(r.value().warnings.empty()) << r.value().warnings[0];
}

TEST_F(ScenePackage, aZipOpensAndLeavesNothingBehind) {
  writeFile(folder_ / "room.zip", zipped({{"room/Source/room.obj", obj_},
                                          {"room/Source/room.mtl", mtl_},
                                          {"room/tex/red.bmp", redBmp()},
                                          {"__MACOSX/._a", "x"},
                                          {"../evil.obj", obj_}}));
  const auto unpacked = [] {
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::temp_directory_path())) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("roomlight-") && !name.starts_with("roomlight-test")) ++count;
    }
    return count;
  };
  const size_t before = unpacked();
  const Result<Imported> r = importScene(folder_ / "room.zip");
  ASSERT_TRUE(r) << r.error();
  EXPECT_EQ(r.value().scene.textures.size(), 1u);
  EXPECT_LE(unpacked(), before);
  EXPECT_EQ(folder_.fileCount(), 1u);
}

TEST_F(ScenePackage, errorsNameTheZipAndItsEntry) {
  writeFile(folder_ / "a.zip", zipped({{"in/a.obj", "v 0 0 0\nf 1 2 3\n"}}));
  EXPECT_EQ(error("a.zip").find((folder_ / "a.zip").string() + ": in/a.obj: "), 0u) << error("a.zip");
  writeFile(folder_ / "b.zip", zipped({{"a.txt", "x"}}));
  EXPECT_NE(error("b.zip").find("holds no scene"), std::string::npos);
  writeFile(folder_ / "c.zip", "PK\x03\x04 and no more");
  EXPECT_NE(error("c.zip").find("damaged"), std::string::npos);
  const std::string inner = zipped({{"x.obj", obj_}});
  writeFile(folder_ / "d.zip", zipped({{"a.obj", inner}}));
  EXPECT_NE(error("d.zip").find("archive in an archive"), std::string::npos);
  EXPECT_NE(error("").find("holds no scene"), std::string::npos);
  std::string bomb = zipped({{"a.obj", std::string(size_t{96} << 20, 'v')}});
  writeFile(folder_ / "e.zip", bomb);
  EXPECT_NE(error("e.zip").find("which no home does"), std::string::npos) << error("e.zip");
}

TEST_F(ScenePackage, contentDecidesWhereTheNameIsWrong) {
  writeFile(folder_ / "room.txt", obj_);
  EXPECT_EQ(error("room.txt"), "");
  writeFile(folder_ / "room.gltf", obj_);
  EXPECT_EQ(error("room.gltf"), "");
  writeFile(folder_ / "home.zip",
            zipped({{"Home.xml", homeXml("<room name='r' areaVisible='true'><point x='0' y='0'/><point x='100' "
                                         "y='0'/><point x='100' y='100'/></room>")}}));
  EXPECT_EQ(error("home.zip"), "");
  GltfFile f = GltfFile::triangle();
  writeFile(folder_ / "t.obj", f.glb());
  EXPECT_EQ(error("t.obj"), "");
  writeFile(folder_ / "a.txt", "a letter\n");
  EXPECT_NE(error("a.txt").find("unknown kind of file '.txt'; use .glb"), std::string::npos);
}

TEST_F(ScenePackage, formatsOfProgramsSayWhatToExport) {
  for (const char* name : {"a.blend", "a.skp", "a.usdz", "a.IFC", "a.max", "a.step", "a.3dm", "a.dwg", "a.rvt"}) {
    writeFile(folder_ / name, "anything");
    EXPECT_NE(error(name).find("export it as"), std::string::npos) << error(name);
  }
}

TEST(CompanionSearch, findsWhatExportersMean) {
  const std::vector<std::string> names{"maps/oak.png", "maps/stone/oak.png", "room.mtl", "tex/Wood Floor.JPG",
                                       "tex/brick.webp"};
  EXPECT_EQ(meantName(names, "", "room.mtl"), "room.mtl");
  EXPECT_EQ(meantName(names, "", "C:\\Users\\x\\MAPS\\Oak.png"), "maps/oak.png");
  EXPECT_EQ(meantName(names, "", "/home/x/stone/oak.png"), "maps/stone/oak.png");
  EXPECT_EQ(meantName(names, "source/", "..\\tex\\wood floor.jpg"), "tex/Wood Floor.JPG");
  EXPECT_EQ(meantName(names, "", "brick.psd"), "tex/brick.webp");  // converted by somebody
  EXPECT_EQ(meantName(names, "", "marble.png"), std::nullopt);
}

TEST(CompanionSearch, neverLeavesTheRoot) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "scene");
  writeFile(folder / "secret.mtl", "x");
  std::filesystem::create_symlink(folder / "secret.mtl", folder / "scene/link.mtl");
  const ReadCompanion read = companionsAround(folder / "scene/a.obj", {});
  for (const char* name : {"../secret.mtl", "link.mtl", "/etc/passwd", "..\\secret.mtl"})
    EXPECT_FALSE(read(name, "")) << name;
  EXPECT_TRUE(companionsAround(folder / "scene/a.obj", folder.path())("../secret.mtl", ""));
}

}  // namespace
}  // namespace roomlight
