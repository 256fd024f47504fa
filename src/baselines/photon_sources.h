// Photons leave every light by its flux: lamps and emissive meshes from where they are, suns and the sky from where
// their light first meets surfaces that are of use.
#pragma once

#include <optional>

#include "baselines/photon_surfaces.h"
#include "baselines/scene_survey.h"

namespace roomlight {

struct PhotonStart {
  LightRay ray;
  bool arrives = false;  // it starts right before the first surface that scatters it: what passes straight through that
                         // is counted elsewhere
};

class PhotonSources {
 public:
  // `survey` tells where the sky is seen. Refers to all but the importance.
  PhotonSources(const RayScene& rays, const Lights& lights, const PhotonImportance& importance,
                const SkySurvey& survey);

  // Lamps, emissive meshes, suns, the sky.
  size_t count() const { return lights_.lampCount() + lights_.emitterCount() + suns_.size() + (sky_ ? 1 : 0); }
  // Its fluxLm, averaged over many, is all that the source gives to the scene; black where it does not arrive.
  PhotonStart sample(size_t source, Sampler& sampler, uint64_t& rayCount) const;

 private:
  PhotonStart arriving(const PieceChoice::Place& place, const LightSample& light, uint64_t& rayCount) const;

  const RayScene& rays_;
  const Lights& lights_;
  const SkySurvey& survey_;
  const SurfacePieces pieces_;
  std::vector<PieceChoice> suns_;
  std::optional<PieceChoice> sky_;
};

}  // namespace roomlight
