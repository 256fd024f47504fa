// Edges of sunlit patches against where geometry has them.
#include "bake/sun_mask.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>

#include "bake/layers.h"
#include "bake/light_texels.h"
#include "support/rooms.h"

namespace roomlight::bake {
namespace {

constexpr float kRoofM = 2, kRoofEndM = 2, kSlope = 0.3f;  // along x, of the way to the sun
constexpr float kEdgeM = kRoofEndM - kRoofM * kSlope;      // of the shadow on the floor

struct Laid {
  explicit Laid(Scene s) : scene(std::move(s)), rays(scene), seen(seenFrom(rays, eyesIn(rays), 1 << 17)) {
    atlas = atlasOf(scene, chartsOf(scene, seen, {}), {}).value();
    lit = litPlacesOf(atlas, rays, seen, 0.08f);
    buried = buriedCells(rays, atlas, lit, seen);
    moved.assign(scene.meshes.size(), 0);
  }
  SunCells cells() const { return {scene, atlas, lit, moved, buried}; }
  // Of each cell of the floor: where it is, and what is left there of the sun.
  std::vector<std::pair<Vec3, Vec3>> floorOf(const SunMask& mask) const {
    std::vector<std::pair<Vec3, Vec3>> out;
    const auto row = static_cast<size_t>(atlas.width * kFineCells);
    for (const PlacedChart& placed : atlas.charts) {
      const Chart& c = placed.chart;
      if (c.byVertices || c.normal.y < 0.99f || c.middle.y > 0.01f) continue;
      const auto along = [](int cell, float low, float perM) {
        return ((static_cast<float>(cell) + 0.5f) / kFineCells - 0.5f - kGap) / perM + low;
      };
      for (int y = 0; y < (placed.grid.height + 2 * kGap) * kFineCells; ++y) {
        for (int x = 0; x < (placed.grid.width + 2 * kGap) * kFineCells; ++x) {
          const Vec3 p =
              c.alongU * along(x, c.lowM.x, placed.grid.perM.x) + c.alongV * along(y, c.lowM.y, placed.grid.perM.y);
          if (p.x < 0 || p.x > 4 || p.z < 0 || p.z > 3) continue;
          const auto& l = mask.left[static_cast<size_t>(placed.top * kFineCells + y) * row +
                                    static_cast<size_t>(placed.left * kFineCells + x)];
          out.emplace_back(p, Vec3(l[0], l[1], l[2]) / 255.0f);
        }
      }
    }
    return out;
  }
  Scene scene;
  RayScene rays;
  SeenSides seen;
  Atlas atlas;
  LitPlaces lit;
  std::vector<bool> buried;
  std::vector<float> moved;
};

Sun sunAlongX(float slope = kSlope) {
  Sun sun;
  sun.toLight = normalize(Vec3{slope, 1, 0}), sun.illuminanceLux = Vec3(50'000);
  return sun;
}

// A floor in the open.
Scene terrace(float albedo = 0.5f) {
  Scene scene;
  addRectangle(scene, {0, 0, 0}, {0, 0, 3}, {4, 0, 0}, addMaterial(scene, lambertian(albedo)));
  Room floor;
  floor.floor = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
  scene.rooms = {floor};
  return scene;
}

Scene underARoof(const Material& roof = lambertian(0.5f)) {
  Scene scene = terrace();
  addRectangle(scene, {-4, kRoofM, -4}, {kRoofEndM + 4, 0, 0}, {0, 0, 11}, addMaterial(scene, roof));
  return scene;
}

TEST(SunMask, theShadowOfAnEdgeIsWhereItBelongs) {
  const Laid laid(underARoof());
  const SunMask mask = sunMaskOf(laid.cells(), laid.rays, sunAlongX());
  EXPECT_FALSE(mask.coloured);
  constexpr float kCellM = 0.05f / kFineCells;
  size_t between = 0;
  double area = 0;
  const auto cells = laid.floorOf(mask);
  for (const auto& [p, left] : cells) {
    const float expected = std::clamp((p.x - kEdgeM) / kCellM + 0.5f, 0.0f, 1.0f);
    EXPECT_NEAR(left.y, expected, 0.15f) << p.x;
    between += left.y > 0.01f && left.y < 0.99f;
    area += static_cast<double>(left.y);
  }
  EXPECT_GT(between, 100u);
  EXPECT_NEAR(area / static_cast<double>(cells.size()), static_cast<double>(4 - kEdgeM) / 4, 0.001);
}

TEST(SunMask, theDiscOfTheSunBlursTheEdge) {
  Sun sun = sunAlongX(0);
  sun.halfAngleRad = 0.05f;
  const Laid laid(underARoof());
  // Seen from the floor, the roof's edge crosses a disc of this radius on the floor.
  const float radiusM = kRoofM * std::tan(sun.halfAngleRad);
  for (const auto& [p, left] : laid.floorOf(sunMaskOf(laid.cells(), laid.rays, sun))) {
    const float s = std::clamp((p.x - kRoofEndM) / radiusM, -1.0f, 1.0f);
    const float expected = 0.5f + (s * std::sqrt(1 - s * s) + std::asin(s)) / kPi;
    EXPECT_NEAR(left.y, expected, 0.16f) << p.x;
  }
}

TEST(SunMask, tintedGlassTintsIt) {
  Material glass = lambertian(1);
  glass.transmission = 1, glass.baseColor = {0.9f, 0.5f, 0.3f};
  const Laid laid(underARoof(glass));
  const Sun sun = sunAlongX();
  const SunMask mask = sunMaskOf(laid.cells(), laid.rays, sun);
  EXPECT_TRUE(mask.coloured);
  const Vec3 expected = laid.rays.transmittance({{0.5f, 0.001f, 1.5f}, sun.toLight});
  EXPECT_GT(expected.x, expected.z + 0.1f);
  for (const auto& [p, left] : laid.floorOf(mask)) {
    if (p.x < kEdgeM - 0.05f) {
      EXPECT_LT(maxComponent(abs(left - expected)), 0.003f) << p.x;
    }
  }
}

// The part of a floor that a cupboard stands on is dark; beside the cupboard that may not be seen.
TEST(SunMask, whatIsUnderACupboardDoesNotDarkenTheFloorBesideIt) {
  Scene scene = terrace();
  addBox(scene, {1, 0.001f, 1}, {2, 1, 2}, 0);
  const Laid laid(std::move(scene));
  size_t foot = 0;
  for (const auto& [p, left] : laid.floorOf(sunMaskOf(laid.cells(), laid.rays, sunAlongX()))) {
    if (p.z < 1.1f || p.z > 1.9f || p.x < 1.98f || p.x > 2.1f) continue;
    ++foot;
    EXPECT_EQ(left.y, 1) << p.x;
  }
  EXPECT_GT(foot, 100u);
}

TEST(SunMask, elementsHaveTheMeanOfTheirTexels) {
  const Laid laid(underARoof());
  const Sun sun = sunAlongX();
  const std::vector<Vec3> lux = sunlightOn(laid.atlas, sunMaskOf(laid.cells(), laid.rays, sun), sun);
  for (size_t i = 0; i < lux.size(); ++i) {
    const SurfaceElement& e = laid.atlas.elements[i];
    if (e.position.y > 0.01f || e.normal.y < 0.9f) continue;
    if (std::abs(e.position.x - kEdgeM) < 0.05f) continue;
    EXPECT_NEAR(lux[i].y, e.position.x > kEdgeM ? 50'000 * sun.toLight.y : 0, 1) << e.position.x;
  }
}

// Beside the mask, meters have what bounces alone: of a floor in the open nothing comes back.
TEST(SunMask, metersLeaveOutWhatIsInIt) {
  Laid laid(terrace());
  laid.scene.suns = {sunAlongX()};
  const RenderProgress quiet;
  RenderStats stats;
  Stages stages(quiet, stats);
  LayerSettings settings;
  ASSERT_TRUE(applyQuality("draft", settings.render));
  const Result<std::vector<BakedLayer>> layers =
      daylightLayers(laid.scene, 12, laid.lit.places, laid.cells(), settings, stages);
  ASSERT_TRUE(layers) << layers.error();
  ASSERT_EQ(layers.value().size(), 1u);
  const BakedLayer& layer = layers.value()[0];
  ASSERT_TRUE(layer.sun);
  for (const Vec3 lux : layer.lux) EXPECT_LT(luminance(lux), 1);
  for (const auto& [p, left] : laid.floorOf(layer.mask)) EXPECT_EQ(left.y, 1);
}

TEST(SunMask, twoSunsStayInTheirLayer) {
  Laid laid(terrace());
  laid.scene.suns = {sunAlongX(), sunAlongX(0.6f)};
  const RenderProgress quiet;
  RenderStats stats;
  Stages stages(quiet, stats);
  LayerSettings settings;
  ASSERT_TRUE(applyQuality("draft", settings.render));
  const Result<std::vector<BakedLayer>> layers =
      daylightLayers(laid.scene, 12, laid.lit.places, laid.cells(), settings, stages);
  ASSERT_TRUE(layers) << layers.error();
  const BakedLayer& layer = layers.value().at(0);
  EXPECT_FALSE(layer.sun || layer.mask.any());
  const float expected = 50'000 * (laid.scene.suns[0].toLight.y + laid.scene.suns[1].toLight.y);
  for (const Vec3 lux : layer.lux) EXPECT_NEAR(luminance(lux), expected, 0.01f * expected);
}

TEST(MaskTexels, comeBackTileByTile) {
  constexpr int kWidth = 8, kHeight = 4, kTile = 4, kEdge = kTile * kFineCells;
  SunMask mask;
  mask.left.resize(static_cast<size_t>(kWidth * kHeight * kFineCells * kFineCells));
  const auto at = [&](int x, int y) -> std::array<uint8_t, 3>& {
    return mask.left[static_cast<size_t>(y * kWidth * kFineCells + x)];
  };
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      const auto v = static_cast<uint8_t>(7 * x + 31 * y);
      at(kEdge + x, y) = {v, static_cast<uint8_t>(v / 2), 0};
    }
  }
  for (const bool coloured : {false, true}) {
    mask.coloured = coloured;
    const MaskTexels texels = maskTexels(mask, kWidth, kTile);
    EXPECT_EQ(texels.tiles, std::vector<uint32_t>{1}) << "the first is dark";
    ASSERT_EQ(texels.channels, coloured ? 3 : 1);
    std::string bytes(static_cast<size_t>(kEdge * kEdge * texels.channels), '\0');
    uLongf size = bytes.size();
    ASSERT_EQ(
        uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(texels.stream.data()),
                   static_cast<uLong>(texels.stream.size())),
        Z_OK);
    ASSERT_EQ(size, bytes.size());
    for (size_t plane = 0; plane < static_cast<size_t>(texels.channels); ++plane) {
      for (int y = 0; y < kEdge; ++y) {
        uint8_t value = 0;
        for (int x = 0; x < kEdge; ++x) {
          value = static_cast<uint8_t>(value + bytes[plane * kEdge * kEdge + static_cast<size_t>(y * kEdge + x)]);
          EXPECT_EQ(value, at(kEdge + x, y)[coloured ? plane : 1]);
        }
      }
    }
  }
}

}  // namespace
}  // namespace roomlight::bake
