#include "baselines/vxgi_clipmap.h"

#include <algorithm>

#include "base/simd.h"
#include "base/parallel.h"

namespace roomlight {

VxgiClipmap::VxgiClipmap(Vec3 centre, float voxelSizeM, int resolution, int levels) : n_(resolution) {
  const size_t perLevel = size_t{4} * 6 * static_cast<size_t>(n_) * static_cast<size_t>(n_) * static_cast<size_t>(n_);
  texels_.resize(perLevel * static_cast<size_t>(levels));
  empty_.resize(texels_.size() / 24);
  for (int l = 0; l < levels; ++l) {
    Level level;
    level.voxelSizeM = voxelSizeM * static_cast<float>(1 << l);
    const auto snapped = [&](float c) {
      return 2 * static_cast<int>(std::floor(0.5f * (c / level.voxelSizeM - 0.5f * static_cast<float>(n_)) + 0.5f));
    };
    level.corner = {snapped(centre.x), snapped(centre.y), snapped(centre.z)};
    level.firstCentre = Vec3{static_cast<float>(level.corner.x) + 0.5f, static_cast<float>(level.corner.y) + 0.5f,
                             static_cast<float>(level.corner.z) + 0.5f} *
                        level.voxelSizeM;
    level.perM = 1 / level.voxelSizeM;
    level.first = perLevel * static_cast<size_t>(l);
    levels_.push_back(level);
  }
}

bool VxgiClipmap::contains(Int3 v) const {
  const auto n = static_cast<unsigned>(n_);
  return static_cast<unsigned>(v.x) < n && static_cast<unsigned>(v.y) < n && static_cast<unsigned>(v.z) < n;
}

bool VxgiClipmap::isMadeOfFiner(int level, Int3 v) const {
  if (level == 0) return false;
  const Int3 own = corner(level), finer = corner(level - 1);
  return contains({2 * (own.x + v.x) - finer.x, 2 * (own.y + v.y) - finer.y, 2 * (own.z + v.z) - finer.z});
}

void VxgiClipmap::put(int level, Int3 v, int face, Float4 value) {
  toHalf4(value, &texels_[texel(levels_[static_cast<size_t>(level)], face, v)]);
}

void VxgiClipmap::set(int level, Int3 v, int face, Vec3 radiance, float opacity) {
  const Vec3 shown = radiance * (opacity / unit_);
  put(level, v, face, Float4(shown.x, shown.y, shown.z, opacity));
}

Float4 VxgiClipmap::get(int level, Int3 v, int face) const {
  return fromHalf4(&texels_[texel(levels_[static_cast<size_t>(level)], face, v)]);
}

// Of the eight voxels of the finer level from v on.
Float4 VxgiClipmap::composed(int finer, Int3 v, int face) const {
  const int axis = face / 2, front = face % 2 == 0 ? 1 : 0;
  Float4 sum;
  for (int column = 0; column < 4; ++column) {
    const int a = column & 1, b = column >> 1;
    const auto at = [&](int along) {
      const Int3 offset = axis == 0 ? Int3{along, a, b} : axis == 1 ? Int3{a, along, b} : Int3{a, b, along};
      return get(finer, {v.x + offset.x, v.y + offset.y, v.z + offset.z}, face);
    };
    const Float4 over = at(front);
    const Float4 left = Float4(1.0f) - over.everyW();
    sum = sum + fma(left, at(1 - front), over);
  }
  return sum * Float4(0.25f);
}

void VxgiClipmap::clear() {
  const size_t part = 1 << 20;
  parallelFor((texels_.size() + part - 1) / part, 1, [&](size_t i) {
    std::fill(texels_.begin() + static_cast<std::ptrdiff_t>(i * part),
              texels_.begin() + static_cast<std::ptrdiff_t>(std::min(texels_.size(), (i + 1) * part)), uint16_t{0});
  });
}

void VxgiClipmap::buildCoarser() {
  const auto rows = static_cast<size_t>(n_);
  for (int level = 1; level < levels(); ++level) {
    const Int3 own = corner(level), finer = corner(level - 1);
    parallelFor(6 * rows, 4, [&](size_t i) {
      const int face = static_cast<int>(i / rows), z = static_cast<int>(i % rows);
      for (int y = 0; y < n_; ++y) {
        for (int x = 0; x < n_; ++x) {
          if (!isMadeOfFiner(level, {x, y, z})) continue;
          put(level, {x, y, z}, face,
              composed(level - 1, {2 * (own.x + x) - finer.x, 2 * (own.y + y) - finer.y, 2 * (own.z + z) - finer.z},
                       face));
        }
      }
    });
  }
}

void VxgiClipmap::findEmpty() {
  const auto rows = static_cast<size_t>(n_);
  parallelFor(static_cast<size_t>(levels()) * rows, 4, [&](size_t i) {
    const int level = static_cast<int>(i / rows), z = static_cast<int>(i % rows);
    for (int y = 0; y < n_; ++y) {
      for (int x = 0; x < n_; ++x) {
        bool empty = true;
        for (int k = 0; k < 8 && empty; ++k) {
          const Int3 v{std::min(x + (k & 1), n_ - 1), std::min(y + (k >> 1 & 1), n_ - 1),
                       std::min(z + (k >> 2), n_ - 1)};
          for (int face = 0; face < 6; ++face)
            empty = empty && texels_[texel(levels_[static_cast<size_t>(level)], face, v) + 3] == 0;
        }
        empty_[place(static_cast<size_t>(level), {x, y, z})] = empty;
      }
    }
  });
}

int VxgiClipmap::levelAt(Vec3 p, int near) const {
  int level = near;
  while (level < levels() && !reaches(levels_[static_cast<size_t>(level)], p)) ++level;
  return level == near && level > 0 && reaches(levels_[static_cast<size_t>(level - 1)], p) ? level - 1 : level;
}

Float4 VxgiClipmap::sample(int level, Vec3 p, Vec3 d) const {
  const Level& l = levels_[static_cast<size_t>(level)];
  const Vec3 q = (p - l.firstCentre) * l.perM;
  const Int3 v{static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z)};
  if (empty_[place(static_cast<size_t>(level), v)]) return {};
  const float fx = q.x - static_cast<float>(v.x), fy = q.y - static_cast<float>(v.y),
              fz = q.z - static_cast<float>(v.z);
  const auto n = static_cast<size_t>(n_);
  const size_t alongY = 4 * n, alongZ = 4 * n * n;
  // Two voxels, neighbours in x, a load.
  Float8 sum;
  for (int axis = 0; axis < 3; ++axis) {
    const float weight = std::abs(d[axis]);
    const uint16_t* at = &texels_[texel(l, 2 * axis + (d[axis] > 0 ? 1 : 0), v)];
    const auto add = [&](size_t offset, float w) { sum = fma(fromHalf8(at + offset), Float8(w * weight), sum); };
    add(0, (1 - fy) * (1 - fz));
    add(alongY, fy * (1 - fz));
    add(alongZ, (1 - fy) * fz);
    add(alongY + alongZ, fy * fz);
  }
  const Float4 seen = fma(Float4(fx), sum.high() - sum.low(), sum.low());
  return seen / max(seen.everyW(), Float4(1.0f));
}

}  // namespace roomlight
