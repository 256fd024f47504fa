// What a piece of surface reflects, emits and blocks on average.
#pragma once

#include "scene/surface.h"
#include "voxel/brick_builder.h"
#include "voxel/clip.h"

namespace roomlight {

struct Shade {
  Vec3 albedo, emission;  // mean over the opaque part; emission in cd/m², so that emission * coverage is what leaves
  float coverage = 1;  // opaque fraction
};

// Shades the pieces of one triangle. A piece is sampled at points spread evenly over it, as many as its texels ask for.
class TriangleShader {
 public:
  TriangleShader(const Scene& scene, const Mesh& mesh, uint32_t triangle, const LatticeTriangle& lattice);
  Shade operator()(const Polygon& piece) const;

 private:
  Shade at(Vec3 p) const;

  const Scene& scene_;
  const Mesh& mesh_;
  const LatticeTriangle& lattice_;
  uint32_t triangle_;
  float texelsPerArea_ = 0;  // of the finest texture, per voxel²
  bool uniform_ = false;
  Shade shade_;  // where uniform
};

}  // namespace roomlight
