#include "baselines/lpv_grid.h"

#include "base/parallel.h"

namespace roomlight {
namespace {

// The sphere around a cell's middle is shared out among the far walls of its six neighbours. Integrated by the midpoint
// rule over each wall; what that lacks of the whole sphere is put right in proportion.
std::array<LpvWall, kLpvWalls> makeWalls() {
  constexpr int kAcross = 64;
  std::array<LpvWall, kLpvWalls> walls{};
  size_t count = 0;
  double sphere = 0;
  for (int side = 0; side < 6; ++side) {
    for (int wall = 0; wall < 6; ++wall) {
      if (wall == (side ^ 1)) continue;
      const Vec3 middle = faceDirection(side) + faceDirection(wall) * 0.5f, n = faceDirection(wall);
      const Frame frame(n);
      double sr = 0, x = 0, y = 0, z = 0;
      for (int i = 0; i < kAcross * kAcross; ++i) {
        const Vec3 p = middle + frame.t * ((static_cast<float>(i % kAcross) + 0.5f) / kAcross - 0.5f) +
                       frame.b * ((static_cast<float>(i / kAcross) + 0.5f) / kAcross - 0.5f);
        const Vec3 d = normalize(p);
        const double part = static_cast<double>(dot(d, n) / lengthSquared(p)) / (kAcross * kAcross);
        sr += part, x += part * static_cast<double>(d.x), y += part * static_cast<double>(d.y),
            z += part * static_cast<double>(d.z);
      }
      const Vec3 sum{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
      walls[count++] = {side,
                        wall,
                        {kSh0 * static_cast<float>(sr), kSh1 * sum.x, kSh1 * sum.y, kSh1 * sum.z},
                        static_cast<float>(sr),
                        normalize(sum)};
      sphere += sr;
    }
  }
  const auto right = static_cast<float>(4 * static_cast<double>(kPi) / sphere);
  for (LpvWall& w : walls) {
    for (float& v : w.weight) v *= right;
    w.solidAngleSr *= right;
  }
  return walls;
}

// Rows of cells along x, padded: what one loop works on.
struct Row {
  size_t first, count;
};

// Four harmonics go below zero where a clamped cosine does not. That part is left out, and the rest made smaller by as
// much: by what factor, so that a cell passes on just what it holds.
void findScales(const LpvGrid& light, int channel, Row row, float* scale) {
  const float *c0 = light.plane(channel, 0) + row.first, *cx = light.plane(channel, 1) + row.first,
              *cy = light.plane(channel, 2) + row.first, *cz = light.plane(channel, 3) + row.first;
  std::array<float, 128> all{}, above{};
  for (size_t from = 0; from < row.count; from += all.size()) {
    const size_t n = std::min(all.size(), row.count - from);
    all.fill(0), above.fill(0);
    for (const LpvWall& w : lpvWalls()) {
      for (size_t i = 0; i < n; ++i) {
        const float flux = w.weight[0] * c0[from + i] + w.weight[1] * cx[from + i] + w.weight[2] * cy[from + i] +
                           w.weight[3] * cz[from + i];
        all[i] += flux;
        above[i] += flux > 0 ? flux : 0;
      }
    }
    for (size_t i = 0; i < n; ++i) scale[row.first + from + i] = all[i] > 0 ? all[i] / above[i] : 0;
  }
}

// From the neighbours on all sides into a row.
void collect(const LpvGrid& light, const LpvGeometry& geometry, const std::vector<float>& scales, int channel, Row row,
             LpvGrid& out) {
  const Int3 n = light.lattice().padded();
  const std::array<std::ptrdiff_t, 3> stride{1, n.x, static_cast<std::ptrdiff_t>(n.x) * n.y};
  float* o0 = out.plane(channel, 0) + row.first;
  for (const LpvWall& w : lpvWalls()) {
    const auto first = static_cast<size_t>(static_cast<std::ptrdiff_t>(row.first) -
                                           (w.side & 1 ? -1 : 1) * stride[static_cast<size_t>(w.side / 2)]);
    const float *c0 = light.plane(channel, 0) + first, *cx = light.plane(channel, 1) + first,
                *cy = light.plane(channel, 2) + first, *cz = light.plane(channel, 3) + first;
    const float *scale = &scales[first], *passes = geometry.passes(static_cast<int>(&w - lpvWalls().data()));
    float* o1 = out.plane(channel, 1 + w.wall / 2) + row.first;
    const float lobe0 = kCosine0 / kPi, lobe1 = (w.wall & 1 ? -kCosine1 : kCosine1) / kPi;
    const float a0 = w.weight[0], ax = w.weight[1], ay = w.weight[2], az = w.weight[3];
    const auto pass = [&](auto share) {
#pragma GCC ivdep
      for (size_t i = 0; i < row.count; ++i) {
        const float flux = a0 * c0[i] + ax * cx[i] + ay * cy[i] + az * cz[i],
                    passed = (flux > 0 ? flux : 0) * scale[i] * share(i);
        o0[i] += lobe0 * passed;
        o1[i] += lobe1 * passed;
      }
    };
    if (passes) {
      pass([&](size_t i) { return passes[first + i]; });
    } else {
      pass([](size_t) { return 1.0f; });
    }
  }
}

// What is stopped on its way out of a cell goes back into it, about the normal of what stopped it.
void sendBack(const LpvGrid& light, const LpvGeometry& geometry, const std::array<std::vector<float>, 3>& scales, int z,
              LpvGrid& out) {
  for (const LpvGeometry::Mirror& m : geometry.mirrors(z)) {
    Vec3 flux;
    for (int k = 5 * m.side; k < 5 * m.side + 5; ++k) {
      const LpvWall& w = lpvWalls()[static_cast<size_t>(k)];
      const float stopped = 1 - geometry.passes(k)[m.cell];
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int i = 0; i < 4; ++i) sum += w.weight[static_cast<size_t>(i)] * light.plane(c, i)[m.cell];
        flux[c] += std::max(0.0f, sum) * scales[static_cast<size_t>(c)][m.cell] * stopped;
      }
    }
    out.addLobe(m.cell, m.normal, flux * m.albedo);
  }
}

LpvGrid step(const LpvGrid& light, const LpvGeometry& geometry, bool reflect) {
  const Int3 n = light.lattice().padded();
  LpvGrid out(light.lattice());
  std::array<std::vector<float>, 3> scales;
  const auto layers = static_cast<size_t>(n.z), layer = static_cast<size_t>(n.x) * static_cast<size_t>(n.y);
  for (std::vector<float>& s : scales) s.resize(light.lattice().paddedCount());
  parallelFor(3 * layers, 1, [&](size_t i) {
    findScales(light, static_cast<int>(i / layers), {i % layers * layer, layer}, scales[i / layers].data());
  });
  parallelFor(3 * (layers - 2), 1, [&](size_t i) {
    const size_t channel = i / (layers - 2), z = i % (layers - 2) + 1;
    for (int y = 1; y < n.y - 1; ++y) {
      collect(light, geometry, scales[channel], static_cast<int>(channel),
              {light.lattice().index({1, y, static_cast<int>(z)}), static_cast<size_t>(n.x - 2)}, out);
    }
  });
  if (reflect) parallelFor(layers, 1, [&](size_t z) { sendBack(light, geometry, scales, static_cast<int>(z), out); });
  return out;
}

}  // namespace

const std::array<LpvWall, kLpvWalls>& lpvWalls() {
  static const std::array<LpvWall, kLpvWalls> walls = makeWalls();
  return walls;
}

void LpvGrid::addLobe(size_t cell, Vec3 n, Vec3 fluxLm) {
  for (int c = 0; c < 3; ++c) {
    const float cd = fluxLm[c] / kPi;
    plane(c, 0)[cell] += kCosine0 * cd;
    for (int k = 0; k < 3; ++k) plane(c, 1 + k)[cell] += kCosine1 * n[k] * cd;
  }
}

void LpvGrid::set(size_t cell, const LpvIntensity& intensity) {
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 4; ++k) plane(c, k)[cell] = intensity[static_cast<size_t>(c)][static_cast<size_t>(k)];
  }
}

LpvIntensity LpvGrid::get(size_t cell) const {
  LpvIntensity out{};
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 4; ++k) out[static_cast<size_t>(c)][static_cast<size_t>(k)] = plane(c, k)[cell];
  }
  return out;
}

void LpvGrid::add(const LpvGrid& other) {
  parallelRanges(values_.size(), 65536, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) values_[i] += other.values_[i];
  });
}

Vec3 LpvGrid::fluxLm() const {
  const Int3 n = lattice_.cells;
  std::array<double, 3> sum{};
  for (int z = 1; z <= n.z; ++z) {
    for (int y = 1; y <= n.y; ++y) {
      for (int x = 1; x <= n.x; ++x) {
        for (int c = 0; c < 3; ++c)
          sum[static_cast<size_t>(c)] += static_cast<double>(plane(c, 0)[lattice_.index({x, y, z})]);
      }
    }
  }
  const double whole = 4 * static_cast<double>(kPi * kSh0);
  return {static_cast<float>(sum[0] * whole), static_cast<float>(sum[1] * whole), static_cast<float>(sum[2] * whole)};
}

LpvGrid propagate(const LpvGrid& light, const LpvGeometry& geometry, int steps, bool reflect) {
  LpvGrid sum = light, now = light;
  for (int i = 0; i < steps; ++i) {
    now = step(now, geometry, reflect);
    sum.add(now);
  }
  return sum;
}

}  // namespace roomlight
