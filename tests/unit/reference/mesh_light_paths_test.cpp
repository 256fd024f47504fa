// Light paths that start in emissive meshes: bulbs in shades.
#include <gtest/gtest.h>

#include "reference/light_vertices.h"
#include "unit/reference/shaded_lamp.h"

namespace roomlight {
namespace {

using test::emptyShade, test::inShade, test::meanLuminance, test::render, test::room, test::standardError;

enum class Bulb {
  Black,
  White,     // reflects light that falls back on it
  Sheet,     // shines to both sides
  Textured,  // a sheet, half of which is dark
  Cluster    // two balls in one mesh, and a lamp beside them
};

void addBulb(Scene& scene, Bulb kind, Vec3 at) {
  Material m = test::lambertian(kind == Bulb::White ? 0.8f : 0, 20000);
  if (kind == Bulb::Black || kind == Bulb::White)
    return test::addSphere(scene, at, 0.02f, test::addMaterial(scene, m), 12);
  if (kind == Bulb::Cluster) {
    test::addSphere(scene, at, 0.015f, test::addMaterial(scene, m), 12);
    Mesh& mesh = scene.meshes.back();
    const Mesh one = mesh;
    for (const uint32_t i : one.indices) mesh.indices.push_back(i + static_cast<uint32_t>(one.positions.size()));
    for (const Vec3 p : one.positions) mesh.positions.push_back(p - Vec3{0.2f, 0, 0});
    mesh.normals.insert(mesh.normals.end(), one.normals.begin(), one.normals.end());
    scene.lamps.push_back(test::pointLamp(at - Vec3{0.1f, 0, 0}, 10));
    return;
  }
  m.doubleSided = true;
  if (kind == Bulb::Textured) m.emissionTexture.texture = static_cast<int>(scene.textures.size());
  test::addRectangle(scene, at - Vec3{0, 0.02f, 0.02f}, {0, 0.04f, 0}, {0, 0, 0.04f}, test::addMaterial(scene, m));
  if (kind != Bulb::Textured) return;
  scene.meshes.back().uv[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  Texture& half = scene.textures.emplace_back();
  half.name = "half", half.width = 16, half.height = 1, half.wrapU = half.wrapV = Wrap::ClampToEdge;
  for (int i = 0; i < 64; ++i) half.rgba.push_back(i % 4 == 3 || i >= 32 ? uint8_t{255} : uint8_t{0});
}

TEST(MeshLightPaths, FirstVerticesHoldAllTheirLight) {
  for (const Bulb kind : {Bulb::Black, Bulb::Sheet, Bulb::Textured, Bulb::Cluster}) {
    Scene scene = room(test::lambertian(0));
    addBulb(scene, kind, {1.3f, 2, 1.7f});
    const RayScene rays(scene);
    const Lights lights(scene);
    LightVertices vertices(rays, lights);
    vertices.trace(200000, 0, 1);
    double lumens = 0;
    for (const LightVertex& v : vertices.all()) lumens += static_cast<double>(luminance(v.flux));
    // Of the flux that Lights knows of a textured one, a sampled mean, the rays do not depend: areas do.
    const double sheet = 2 * std::numbers::pi * 20000 * 0.0016,
                 expected = kind == Bulb::Sheet ? sheet
                            : kind == Bulb::Textured
                                ? sheet / 2
                                : lights.emittedFluxLm() + (kind == Bulb::Cluster ? 40 * std::numbers::pi : 0);
    EXPECT_NEAR(lumens, expected, 0.01 * expected) << static_cast<int>(kind);
  }
}

class BulbInShade : public testing::TestWithParam<Bulb> {};

TEST_P(BulbInShade, MeanIsThatOfPathsWithoutConnections) {
  Scene scene = emptyShade(test::lambertian(0.7f), 0.3f);
  addBulb(scene, GetParam(), inShade(0.85f, 0.3f));
  // Several renders, because the error of one depends on its few brightest pixels.
  constexpr int kRenders = 4;
  double difference = 0, variance = 0, plainError = 0, connectedError = 0, mean = 0;
  for (uint64_t seed = 0; seed < kRenders; ++seed) {
    const PathResult plain = render(scene, 1024, false, seed), connected = render(scene, 256, true, seed);
    const double p = standardError(plain), c = standardError(connected);
    plainError += p, connectedError += c;
    mean += meanLuminance(plain.image) / kRenders;
    difference += (meanLuminance(connected.image) - meanLuminance(plain.image)) / kRenders;
    variance += (p * p + c * c) / (kRenders * kRenders);
  }
  EXPECT_LT(connectedError, plainError);
  EXPECT_NEAR(difference, 0, 3.5 * std::sqrt(variance)) << "of " << mean;
}
INSTANTIATE_TEST_SUITE_P(Kinds, BulbInShade,
                         testing::Values(Bulb::Black, Bulb::White, Bulb::Sheet, Bulb::Textured, Bulb::Cluster));

// A globe under the ceiling, above the camera: little noise either way.
TEST(MeshLightPaths, ConnectionsKeepTheMeanWithinOnePercent) {
  Scene scene = room(test::lambertian(0.6f));
  test::addSphere(scene, {2, 2.6f, 3.5f}, 0.15f, test::addMaterial(scene, test::lambertian(0.5f, 500)), 12);
  const PathResult plain = render(scene, 3072, false), connected = render(scene, 2048, true);
  const double m = meanLuminance(plain.image);
  EXPECT_LT(3 * std::hypot(standardError(plain), standardError(connected)), 0.01 * m) << "else the test cannot tell";
  EXPECT_NEAR(meanLuminance(connected.image), m, 0.01 * m);
}

TEST(MeshLightPaths, LowerTheNoiseOfABulbInAShade) {
  Scene scene = emptyShade(test::lambertian(0.7f), 0.3f);
  addBulb(scene, Bulb::Black, inShade(0.85f, 0.3f));
  EXPECT_LT(render(scene, 64, true).noise, 0.6 * render(scene, 64, false).noise);
}

// A wide emitter starts no light paths: the picture is the same bit for bit.
TEST(MeshLightPaths, LeaveWideEmittersAlone) {
  Scene scene = room(test::lambertian(0.6f));
  test::addRectangle(scene, {1, 2.99f, 1}, {1, 0, 0}, {0, 0, 1}, test::addMaterial(scene, test::lambertian(0.6f, 100)));
  EXPECT_EQ(render(scene, 2, true).image.pixels, render(scene, 2, false).image.pixels);
}

// Walls so small that all of them start light paths: the radiance is 10 / (1 - albedo) all the same.
TEST(MeshLightPaths, SmallFurnaceStaysUniform) {
  for (const float rho : {0.3f, 0.7f}) {
    Scene scene;
    test::addRoom(scene, {0, 0, 0}, {0.2f, 0.2f, 0.2f},
                  std::vector<int>(6, test::addMaterial(scene, test::lambertian(rho, 10))));
    const RayScene rays(scene);
    const Lights lights(scene);
    ASSERT_TRUE(LightRays(lights).hasAllLight());
    Camera camera;
    camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.09f, 0.11f, 0.17f}};
    camera.yFovRad = 1.2f;
    PathSettings settings;
    settings.width = settings.height = 20, settings.samples = 512;
    EXPECT_NEAR(meanLuminance(pathTrace(rays, lights, camera, settings).image), 10 / (1 - static_cast<double>(rho)),
                0.01 * 10 / (1 - static_cast<double>(rho)));
  }
}

}  // namespace
}  // namespace roomlight
