// Sends more gathering rays to bright places that cosine sampling finds too seldom, learned from where rays of few
// pixels arrived (after Vévoda, Kondapaneni & Křivánek 2018, "Bayesian online regression for adaptive direct
// illumination sampling", and Müller, Gross & Novák 2017, "Practical path guiding"). Places, not directions, are kept:
// so what is near is found from all over a region. Guides choose directions only, so they never bias.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight {

constexpr size_t kGuideTargets = 24;

// Targets as one point sees them: cones, from each of which directions are drawn uniformly.
struct GuideCones {
  std::array<float, kGuideTargets> x, y, z, cosMost,
      density;  // unit axis, cosine of the half angle, chance per steradian
  std::array<float, kGuideTargets> upTo;  // of chances; the last is 1
  int count = 0;
  float share = 0;  // of rays that shall follow the guide; 0: none

  float pdf(Vec3 d) const;  // per steradian, of rays that follow it
  Vec3 sample(Vec2 u, float choice) const;
};

// One ray that arrived somewhere, and what it brings.
struct GuideRay {
  Vec3 from, normal;  // where it began, unit normal there
  bool arrives = false;  // at a surface,
  Vec3 to;  // there
  float weight = 0;  // of the ray beside others that began near it
  float light = 0;  // that it brings, with its weight
};

class HitGuide {
 public:
  HitGuide() = default;
  // `rays` of few pixels; what lies within one cell of clusterM is one target, and each cell of regionM has its own.
  HitGuide(std::span<const GuideRay> rays, float regionM, float clusterM);
  bool empty() const { return regions_.empty(); }
  // What a point of a surface sees of its region's targets.
  GuideCones at(Vec3 p, Vec3 n) const;

 private:
  struct Region {
    std::array<float, kGuideTargets> x, y, z, radiusM, weight;
    int count = 0;
    float share = 0;
  };
  struct Cluster {
    uint64_t key;
    Vec3 centre;
    float radiusM, light;  // that a ray brings which arrives there
  };
  struct Entry {
    uint64_t key = 0;  // 0: none
    uint32_t region = 0;
  };
  static uint64_t keyOf(Vec3 p, Vec3 n, float cellM);
  static std::vector<Cluster> clustersOf(std::span<const GuideRay> rays, float cellM);
  static Region regionOf(std::span<const GuideRay> rays, std::span<const uint32_t> own,
                         std::span<const Cluster> clusters, float clusterM, float meanOfAll);

  float regionM_ = 1;
  std::vector<Region> regions_;
  std::vector<Entry> table_;  // open addressing, a power of two
};

}  // namespace roomlight
