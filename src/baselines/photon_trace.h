// Photons on their way from lights through the scene, and where they are kept (Jensen 1996).
#pragma once

#include "base/progress.h"
#include "baselines/photon_map.h"
#include "baselines/photon_settings.h"
#include "baselines/photon_sources.h"

namespace roomlight {

// What a photon has met before.
enum class PhotonKind : uint8_t {
  Direct,    // nothing but panes
  Caustic,   // only surfaces smoother than rayRoughness, at least one
  Indirect,
};

struct TracedPhotons {
  std::vector<Photon> photons;
  uint64_t emitted = 0, rays = 0;
};

class PhotonTracer {
 public:
  // Of a scene whose `importance` tells which photons to keep. Refers to all of them.
  PhotonTracer(const RayScene& rays, const Lights& lights, const PhotonImportance& importance, const SkySurvey& survey,
               const PhotonSettings& settings);

  // About settings.photons of them: of every kind, or `indirectOnly`.
  TracedPhotons global(bool indirectOnly, const Progress& progress) const;
  // About settings.causticPhotons of that kind.
  TracedPhotons caustics(const Progress& progress) const;

 private:
  struct Wish;
  struct Source;
  template <class Keep>
  uint64_t follow(const PhotonStart& start, float share, const Wish& wish, Sampler& sampler, Keep&& keep) const;
  TracedPhotons trace(const Wish& wish, const Progress& progress) const;
  std::vector<Source> plan(const Wish& wish, uint64_t& rayCount) const;

  const RayScene& rays_;
  const PhotonImportance& importance_;
  const PhotonSettings& settings_;
  const PhotonSources sources_;
};

}  // namespace roomlight
