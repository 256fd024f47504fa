// Light at surface points by rays, for many points at once: rays to lights, and rays that gather what other surfaces reflect and
// read it from the slots they hit. Where a slot cannot be trusted the path goes on from there, as in path tracing.
#pragma once

#include "gather/ray_gather.h"
#include "gather/shading.h"
#include "radiance/near_lamps.h"
#include "radiance/slot_cache.h"
#include "trace/bsdf.h"
#include "trace/surfaces.h"

namespace roomlight {

class RayShader final : public SurfaceShader {
 public:
  RayShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const RayGatherSettings& settings);
  void shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light, GatherCounters& count) const override;

 private:
  struct Path;
  struct Vertex;
  struct Workspace;

  SurfaceLight start(const Shading& work, std::span<const Shadow> shadows, Workspace& w) const;
  static void sumUp(std::span<const Lobes> found, SurfaceLight& out);
  void follow(Workspace& w) const;
  float expectedRadiance(const SurfacePoint& s) const;
  void scatter(const Vertex& v, Workspace& w) const;
  static float cosinePdf(const Vertex& v, Vec3 wi);
  void lightsAt(const Vertex& v, Workspace& w) const;
  bool isBeside(Vec3 p, const LightSample& lamp) const;
  void glowAt(const Vertex& v, Workspace& w) const;
  void gatherAt(const Vertex& v, Workspace& w) const;
  void arrive(const Path& path, const Hit& hit, Workspace& w) const;
  bool cached(const Path& path, const Hit& hit, Vec3 p, Vec3 n, Workspace& w) const;
  void goOn(const Path& path, SurfacePoint s, Workspace& w) const;
  void read(const Path& path, const Hit& hit, int64_t slot, Vec3 p, Vec3 n, Workspace& w) const;
  Vec3 sunward(const Path& path, const Hit& hit, int64_t slot) const;
  void traceShadows(Workspace& w) const;
  void resolveUnsure(Workspace& w) const;
  Vec3 backgroundAlong(const Path& path) const;

  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceField& field_;
  const SlotCache cache_;
  const RayGatherSettings& settings_;
  const SharpLights sharp_;
  float meanRadiance_ = 0;
  Vec3 sunDirection_, sunColour_;  // where there is one alone; of luminance 1
  std::vector<LampSurroundings> surroundings_;  // per lamp
  std::vector<uint8_t> kind_;  // per instance: what about its surfaces the cache does not know
};

}  // namespace roomlight
