// Rays that leave lamps and small emissive meshes, and how densely they land: for paths that start at lights.
#pragma once

#include <vector>

#include "base/sampler.h"
#include "trace/lights.h"

namespace roomlight {

class LightRays {
 public:
  // Refers to the lights. Lamps start rays, and emissive meshes that shine from at most kWidestM2 (both sides, where
  // both shine). A surface is never lit more than the mesh's own exitance: what shines from a wide area makes no small
  // bright spots, which other paths would find by chance only, and would take rays from bulbs in shades.
  explicit LightRays(const Lights& lights);
  static constexpr float kWidestM2 = 0.5f;

  bool any() const { return shareOfLamps_ > 0 || !emitters_.empty(); }
  // Does nothing else shine?
  bool hasAllLight() const { return all_; }
  bool leaveEmitter(int32_t emitter) const { return emitter >= 0 && leaves_[static_cast<size_t>(emitter)]; }
  bool leave(const LightSample& light) const { return light.lamp >= 0 || leaveEmitter(light.emitter); }

  // In proportion to flux.
  LightRay sample(Sampler& sampler) const;
  // About how many such rays land on a m² of a surface element at p with normal n, of all rays, if nothing stands
  // between.
  float densityM2(Vec3 p, Vec3 n) const;

 private:
  // Part of a mesh, about as large in all directions: seen as a ball of light, or a flat piece, or something between
  // them.
  struct Piece {
    Vec3 centre;
    float radius;  // m, of the sphere around it
    Vec3 facing;  // sum of area times normal over area: unit for a flat piece, 0 for a closed one or one that shines to
                  // both sides
    float flatness;  // its length
    float raysPerSr;  // of all rays, mean over all directions
    float mostPerM2;  // on what touches it
  };
  void addPieces(size_t emitter, float share);
  float densityM2(const Piece& piece, Vec3 p, Vec3 n) const;

  const Lights& lights_;
  float shareOfLamps_ = 0;  // of all rays
  std::vector<size_t> emitters_;  // those that start rays
  std::vector<float> cdf_;  // upper ends of their shares among emitters
  std::vector<bool> leaves_;  // of every emitter
  std::vector<Piece> pieces_;
  bool all_ = false;
};

}  // namespace roomlight
