// Technique `vxgi`: voxel cone tracing with clipmaps, as in the well-known SDK, to be measured against.
 // docs/methods/vxgi.md
#pragma once

#include "baselines/vxgi_clipmap.h"
#include "baselines/vxgi_settings.h"
#include "radiance/radiance_field.h"

namespace roomlight {

// Cones in one clipmap.
struct VxgiTracing {
  float step = 0.5f;
  int maxSamples = 128;
  float startOffsetVoxels = 2;
  VxgiTracing() = default;
  explicit VxgiTracing(const VxgiSettings& s)
      : step(s.tracingStep), maxSamples(s.maxSamples), startOffsetVoxels(s.startOffsetVoxels) {}
};

// Mean radiance that the cone of half-angle atan(tanHalf) about unit d from `origin` meets, cd/m².
Vec3 traceVxgiCone(const VxgiClipmap& map, Vec3 origin, Vec3 d, float tanHalf, const VxgiTracing& tracing);

// The diffuse cones of a hemisphere: directions (z up) of equal solid angle with weights by their cosine, which sum
// to 1.
struct VxgiCones {
  explicit VxgiCones(int count);
  std::vector<Vec3> direction;
  std::vector<float> weight;
  float tanHalf = 0;
};

// A place on a surface with unit normals, the true one and that for shading.
struct VxgiReceiver {
  Vec3 p, ng, ns;
};

// Irradiance / pi, cd/m². `turnRad` rotates the cones.
Vec3 traceVxgiDiffuse(const VxgiClipmap& map, const VxgiReceiver& at, const VxgiCones& cones, float turnRad,
                      const VxgiTracing& tracing);

struct VxgiLight {
  VxgiClipmap map;
  Voxels voxels;  // of the finest level, and
  SkyGuide guide; // where they see the sky
  size_t sources = 0;  // voxels that reflect light
  int bounces = 0;
  double residual = 0;
  uint64_t rays = 0;
};

// Voxels, their light by shadow rays, and its bounces by cones. `room` is what the finest level shall hold. Once
// `progress` says stop it ends soon, with part of the light.
VxgiLight lightVxgi(const RayScene& rays, const Lights& lights, const Bounds3& room, const VxgiSettings& settings,
                    const Progress& progress = {});

}  // namespace roomlight
