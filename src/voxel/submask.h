// The 4x4x4 sub-cells of a voxel that a flat convex polygon touches.
#pragma once

#include <cstdint>

#include "voxel/clip.h"

namespace roomlight {

// `polygon` lies within the voxel whose lower corner is `corner` (voxel units); `normal` need not be unit.
// Conservative: no touched cell is missing. Columns along the axis nearest to the normal; within a column the plane
// bounds the height.
inline uint64_t subVoxelMask(const Polygon& polygon, Vec3 corner, Vec3 normal) {
  const Vec3 an = abs(normal);
  const int a = an.x >= an.y && an.x >= an.z ? 0 : an.y >= an.z ? 1 : 2;
  const int u = (a + 1) % 3, v = (a + 2) % 3;
  float lo[3] = {kInfinity, kInfinity, kInfinity}, hi[3] = {-kInfinity, -kInfinity, -kInfinity};
  std::array<Vec3, 10> q;
  for (int i = 0; i < polygon.count; ++i) {
    q[static_cast<size_t>(i)] = (polygon.v[static_cast<size_t>(i)] - corner) * 4.0f;
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], q[static_cast<size_t>(i)][k]);
      hi[k] = std::max(hi[k], q[static_cast<size_t>(i)][k]);
    }
  }
  const auto cellLo = [](float x) { return std::clamp(static_cast<int>(std::floor(x)), 0, 3); };
  const auto cellHi = [&](float l, float h) {
    return std::max(cellLo(l), std::clamp(static_cast<int>(std::ceil(h)) - 1, 0, 3));
  };
  const int shift[3] = {0, 2, 4};  // bit = x + 4 y + 16 z
  const float du = -normal[u] / normal[a], dv = -normal[v] / normal[a];
  const float h0 = q[0][a] - du * q[0][u] - dv * q[0][v];
  uint64_t mask = 0;
  for (int iv = cellLo(lo[v]); iv <= cellHi(lo[v], hi[v]); ++iv) {
    for (int iu = cellLo(lo[u]); iu <= cellHi(lo[u], hi[u]); ++iu) {
      const float u0 = static_cast<float>(iu), v0 = static_cast<float>(iv);
      bool outside = false;
      for (int i = 0; i < polygon.count && !outside; ++i) {
        const Vec3 p = q[static_cast<size_t>(i)], r = q[static_cast<size_t>(i + 1 == polygon.count ? 0 : i + 1)];
        // Inward normal of the edge in the (u, v) plane; the square's corner farthest inside decides.
        const float sign = normal[a] > 0 ? 1.0f : -1.0f;
        const float eu = -(r[v] - p[v]) * sign, ev = (r[u] - p[u]) * sign;
        const float best = eu * ((eu > 0 ? u0 + 1 : u0) - p[u]) + ev * ((ev > 0 ? v0 + 1 : v0) - p[v]);
        outside = best < -1e-4f;
      }
      if (outside) continue;
      const float h = h0 + du * u0 + dv * v0;
      // Slack for the plane's rounding, but not beyond the polygon: a flat wall stays one sub-cell thick.
      const float hMin = std::max(lo[a], h + std::min(du, 0.0f) + std::min(dv, 0.0f) - 1e-4f);
      const float hMax = std::min(hi[a], h + std::max(du, 0.0f) + std::max(dv, 0.0f) + 1e-4f);
      for (int ia = cellLo(hMin); ia <= cellHi(hMin, hMax); ++ia) {
        mask |= uint64_t{1} << ((iu << shift[u]) + (iv << shift[v]) + (ia << shift[a]));
      }
    }
  }
  return mask;
}

// Fraction of the 16 columns along each axis in which some sub-cell is set.
inline Vec3 columnCoverage(uint64_t mask) {
  uint64_t x = mask | (mask >> 1);
  x = (x | (x >> 2)) & 0x1111111111111111ull;  // any of four neighbours in x
  uint64_t y = mask | (mask >> 4);
  y = (y | (y >> 8)) & 0x000f000f000f000full;
  uint64_t z = mask | (mask >> 16);
  z = (z | (z >> 32)) & 0xffffull;
  const auto f = [](uint64_t bits) { return static_cast<float>(__builtin_popcountll(bits)) / 16.0f; };
  return {f(x), f(y), f(z)};
}

}  // namespace roomlight
