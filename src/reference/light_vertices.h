// Where light of lamps and small emissive meshes goes first: the vertices of paths that start in them, for paths from
// the camera to connect to (Keller 1997; vertices pooled as by Davidovič et al. 2014). A lamp inside its shade lights a
// spot of a few centimetres that rays from the room find by chance; paths from the lamp always do.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/bsdf.h"
#include "trace/light_rays.h"
#include "trace/ray_scene.h"

namespace roomlight {

// Complete in itself: a connection reads nothing of the mesh. The first half, one cache line, is what choosing needs.
struct alignas(64) LightVertex {
  Vec3 p, ng, ns;  // unit normals on the side the light came from, ns not bent
  Vec3 wi;  // unit, towards where the light came from
  float diffuseLm = 0, glossyLm = 0;  // of flux times albedo, by lobe: what is worth connecting to
  float alpha = 1;  // of the glossy lobe
  float densityM2 = 0;  // LightRays::densityM2() here
  Vec3 flux;  // lm that arrive here and stand for this path's share of all paths
  Vec3 base, f0, f90;  // as in MaterialSample; of the base, what is neither metal nor glass
  float roughness = 1;
  int32_t lamp = -1, emitter = -1;  // whose light it is

  Bsdf bsdf(Vec3 wo) const;  // wo: unit, on the side of ng

  // About the intensity towards wo, cd; for choosing among vertices. Never zero where light goes.
  float estimateCd(Vec3 wo) const {
    const float cosO = std::max(dot(wo, ng), 0.0f);
    float cd = diffuseLm * cosO / kPi;
    if (glossyLm > 0) {
      const Vec3 h = wo + wi;
      const float cosH = dot(h, ns), l2 = lengthSquared(h), a2 = alpha * alpha, k = (l2 + cosH * cosH * (a2 - 1)) / l2;
      cd += glossyLm * a2 / (4 * kPi * std::max(dot(wi, ng), cosO) * k * k);
    }
    return cd;
  }
};

class LightVertices {
 public:
  LightVertices(const RayScene& rays, const Lights& lights) : rays_(rays), lightRays_(lights) {}

  // Traces `paths` of them anew; the same for any number of threads.
  void trace(int paths, uint32_t pass, uint64_t seed);

  const LightRays& lightRays() const { return lightRays_; }
  const std::vector<LightVertex>& all() const { return all_; }
  double perPath() const { return perPath_; }  // vertices, in the last pass
  uint64_t rayCount() const { return rayCount_; }  // traced so far

  // Can light that z scatters be had by connecting to z? Not where a lobe is so narrow that connections miss it.
  static bool connects(const Bsdf& z) { return z.alpha() >= 0.05f; }
  // Of so many vertices one is connected to, chosen by what it could give without shadows.
  static constexpr int kCandidates = 4;
  // Light from z to x is shared between the path that scattered at x and found z, and connections from x: this is the
  // connections' part, by the densities per area of z with which either finds it: candidates lie kCandidates times as
  // densely as one path of light does. Any function of x and z would do.
  static float share(float pdfAtX, float cosZ, float inverseDistance2, float densityM2) {
    const float byPath = pdfAtX * cosZ * inverseDistance2;
    const float byLight = kCandidates * densityM2, l = byLight * byLight, c = byPath * byPath;
    return l > 0 ? l / (l + c) : 0;
  }

 private:
  void follow(uint64_t path, float share, uint32_t pass, uint64_t seed, std::vector<LightVertex>& out,
              uint64_t& rayCount) const;

  const RayScene& rays_;
  const LightRays lightRays_;
  std::vector<LightVertex> all_;
  uint64_t rayCount_ = 0;
  double perPath_ = 0;
};

}  // namespace roomlight
