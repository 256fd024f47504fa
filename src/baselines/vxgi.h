// Technique `vxgi`: voxel cone tracing with clipmaps, as in the well-known SDK, to be measured against.
// docs/methods/vxgi.md
#pragma once

#include "baselines/vxgi_clipmap.h"
#include "gather/direct_shader.h"
#include "gather/picture.h"
#include "radiance/radiance_field.h"

namespace roomlight {

// What decides how technique `vxgi` works; the parameters of the SDK it follows. docs/methods/vxgi.md
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
  int bouncesAtOnce = 0;        // of an update: what is missing then follows with the next; 0: no limit
};

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

// Technique `vxgi` at one surface point: diffuse and specular cones through its clipmap.
class VxgiShader final : public DirectShader {
 public:
  // Refers to all but the settings.
  VxgiShader(const RayScene& rays, const Lights& lights, const VxgiLight& light, const VxgiSettings& settings);

 private:
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const override;
  Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
              GatherCounters& count) const override;

  const VxgiClipmap& map_;
  const VxgiTracing tracing_;
  const VxgiCones cones_;
  const bool rotate_;
};

}  // namespace roomlight
