// Technique `vxgi`: voxel cone tracing with clipmaps, as in the well-known SDK, to be measured against. docs/methods/vxgi.md
#pragma once

#include "baselines/vxgi_clipmap.h"
#include "gather/picture.h"
#include "radiance/radiance_field.h"

namespace roomlight {

struct VxgiSettings : PictureSettings {
  VxgiSettings() { rayRoughness = 0.1f; }
  int resolution = 64;          // voxels along an edge of a level
  int levels = 5;
  float voxelSizeM = 0;         // of the finest level; 0: as large as makes it hold the room
  int cones = 8;                // diffuse, a shading
  float tracingStep = 0.5f;     // in diameters of the cone
  int maxSamples = 128;         // along a cone
  float startOffsetVoxels = 2;  // along the normal, where cones start
  bool rotateCones = true;      // about the normal, at random from shading to shading
  int directSamples = 8;        // light samples a voxel side, as in RadianceSettings
  float residual = 0.002f;      // bounces end when one changes all light by less than this share
  int maxBounces = 32;
};

// Cones in one clipmap.
struct VxgiTracing {
  float step = 0.5f;
  int maxSamples = 128;
  float startOffsetVoxels = 2;
  VxgiTracing() = default;
  explicit VxgiTracing(const VxgiSettings& s) : step(s.tracingStep), maxSamples(s.maxSamples), startOffsetVoxels(s.startOffsetVoxels) {}
};

// Mean radiance that the cone of half-angle atan(tanHalf) about unit d from `origin` meets, cd/m².
Vec3 traceVxgiCone(const VxgiClipmap& map, Vec3 origin, Vec3 d, float tanHalf, const VxgiTracing& tracing);

// The diffuse cones of a hemisphere: directions (z up) of equal solid angle with weights by their cosine, which sum to 1.
struct VxgiCones {
  explicit VxgiCones(int count);
  std::vector<Vec3> direction;
  std::vector<float> weight;
  float tanHalf = 0;
};

// Irradiance / pi, cd/m², of a surface at p with unit normals ng (true) and ns (for shading). `turnRad` rotates the cones.
Vec3 traceVxgiDiffuse(const VxgiClipmap& map, Vec3 p, Vec3 ng, Vec3 ns, const VxgiCones& cones, float turnRad, const VxgiTracing& tracing);

struct VxgiLight {
  VxgiClipmap map;
  Voxels voxels;  // of the finest level, and
  SkyGuide guide; // where they see the sky
  size_t sources = 0;  // voxels that reflect light
  int bounces = 0;
  double residual = 0;
  uint64_t rays = 0;
};

// What surrounds `eye`, as far as the first surfaces in all directions; a few of the farthest are left out.
Bounds3 roomAround(const RayScene& rays, Vec3 eye);

// Voxels, their light by shadow rays, and its bounces by cones. `room` is what the finest level shall hold. Once `progress` says stop
// it ends soon, with part of the light.
VxgiLight lightVxgi(const RayScene& rays, const Lights& lights, const Bounds3& room, const VxgiSettings& settings, const Progress& progress = {});

}  // namespace roomlight
