// Irradiance from the photons around a place.
#pragma once

#include "baselines/photon_map.h"
#include "baselines/photon_settings.h"
#include "trace/ray_scene.h"

namespace roomlight {

struct PhotonIrradiance {
  Vec3 lux;
  float radiusM = 0;     // within which photons were counted
  bool walls = false;    // end the surface within it
};

// The k nearest photons on the surface around a place, weighted by the kernel, over the part of their disc that is
// surface. `rayCount` counts rays.
class PhotonEstimate {
 public:
  // Refers to all of them.
  PhotonEstimate(const RayScene& rays, const PhotonMap& map, int nearest, const PhotonSettings& settings)
      : rays_(rays), map_(map), nearest_(static_cast<size_t>(nearest)), settings_(settings) {}
  // At p on a surface of unit geometric normal n. `self`: a photon of the map that is asked about its own place, and
// does not count; -1: none.
  PhotonIrradiance at(Vec3 p, Vec3 n, uint64_t& rayCount, int64_t self = -1) const;

 private:
  const RayScene& rays_;
  const PhotonMap& map_;
  size_t nearest_;
  const PhotonSettings& settings_;
};

// Irradiance worked out before at every n-th photon; a place takes that of the nearest (Christensen 1999).
class IrradianceCache {
 public:
  IrradianceCache() = default;
  IrradianceCache(const PhotonMap& map, const PhotonEstimate& estimate, const PhotonSettings& settings,
                  uint64_t& rayCount, const Progress& progress);
  // Where none is as near as the photons that it was made of, or a wall stands between, `estimate` works it out.
  PhotonIrradiance at(Vec3 p, Vec3 n, const RayScene& rays, const PhotonEstimate& estimate,
                      const PhotonSettings& settings, uint64_t& rayCount) const;
  size_t bytes() const { return places_.bytes() + reach_.size() * sizeof(Reach); }
  size_t size() const { return places_.size(); }

 private:
  struct Reach {
    float radiusM = 0;
    bool walls = false;
  };
  PhotonMap places_;  // lux for flux
  std::vector<Reach> reach_;
};

}  // namespace roomlight
