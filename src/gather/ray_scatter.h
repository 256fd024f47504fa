// Rays from a surface: to every kind of light, and on to other surfaces. All share the light by multiple importance
// sampling (Veach 1997, power heuristic).
#pragma once

#include <array>

#include "gather/ray_paths.h"
#include "gather/sun_gloss.h"
#include "radiance/bright_patches.h"
#include "radiance/near_lights.h"
#include "radiance/radiance_field.h"

namespace roomlight {

class RayScatter {
 public:
  // `sampleLamps`: lamps are too many for each to cast its own shadow on what the camera sees.
  RayScatter(const Lights& lights, const Voxels& voxels, const RadianceField& field, const BrightPatches& patches,
             const SunGloss& sunGloss, bool sampleLamps);
  // Adds its shadow rays and paths to `w`.
  void from(const GatherVertex& v, GatherWork& w) const;
  // Whether light straight from the emissive mesh of an instance to where the path came from is in the cache.
  bool isCached(const GatherPath& path, uint32_t instance) const;
  // Density with which samples of emissive meshes where the path came from, all together, would have chosen its way to
  // s.
  float pdfEmitters(const GatherPath& path, const SurfacePoint& s) const;
  // What light of an emissive mesh, found where a path ends, weighs in its layer relative to the picture: layers sample
  // each apart.
  float weightInLayer(const GatherPath& path, const SurfacePoint& s) const;

 private:
  static constexpr size_t kEmitterSamples = 4;  // of what the camera sees,
  static constexpr int kLayerSamples = 2;  // and of each layer there
  static size_t emitterSamples(int depth) { return depth == 0 ? kEmitterSamples : 1; }
  static int layerSamples(int depth) { return depth == 0 ? kLayerSamples : 1; }
  struct DrawnSky {
    SkyDistribution::Sample sample;
    float weight = 0;  // 0: none was drawn
  };
  static float cosinePdf(const GatherVertex& v, Vec3 wi);
  void lightsAt(const GatherVertex& v, const DrawnSky& sky, GatherWork& w) const;
  DrawnSky drawSky(const GatherVertex& v, GatherWork& w) const;
  static float askingWeight(float most, uint32_t estimate, GatherWork& w);
  // `isWide`: rays that go on find it, too; else, where the vertex is blunt, none looks for it.
  void takeLight(const GatherVertex& v, const LightSample& light, bool isWide, const LightOrigin& origin,
                 bool layersOnly, GatherWork& w) const;
  // Whether layers' lamps are sampled for what the camera sees: else each of them is asked by whoever wants its light.
  bool asksLamps(bool lampsKnown) const { return sampleLamps_ && !lampsKnown; }
  void layersAt(const GatherVertex& v, GatherWork& w) const;
  void lampsOfMeterAt(const GatherVertex& v, uint64_t reach, GatherWork& w) const;
  LightSample sampleLayer(size_t layer, Vec3 p, bool withLamps, bool withEmitters, Sampler& sampler) const;
  bool leavesToCache(const GatherVertex& v, const LightSample& light) const;
  bool isBeside(const GlowPoint& point, Vec3 p) const;
  static int32_t layerOf(const LightLayers& layers, const GlowPoint& point);
  void glowAt(const GatherVertex& v, const BrightPatches::Candidates& drawn, GatherWork& w) const;
  void gatherAt(const GatherVertex& v, GatherWork& w) const;

  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceField& field_;
  const BrightPatches& patches_;
  const SunGloss& sunGloss_;
  const bool sampleLamps_;
  // Lights of a layer that are sampled from there on: lamps, if they are at all, and emissive meshes.
  struct Members {
    std::vector<uint32_t> lamps, emitters;
  };
  std::vector<Members> members_;
  std::vector<LightSurroundings> besideLamps_;  // of each
  const std::vector<LightSurroundings> besideEmitters_;  // of each
};

}  // namespace roomlight
