#include "scene/outline.h"

#include <cmath>

namespace roomlight {

double signedAreaM2(std::span<const Vec2> corners) {
  double twice = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    // x runs right and z towards the viewer: the sense of rotation is the other way round than in (x, y).
    twice += static_cast<double>(b.x) * static_cast<double>(a.y) - static_cast<double>(a.x) * static_cast<double>(b.y);
  }
  return twice / 2;
}

bool crossesItself(std::span<const Vec2> corners) {
  const size_t n = corners.size();
  const auto turn = [](Vec2 a, Vec2 b, Vec2 c) {
    const double abx = static_cast<double>(b.x) - static_cast<double>(a.x),
                 aby = static_cast<double>(b.y) - static_cast<double>(a.y);
    return abx * (static_cast<double>(c.y) - static_cast<double>(a.y)) -
           aby * (static_cast<double>(c.x) - static_cast<double>(a.x));
  };
  for (size_t i = 0; i < n; ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % n];
    for (size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      const Vec2 c = corners[j], d = corners[(j + 1) % n];
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
    }
  }
  return false;
}

bool contains(std::span<const Vec2> corners, Vec2 p) {
  bool inside = false;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

double distanceToEdgeM(std::span<const Vec2> corners, Vec2 p) {
  double least = INFINITY;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], side = corners[(i + 1) % corners.size()] - a, to = p - a;
    const float square = side.x * side.x + side.y * side.y;
    const float along = square > 0 ? std::clamp((to.x * side.x + to.y * side.y) / square, 0.0f, 1.0f) : 0.0f;
    const Vec2 away = to - side * along;
    least = std::min(least, std::hypot(static_cast<double>(away.x), static_cast<double>(away.y)));
  }
  return least;
}

Vec2 longestSide(std::span<const Vec2> corners) {
  Vec2 best{1, 0};
  float longest = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec2 side = corners[(i + 1) % corners.size()] - corners[i];
    const float l = std::hypot(side.x, side.y);
    if (l > longest * 1.001f) longest = l, best = side * (1 / l);
  }
  return best;
}

}  // namespace roomlight
