// The camera rays of one pixel together. Rays that see the same surface share its shading: edges, textures and sharp
// shadows are as smooth as the pixel's many cheap rays make them, while the rest of its light comes from few samples.
// Panes and mirrors send the rays on: what is seen in a mirror is shaded, and filtered, like what is seen directly.
#pragma once

#include <span>

#include "filter/filter.h"
#include "gather/fragments.h"
#include "gather/picture.h"
#include "scene/surface.h"

namespace roomlight {

constexpr size_t kRaysAtOnce = SharpLights::kMostPoints;

// Random numbers of one pixel. Pixels take their points of one sequence along Morton's curve, so that every square
// block of 2^k pixels together has a well-distributed set: what a filter makes of them has far less noise than from
// points chosen apart (Ahmed & Wonka 2020, "Screen-space blue-noise diffusion of Monte Carlo sampling error via
// hierarchical ordering of pixels").
class PixelSequence {
 public:
  // Of `every` pixels, a power of two, one in every pass gathers for all.
  PixelSequence(int x, int y, uint32_t pass, uint64_t seed, uint32_t every = 1);
  bool gathers() const { return gathers_; }
  // Of `count` shadings that pixels have of one surface, a power of two; `surface` counts those of this pixel.
  Sampler forShading(uint32_t surface, uint32_t i, uint32_t count) const {
    return {key_ + 2 * surface, shadingIndex_ * count + i, seed_};
  }
  Sampler forShadow(uint32_t surface, uint32_t ray) const {
    return {key_ + 2 * surface + 1, index_ * static_cast<uint32_t>(kRaysAtOnce) + ray, seed_};
  }

 private:
  uint64_t key_, seed_;
  uint32_t index_, shadingIndex_;  // those that gather follow one another
  bool gathers_;
};

struct PixelSum {  // variances are of the sums
  FilterPixel* sum;
  PixelCount* count;
  uint32_t index;  // of the pixel, in sums by layers
  ReflectedPlace* reflected = nullptr;
};
FilterPixel meanOf(const FilterPixel& sum, const PixelCount& count);

// Whether what it reflects is seen as a picture, by rays sent on; `clear`: light passes through too.
bool isMirror(const MaterialSample& m, bool clear);

// The place of a surface for the filter, seen through panes and veils that leave so much of it.
Vec3 veiledPlace(const SurfacePoint& s, Vec3 left);

// What the pixels of a tile have seen and want lit.
struct TileWork {
  struct Part {  // one surface in one pixel
    PixelSum pixel;
    uint32_t first, count;  // shadings
    Vec3 left;              // share of their light that reaches the eye
    float weight;           // camera rays that each stands for
    bool turn;              // whether its pixel is one of those that gather for others
    uint32_t gathers = 1, glossy = 1;  // what its diffuse and specular light counts for
    Vec3 normal{}, position{};   // sums over the camera rays that saw no solid surface before it; none of mirrors
    float roughness = 0, surface = 0;
    bool veil = false;       // lets most light through: a surface only where nothing solid is seen behind
    bool once = false;       // lit by single estimates
    float survival = 1;  // probability that it was lit at all: what is found stands for those that were not; unlit
                         // parts have no shadings
    Vec3 unlitAlbedo{};  // sum over the camera rays of an unlit part
    bool apart = false;  // not filtered with what fills most of its pixel: another surface, or what outshines that
  };
  std::vector<Shading> shadings;
  std::vector<Shadow> shadows;
  std::vector<Part> parts;
  void clear() { shadings.clear(), shadows.clear(), parts.clear(); }
};

class PixelShader {
 public:
  // `keepsFragments`: what edges show of other surfaces is kept apart. `byLayer`, where given: a sum for each pixel, of
  // light by `layers`.
  PixelShader(const RayScene& rays, const Lights& lights, const PictureSettings& settings, bool keepsFragments,
              const LightLayers* layers = nullptr, LayerSums* byLayer = nullptr)
      : rays_(rays),
        lights_(lights),
        sharp_(rays, lights),
        settings_(settings),
        keepsFragments_(keepsFragments),
        layers_(layers),
        byLayer_(byLayer) {}
  // At most kRaysAtOnce rays. What shines by itself is added to `pixel` at once; what has to be lit, to `work`.
  void see(std::span<const Ray> rays, const PixelSequence& sequence, PixelSum pixel, TileWork& work,
           GatherCounters& count) const;
  // Marks parts that outshine their pixels.
  void findOutshining(TileWork& work, std::span<const SurfaceLight> light) const;
  // Adds the light of everything in `work` to its pixels, but for what `fragments`, where given, take: such parts are
  // marked.
  static void add(TileWork& work, std::span<const SurfaceLight> light, Fragments* fragments);
  // The same by layers, of which `light` has one thing for each shading.
  void addLayers(const TileWork& work, std::span<const SurfaceLight> whole, const LayerSums& light) const;

 private:
  struct Layer;
  struct Group;
  struct SeenSurface;
  struct ShadingPlan;
  Group* groupOf(const Ray& ray, const Hit& hit, std::span<Group> groups, size_t& used) const;
  MaterialSample meanMaterial(const SeenSurface& seen, bool uniform) const;
  bool glints(const SeenSurface& seen, const MaterialSample& m, Vec3 toLight) const;
  uint32_t shadows(const SeenSurface& seen, const MaterialSample* smooth, std::vector<Shadow>& out,
                   GatherCounters& count) const;
  ShadingPlan planned(const SeenSurface& seen, const MaterialSample& m, bool clear, const PixelCount& known) const;
  void see(const SeenSurface& seen, PixelSum pixel, TileWork& work, Layer& behind, GatherCounters& count) const;
  static void addPlace(const TileWork::Part& part);
  static void addFragment(const TileWork::Part& part, std::span<const SurfaceLight> shadings, Fragments& fragments);
  static void addPart(const TileWork::Part& part, std::span<const SurfaceLight> shadings);
  static void addVariance(std::span<const SurfaceLight> light, const TileWork::Part& part);
  static void passOn(const SeenSurface& seen, Vec3 through, bool solid, Layer& behind);
  void addVarianceOfLayers(const TileWork::Part& part, std::span<const SurfaceLight> whole,
                           const LayerSums& light) const;
  void addBackground(Vec3 left, Vec3 direction, PixelSum pixel) const;
  void reflectOn(const SeenSurface& seen, const MaterialSample& m, Layer& behind) const;

  const RayScene& rays_;
  const Lights& lights_;
  const SharpLights sharp_;
  const PictureSettings& settings_;
  const bool keepsFragments_;  // for add(); else all surfaces of a pixel are one
  const LightLayers* layers_;
  LayerSums* byLayer_;
};

}  // namespace roomlight
