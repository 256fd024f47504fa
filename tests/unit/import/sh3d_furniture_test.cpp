// Furniture and lights of Sweet Home 3D's homes: where they land, how they look, what light they give.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;

// A wedge without symmetry: full depth at its left, front right corner missing. 2 x 3 x 4 of its own unit, off its
// origin.
const std::string kWedge =
    "mtllib wedge.mtl\n"
    "v 5 1 0\nv 7 1 0\nv 5 1 4\nv 5 4 0\nv 7 4 0\nv 5 4 4\n"
    "usemtl red\nf 1 2 3\nf 4 6 5\nusemtl blue\nf 1 4 5 2\nf 2 5 6 3\nf 3 6 4 1\n";
const std::string kWedgeMtl = "newmtl red\nKd 0.8 0 0\nnewmtl blue\nKd 0 0 0.8\n";
const ZipEntries kModel{{"1/wedge.obj", kWedge}, {"1/wedge.mtl", kWedgeMtl}};

std::string pieceXml(const std::string& more, const std::string& inside = "",
                     const std::string& kind = "pieceOfFurniture") {
  return "<" + kind + " name='piece' x='300' y='200' width='100' depth='50' height='80' model='1/wedge.obj' " + more +
         ">" + inside + "</" + kind + ">";
}

Scene pieceScene(const std::string& more, const std::string& inside = "", const ZipEntries& model = kModel,
                 const std::string& kind = "pieceOfFurniture") {
  Result<Imported> imported = importHome(pieceXml(more, inside, kind), model);
  if (!imported) {
    ADD_FAILURE() << imported.error();
    return {};
  }
  return std::move(imported.value().scene);
}

void expectBox(const Scene& scene, Vec3 lo, Vec3 hi) {
  const Bounds3 b = boundsOf(scene, "piece");
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(b.lo[i], lo[i], 1e-5) << i;
    EXPECT_NEAR(b.hi[i], hi[i], 1e-5) << i;
  }
}

// The wedge's missing corner: where, on the plan, no part of it is.
bool covers(const Scene& scene, float x, float z) {
  for (const Face& f : facesOf(scene, "piece")) {
    if (std::abs(f.normal.y) < 0.9f) continue;
    const auto side = [&](Vec3 a, Vec3 b) { return (b.x - a.x) * (z - a.z) - (b.z - a.z) * (x - a.x); };
    const float s0 = side(f.a, f.b), s1 = side(f.b, f.c), s2 = side(f.c, f.a);
    if ((s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0)) return true;
  }
  return false;
}

TEST(Sh3dFurniture, fillsItsBoxOnItsElevation) {
  const Scene scene = pieceScene("elevation='40'");
  expectBox(scene, {2.5f, 0.4f, 1.75f}, {3.5f, 1.2f, 2.25f});
  // The model's front, +z, is the plan's y: its front right corner is missing.
  EXPECT_TRUE(covers(scene, 2.6f, 1.8f));
  EXPECT_TRUE(covers(scene, 2.55f, 2.15f));
  EXPECT_TRUE(covers(scene, 3.4f, 1.77f));
  EXPECT_FALSE(covers(scene, 3.4f, 2.2f));
}

TEST(Sh3dFurniture, turnsClockwiseOnThePlan) {
  const Scene scene = pieceScene("angle='1.5707963'");
  expectBox(scene, {2.75f, 0, 1.5f}, {3.25f, 0.8f, 2.5f});
  EXPECT_FALSE(covers(scene, 2.8f, 2.4f));  // what was at the front right
  EXPECT_TRUE(covers(scene, 3.2f, 1.6f));
}

TEST(Sh3dFurniture, mirrorsLeftAndRight) {
  const Scene scene = pieceScene("modelMirrored='true'");
  expectBox(scene, {2.5f, 0, 1.75f}, {3.5f, 0.8f, 2.25f});
  EXPECT_FALSE(covers(scene, 2.6f, 2.2f));
  EXPECT_TRUE(covers(scene, 3.4f, 2.15f));
}

TEST(Sh3dFurniture, modelRotationComesBeforeTheSize) {
  // z up to y up: the model's 4 units of depth become the height.
  const Scene scene = pieceScene("modelRotation='1 0 0 0 0 1 0 -1 0'");
  expectBox(scene, {2.5f, 0, 1.75f}, {3.5f, 0.8f, 2.25f});
  double level = 0;
  for (const Face& f : facesOf(scene, "piece"))
    level += std::abs(f.normal.y) > 0.9f ? static_cast<double>(f.areaM2) : 0;
  EXPECT_NEAR(level, 1 * 0.5, 1e-5);  // one rectangle instead of two triangles of half
}

TEST(Sh3dFurniture, pitchAndRollTiltAndKeepItOnTheFloor) {
  const Scene pitched = pieceScene("pitch='1.5707963' elevation='10'");
  expectBox(pitched, {2.5f, 0.1f, 2 - 0.4f}, {3.5f, 0.6f, 2 + 0.4f});
  const Scene rolled = pieceScene("roll='1.5707963' angle='1.5707963'");
  expectBox(rolled, {3 - 0.25f, 0, 2 - 0.4f}, {3.25f, 1, 2.4f});
}

TEST(Sh3dFurniture, levelsAndGroupsCarryPieces) {
  const std::string levels =
      "<level id='l0' name='0' elevation='0' floorThickness='12' height='250'/><level id='l1' name='1' elevation='260' "
      "floorThickness='12' height='250'/>";
  const std::string group = "<furnitureGroup name='g' level='l1'><furnitureGroup name='h'>" + pieceXml("") +
                            "</furnitureGroup>" + "<furnitureGroup name='hidden' visible='false'>" +
                            pieceXml("elevation='900'") + "</furnitureGroup></furnitureGroup>";
  const Result<Imported> imported = importHome(levels + group, kModel);
  ASSERT_TRUE(imported.ok()) << imported.error();
  expectBox(imported.value().scene, {2.5f, 2.6f, 1.75f}, {3.5f, 3.4f, 2.25f});
}

TEST(Sh3dFurniture, transformationsMoveTheirGroups) {
  const std::string door =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "g frame\nf 1 2 3 4\ng sweethome3d_opening_on_hinge_1\nf 5 6 7 8\ng sweethome3d_window_pane_on_hinge_1\nf 5 6 7\n"
      "g sweethome3d_opening_on_hinge_12\nf 1 5 8 4\n";
  const Scene scene = pieceScene("", "<transformation name='sweethome3d_hinge_1' matrix='1 0 0 0 0 1 0 0 0 0 1 1'/>",
                                 {{"1/wedge.obj", door}});
  // The model is 2 deep with its leaf moved by 1: the frame's group of the other name ends in the middle.
  expectBox(scene, {2.5f, 0, 1.75f}, {3.5f, 0.8f, 2.25f});
  float deepest = 0;
  for (const Face& f : facesOf(scene, "piece")) {
    if (std::abs(f.normal.x) > 0.9f) deepest = std::max({deepest, f.a.z, f.b.z, f.c.z});
  }
  EXPECT_NEAR(deepest, 2, 1e-5);
}

// A door of 1 x 0.8 x 0.5 of its unit that fills its piece: a frame, a leaf with a handle in its middle plane, a pin
// before the leaf's left edge. The groups that move stand inside objects, and the frame goes on behind the pin.
const std::string kDoor =
    "v 0 0 0\nv 1 0 0\nv 1 0.8 0.5\nv 0 0.8 0.5\n"
    "v 0.1 0.1 0.25\nv 0.3 0.1 0.25\nv 0.3 0.7 0.25\nv 0.1 0.7 0.25\n"
    "v 0.28 0.4 0.25\nv 0.28 0.4 0.3\nv 0.28 0.42 0.3\n"
    "v 0.1 0.1 0.28\nv 0.1 0.1 0.29\nv 0.1 0.7 0.29\nv 0.1 0.7 0.28\n"
    "o door\ng sweethome3d_opening_on_hinge_1_wood\nf 5 6 7 8\ng sweethome3d_opening_on_hinge_1_brass\nf 9 10 11\n"
    "o frame\ng frame_wood\nf 1 2 3\ng sweethome3d_hinge_1_brass\nf 12 13 14 15\ng frame_paint\nf 1 3 4\n";

// Turned by that much about its pin, right-handed about +y.
std::string turnedAboutPin(double turnRad) {
  const double c = std::cos(turnRad), s = std::sin(turnRad), x = 0.1, z = 0.285;
  std::string matrix;
  for (const double v : {c, 0.0, s, x - c * x - s * z, 0.0, 1.0, 0.0, 0.0, -s, 0.0, c, z + s * x - c * z})
    matrix += std::to_string(v) + " ";
  return "<transformation name='sweethome3d_hinge_1' matrix='" + matrix.substr(0, matrix.size() - 1) + "'/>";
}

Scene doorScene(const std::string& more, const std::string& inside = "", const std::string& kind = "doorOrWindow") {
  return pieceScene(more, inside, {{"1/wedge.obj", kDoor}}, kind);
}

void expectLeaf(const Scene& scene, Vec3 hinge, float turnRad, float atRest) {
  ASSERT_EQ(scene.leaves.size(), 1u);
  const Leaf& leaf = scene.leaves[0];
  EXPECT_NEAR(length(leaf.hinge - hinge), 0, 1e-4);
  EXPECT_NEAR(length(leaf.axis - Vec3(0, 1, 0)), 0, 1e-5);
  EXPECT_NEAR(leaf.turnRad, turnRad, 1e-3);
  EXPECT_NEAR(leaf.atRest, atRest, 1e-3);
  EXPECT_TRUE(isBlack(leaf.slideM));
}

TEST(Sh3dLeaves, turnAboutTheirPinsToItsSide) {
  const Scene scene = doorScene("");
  expectLeaf(scene, {2.6f, 0.4f, 2.035f}, -kPi / 2, 0);
  std::vector<int> leaves;
  for (const Instance& i : scene.instances) {
    if (i.name == "piece") leaves.push_back(i.leaf);
  }
  EXPECT_EQ(leaves, (std::vector<int>{0, 0, -1, -1}));  // wood, brass, all of the frame, pin
  expectLeaf(doorScene("modelMirrored='true'"), {3.4f, 0.4f, 2.035f}, kPi / 2, 0);
  expectLeaf(doorScene("angle='3.1415927'"), {3.4f, 0.4f, 1.965f}, -kPi / 2, 0);
}

TEST(Sh3dLeaves, areAtRestAsTheHomeHasThem) {
  const Vec3 hinge{2.6f, 0.4f, 2.035f};
  expectLeaf(doorScene("", turnedAboutPin(-kPi / 4)), hinge, -kPi / 2, 0.5f);
  expectLeaf(doorScene("", turnedAboutPin(kPi / 8)), hinge, kPi / 8, 1);  // to the other side
  EXPECT_TRUE(doorScene("", "", "light").leaves.empty());
}

TEST(Sh3dLeaves, slideToTheFarEndOfTheirRail) {
  const std::string slider =
      "v 0 0 0\nv 1 0 0\nv 1 0.8 0.5\nv 0 0.8 0.5\nv 0.5 0.1 0.25\nv 1 0.1 0.25\nv 1 0.7 0.25\nv 0 0.1 0.3\nv 0.5 0.1 "
      "0.3\nv 0.5 0.7 0.3\n"
      "g sweethome3d_unique_rail_frame\nf 1 2 3 4\ng sweethome3d_opening_on_rail_1\nf 5 6 7\ng "
      "sweethome3d_opening_on_rail_2\nf 8 9 10\n";
  const Scene scene = pieceScene("", "", {{"1/wedge.obj", slider}});
  ASSERT_EQ(scene.leaves.size(), 1u);
  EXPECT_NEAR(length(scene.leaves[0].slideM - Vec3(-0.5f, 0, 0)), 0, 1e-5);
  EXPECT_EQ(scene.leaves[0].turnRad, 0);
}

TEST(Sh3dFurniture, edgesAreHiddenWhereTheModelSaysSo) {
  const std::string edged = "v 0 0 0\nv 1 0 0\nv 0 1 1\nv 1 1 0\nusemtl a\nf 1 2 3\nusemtl edge_color_1\nf 2 3 4\n";
  EXPECT_EQ(facesOf(pieceScene("", "", {{"1/wedge.obj", edged}}), "piece").size(), 2u);
  EXPECT_EQ(facesOf(pieceScene("modelFlags='2'", "", {{"1/wedge.obj", edged}}), "piece").size(), 1u);
}

// A checkered floor of 2 x 1 m a picture, moved by a quarter picture to the right and half a one up, then turned by a
// right angle.
TEST(Sh3dTextures, areLaidByTheirSizeOffsetAndAngle) {
  const std::string bmp(
      "BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x18\0\0\0\0\0\x04\0\0\0\0\0\0\0\0\0\0\0\0\0\0"
      "\0\0\0\0\0\x40\x80\xff\0",
      58);
  const auto map = [&](const std::string& more, Vec2 at) {
    const std::string room =
        "<room name='R' ceilingVisible='false'><texture attribute='floorTexture' name='t' image='7' width='200' "
        "height='100' " +
        more + "/><point x='0' y='0'/><point x='400' y='0'/><point x='400' y='300'/></room>";
    const Result<Imported> r = importHome(room, {{"7", bmp}});
    EXPECT_TRUE(r.ok()) << r.error();
    if (!r) return Vec2();
    for (const Material& m : r.value().scene.materials) {
      if (m.baseColorTexture.texture < 0) continue;
      const auto& t = m.baseColorTexture.m;
      return Vec2{t[0][0] * at.x + t[0][1] * at.y + t[0][2], t[1][0] * at.x + t[1][1] * at.y + t[1][2]};
    }
    ADD_FAILURE() << "no texture";
    return Vec2();
  };
  const auto expect = [](Vec2 got, float u, float v) { EXPECT_NEAR(std::hypot(got.x - u, got.y - v), 0, 1e-5); };
  expect(map("", {1, 0.25f}), 0.5f, 0.25f);
  expect(map("scale='2'", {1, 0.25f}), 0.25f, 0.125f);
  expect(map("xOffset='0.25' yOffset='0.5'", {1, 0.25f}), 0.25f, 0.75f);
  expect(map("angle='1.5707963'", {1, 0.25f}), 0.125f, -1);
}

TEST(Sh3dFurniture, coloursReplaceThoseOfTheModel) {
  const auto colours = [](const Scene& scene) {
    std::vector<Vec3> out;
    for (const Instance& i : scene.instances) {
      if (i.name == "piece")
        out.push_back(
            scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)].baseColor);
    }
    return out;
  };
  const auto plain = colours(pieceScene(""));
  ASSERT_EQ(plain.size(), 2u);
  EXPECT_EQ(plain[0], Vec3(0.8f, 0, 0));
  const auto all = colours(pieceScene("color='FF00FF00'"));
  for (const Vec3 c : all) EXPECT_NEAR(length(c - Vec3(0, 0.85f, 0)), 0, 1e-6);
  const auto one = colours(pieceScene("color='FF00FF00'", "<material name='blue' color='FFFFFFFF'/>"));
  EXPECT_NEAR(length(one[0] - Vec3(0, 0.85f, 0)), 0, 1e-6);
  EXPECT_NEAR(length(one[1] - Vec3(0.85f)), 0, 1e-6);
  const auto keyed = colours(pieceScene("", "<material name='my own' key='red' color='FFFFFFFF'/>"));
  EXPECT_NEAR(length(keyed[0] - Vec3(0.85f)), 0, 1e-6);
  EXPECT_EQ(keyed[1], Vec3(0, 0, 0.8f));
}

TEST(Sh3dFurniture, veilsInDoorsAndWindowsAreGlass) {
  const ZipEntries model{{"1/wedge.obj", kWedge},
                         {"1/wedge.mtl", "newmtl red\nKd 0.8 0.8 0.8\nd 0.5\nnewmtl blue\nKd 0.8 0.8 0.8\nd 0.9\n"}};
  const auto panes = [&](const std::string& kind, const std::string& inside) {
    const Scene scene = pieceScene("", inside, model, kind);
    std::vector<int> out;
    for (const Instance& i : scene.instances) {
      if (i.name == "piece")
        out.push_back(
            scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)].glazing.panes);
    }
    return out;
  };
  EXPECT_EQ(panes("doorOrWindow", ""), (std::vector{1, 0}));
  EXPECT_EQ(panes("pieceOfFurniture", ""), (std::vector{0, 0}));
  EXPECT_EQ(panes("doorOrWindow", "<material name='red' color='FFFFFFFF'/>"), (std::vector{0, 0}));
}

TEST(Sh3dFurniture, missingModelsAreBoxesWithAWarning) {
  const Result<Imported> imported = importHome(pieceXml(""), {});
  ASSERT_TRUE(imported.ok());
  expectBox(imported.value().scene, {2.5f, 0, 1.75f}, {3.5f, 0.8f, 2.25f});
  ASSERT_EQ(imported.value().warnings.size(), 3u);
  EXPECT_NE(imported.value().warnings[0].find("'1/wedge.obj' is missing"), std::string::npos);
  const Result<Imported> dae = importHome(pieceXml(""), {{"1/wedge.obj", "<?xml version='1.0'?><COLLADA/>"}});
  ASSERT_TRUE(dae.ok());
  EXPECT_NE(dae.value().warnings[0].find("the model '1/wedge.obj'"), std::string::npos);
  const Result<Imported> damaged = importHome(pieceXml(""), {{"1/wedge.obj", "v 0 0 0\nf 1 2 9\n"}});
  ASSERT_TRUE(damaged.ok());
  EXPECT_NE(damaged.value().warnings[0].find("line 2"), std::string::npos);
}

TEST(Sh3dFurniture, namesOfModelsMayBeEscaped) {
  const Result<Imported> r = importHome(
      "<pieceOfFurniture name='piece' x='300' y='200' width='100' depth='50' height='80' model='1/my%20we%25ge.obj'/>" +
          std::string("<pieceOfFurniture name='q' x='0' y='0' width='1' depth='1' height='1' model='1/50%.obj'/>"),
      {{"1/my we%ge.obj", kWedge}, {"1/wedge.mtl", kWedgeMtl}, {"1/50%.obj", kWedge}});
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(facesOf(r.value().scene, "piece").size(), 8u);
  EXPECT_EQ(facesOf(r.value().scene, "q").size(), 8u);
}

TEST(Sh3dFurniture, texturesOfModelsHaveNoSize) {
  const std::string paint =
      "<material name='red' shininess='3'><texture name='t' width='-1' height='-1' image='none'/></material>";
  EXPECT_EQ(facesOf(pieceScene("", paint), "piece").size(), 8u);
}

TEST(Sh3dFurniture, modelsInAZipFileOfTheirOwn) {
  const Scene scene = pieceScene(
      "", "",
      {{"1/wedge.obj", zipped({{"textures/x.txt", "x"}, {"m/wedge.obj", kWedge}, {"m/wedge.mtl", kWedgeMtl}})}});
  expectBox(scene, {2.5f, 0, 1.75f}, {3.5f, 0.8f, 2.25f});
}

double fluxLm(const Scene& scene) {
  double sum = 0;
  for (const Lamp& lamp : scene.lamps) sum += 4 * std::numbers::pi * static_cast<double>(luminance(lamp.intensityCd));
  for (const Instance& i : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    const Material& m = scene.materials[static_cast<size_t>(mesh.material)];
    EXPECT_FALSE(m.doubleSided && !isBlack(m.emission));
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const Affine& w = i.worldFromObject;
      const Vec3 a = w.point(mesh.positions[mesh.indices[t]]), b = w.point(mesh.positions[mesh.indices[t + 1]]),
                 c = w.point(mesh.positions[mesh.indices[t + 2]]);
      sum += std::numbers::pi * static_cast<double>(luminance(m.emission) * length(cross(b - a, c - a))) / 2;
    }
  }
  return sum;
}

TEST(Sh3dLights, sourcesShareTheFluxOfThePower) {
  const std::string two =
      "<lightSource x='0' y='0' z='1' color='FFBCBCBC'/><lightSource x='1' y='1' z='0' color='FFFFFFFF' "
      "diameter='0.1'/>";
  const Scene scene = pieceScene("power='0.5' elevation='20'", two, kModel, "light");
  EXPECT_NEAR(fluxLm(scene), 800, 0.1);
  ASSERT_EQ(scene.lamps.size(), 1u);
  EXPECT_NEAR(4 * std::numbers::pi * static_cast<double>(luminance(scene.lamps[0].intensityCd)),
              800 * 0.502886 / 1.502886, 0.05);  // sRGB 188 of 255 is 0.502886
  // Left, front, top; the ball lies right, back, bottom and is 10 cm wide.
  EXPECT_NEAR(length(scene.lamps[0].position - Vec3(2.5f, 1, 2.25f)), 0, 1e-5);
  const Bounds3 ball = boundsOf(scene, "piece (light)");
  EXPECT_NEAR(length(ball.centre() - Vec3(3.5f, 0.2f, 1.75f)), 0, 1e-5);
  EXPECT_NEAR(ball.size().y, 0.1, 1e-5);
  EXPECT_NEAR(volumeM3(scene, "piece (light)"), 4 * std::numbers::pi / 3 * 0.05 * 0.05 * 0.05, 1e-4);
  EXPECT_GT(volumeM3(scene, "piece (light)"), 0);  // its fronts look outwards
}

TEST(Sh3dLights, coloursTintButDoNotDim) {
  const Scene scene = pieceScene("power='0.5'", "<lightSource x='0' y='0' z='1' color='FF402000'/>", kModel, "light");
  EXPECT_NEAR(fluxLm(scene), 800, 0.1);
  EXPECT_GT(scene.lamps[0].intensityCd.x, 2 * scene.lamps[0].intensityCd.y);
  EXPECT_EQ(scene.lamps[0].intensityCd.z, 0);
}

TEST(Sh3dLights, turnAndMirrorWithTheirPiece) {
  const std::string source = "<lightSource x='0' y='0' z='1' color='FFFFFFFF'/>";
  EXPECT_NEAR(
      length(pieceScene("angle='1.5707963'", source, kModel, "light").lamps[0].position - Vec3(2.75f, 0.8f, 1.5f)), 0,
      1e-5);
  EXPECT_NEAR(
      length(pieceScene("modelMirrored='true'", source, kModel, "light").lamps[0].position - Vec3(3.5f, 0.8f, 2.25f)),
      0, 1e-5);
}

TEST(Sh3dLights, powerScalesAndZeroIsDark) {
  const std::string source = "<lightSource x='0.5' y='0.5' z='0.5' color='FF2040FF'/>";
  EXPECT_NEAR(fluxLm(pieceScene("power='0.125'", source, kModel, "light")), 200, 0.05);
  EXPECT_EQ(fluxLm(pieceScene("power='0'", source, kModel, "light")), 0);
  const TemporaryFolder folder;
  writeFile(folder / "home.sh3d", zipped({{"Home.xml", homeXml(pieceXml("", source, "light"))}}));
  const Result<Imported> brighter = importScene(folder / "home.sh3d", {.lumenAtFullPower = 100});
  EXPECT_TRUE(!brighter.ok() || std::abs(fluxLm(brighter.value().scene) - 50) < 0.01);
}

TEST(Sh3dLights, thoseThatAreOffAreKeptForWhoSwitchesThemOn) {
  const std::string source = "<lightSource x='0' y='0' z='1' color='FFFFFFFF' diameter='0.1'/>";
  const auto imported = [&](const char* power) {
    return std::move(importHome(pieceXml(power, source, "light"), kModel).value());
  };
  EXPECT_TRUE(imported("power='0.5'").offLamps.empty());
  const Imported off = imported("power='0'");
  EXPECT_TRUE(off.scene.lamps.empty());
  ASSERT_EQ(off.offLamps.size(), 1u);
  EXPECT_EQ(off.offLamps[0].name, "piece");
  EXPECT_NEAR(4 * std::numbers::pi * static_cast<double>(luminance(off.offLamps[0].intensityCd)), 800, 0.1);
  EXPECT_NEAR(length(off.offLamps[0].position - Vec3(2.5f, 0.8f, 2.25f)), 0, 1e-5);
}

TEST(Sh3dLights, namedMaterialsGlow) {
  const Scene scene = pieceScene("power='1'", "<lightSourceMaterial name='blue'/>", kModel, "light");
  EXPECT_NEAR(fluxLm(scene), 1600, 0.5);
  EXPECT_TRUE(scene.lamps.empty());
}

}  // namespace
}  // namespace roomlight
