#include "bake/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/rooms.h"
#include "unit/bake/atlas_of_all.h"

namespace roomlight::bake {
namespace {

Scene room() {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, grey));
  addBox(scene, {2, 0, 1}, {2.6f, 0.6f, 1.5f}, grey);
  addSphere(scene, {1, 1, 1}, 0.05f, grey);
  Room floor;
  floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  return scene;
}

// What interpolation reads at a place of the atlas; it may be off by half a texel.
Vec3 placeRead(const Atlas& atlas, Vec2 texel) {
  std::vector<Vec3> places(static_cast<size_t>(atlas.width) * static_cast<size_t>(atlas.height), Vec3(1e6f));
  for (size_t i = 0; i < atlas.elements.size(); ++i) places[atlas.texels[i]] = atlas.elements[i].position;
  const float x = texel.x - 0.5f, y = texel.y - 0.5f;
  const auto x0 = static_cast<size_t>(x), y0 = static_cast<size_t>(y), w = static_cast<size_t>(atlas.width);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const auto row = [&](size_t at) { return fx > 1e-3f ? places[at] * (1 - fx) + places[at + 1] * fx : places[at]; };
  return fy > 1e-3f ? row(y0 * w + x0) * (1 - fy) + row((y0 + 1) * w + x0) * fy : row(y0 * w + x0);
}

TEST(Atlas, eachTexelBelongsToOne) {
  const Atlas atlas = atlasOfAll(room());
  EXPECT_EQ(atlas.height % 32, 0);
  std::set<uint32_t> texels(atlas.texels.begin(), atlas.texels.end());
  EXPECT_EQ(texels.size(), atlas.texels.size());
  for (const auto& [texel, element] : atlas.padding) {
    EXPECT_TRUE(texels.insert(texel).second);
    EXPECT_LT(element, atlas.elements.size());
  }
  EXPECT_LT(*texels.rbegin(), static_cast<uint32_t>(atlas.width * atlas.height));
}

TEST(Atlas, aVertexReadsTheLightOfItsPlace) {
  const Scene scene = room();
  const Atlas atlas = atlasOfAll(scene);
  for (const PlacedChart& placed : atlas.charts) {
    const Instance& instance = scene.instances[placed.chart.instance];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (const AtlasVertex& v : placed.vertices) {
      const Vec3 place = instance.worldFromObject.point(mesh.positions[v.vertex]);
      EXPECT_LT(length(placeRead(atlas, v.texel) - place), 0.025f) << v.texel.x << " " << v.texel.y;
    }
  }
}

TEST(Atlas, elementsFaceTheLitSideAndAreOffTheEdges) {
  const Atlas atlas = atlasOfAll(room());
  for (size_t i = 0; i < atlas.elements.size(); ++i) {
    const SurfaceElement& e = atlas.elements[i];
    EXPECT_NEAR(length(e.normal), 1, 1e-4);
    const Chart& chart = atlas.charts[atlas.chartOf[i]].chart;
    if (chart.byVertices) continue;
    EXPECT_GT(dot(e.normal, chart.normal), 0.8f);
    const Vec3 outside = max(max(-e.position, e.position - Vec3(4, 2.5f, 3)), Vec3(0));
    EXPECT_LT(maxComponent(outside), 1e-6f);
  }
}

// Its two triangles are fifty times as long as wide.
TEST(Atlas, placesOfASkirtingBoardKeepOffItsEdges) {
  Scene scene;
  addRectangle(scene, {0, 0, 0}, {4, 0, 0}, {0, 0.08f, 0}, addMaterial(scene, lambertian(0.5f)));
  const Atlas atlas = atlasOfAll(scene);
  ASSERT_FALSE(atlas.elements.empty());
  for (const SurfaceElement& e : atlas.elements) {
    EXPECT_GT(std::min(e.position.y, 0.08f - e.position.y), 0.0098f) << e.position.x;
    EXPECT_GT(std::min(e.position.x, 4 - e.position.x), 0.0098f) << e.position.y;
  }
}

// Where a gable tapers there is no room for all of the centimetre.
TEST(Atlas, placesOfASliverStayOnIt) {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 0.1f, 0}};
  mesh.indices = {0, 1, 2};
  mesh.material = addMaterial(scene, lambertian(0.5f));
  scene.meshes.push_back(mesh);
  scene.instances.push_back({});
  const Atlas atlas = atlasOfAll(scene);
  ASSERT_FALSE(atlas.elements.empty());
  for (const SurfaceElement& e : atlas.elements) {
    const float heightM = 0.05f * e.position.x;
    EXPECT_GT(e.position.y, 0) << e.position.x;
    EXPECT_LT(e.position.y, heightM) << e.position.x;
  }
}

// A slat of 3 cm whose long edges are rounded over a millimetre, and shaded smoothly.
Scene roundedSlat() {
  Scene scene;
  const float x[] = {-0.015f, -0.0136f, 0.0136f, 0.015f}, z[] = {-0.0005f, 0, 0, -0.0005f}, lean[] = {-1, 0, 0, 1};
  Mesh mesh;
  for (size_t k = 0; k < 4; ++k) {
    for (const float y : {0.0f, 2.0f}) {
      mesh.positions.push_back({x[k], y, z[k]});
      mesh.normals.push_back(normalize(Vec3(lean[k], 0, 1)));
    }
  }
  for (uint32_t k = 0; k < 6; k += 2) mesh.indices.insert(mesh.indices.end(), {k, k + 2, k + 3, k, k + 3, k + 1});
  mesh.material = addMaterial(scene, lambertian(0.5f));
  scene.meshes.push_back(mesh);
  scene.instances.push_back({});
  return scene;
}

TEST(Atlas, theFaceAndNotItsRoundedEdgeIsLit) {
  const Atlas atlas = atlasOfAll(roundedSlat());
  ASSERT_EQ(atlas.charts.size(), 1u);
  EXPECT_GE(atlas.elements.size(), 20u);
  for (const SurfaceElement& e : atlas.elements) {
    EXPECT_GT(e.normal.z, 0.99f);
    EXPECT_LT(std::abs(e.position.x), 0.0136f);
    EXPECT_GT(e.footprintM, 0.04f);
  }
}

TEST(Atlas, texelsAreAsFineAsAskedAndTheGroundIsCoarse) {
  Scene scene = room();
  addRectangle(scene, {-50, -0.1f, -50}, {0, 0, 100}, {100, 0, 0}, 0);
  const Atlas fine = atlasOfAll(scene, {0.05f, 2048, 32}), coarse = atlasOfAll(scene, {0.1f, 2048, 32});
  const auto count = [](const Atlas& atlas, bool ground) {
    size_t n = 0;
    for (size_t i = 0; i < atlas.elements.size(); ++i) {
      const Chart& chart = atlas.charts[atlas.chartOf[i]].chart;
      n += !chart.byVertices && (chart.areaM2 > 1000) == ground;
    }
    return n;
  };
  EXPECT_NEAR(static_cast<double>(count(fine, false)), 60.44 / (0.05 * 0.05), 2500);
  EXPECT_NEAR(static_cast<double>(count(coarse, false)), 60.44 / (0.1 * 0.1), 1300);
  EXPECT_LE(count(fine, true), 64u * 64u);
}

// A hotel: each room in rows of tiles of its own would be higher than a texture can be.
TEST(Atlas, manyRoomsShareRows) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  for (int i = 0; i < 150; ++i) {
    const auto x = static_cast<float>(4 * i);
    addRoom(scene, {x, 0, 0}, {x + 3, 2.5f, 3}, std::vector<int>(6, grey));
    Room floor;
    floor.floor = {{x, 0}, {x, 3}, {x + 3, 3}, {x + 3, 0}};
    scene.rooms.push_back(floor);
  }
  AtlasSettings settings;
  settings.texelM = 0.05f;
  const Atlas atlas = atlasOfAll(scene, settings);
  EXPECT_LE(atlas.height, kMostAtlasEdge);
  for (const PlacedChart& chart : atlas.charts) ASSERT_NEAR(chart.grid.perM.x, 20, 1.5f) << "texels of 5 cm";
}

TEST(Atlas, whatDoesNotFitGetsLongerTexels) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  for (int i = 0; i < 40; ++i) addRectangle(scene, {0, static_cast<float>(i), 0}, {0, 0, 7}, {7, 0, 0}, grey);
  Room floor;
  floor.floor = {{-1, -1}, {-1, 8}, {8, 8}, {8, -1}}, floor.heightM = 50;
  scene.rooms = {floor};
  SeenSides seen(scene);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    for (uint32_t t = 0; t < 2; ++t) seen.mark(i, t, false);
  }
  const std::vector<Chart> charts = chartsOf(scene, seen, {});
  const AtlasSettings fine{0.007f, 2048, 32, 0, {}};
  const Atlas atlas = atlasOf(scene, charts, fine).value();
  EXPECT_LE(atlas.height, kMostAtlasEdge);
  EXPECT_EQ(atlas.width, kMostAtlasEdge);
  EXPECT_GT(atlas.elements.size(), 1'000'000u);
}

}  // namespace
}  // namespace roomlight::bake
