#include "gather/light_nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace roomlight {
namespace {

bool anywhere(Vec3) { return true; }

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

TEST(LightNodes, areLinearBetweenThemselves) {
  for (const Vec3 n : {Vec3(0, 1, 0), Vec3(0, -1, 0), normalize(Vec3(0.3f, 1, -0.2f))}) {
    LightNodes nodes;
    for (const LightNodes::Place& place : placesOf(n, 0.1f)) {
      const Vec3 found = nodes.at(place, {anywhere, evenly}), wanted = evenly(place.p);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 0.02f) << place.p.x << ", " << place.p.z;
    }
  }
}

TEST(LightNodes, areGatheredOnce) {
  LightNodes nodes;
  size_t asked = 0;
  const auto gather = [&](Vec3 node) {
    ++asked;
    return evenly(node);
  };
  for (int frame = 0; frame < 3; ++frame) {
    for (const LightNodes::Place& place : placesOf({0, 1, 0}, 0.2f)) nodes.at(place, {anywhere, gather});
  }
  EXPECT_EQ(asked, nodes.nodes());
  EXPECT_LT(asked, 60u);
}

// Each surface keeps its own light, whoever asks first.
TEST(LightNodes, doNotLendToOtherSurfaces) {
  const float s = std::sqrt(0.5f);
  const std::vector<LightNodes::Place> places{
      {1, {0.1f, 0, 0.1f}, {0, 1, 0}, 0.15f}, {1, {0.1f, 0, 0.1f}, {0, -1, 0}, 0.15f},
      {2, {0.1f, 0, 0.1f}, {0, 1, 0}, 0.15f}, {1, {0.1f, 0.2f, 0.1f}, {0, 1, 0}, 0.15f},
      {3, {0.1f, 0, 0.1f}, {s, s, 0}, 0.15f}, {3, {0.1f, 0, 0.1f}, {-s, s, 0}, 0.15f}};
  for (const bool backwards : {false, true}) {
    LightNodes nodes;
    for (size_t k = 0; k < places.size(); ++k) {
      const size_t i = backwards ? places.size() - 1 - k : k;
      const auto own = static_cast<float>(i + 1);
      EXPECT_FLOAT_EQ(nodes.at(places[i], {anywhere, [&](Vec3) { return Vec3(own); }}).x, own) << i;
    }
  }
}

// A thin wall stands on the floor: bright on one side, dark on the other.
TEST(LightNodes, doNotShineThroughWalls) {
  const auto gather = [](Vec3 node) { return Vec3(node.x < 0.3f ? 1.0f : 100.0f); };
  const auto at = [&](LightNodes& nodes, float x) {
    const auto sees = [x](Vec3 node) { return (node.x < 0.3f) == (x < 0.3f); };
    return nodes.at({1, {x, 0, 0.1f}, {0, 1, 0}, 0.25f}, {sees, gather}).x;
  };
  LightNodes nodes, others;
  EXPECT_FLOAT_EQ(at(nodes, 0.29f), 1);
  EXPECT_FLOAT_EQ(at(nodes, 0.31f), 100);
  EXPECT_FLOAT_EQ(at(nodes, 0.29f), 1);
  EXPECT_FLOAT_EQ(at(others, 0.31f), 100);
  EXPECT_FLOAT_EQ(at(others, 0.29f), 1);
}

TEST(LightNodes, aPlaceThatSeesNoneIsGatheredItselfOnce) {
  LightNodes nodes;
  int asked = 0;
  const LightNodes::Light light{[](Vec3) { return false; },
                                [&](Vec3 p) {
                                  ++asked;
                                  return Vec3(10 * p.x);
                                }};
  for (int frame = 0; frame < 2; ++frame) EXPECT_FLOAT_EQ(nodes.at({1, {0.3f, 0, 0.1f}, {0, 1, 0}, 0.25f}, light).x, 3);
  EXPECT_EQ(asked, 1);
}

TEST(LightNodes, areForgottenOfThingsThatMoved) {
  LightNodes nodes;
  const auto value = [&](uint32_t instance, float now) {
    return nodes.at({instance, {0.1f, 0, 0.1f}, {0, 1, 0}, 0.1f}, {anywhere, [&](Vec3) { return Vec3(now); }}).x;
  };
  value(1, 1), value(2, 1);
  const uint32_t moved[] = {1};
  nodes.forget(moved);
  EXPECT_FLOAT_EQ(value(1, 2), 2);
  EXPECT_FLOAT_EQ(value(2, 2), 1);
  nodes.forget();
  EXPECT_FLOAT_EQ(value(2, 3), 3);
}

}  // namespace
}  // namespace roomlight
