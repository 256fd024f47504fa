// Where photons are of use: paths from where light is asked for (importons, Peter & Pietrek 1998) mark the places they
// come by and how these see suns and sky.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "base/random.h"
#include "base/sampler.h"
#include "base/vec.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight {

// The ray on which light number `index` of those asked for would arrive, turned round.
using ImportonStart = std::function<Ray(uint32_t index, Sampler& sampler)>;

// A place that a path came by, and a direction it was tried in, by the cosine.
struct SkyProbe {
  Vec3 p, n, d;
  float open;  // 0..1: how much light comes through
};
struct SunProbe {
  Vec3 p, n, d;
  float open;
};

class PhotonImportance {
 public:
  PhotonImportance(const RayScene& rays, const Lights& lights, const ImportonStart& start, int count, uint64_t seed);

  // How many paths came by, per place of about a metre; next to such places a little; 0: photons there would be seen by
  // nobody.
  float at(Vec3 p) const;
  const std::vector<SkyProbe>& skyProbes() const { return sky_; }
  const std::vector<SunProbe>& sunProbes(size_t sun) const { return suns_[sun]; }
  uint64_t rays() const { return rays_; }

 private:
  struct Part;
  void follow(const RayScene& rays, const Lights& lights, Ray ray, Sampler& sampler, Part& out) const;
  void mark(const std::vector<Vec3>& places);

  std::unordered_map<uint64_t, float> cells_;
  std::vector<SkyProbe> sky_;
  std::vector<std::vector<SunProbe>> suns_;
  uint64_t rays_ = 0;
};

// Space in cells of a metre, each told by a number.
struct PhotonCell {
  int64_t x, y, z;

  static PhotonCell of(Vec3 p) {
    const auto whole = [](float v) { return static_cast<int64_t>(std::floor(v)); };
    return {whole(p.x), whole(p.y), whole(p.z)};
  }
  // Number k of 27: itself (13) and those around it.
  PhotonCell around(int k) const { return {x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1}; }
  uint64_t key() const {
    const auto part = [](int64_t v) { return static_cast<uint64_t>(v + (1 << 20)) & 0x1fffffu; };
    return part(x) | part(y) << 21 | part(z) << 42;
  }
  // Of what looks the way of `face` there.
  uint64_t key(int face) const { return mix64(key() * 8 + static_cast<uint64_t>(face)); }
};

}  // namespace roomlight
