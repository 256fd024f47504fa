// What surfaces close to point and spot lamps reflect: the inside of a shade, the ceiling over a pendant. From afar
// such a spot is small and very bright, so few cones find it. It is kept as points, each an exact place on a surface,
// that light is sampled from with shadow rays; cones and points share it by multiple importance sampling (Veach 1997,
// power heuristic).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/sampler.h"
#include "trace/lights.h"

namespace roomlight {

struct GlowPoint {
  Vec3 p, n;           // clear of a surface, as rays start there; its normal on the lit side
  Vec3 fluxLm;         // reflected, Lambertian; all points have the same luminous flux
  int64_t slot;        // that stands for the surface, -1: none, and
  float radianceCdM2;  // the luminance that it shows cones
  bool onMetal = false;  // polished
  int32_t lamp = -1, emitter = -1;  // whose light it reflects, one of the two (see Lights)
};

// A cone that may find what a point stands for.
struct GlowCone {
  float pdf;      // per steradian, of all cones that look for it
  float tanHalf;  // of half its angle
};

struct GlowSample {
  LightSample light;
  size_t point;
};

class LampGlow {
 public:
  LampGlow() = default;
  LampGlow(std::vector<GlowPoint> points, float voxelSizeM);

  bool empty() const { return points_.empty(); }
  std::span<const GlowPoint> points() const { return points_; }
  const GlowPoint& point(size_t index) const { return points_[index]; }

  // One point, chosen by what it could give without shadows to a surface at p with normal n, of what diffuse cones
// leave to points.
  GlowSample sample(Vec3 p, Vec3 n, float diffuseCones, float tanHalf, Sampler& sampler) const;
  // The part that points take of the light that goes from one of them to p. The rest is for the cones.
  float pointShare(size_t point, Vec3 p, const GlowCone& cone) const;
  // The part that a cone takes of luminance that it meets at a distance (m) under a cosine, on voxels of the base
// level.
  float coneShare(float radianceCdM2, float distance, float cosLight, float conePdf) const {
    const float points = perRadiance_ * radianceCdM2 * distance * distance, cones = cosLight * conePdf;
    return cones > 0 ? cones * cones / (cones * cones + points * points) : 0;
  }
  size_t bytes() const { return points_.size() * sizeof(GlowPoint); }
  // All that `glow` holds, for who keeps it in files.
  static void visit(auto& glow, auto&& member) {
    member(glow.points_), member(glow.voxelSizeM_), member(glow.perRadiance_);
  }

 private:
  float shareAt(const GlowPoint& g, float distance, float cosLight, const GlowCone& cone) const;

  std::vector<GlowPoint> points_;
  float voxelSizeM_ = 0, perRadiance_ = 0;
};

}  // namespace roomlight
