// Convex polygons cut by the planes of an integer lattice. Coordinates are in voxels from the world's origin, so that
// bricks and voxels are cut by the very same planes and no piece is lost or counted twice between them.
#pragma once

#include <array>

#include "base/vec.h"

namespace roomlight {

// A triangle cut by six planes has at most nine corners.
struct Polygon {
  std::array<Vec3, 10> v;
  int count = 0;
  void add(Vec3 p) {
    if (count < static_cast<int>(v.size())) v[static_cast<size_t>(count++)] = p;
  }
};

struct AreaCentroid {
  Vec3 vectorArea;  // normal times area
  Vec3 centroid;
  float area = 0;
};

inline AreaCentroid areaOf(const Polygon& polygon) {
  AreaCentroid r;
  Vec3 moment;
  for (int i = 1; i + 1 < polygon.count; ++i) {
    // Relative to a corner: coordinates may be far larger than the piece.
    const Vec3 b = polygon.v[static_cast<size_t>(i)] - polygon.v[0],
               c = polygon.v[static_cast<size_t>(i) + 1] - polygon.v[0];
    const Vec3 n = cross(b, c) * 0.5f;
    const float area = length(n);
    r.vectorArea += n;
    r.area += area;
    moment += (b + c) * (area / 3);
  }
  r.centroid = r.area > 0 ? polygon.v[0] + moment / r.area : polygon.v[0];
  return r;
}

// Cuts along `axis` at coordinate `plane`: what lies below and what lies above. New corners lie on the plane exactly.
inline void split(const Polygon& in, int axis, float plane, Polygon& below, Polygon& above) {
  below.count = above.count = 0;
  for (int i = 0; i < in.count; ++i) {
    const Vec3 a = in.v[static_cast<size_t>(i)], b = in.v[static_cast<size_t>(i + 1 == in.count ? 0 : i + 1)];
    const float da = a[axis] - plane, db = b[axis] - plane;
    if (da <= 0) below.add(a);
    if (da >= 0) above.add(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      Vec3 p = a + (b - a) * (da / (da - db));
      p[axis] = plane;
      below.add(p);
      above.add(p);
    }
  }
}

// Calls visit(cell, piece) for every cell of width `size` along `axis` that the polygon reaches. A polygon that lies in
// a plane between two cells belongs to the upper one.
template <class Visit>
void cutIntoCells(const Polygon& polygon, int axis, int size, Visit&& visit) {
  float lo = kInfinity, hi = -kInfinity;
  for (int i = 0; i < polygon.count; ++i) {
    lo = std::min(lo, polygon.v[static_cast<size_t>(i)][axis]);
    hi = std::max(hi, polygon.v[static_cast<size_t>(i)][axis]);
  }
  const auto s = static_cast<float>(size);
  const int first = static_cast<int>(std::floor(lo / s));
  const int last = std::max(first, static_cast<int>(std::ceil(hi / s)) - 1);
  if (first == last) {
    visit(first, polygon);
    return;
  }
  Polygon rest = polygon, piece, next;
  for (int cell = first; cell < last; ++cell) {
    split(rest, axis, s * static_cast<float>(cell + 1), piece, next);
    if (piece.count >= 3) visit(cell, piece);
    std::swap(rest, next);
  }
  if (rest.count >= 3) visit(last, rest);
}

// The part of the polygon within cell `cell` of width `size` along `axis`, as cutIntoCells would hand it out.
inline bool keepCell(Polygon& polygon, int axis, int size, int cell) {
  bool kept = false;
  Polygon result;
  // Same cuts in the same order as cutIntoCells, but stopping at the cell wanted.
  cutIntoCells(polygon, axis, size, [&](int c, const Polygon& piece) {
    if (c == cell) result = piece, kept = true;
  });
  polygon = result;
  return kept;
}

}  // namespace roomlight
