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
  bool sampled() const { return sky_.image.width > 0 && present_; }
  Vec3 radiance(Vec3 d) const;  // cd/m² along unit world direction d; image bilinear
  Vec3 mean() const { return mean_; }  // over the sphere

  struct Sample {
    Vec3 d;
    float pdf = 0;  // per steradian
  };
  Sample sample(Vec2 u) const;
  float pdf(Vec3 d) const;

  // The sphere in kBlocks parts of the map, for callers that know which of them are worth while. `pdf` of a sample is the
  // density inside its block: pdf(d) / blockShare(block).
  static constexpr int kBlocksX = 32, kBlocksY = 16, kBlocks = kBlocksX * kBlocksY;
  int blockOf(Vec3 d) const;
  float blockShare(int block) const { return blockShare_[static_cast<size_t>(block)]; }  // of the sky's light, weighted as in sample(); sums to 1
  Sample sampleBlock(int block, Vec2 u) const;

 private:
  Vec2 toUv(Vec3 d) const;
  void tabulateConstant();
  void tabulate(const std::vector<double>& weights, double total);
  Sample inCell(int column, int row, float dx, float dy) const;
  const Sky& sky_;
  bool present_ = false;
  int width_ = 0, height_ = 0;   // of the table
  float cosRotation_ = 1, sinRotation_ = 0;
  Vec3 mean_;
  std::vector<float> cells_;     // density per cell, sums to 1
  std::vector<float> rowCdf_;    // height + 1
  std::vector<float> columnCdf_; // (width + 1) per row
  std::vector<float> blockShare_;
};

}  // namespace roomlight
