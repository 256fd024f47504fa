// The camera rays of one pixel together. Rays that see the same surface share its shading: edges, textures and sharp
// shadows are as smooth as the pixel's many cheap rays make them, while the rest of its light comes from few samples.
// Panes and mirrors send the rays on: what is seen in a mirror is shaded, and filtered, like what is seen directly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/image.h"
#include "filter/filter.h"
#include "gather/picture.h"
#include "scene/surface.h"
#include "trace/camera_rays.h"

namespace roomlight {

// What a pixel keeps beside the sums over its
// camera rays.
struct PixelCount {
  uint32_t rays = 0;
  uint32_t gathered = 0, glossy = 0;  // that diffuse and specular light is known of, each times the estimates it got
  bool edge = false;  // more than one surface seen
  float occlusion = 0;
};
// What pixels see beside the surface that fills most of them: an edge of a thing before a wall. Its diffuse light is
// filtered with that of its own surface.
struct Fragment {
  uint32_t pixel;
  Vec3 diffuse, albedo, normal, position;  // sums over camera rays, as FilterPixel's
  float surface = 0, luminance = 0;  // luminance: with what of its light is not filtered
  float kept = 1;  // of its own diffuse light, in the picture composed last
};
struct Fragments {  // of a tile
  std::vector<Fragment> all;
  std::vector<Vec3> byLayer;  // where light is kept in layers: of each fragment its diffuse light, layer by layer

  size_t layers() const { return all.empty() ? 0 : byLayer.size() / all.size(); }
  // Of one layer, or, below 0, of all together.
  Vec3 diffuse(size_t fragment, int layer) const {
    return layer < 0 ? all[fragment].diffuse : byLayer[fragment * layers() + static_cast<size_t>(layer)];
  }
};

// Whether light on two surfaces may be filtered together, much as the filter has it. Normals of any length.
bool onOneSheet(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition);

// Adds their light to a picture that was filtered without them: of pixels around that see the same surface, by their
// irradiance after filtering; where there is none their own, bounded. `layer`: that the picture is of; below 0: of all,
// which goes before layers and tells how much of their own light they keep.
void addFragments(Fragments& fragments, int layer, const FilterInput& means, const std::vector<PixelCount>& counts,
                  std::span<const Vec3> irradiance, Image& image);

// Of each pixel the luminance of what it shows beside its own surface and no pixel beside it shows as its own: things
// and grooves thinner than pixels. What they shine by themselves is not in it. -1: nothing. `sums`: over camera rays.
Plane thinThings(const std::vector<Fragments>& fragments, const FilterInput& sums,
                 const std::vector<PixelCount>& counts);

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
    Vec3 left;  // share of their light that reaches the eye
    float weight;  // camera rays that each stands for
    bool turn;  // whether its pixel is one of those that gather for others
    uint32_t gathers = 1, glossy = 1;  // what its diffuse and specular light counts for
    Vec3 normal{}, position{};  // sums over the camera rays that saw no solid surface before it; none of mirrors
    float roughness = 0, surface = 0;
    bool veil = false;  // lets most light through: a surface only where nothing solid is seen behind
    bool once = false;  // lit by single estimates
    float survival = 1;  // probability that it was lit at all: what is found stands for those that were not; unlit
                         // parts have no shadings
    Vec3 unlitAlbedo{};  // sum over the camera rays of an unlit part
    bool apart = false;  // not filtered with what fills most of its pixel: another surface, or what outshines that
    int32_t fragment = -1;  // of the tile's that its diffuse light belongs to
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
  void addLayers(const TileWork& work, std::span<const SurfaceLight> whole, const LayerSums& light,
                 Fragments* fragments) const;

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
  static void addFragment(TileWork::Part& part, std::span<const SurfaceLight> shadings, Fragments& fragments);
  void addLayersApart(const TileWork::Part& part, const LayerSums& light, Fragments* fragments) const;
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

// Whether two pixels see one surface: by normals and places, the first pixel's being that of its tangent plane.
bool onOneSurface(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition);

// What pixel i would be by the light of those beside it that see the same surface; where there is none, what it is.
FilterPixel meanBeside(const FilterInput& sums, const std::vector<PixelCount>& counts, size_t i);

// Of each pixel, how many more rays it needs beside those it had, where its noise is not shared with like neighbours or
// it is on an edge of a thing; 0: none. `tolerance`: relative standard error of
// luminance that may be left. `left`: of each pixel after the filter; empty: there is none. `thin`: of thinThings();
// empty: not known.
std::vector<uint16_t> raysNeeded(const FilterInput& sums, const std::vector<PixelCount>& counts,
                                 const FilteredLuminance& left, const Plane& thin, float tolerance);

// One pixel in many gathers light, by as many times the estimates; the filter gives it to the others. Each has its own
// camera rays, sharp shadows and reflections of smooth surfaces. (Ward, Rubinstein & Clear 1988 gather sparsely and
// interpolate; Kopf et al. 2007 upsample by what pixels see.)
struct Rectangle {
  int x0, y0, x1, y1;
};

// What a tile's pixels have seen by `rays` camera rays each, before it is lit. Pixels on edges and contacts gather for
// themselves.
void gatherSparsely(TileWork& work, const Rectangle& tile, uint32_t every, float rayRoughness, uint32_t rays,
                    const FilterInput& sums);

// How open surfaces are to what lies near: the part of their hemisphere that is free as far as a few to some dozen
// pixels reach. It has little noise where light has much, and contacts, corners and things before walls show in both:
// the filter learns from it where light changes (filter/levels.h). Sets FilterPixel::open of what pixels see, from sums
// over their camera rays. Returns how many rays it took.
uint64_t findOpenness(const RayScene& rays, const CameraRays& camera, uint64_t seed, FilterInput& sums);

}  // namespace roomlight
