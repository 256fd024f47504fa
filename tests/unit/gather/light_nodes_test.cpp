#include "gather/light_nodes.h"

#include <gtest/gtest.h>

#include <vector>

namespace roomlight {
namespace {

// Light that grows evenly over a plane.
Vec3 evenly(Vec3 p) { return {1 + p.x, 2 + p.z, 3 + p.x - p.z}; }

std::vector<LightNodes::Place> placesOf(Vec3 n, float stepM) {
  std::vector<LightNodes::Place> out;
  for (int i = 0; i < 40; ++i) {
    Vec3 p(0.031f * static_cast<float>(i), 0, 0.017f * static_cast<float>(i * i % 40));
    p.y = 0.4f - (n.x * p.x + n.z * p.z) / n.y;
    out.push_back({7, p, n, stepM});
  }
  return out;
}

TEST(LightNodes, isLinearBetweenNodes) {
  for (const Vec3 n : {Vec3(0, 1, 0), Vec3(0, -1, 0), normalize(Vec3(0.3f, 1, -0.2f))}) {
    LightNodes light;
    for (const LightNodes::Place& place : placesOf(n, 0.1f)) {
      const Vec3 found = light.at(place, [](Vec3 node) { return evenly(node); });
      const Vec3 wanted = evenly(place.p);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 0.02f) << place.p.x << ", " << place.p.z;
    }
  }
}

TEST(LightNodes, gathersAtEachNodeOnce) {
  LightNodes light;
  size_t asked = 0;
  const auto gather = [&](Vec3 node) {
    ++asked;
    return evenly(node);
  };
  for (int frame = 0; frame < 3; ++frame) {
    for (const LightNodes::Place& place : placesOf({0, 1, 0}, 0.2f)) light.at(place, gather);
  }
  EXPECT_EQ(asked, light.nodes());
  EXPECT_LT(asked, 60u);
}

TEST(LightNodes, sidesOfOneThingAreKeptApart) {
  LightNodes light;
  const Vec3 p(0.1f, 0, 0.1f);
  EXPECT_FLOAT_EQ(light.at({1, p, {0, 1, 0}, 0.1f}, [](Vec3) { return Vec3(4); }).x, 4);
  EXPECT_FLOAT_EQ(light.at({1, p, {0, -1, 0}, 0.1f}, [](Vec3) { return Vec3(2); }).x, 2);
  EXPECT_FLOAT_EQ(light.at({2, p, {0, 1, 0}, 0.1f}, [](Vec3) { return Vec3(1); }).x, 1);
}

TEST(LightNodes, nodesThatLieElsewhereDoNotCount) {
  LightNodes light;
  const auto onThisSide = [](Vec3 node) { return node.x > 0.5f ? std::nullopt : std::optional(Vec3(3)); };
  EXPECT_FLOAT_EQ(light.at({1, {0.49f, 0, 0.1f}, {0, 1, 0}, 0.25f}, onThisSide).x, 3);
  const auto nowhere = [](Vec3 node) { return node.x == 0.3f ? std::optional(Vec3(5)) : std::nullopt; };
  EXPECT_FLOAT_EQ(light.at({1, {0.3f, 0, 0.1f}, {0, 1, 0}, 0.25f}, nowhere).x, 3) << "of the nodes that are known";
  LightNodes other;
  EXPECT_FLOAT_EQ(other.at({1, {0.3f, 0, 0.1f}, {0, 1, 0}, 0.25f}, nowhere).x, 5) << "of the place itself";
}

TEST(LightNodes, isForgottenOfThingsThatMoved) {
  LightNodes light;
  const Vec3 p(0.1f, 0, 0.1f);
  const auto value = [&](uint32_t instance, float now) {
    return light.at({instance, p, {0, 1, 0}, 0.1f}, [&](Vec3) { return Vec3(now); }).x;
  };
  value(1, 1), value(2, 1);
  const uint32_t moved[] = {1};
  light.forget(moved);
  EXPECT_FLOAT_EQ(value(1, 2), 2);
  EXPECT_FLOAT_EQ(value(2, 2), 1);
  light.forget();
  EXPECT_FLOAT_EQ(value(2, 3), 3);
}

}  // namespace
}  // namespace roomlight
