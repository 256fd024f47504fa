// Furniture libraries of Sweet Home 3D, and the property files that they are listed in.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "import/failure.h"
#include "import/java_properties.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;
using namespace importers;

std::map<std::string, std::string> properties(const std::string& text) {
  return javaProperties({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

TEST(JavaProperties, linesKeysAndEscapes) {
  const auto p = properties(
      "# a comment\n! another \\\n  id=x\r\nname#1 = Caf\\u00e9 \\\n    au lait\nb:c\nd e\n\\ "
      "k\\=1=v\\\\w\\t.\nempty\nlatin=\xe9\nface=\\ud83d\\ude00\nlone=\\ud83d!\nlast=1\nlast=2");
  EXPECT_EQ(p.at("id"), "x");
  EXPECT_EQ(p.at("name#1"), "Caf\xc3\xa9 au lait");
  EXPECT_EQ(p.at("b"), "c");
  EXPECT_EQ(p.at("d"), "e");
  EXPECT_EQ(p.at(" k=1"), "v\\w\t.");
  EXPECT_EQ(p.at("empty"), "");
  EXPECT_EQ(p.at("latin"), "\xc3\xa9");
  EXPECT_EQ(p.at("face"), "\xf0\x9f\x98\x80");
  EXPECT_EQ(p.at("lone"), "\xef\xbf\xbd!");
  EXPECT_EQ(p.at("last"), "2");
  EXPECT_EQ(p.size(), 10u);
}

TEST(JavaProperties, badEscapesNameTheirLine) {
  for (const char* text : {"a=1\nb=\\u12", "a=1\nb=\\u12g4", "a=1\nb=\\u"}) {
    try {
      properties(text);
      ADD_FAILURE() << text;
    } catch (const Failure& f) {
      EXPECT_NE(std::string(f.what()).find("line 2"), std::string::npos) << f.what();
    }
  }
}

Result<Imported> library(const std::string& catalogue, const ZipEntries& models = {}) {
  ZipEntries entries{{"PluginFurnitureCatalog.properties", catalogue}};
  entries.insert(entries.end(), models.begin(), models.end());
  const TemporaryFolder folder;
  writeFile(folder / "a.sh3f", zipped(entries));
  return importScene(folder / "a.sh3f");
}

const std::string kBox = "v 0 0 0\nv 1 0 0\nv 0 1 1\nv 1 1 1\nf 1 2 4 3\n";

TEST(Sh3f, piecesStandInRowsApart) {
  std::string catalogue = "id=lib\n";
  for (int i = 1; i <= 30; ++i) {
    catalogue += fmt::format("name#{0}=piece {0}\nmodel#{0}=/m/box.obj\nwidth#{0}={1}\ndepth#{0}={2}\nheight#{0}=80\n",
                             i, 40 + 7 * i, 150 - 4 * i);
  }
  const Result<Imported> r = library(catalogue, {{"m/box.obj", kBox}});
  ASSERT_TRUE(r.ok()) << r.error();
  const Scene& scene = r.value().scene;
  EXPECT_EQ(scene.meshes.size(), 3u);  // floor, ground, and one model for all
  std::vector<Bounds3> boxes;
  for (int i = 1; i <= 30; ++i) {
    boxes.push_back(boundsOf(scene, "piece " + std::to_string(i)));
    EXPECT_NEAR(boxes.back().size().x, (40 + 7 * i) / 100.0, 1e-4);
    EXPECT_NEAR(boxes.back().size().z, (150 - 4 * i) / 100.0, 1e-4);
    EXPECT_NEAR(boxes.back().lo.y, 0, 1e-5);
  }
  const Bounds3 floor = boundsOf(scene, "showroom");
  for (size_t a = 0; a < boxes.size(); ++a) {
    EXPECT_GE(boxes[a].lo.x, floor.lo.x);
    EXPECT_LE(boxes[a].hi.z, floor.hi.z);
    for (size_t b = 0; b < a; ++b) {
      const bool apart = boxes[a].lo.x > boxes[b].hi.x + 0.4f || boxes[b].lo.x > boxes[a].hi.x + 0.4f ||
                         boxes[a].lo.z > boxes[b].hi.z + 0.4f || boxes[b].lo.z > boxes[a].hi.z + 0.4f;
      EXPECT_TRUE(apart) << a << " " << b;
    }
  }
  // About as wide as deep, by day, seen by its camera.
  EXPECT_LT(floor.size().x, 2.5f * floor.size().z);
  EXPECT_EQ(scene.suns.size(), 1u);
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  const Vec3 centre = normalize(floor.centre() - camera.worldFromCamera.w);
  EXPECT_GT(dot(-camera.worldFromCamera.z, centre), 0.999f);
}

TEST(Sh3f, lightSourcesAreInCentimetres) {
  const Result<Imported> r = library(
      "name#3=Lamp\nmodel#3=m/box.obj\nwidth#3=40\ndepth#3=20\nheight#3=60\nelevation#3=100\nlightSourceX#3=10 "
      "30\nlightSourceY#3=10 10\nlightSourceZ#3=45 45\n"
      "lightSourceColor#3=#FFFFFF #FFFFFF\n",
      {{"m/box.obj", kBox}});
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.value().scene.lamps.size(), 2u);
  const Lamp &a = r.value().scene.lamps[0], &b = r.value().scene.lamps[1];
  EXPECT_NEAR(a.position.y, 1.45, 1e-4);
  EXPECT_NEAR(b.position.x - a.position.x, 0.2, 1e-4);
  EXPECT_NEAR(luminance(a.intensityCd), 400 / (4 * std::numbers::pi), 0.1);  // half of 1600 lm, shared by two
}

TEST(Sh3f, damagedPiecesAreLeftOut) {
  const Result<Imported> r = library(
      "name#1=good\nwidth#1=10\ndepth#1=10\nheight#1=10\nname#2=bad\nwidth#2=wide\nname#4=far\nwidth#4=1e300\nname#x="
      "none\n");
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(facesOf(r.value().scene, "good").size(), 12u);  // a box, as it has no model
  EXPECT_NE(r.value().warnings[0].find("width#2: is 'wide'"), std::string::npos) << r.value().warnings[0];
  EXPECT_NE(r.value().warnings[1].find("width#4"), std::string::npos);
}

TEST(Sh3f, whatIsNoLibrarySaysSo) {
  const TemporaryFolder folder;
  writeFile(folder / "a.sh3f", zipped({{"Home.xml", "x"}}));
  const Result<Imported> none = importScene(folder / "a.sh3f");
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().find("no furniture library"), std::string::npos);
  const Result<Imported> empty = library("id=lib\n");
  ASSERT_FALSE(empty.ok());
  EXPECT_NE(empty.error().find("holds no pieces"), std::string::npos);
}

}  // namespace
}  // namespace roomlight
