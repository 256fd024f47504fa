// Technique `cone`: pictures from voxel radiance. Primary visibility and direct light by exact rays, diffuse light and
// occlusion by cones through the directional pyramid, reflections by cones or, where they are narrower than voxels,
// rays.
#pragma once

#include "gather/direct_shader.h"
#include "gather/picture.h"
#include "radiance/pyramid.h"
#include "radiance/radiance_field.h"
#include "trace/traced_scene.h"

namespace roomlight {

struct ConeGatherSettings : PictureSettings {
  ConeGatherSettings() { rayRoughness = 0.6f; }
  int conesPerShading = 2;        // diffuse cones
  float coneHalfAngleDeg = 0.3f;
  float startOffsetVoxels = 0.05f;  // along the normal
  float occlusionLambda = 0;      // f(r) = 1 / (1 + lambda r) in ambient occlusion, 1/m
  Vec3 ambientCdM2{0, 0, 0};      // luminance of light that ambient occlusion attenuates; 0: physical light only
};

GatheredPicture gatherCones(const TracedScene& scene, const Voxels& voxels, const RadianceField& field,
                            const Camera& camera, const ConeGatherSettings& settings, const Progress& progress = {});

// Technique `cone` at one surface point: cones for diffuse light and where reflections are rough.
class ConeShader final : public DirectShader {
 public:
  ConeShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
             const ConeGatherSettings& settings);

 private:
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const override;
  Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
              GatherCounters& count) const override;
  Vec3 reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler,
                           GatherCounters& count) const override;
  void addNear(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, Sampler& sampler, Lobes& sum,
               GatherCounters& count) const override;
  float conePdf(float cosSurface) const;
  ConeShape lobe(const SurfacePoint& s, float pdf) const;
  ConeStart coneStart(const SurfacePoint& s) const;
  Vec3 seen(Ray ray, const Reflected& from, Vec3 startLux, Sampler& sampler, GatherCounters& count) const;
  bool isParted(size_t slot, const SurfacePoint& s, GatherCounters& count) const;
  int64_t slotNear(const SurfacePoint& s, Sampler& sampler) const;

  const RadianceField& field_;
  const ConeGatherSettings& settings_;
  const ConeShape diffuse_;
};

}  // namespace roomlight
