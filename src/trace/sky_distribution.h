// Radiance of the sky by direction, and sampling in proportion to it.
#pragma once

#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace roomlight {

class SkyDistribution {
 public:
  // `spotApart`: whether a small and bright part of an image, as a sun is, is no part of all else here but stands in
// spot...().
  explicit SkyDistribution(const Sky& sky, bool spotApart = false);

  bool present() const { return present_; }
  // A constant sky is found best by BSDF sampling; only images are sampled directly.
  bool sampled() const { return sky_.image.width > 0 && present_; }
  Vec3 radiance(Vec3 d) const { return radianceAt(toUv(d)); }  // cd/m² along unit world direction d; image bilinear
  Vec3 radianceAt(Vec2 uv) const;  // for a place in the map: (0, 0) is its upper left corner
  // Has what radianceAt() reads fetched into the processor's cache.
  void prefetch(Vec2 uv) const;
  Vec3 mean() const { return mean_; }  // over the sphere

  struct Sample {
    Vec3 d;
    float pdf = 0;  // per steradian
    Vec2 uv{};      // of d, in the map
  };
  Sample sample(Vec2 u) const;
  float pdf(Vec3 d) const { return pdfAt(toUv(d)); }
  float pdfAt(Vec2 uv) const;
  Vec2 toUv(Vec3 d) const;

  // The spot that stands apart, of even light within each cell of the table. Its samples all give the same luminance
  // over density, except for what cells differ in colour.
  bool hasSpot() const { return !spot_.empty(); }
  Sample sampleSpot(Vec2 u) const;
  Bounds3 spotDirections() const;  // a box that holds all unit directions of it
  Vec3 spotRadiance(Vec3 d, float& pdf) const;  // cd/m² and density of sampleSpot() there; 0 outside

  // The sphere in kBlocks parts of the map, for callers that know which of them are worth while. `pdf` of a sample is
  // that of sample(): blockShare(block) times the density inside its block.
  static constexpr int kBlocksX = 32, kBlocksY = 16, kBlocks = kBlocksX * kBlocksY;
  int blockOf(Vec3 d) const { return blockAt(toUv(d)); }
  int blockAt(Vec2 uv) const;
  float blockShare(int block) const {
    return blockShare_[static_cast<size_t>(block)];
  }  // of the sky's light, weighted as in sample(); sums to 1
  Sample sampleBlock(int block, Vec2 u) const;

 private:
  struct SpotCell {
    int64_t cell;
    Vec3 radiance;
    float share, upTo;  // of the spot's luminous flux, and the sum of shares up to this one
  };
  void tabulateConstant();
  double takeSpot(std::vector<double>& weights);
  Vec3 cellMean(int column, int row) const;
  int64_t cellAt(Vec2 uv) const;
  const SpotCell* spotAt(Vec2 uv) const;
  float spotPdf(const SpotCell& c) const;
  float solidAngleAt(float sinTheta) const;
  void tabulate(const std::vector<double>& weights, double total);
  Vec3 directionIn(int column, int row, float dx, float dy) const;
  Sample inCell(int column, int row, float dx, float dy) const;
  const Sky& sky_;
  bool present_ = false;
  int width_ = 0, height_ = 0;  // of the table
  float cosRotation_ = 1, sinRotation_ = 0;
  Vec3 mean_;
  std::vector<float> cells_;  // density per cell, sums to 1
  std::vector<float> rowCdf_;  // height + 1
  std::vector<float> columnCdf_;  // (width + 1) per row
  std::vector<float> blockShare_;
  std::vector<float> blockRows_;  // per block: up to the end of each of its rows of cells, the last 1
  std::vector<SpotCell> spot_;
};

}  // namespace roomlight
