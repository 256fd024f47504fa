// The camera rays of one pixel together. Rays that see the same surface share its shading: edges, textures and sharp shadows are
// as smooth as the pixel's many cheap rays make them, while the rest of its light comes from few samples. Panes and mirrors send
// the rays on: what is seen in a mirror is shaded, and filtered, like what is seen directly.
#pragma once

#include <span>

#include "gather/filter.h"
#include "gather/shading.h"
#include "scene/surface.h"

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

// What the pixels of a tile have seen and want lit.
struct TileWork {
  struct Part {  // one surface in one pixel
    PixelSum* pixel;
    uint32_t first, count;  // shadings
    Vec3 left;              // share of their light that reaches the eye
    float weight;           // camera rays that each stands for
  };
  std::vector<Shading> shadings;
  std::vector<Shadow> shadows;
  std::vector<Part> parts;
  void clear() { shadings.clear(), shadows.clear(), parts.clear(); }
};

class PixelShader {
 public:
  PixelShader(const RayScene& rays, const Lights& lights, int raysPerShading) : rays_(rays), lights_(lights), sharp_(rays, lights), raysPerShading_(raysPerShading) {}
  // At most kRaysAtOnce rays. What shines by itself is added to `pixel` at once; what has to be lit, to `work`.
  void see(std::span<const Ray> rays, PixelSequence& sequence, PixelSum& pixel, TileWork& work, GatherCounters& count) const;
  // Adds the light of everything in `work` to its pixels.
  static void add(const TileWork& work, std::span<const SurfaceLight> light);

 private:
  struct Layer;
  struct Group;
  Group* groupOf(const Ray& ray, const Hit& hit, std::span<Group> groups, size_t& used) const;
  MaterialSample meanMaterial(const Group& group, const Layer& layer, bool uniform) const;
  uint32_t shadows(const Group& group, const Layer& layer, PixelSequence& sequence, std::vector<Shadow>& out, GatherCounters& count) const;
  void see(const Group& group, const Layer& layer, size_t rays, PixelSequence& sequence, PixelSum& pixel, TileWork& work, Layer& behind, GatherCounters& count) const;
  static void addVariance(std::span<const SurfaceLight> light, Vec3 left, float weight, FilterPixel& sum);
  static void passOn(const Group& group, const Layer& layer, Vec3 through, bool solid, Layer& behind);
  void reflectOn(const Group& group, const Layer& layer, const MaterialSample& m, PixelSequence& sequence, Layer& behind) const;

  const RayScene& rays_;
  const Lights& lights_;
  const SharpLights sharp_;
  const int raysPerShading_;
};

}  // namespace roomlight
