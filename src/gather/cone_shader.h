// Light at one surface point: exact direct light, cones for diffuse light, rays and cones for reflections.
#pragma once

#include "gather/cone_gather.h"
#include "radiance/cone_march.h"
#include "gather/shading.h"
#include "trace/bsdf.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

// Who looks where a surface's glossy lobe reflects.
enum class Reflection : uint8_t {
  Cone,     // the shader
  Ray,      // the shader, exactly: lights too
  Followed  // the caller, who sends rays on from mirrors
};

class ConeShader final : public SurfaceShader {
 public:
  ConeShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const GatherSettings& settings);
  void shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light, GatherCounters& count) const override;

 private:
  // Where a reflected ray started, and the density with which its direction was chosen; 0: nothing else looked for lights there.
  struct Reflected {
    Vec3 p;
    float pdf;
    int32_t guide;
    bool sharp;  // what it meets is seen clearly, and is lit with the care of what the camera sees
    float weight(float lightPdf) const;
  };

  SurfaceLight shade(const Shading& work, std::span<const Shadow> shadows, GatherCounters& count) const;
  Vec3 visible(const SurfacePoint& s, const LightSample& light, const Lobes& f, GatherCounters& count) const;
  void glow(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, Sampler& sampler, Lobes& sum, GatherCounters& count) const;
  Lobes towards(const LightSample& light, const Bsdf& bsdf, Reflection by, float strategies) const;
  Lobes sharp(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, std::span<const Shadow> shadows, Sampler& sampler, GatherCounters& count, float& variance) const;
  Lobes soft(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, int32_t guide, Sampler& sampler, GatherCounters& count, bool skyToo = true) const;
  float conePdf(float cosSurface) const;
  ConeShape lobe(const SurfacePoint& s, float pdf) const;
  ConeStart coneStart(const SurfacePoint& s) const;
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const;
  Vec3 reflection(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, int32_t guide, Sampler& sampler, GatherCounters& count) const;
  Vec3 seen(Ray ray, const Reflected& from, Vec3 startLux, Sampler& sampler, GatherCounters& count) const;
  bool isParted(size_t slot, const SurfacePoint& s, GatherCounters& count) const;
  Vec3 along(Ray ray, Reflected from, Sampler& sampler, GatherCounters& count) const;
  Vec3 reflectedBackground(Vec3 d, const Reflected& from) const;
  Vec3 reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler) const;
  int64_t slotNear(const SurfacePoint& s, Sampler& sampler) const;

  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceField& field_;
  const GatherSettings& settings_;
  const SharpLights sharp_;
  const ConeShape diffuse_;
};

}  // namespace roomlight
