// What validate() lets through and what it names.
#include "scene/validate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/rooms.h"

namespace roomlight {
namespace {

Scene oneRectangle() {
  Scene scene;
  test::addRectangle(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  scene.instances[0].name = "table";
  return scene;
}

void expectTooLarge(const Scene& scene) {
  const Status status = validate(scene);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().find("instance 0 'table': its bounds in the world are not finite"), std::string::npos)
      << status.error();
}

TEST(Validate, plainSceneIsFine) {
  const Status status = validate(oneRectangle());
  EXPECT_TRUE(status.ok()) << status.error();
}

TEST(Validate, verticesThatATransformCarriesToInfinityAreNamed) {
  Scene scene = oneRectangle();
  for (Vec3& p : scene.meshes[0].positions) p *= 1e20f;
  scene.instances[0].worldFromObject.x = {1e20f, 0, 0};
  expectTooLarge(scene);
}

// Infinity less infinity is no number, which bounds pass over in silence.
TEST(Validate, sumsThatAreNoNumberAreNamed) {
  Scene scene = oneRectangle();
  for (Vec3& p : scene.meshes[0].positions) p *= 1e20f;
  scene.instances[0].worldFromObject.x = {1e20f, 0, 0};
  scene.instances[0].worldFromObject.z = {-1e20f, 0, 1};
  expectTooLarge(scene);
}

TEST(Validate, translationCanBeWhatIsTooMuch) {
  Scene scene = oneRectangle();
  for (Vec3& p : scene.meshes[0].positions) p *= 3e38f;
  EXPECT_TRUE(validate(scene).ok());
  scene.instances[0].worldFromObject.w = {3e38f, 0, 0};
  expectTooLarge(scene);
}

TEST(Validate, verticesThatNoTriangleUsesDoNotCount) {
  Scene scene = oneRectangle();
  scene.meshes[0].positions.push_back({3e38f, 0, 0});
  scene.instances[0].worldFromObject.x = {10, 0, 0};
  EXPECT_TRUE(validate(scene).ok());
}

// The line that refuses the scene, changed so.
template <class Change>
std::string refusal(Change&& change) {
  Scene scene = oneRectangle();
  Mesh& mesh = scene.meshes[0];
  const size_t n = mesh.positions.size();
  mesh.uv[0].assign(n, {0, 0}), mesh.uv[1].assign(n, {0, 0});
  mesh.colors.assign(n, Vec3(1)), mesh.colorAlphas.assign(n, 1.0f);
  mesh.tangents.assign(n, {1, 0, 0}), mesh.tangentSigns.assign(n, -1.0f);
  scene.lamps.emplace_back().kind = LampKind::Spot;
  scene.suns.emplace_back().illuminanceLux = Vec3(1);
  EXPECT_TRUE(validate(scene).ok()) << validate(scene).error();
  change(scene);
  const Status status = validate(scene);
  return status.ok() ? "none" : status.error();
}

void expectRefused(const std::string& error, const std::string& what) {
  EXPECT_NE(error.find(what), std::string::npos) << error;
}

TEST(Validate, brokenValuesOfVerticesAreNamed) {
  for (const float v : {std::nanf(""), kInfinity, -1e13f}) {
    expectRefused(refusal([&](Scene& s) { s.meshes[0].uv[1][2].y = v; }), "texture coordinate 2 of set 1 is not");
    expectRefused(refusal([&](Scene& s) { s.meshes[0].colors[1].z = v; }), "colour 1 is not from 0 to 1");
    expectRefused(refusal([&](Scene& s) { s.meshes[0].colorAlphas[3] = v; }), "alpha 3 of the colours is not");
    expectRefused(refusal([&](Scene& s) { s.meshes[0].tangentSigns[0] = v; }), "sign 0 of the tangents is neither");
  }
  expectRefused(refusal([](Scene& s) { s.meshes[0].tangents[2].x = kInfinity; }), "tangent 2 is not finite");
  expectRefused(refusal([](Scene& s) { s.meshes[0].colors[0] = Vec3(1.5f); }), "colour 0 is not from 0 to 1");
}

TEST(Validate, conesThatAreNoneAreNamed) {
  for (const float v : {std::nanf(""), -0.1f, 2.0f, kInfinity}) {
    expectRefused(refusal([&](Scene& s) { s.lamps[0].innerConeRad = v; }), "lamp 0 '': its cones are not");
    expectRefused(refusal([&](Scene& s) { s.lamps[0].outerConeRad = v; }), "lamp 0 '': its cones are not");
  }
  expectRefused(refusal([](Scene& s) { s.lamps[0].direction = Vec3(0); }), "its direction is no unit vector");
  expectRefused(refusal([](Scene& s) { s.lamps[0].up.x = kInfinity; }), "a value is negative or not finite");
  expectRefused(refusal([](Scene& s) { s.lamps[0].wattsW = -1; }), "its size or power is negative");
  // Of other lamps the cones mean nothing, and half a sphere is a cone.
  EXPECT_EQ(refusal([](Scene& s) { s.lamps[0].kind = LampKind::Point, s.lamps[0].outerConeRad = -1; }), "none");
  EXPECT_EQ(refusal([](Scene& s) { s.lamps[0].outerConeRad = s.lamps[0].innerConeRad = kPi / 2; }), "none");
}

TEST(Validate, sunsThatAreNoneAreNamed) {
  for (const float v : {std::nanf(""), -0.1f, 2.0f})
    expectRefused(refusal([&](Scene& s) { s.suns[0].halfAngleRad = v; }), "sun 0 '': its disc is not 0 to 90 degrees");
  for (const Vec3 v : {Vec3(0), Vec3(std::nanf("")), Vec3{0, 2, 0}})
    expectRefused(refusal([&](Scene& s) { s.suns[0].toLight = v; }), "sun 0 '': its direction is no unit vector");
  expectRefused(refusal([](Scene& s) { s.sky.rotationRad = std::nanf(""); }), "sky: its rotation is not finite");
}

}  // namespace
}  // namespace roomlight
