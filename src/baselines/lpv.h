// Technique `lpv`: cascaded light propagation volumes with bounces, to be measured against. docs/methods/lpv.md
#pragma once

#include <functional>

#include "baselines/lpv_grid.h"
#include "gather/direct_shader.h"
#include "gather/picture.h"
#include "radiance/radiance_field.h"

namespace roomlight {

struct LpvSettings : PictureSettings {
  LpvSettings() { rayRoughness = 0.1f; }
  int cells = 32;            // along the longest edge of the fine grid, which holds the room
  int coarseCells = 64;      // of the coarse one, which holds the home
  float coarseReach =
      1.5f;  // how far that goes beyond the room on every side, in longest edges of the room, if the home does
  int steps = 16;            // of propagation
  int mapSize = 512;         // of a light's reflective shadow map: mapSize² rays
  int mostMaps = 32;         // more lamps and emissive meshes than these share the rays of so many
  int skySamples = 8;        // a surfel
  bool geometry = true;      // a geometry volume stops light
  bool bounces = true;       // and sends it back
  bool dampening = false;    // of light that grows towards the surface, as where it leaked
  float lookUpCells = 0.5f;  // along the normal, where surfaces take their light
  int glossySteps = 16;      // along a rough reflection, a cell each
};

// One light that a surface reflects: a texel of a reflective shadow map.
struct VirtualLight {
  Vec3 p, n, fluxLm;
};

// What rays from all lights meet first, panes apart: map by map handed to `take`. Of suns what falls on `home`. Returns
// how many rays were traced.
uint64_t traceShadowMaps(const RayScene& rays, const Lights& lights, const Bounds3& home, const LpvSettings& settings,
                         const std::function<void(std::span<const VirtualLight>)>& take, const Progress& progress = {});

// A grid after propagation, cell by cell for look-ups.
class LpvLevel {
 public:
  LpvLevel(const LpvGrid& light, LpvGeometry geometry);
  const LpvLattice& lattice() const { return lattice_; }
  const LpvGeometry& geometry() const { return geometry_; }
  size_t bytes() const { return cells_.size() * sizeof(LpvIntensity) + geometry_.bytes(); }
  // Whether p lies between the middles of own cells.
  bool holds(Vec3 p) const;
  // Intensity between the eight cells around p; those of the layer around them included.
  LpvIntensity at(Vec3 p) const;
  // cd/m² per cd: a cell with even radiance L in it has the intensity 1.5 L cell², the mean area that a cube shows.
  float perCd() const { return 1 / (1.5f * lattice_.cellM * lattice_.cellM); }

 private:
  LpvLattice lattice_;
  LpvGeometry geometry_;
  std::vector<LpvIntensity> cells_;
};

struct LpvLight {
  std::vector<LpvLevel> levels;  // the finest first
  Voxels voxels;  // where surfels come from, and
  SkyGuide guide;  // where they see the sky
  size_t virtualLights = 0, surfels = 0;
  uint64_t rays = 0;
};

// `room` is what the fine grid shall hold. Once `progress` says stop it ends soon, with part of the light.
LpvLight lightLpv(const RayScene& rays, const Lights& lights, const Bounds3& room, const LpvSettings& settings,
                  const Progress& progress = {});

// Irradiance / pi, cd/m², on a surface at p with unit normals ng (true) and ns (for shading).
Vec3 lpvIrradiance(const LpvLight& light, Vec3 p, Vec3 ng, Vec3 ns, const LpvSettings& settings);
// Radiance that comes to p, on a surface with normal ng, from around unit d.
Vec3 lpvRadiance(const LpvLight& light, Vec3 p, Vec3 ng, Vec3 d, const LpvSettings& settings);

// Technique `lpv` at one surface point: look-ups in its grids.
class LpvShader final : public DirectShader {
 public:
  // Refers to all of them.
  LpvShader(const RayScene& rays, const Lights& lights, const LpvLight& light, const LpvSettings& settings)
      : DirectShader(rays, lights, light.voxels, light.guide, settings.rayRoughness),
        light_(light),
        settings_(settings) {}

 private:
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const override;
  Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
              GatherCounters& count) const override;

  const LpvLight& light_;
  const LpvSettings& settings_;
};

}  // namespace roomlight
