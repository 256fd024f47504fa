// Light at one surface point, for every technique that lights one at a time: direct light by exact shadow rays,
// polished reflections by exact rays. Who derives from it adds the light that other surfaces reflect, and nothing else.
#pragma once

#include "gather/shading.h"
#include "radiance/radiance_field.h"
#include "trace/bsdf.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

// Who looks where a surface's glossy lobe reflects.
enum class Reflection : uint8_t {
  Cone,  // the technique, see glossy()
  Ray,  // the shader, exactly: lights too
  Followed  // the caller, who sends rays on from mirrors
};

// A surface that is lit, with its BSDF towards where it is seen from.
struct LitSurface {
  const SurfacePoint& s;
  const Bsdf& bsdf;
  Reflection by;
};

class DirectShader : public SurfaceShader {
 public:
  // `guide`, over the bricks of `voxels`, says where the sky is seen; it may be empty. Below `rayRoughness` reflections
  // follow rays. Refers to all of them.
  DirectShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const SkyGuide& guide,
               float rayRoughness)
      : rays_(rays),
        lights_(lights),
        voxels_(voxels),
        sharp_(rays, lights),
        guide_(guide),
        rayRoughness_(rayRoughness) {}
  void shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
             GatherCounters& count) const final;

 protected:
  // Where a reflected ray started, and the density with which its direction was chosen; 0: nothing else looked for
  // lights there.
  struct Reflected {
    Vec3 p;
    float pdf;
    int32_t guide;
    bool sharp;  // what it meets is seen clearly, and is lit with the care of what the camera sees
    float weight(float lightPdf) const;
  };

  // What other surfaces send to s, without lights and sky: irradiance / pi, cd/m². `occlusion` may be added to.
  virtual Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const = 0;
  // The same along r, a sample of the glossy lobe towards unit `wo` of a surface too rough for rays: mean radiance
  // around there.
  virtual Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
                      GatherCounters& count) const = 0;
  // All light, lx, on a surface that a blurred reflection meets from `direction`. Here: worked out afresh, as for what
  // the camera sees.
  virtual Vec3 reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler,
                                   GatherCounters& count) const;
  // Further light, before any noise of the others' is known. Here: none.
  virtual void addNear(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, Sampler& sampler, Lobes& sum,
                       GatherCounters& count) const;

  Vec3 visible(const SurfacePoint& s, const LightSample& light, const Lobes& f, GatherCounters& count) const;
  Lobes sharp(const LitSurface& at, std::span<const Shadow> shadows, Sampler& sampler, GatherCounters& count,
              float& variance) const;
  Lobes soft(const LitSurface& at, int32_t guide, Sampler& sampler, GatherCounters& count, bool skyToo = true) const;
  int32_t guideOf(const SurfacePoint& s) const;

  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const SharpLights sharp_;

 private:
  SurfaceLight shade(const Shading& work, std::span<const Shadow> shadows, GatherCounters& count) const;
  Lobes towards(const LightSample& light, const LitSurface& at, float strategies) const;
  Vec3 reflection(const LitSurface& at, Vec3 wo, int32_t guide, Sampler& sampler, GatherCounters& count) const;
  Vec3 along(Ray ray, Reflected from, Sampler& sampler, GatherCounters& count) const;
  Vec3 reflectedBackground(Vec3 d, const Reflected& from) const;

  const SkyGuide& guide_;
  const float rayRoughness_;
};

}  // namespace roomlight
