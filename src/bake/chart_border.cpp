#include "bake/chart_border.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace roomlight::bake {
namespace {

constexpr int kCorner = 3;        // edges that a place is moved off, one after the other
constexpr float kRoundingM = 1e-5f;  // that a place on an edge may be outside of it
constexpr float kEnough = 0.99f;     // of the way

float dot2(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

}  // namespace

ChartBorder::ChartBorder(std::span<const std::array<Vec2, 3>> triangles) {
  using Corner = std::pair<float, float>;
  struct Side {
    Vec2 a, b, opposite;
    int triangles = 0;
  };
  std::map<std::pair<Corner, Corner>, Side> sides;
  for (const auto& corners : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec2 a = corners[k], b = corners[(k + 1) % 3];
      const Corner at{a.x, a.y}, to{b.x, b.y};
      Side& side = sides[at < to ? std::pair(at, to) : std::pair(to, at)];
      side.a = a, side.b = b, side.opposite = corners[(k + 2) % 3], ++side.triangles;
    }
  }
  double area = 0, around = 0;
  for (const auto& c : triangles) {
    const Vec2 a = c[1] - c[0], b = c[2] - c[0];
    area += std::abs(static_cast<double>(a.x * b.y - a.y * b.x)) / 2;
  }
  for (const auto& [corners, side] : sides) {
    const Vec2 d = side.b - side.a;
    const float length = std::sqrt(dot2(d, d));
    if (side.triangles != 1 || !(length > 0)) continue;
    const Vec2 along = d * (1 / length), left{-along.y, along.x};
    edges_.push_back({side.a, along, dot2(side.opposite - side.a, left) < 0 ? left * -1.0f : left, length});
    around += static_cast<double>(length);
  }
  widthM_ = around > 0 ? static_cast<float>(2 * area / around) : kInfinity;
}

Vec2 ChartBorder::inset(Vec2 place, float byM) const {
  for (int k = 0; k < kCorner; ++k) {
    const Edge* nearest = nullptr;
    float least = byM;
    for (const Edge& e : edges_) {
      const Vec2 d = place - e.from;
      const float at = dot2(d, e.along), off = dot2(d, e.inwards);
      if (at < -byM || at > e.length + byM || off < -kRoundingM || off >= least) continue;
      nearest = &e, least = off;
    }
    if (!nearest || least > kEnough * byM) break;
    place = place + nearest->inwards * (byM - least);
  }
  return place;
}

}  // namespace roomlight::bake
