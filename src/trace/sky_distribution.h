// Radiance of the sky by direction, and sampling in proportion to it.
#pragma once

#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace roomlight {

class SkyDistribution {
 public:
  explicit SkyDistribution(const Sky& sky);

  bool present() const { return present_; }
  // A constant sky is found best by BSDF sampling; only images are sampled directly.
  bool sampled() const { return !cells_.empty(); }
  Vec3 radiance(Vec3 d) const;  // cd/m² along unit world direction d; image bilinear
  Vec3 mean() const { return mean_; }  // over the sphere

  struct Sample {
    Vec3 d;
    float pdf = 0;  // per steradian
  };
  Sample sample(Vec2 u) const;
  float pdf(Vec3 d) const;

 private:
  Vec2 toUv(Vec3 d) const;
  const Sky& sky_;
  bool present_ = false;
  int width_ = 0, height_ = 0;   // of the table
  float cosRotation_ = 1, sinRotation_ = 0;
  Vec3 mean_;
  std::vector<float> cells_;     // density per cell, sums to 1
  std::vector<float> rowCdf_;    // height + 1
  std::vector<float> columnCdf_; // (width + 1) per row
};

}  // namespace roomlight
