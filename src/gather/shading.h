// A surface point to be lit, the light that it sends to the eye, and who works that out: what the techniques of this
// folder share and where they differ.
#pragma once

#include <span>

#include "base/sampler.h"
#include "filter/filter.h"
#include "gather/layer_light.h"
#include "gather/sharp_lights.h"
#include "trace/surface_point.h"

namespace roomlight {

struct GatherCounters {
  uint64_t rays = 0, cones = 0;
};

struct Shading {
  SurfacePoint s;
  Vec3 wo;               // unit, towards the eye
  Sampler sampler;
  uint32_t firstShadow;  // of every sharp light, in a list beside this one
  bool followed;         // a mirror: the caller sends rays on where it reflects
  int gathers = 1;  // times as many estimates as else; 0: of sharp lights, and of what smooth surfaces reflect, alone
  bool skyKnown = false;  // what comes straight from the sky, through panes too, is left to the caller;
  bool lampsKnown = false;  // so is what comes straight from lamps (shadeInLayers() alone, of meters, whose sum of all
                            // light is of no use then)
  bool once = false;  // one estimate alone
};

// Light that a surface sends to the eye, in cd/m², without what it emits, what passes straight through it and, where
// that is followed, its reflection of other surfaces, sky and lights of any size.
struct SurfaceLight {
  Vec3 diffuse;  // reflected by the Lambertian lobe: from all around,
  Vec3 rare;  // the same, what single rays found far beyond what all should (of shaders that tell; else part of
              // diffuse), and
  Vec3 sharp;  // from suns and lamps
  Vec3 albedo;  // of that lobe: (diffuse + rare + sharp) / albedo is irradiance / pi
  Vec3 specular;  // reflected by the glossy lobe, but for
  Vec3 mirrored;  // what shines by itself and is seen as a picture in what is as smooth as a mirror (of shaders that
                  // tell; else part of specular): no noise, however bright beside what is around
  ReflectedPlace reflected;  // what is seen as a picture in it, where the shader tells
  float sharpVariance = 0;  // of the luminance of `sharp`
  float diffuseVariance = 0, specularVariance = 0;  // of the others', where the shader took several samples; else 0
  float occlusion = 0;
};

// Light by the lobe that reflects it; or, before the light is multiplied in, the two lobes' values.
struct Lobes {
  Vec3 diffuse, specular;
  void add(const Lobes& f, Vec3 light) { diffuse += f.diffuse * light, specular += f.specular * light; }
};

class SurfaceShader {
 public:
  virtual ~SurfaceShader() = default;
  // light[i] of work[i].
  virtual void shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
                     GatherCounters& count) const = 0;
  // The same, and by layers, for shaders that can: layers.at(i) of work[i], zero before.
  virtual void shadeInLayers(std::span<const Shading> work, std::span<const Shadow> shadows,
                             std::span<SurfaceLight> light, LayerSums& /*layers*/, GatherCounters& count) const {
    shade(work, shadows, light, count);
  }
  virtual const LightLayers* layers() const { return nullptr; }  // that it keeps light apart by
};

}  // namespace roomlight
