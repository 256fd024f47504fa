// The camera rays of one pixel together. Rays that see the same surface share its shading: edges, textures and sharp shadows are
// as smooth as the pixel's many cheap rays make them, while the rest of its light comes from few samples. Panes and mirrors send
// the rays on: what is seen in a mirror is shaded, and filtered, like what is seen directly.
#pragma once

#include <span>

#include "gather/cone_shader.h"
#include "gather/filter.h"

namespace roomlight {

constexpr size_t kRaysAtOnce = SharpLights::kMostPoints;

// Random numbers of one pixel, a set for each shading and each group of shadows.
struct PixelSequence {
  uint64_t pixel = 0, seed = 0;
  uint32_t shadings = 0, shadows = 0;  // used
  Sampler forShading() { return {pixel, shadings++, seed}; }
  Sampler forShadows() { return {pixel, shadows++, mix64(seed + 1)}; }
};

// Sums over camera rays; variances are of the sums.
struct PixelSum {
  FilterPixel sum;
  float occlusion = 0;
  uint32_t rays = 0, shadings = 0, shadows = 0;
  FilterPixel mean() const;
};

class PixelShader {
 public:
  PixelShader(const RayScene& rays, const ConeShader& shader, const GatherSettings& settings) : rays_(rays), shader_(shader), settings_(settings) {}
  // At most kRaysAtOnce rays.
  void add(std::span<const Ray> rays, PixelSequence& sequence, PixelSum& pixel, ConeCounters& count) const;

 private:
  struct Layer;
  struct Group;
  Group* groupOf(const Ray& ray, const Hit& hit, std::span<Group> groups, size_t& used) const;
  MaterialSample meanMaterial(const Group& group, const Layer& layer, bool uniform) const;
  void shadows(const Group& group, const Layer& layer, PixelSequence& sequence, std::vector<Shadow>& out, ConeCounters& count) const;
  void shade(const Group& group, const Layer& layer, size_t rays, PixelSequence& sequence, PixelSum& pixel, Layer& behind, ConeCounters& count) const;
  static void addShading(const SurfaceLight& light, Vec3 left, float weight, PixelSum& pixel);
  static void addVariance(std::span<const SurfaceLight> light, Vec3 left, float weight, FilterPixel& sum);
  static void passOn(const Group& group, const Layer& layer, Vec3 through, bool solid, Layer& behind);
  void reflectOn(const Group& group, const Layer& layer, const MaterialSample& m, PixelSequence& sequence, Layer& behind) const;

  const RayScene& rays_;
  const ConeShader& shader_;
  const GatherSettings& settings_;
};

}  // namespace roomlight
