// Technique `hybrid`: exact rays decide what every direction sees; the voxels are a cache of the light that leaves what
// they hit.
#pragma once

#include <memory>

#include "gather/picture.h"
#include "radiance/radiance_field.h"
#include "trace/traced_scene.h"

namespace roomlight {

struct RayGatherSettings : PictureSettings {
  RayGatherSettings() {
    samples = 20, firstSamples = 4, tolerance = 0.05f, raysPerShading = 2, fewestShadings = 1, filterPasses = 6;
  }
  int estimates =
      2;  // per shading, a power of two: each a ray that gathers what surfaces reflect, and one to every kind of light
  float nearVoxels = 2;  // what is hit nearer than this is lit afresh, not read from the cache
  float hitCellM =
      0;  // edge of the smallest cells of the cache of hits; 0: chosen by the voxels; below 0: no such cache
  int causticPhotons = 1 << 17;  // of what polished surfaces throw on others; 0: rays are left to find it
  int hitSamples = 6;  // of the light on each cell, at most
  bool countsBySize = true;  // samples and raysPerShading are meant for small pictures: see withCounts()
};

class RayShader;
struct HitSurvey;

// Settings with the counts of rays that suit the size of the picture, where they go by that. The filter shares light
// over a surface, and a surface of a larger picture has more pixels, of which fewer lie on edges: by as many rays a
// pixel larger pictures have less error than smaller ones. So more of their rays share a shading, and fewer are added
// after the first pass. RayGather::picture() does so by itself.
RayGatherSettings withCounts(RayGatherSettings settings);

// Settings with the size of cells that suits voxels of that edge.
RayGatherSettings withCells(RayGatherSettings settings, float voxelM);

// RayShader with what a survey found of the places where rays of one camera arrive. Refers to both.
class SurveyedShader final : public SurfaceShader {
 public:
  SurveyedShader(const RayShader& shader, const HitSurvey& survey) : shader_(shader), survey_(survey) {}
  void shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
             GatherCounters& count) const override;
  void shadeInLayers(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
                     LayerSums& layers, GatherCounters& count) const override;
  const LightLayers* layers() const override;

 private:
  const RayShader& shader_;
  const HitSurvey& survey_;
};

// What pictures of one camera share: the cache of hits and the guide. Refers to all that it is made of but the camera.
class RayGather {
 public:
  // `settings` as the shader has them.
  RayGather(const RayScene& rays, const Lights& lights, const RayShader& shader, const Camera& camera,
            const RayGatherSettings& settings, const Progress& progress = {});
  ~RayGather();
  const Camera& camera() const { return camera_; }
  // Of that size, with so many samples; how they are taken is as prepared.
  GatheredPicture picture(RayGatherSettings settings, const Progress& progress = {}) const;

 private:
  const RayScene& rays_;
  const Lights& lights_;
  const RayShader& shader_;
  const Camera camera_;
  std::unique_ptr<HitSurvey> survey_;  // null: there is none
};

GatheredPicture gatherRays(const TracedScene& scene, const Voxels& voxels, const RadianceField& field,
                           const Camera& camera, const RayGatherSettings& settings, const Progress& progress = {});

}  // namespace roomlight
