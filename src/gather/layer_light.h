// Light kept apart by layers while a picture is gathered: beside every sum of light, what lamps, suns and sky have in
// it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/simd.h"
#include "base/vec.h"
#include "gather/hit_cache.h"
#include "radiance/slot_light.h"

namespace roomlight {

// Of what a sample of light comes from: a layer, the shares of a slot or a cell, or nothing that is known.
struct LightOrigin {
  int32_t layer = -1;
  const uint16_t* shares = nullptr;  // as SlotLayers has them
  float weight = 1;   // of the light in its layer, where layers sample it otherwise than the picture
  float glow = 0,
        sun = 0;  // of the light that has these shares, what points have taken of it: of layer `glowOf`, and of the sun
  int32_t glowOf = -1;
  static LightOrigin ofLayer(int32_t layer, float weight = 1) { return {layer, nullptr, weight, 0, 0, -1}; }
};

// Sums for many things, each with kParts kinds of light (and variances), each of three channels of `stride` layers.
class LayerSums {
 public:
  enum Part : size_t {
    kDiffuse,  // rare light, too
    kSharp,
    kSpecular,
    kRest,
    kVariance,  // of the luminance of diffuse, sharp and specular light
    kParts
  };
  LayerSums() = default;
  // `together`: of all things one sum, as the first.
  explicit LayerSums(size_t layers, bool together = false) : stride_(layerStride(layers)), together_(together) {}

  void resize(size_t things) { values_.assign((together_ ? std::min<size_t>(1, things) : things) * size(), 0); }
  size_t stride() const { return stride_; }
  size_t bytes() const { return values_.size() * sizeof(float); }
  float* at(size_t thing, Part part) { return values_.data() + begin(thing, part); }
  const float* at(size_t thing, Part part) const { return values_.data() + begin(thing, part); }
  Vec3 get(size_t thing, Part part, size_t layer) const {
    const float* v = at(thing, part) + layer;
    return {v[0], v[stride_], v[2 * stride_]};
  }
  void add(size_t thing, Part part, int32_t layer, Vec3 light) {
    if (layer < 0) return;
    float* v = at(thing, part) + layer;
    v[0] += light.x, v[stride_] += light.y, v[2 * stride_] += light.z;
  }
  void addShares(size_t thing, Part part, const uint16_t* shares, Vec3 light) {
    float* v = at(thing, part);
    for (int c = 0; c < 3; ++c, v += stride_, shares += stride_) {
      const Float4 l(light[c]);
      for (size_t i = 0; i < stride_; i += 4) fma(fromHalf4(shares + i), l, Float4::load(v + i)).store(v + i);
    }
  }
  // Adds `factor` times what another has of a thing, of a part of it.
  void addFrom(size_t thing, Part part, Part otherPart, const LayerSums& other, size_t otherThing, Vec3 factor) {
    float* v = at(thing, part);
    const float* o = other.at(otherThing, otherPart);
    for (int c = 0; c < 3; ++c, v += stride_, o += stride_) {
      const Float4 f(factor[c]);
      for (size_t i = 0; i < stride_; i += 4) fma(Float4::load(o + i), f, Float4::load(v + i)).store(v + i);
    }
  }

 private:
  size_t size() const { return kParts * 3 * stride_; }
  size_t begin(size_t thing, Part part) const { return (together_ ? 0 : thing * size()) + part * 3 * stride_; }
  size_t stride_ = 0;
  bool together_ = false;
  std::vector<float> values_;
};

// Whose the light of places is where gathering rays arrive, for cells of light in layers. The soft light of each layer
// is told by neighbours, as that of all together is.
class HitLayers {
 public:
  HitLayers(size_t layers, size_t samples)
      : layers_(layers), stride_(layerStride(layers)), samples_(samples), light_(2 * layers * samples) {}
  // Light of sample `number`, thing `thing` of the sums. May be called by many threads, for different samples.
  void take(uint32_t number, const LayerSums& sums, size_t thing);
  // Smoothes each layer's light of the samples (smoothLight), which are as they were found. Those of one layer
  // count as many rays as the samples do.
  void smooth(const RayScene& rays, const HitCache& cells, std::span<const LitHit> samples);
  // Appends the shares of what these samples send out together, half floats: three channels, each a stride of layers.
  void addShares(std::span<const LitHit> samples, std::span<const uint32_t> members, std::vector<uint16_t>& out) const;

 private:
  Vec3& soft(size_t layer, size_t number) { return light_[layer * samples_ + number]; }
  Vec3& sharp(size_t layer, size_t number) { return light_[(layers_ + layer) * samples_ + number]; }
  Vec3 all(size_t layer, size_t number) const {
    return light_[layer * samples_ + number] + light_[(layers_ + layer) * samples_ + number];
  }

  size_t layers_, stride_, samples_;
  std::vector<Vec3> light_;  // soft of each layer, then sharp
};

}  // namespace roomlight
