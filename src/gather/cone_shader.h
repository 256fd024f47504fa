// Light along one camera ray: exact direct light, cones for diffuse light, rays and cones for reflections.
#pragma once

#include "base/sampler.h"
#include "gather/cone_gather.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

struct ConeCounters {
  uint64_t rays = 0, cones = 0;
};

// One sample of a pixel. Its luminance in cd/m² is diffuse + specular + rest; the other values describe what is seen there.
struct ConeSample {
  Vec3 diffuse;   // reflected by Lambertian lobes
  Vec3 albedo;    // of those lobes: diffuse / albedo is irradiance / pi
  Vec3 specular;  // reflected by glossy lobes
  Vec3 rest;      // emission and background
  Vec3 normal, position;  // of the first surface that is no clear pane
  float roughness = 1, occlusion = 0;
  bool surface = false;
};

class ConeShader {
 public:
  ConeShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const GatherSettings& settings)
      : rays_(rays), lights_(lights), voxels_(voxels), field_(field), settings_(settings) {}
  ConeSample sample(const Ray& ray, Sampler& sampler, ConeCounters& count) const;

 private:
  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceField& field_;
  const GatherSettings& settings_;
};

}  // namespace roomlight
