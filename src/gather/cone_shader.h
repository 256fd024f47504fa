// Light at one surface point: exact direct light, cones for diffuse light, rays and cones for reflections.
#pragma once

#include "base/sampler.h"
#include "gather/cone_gather.h"
#include "gather/cone_march.h"
#include "gather/sharp_lights.h"
#include "trace/bsdf.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"
#include "trace/surface_point.h"
#include "voxel/voxels.h"

namespace roomlight {

struct ConeCounters {
  uint64_t rays = 0, cones = 0;
};

// Light that a surface sends to the eye, in cd/m²: diffuse + sharp + specular + emitted.
struct SurfaceLight {
  Vec3 diffuse;   // reflected by the Lambertian lobe: from all around, and
  Vec3 sharp;     // from suns and lamps
  Vec3 albedo;    // of that lobe: (diffuse + sharp) / albedo is irradiance / pi
  Vec3 specular;  // reflected by the glossy lobe
  Vec3 emitted;
  float sharpVariance = 0;  // of the luminance of `sharp`
  float occlusion = 0;
};

// Who looks where a surface's glossy lobe reflects.
enum class Reflection : uint8_t {
  Cone,     // the shader
  Ray,      // the shader, exactly: lights too
  Followed  // the caller, who sends rays on from mirrors
};

// What goes straight through a surface met under |cos theta|.
Vec3 passing(const MaterialSample& m, const Material& material, float cosTheta);

class ConeShader {
 public:
  ConeShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const GatherSettings& settings);
  // Without what passes straight through the surface and, where it is followed, without its reflection of other surfaces, sky and
  // lights of any size. `shadows`: of every sharp light.
  SurfaceLight shade(const SurfacePoint& s, Vec3 wo, bool followed, std::span<const Shadow> shadows, Sampler& sampler, ConeCounters& count) const;
  // What a ray sees that meets no surface.
  Vec3 background(Vec3 d) const;
  const SharpLights& sharpLights() const { return sharp_; }

 private:
  // Light that leaves a surface, by the lobe that reflected it; or, before the light is multiplied in, the two lobes' values.
  struct Lobes {
    Vec3 diffuse, specular;
    void add(const Lobes& f, Vec3 light) { diffuse += f.diffuse * light, specular += f.specular * light; }
  };

  // Where a reflected ray started, and the density with which its direction was chosen; 0: nothing else looked for lights there.
  struct Reflected {
    Vec3 p;
    float pdf;
    int32_t guide;
    bool sharp;  // what it meets is seen clearly, and is lit with the care of what the camera sees
    float weight(float lightPdf) const;
  };

  Vec3 visible(const SurfacePoint& s, const LightSample& light, const Lobes& f, ConeCounters& count) const;
  void glow(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, Sampler& sampler, Lobes& sum, ConeCounters& count) const;
  Lobes towards(const LightSample& light, const Bsdf& bsdf, Reflection by, float strategies) const;
  Lobes sharp(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, std::span<const Shadow> shadows, Sampler& sampler, ConeCounters& count, float& variance) const;
  Lobes soft(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, int32_t guide, Sampler& sampler, ConeCounters& count) const;
  float conePdf(float cosSurface) const;
  ConeShape lobe(const SurfacePoint& s, float pdf) const;
  ConeStart coneStart(const SurfacePoint& s) const;
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, ConeCounters& count, float& occlusion) const;
  Vec3 reflection(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, int32_t guide, Sampler& sampler, ConeCounters& count) const;
  Vec3 seen(Ray ray, const Reflected& from, Vec3 startLux, Sampler& sampler, ConeCounters& count) const;
  bool isParted(size_t slot, const SurfacePoint& s, ConeCounters& count) const;
  Vec3 along(Ray ray, Reflected from, Sampler& sampler, ConeCounters& count) const;
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
