// What photon mapping may be asked to do. Counts are of photons kept.
#pragma once

#include "gather/picture.h"

namespace roomlight {

enum class PhotonKernel : uint8_t {
  Disc,          // all photons alike
  Cone,          // 1 - d / 1.1 r (Jensen 2001, 7.2.2)
  Epanechnikov,  // 1 - d² / r²
};

struct PhotonSettings : PictureSettings {
  int photons = 500000;         // of the global map
  int causticPhotons = 250000;  // of the caustic map; fewer where so many would take more than mostEmitted
  int nearest = 120;            // photons in an estimate of the global map,
  int causticNearest = 60;      // and of the caustic map
  PhotonKernel kernel = PhotonKernel::Epanechnikov;
  float flatness = 4;  // distances along the surface's normal count so many times: photons of other surfaces stay out
  float largestRadiusM = 1;  // of an estimate; where fewer photons lie within, those count
  int edgeRays = 16;  // rays around an estimate's place that tell which part of its disc is surface; 0: all of it is
                      // taken for surface
  int finalGather =
      4;  // rays per shading that gather what the global map says where they arrive; 0: the map is seen directly
  int irradianceEvery =
      4;  // with final gathering: photons of which one has its irradiance worked out before (Christensen 1999)
  float nearRadii = 1;  // gathering rays shorter than so many radii of the estimate they would read gather once more
  int rouletteDepth = 5;  // reflections before Russian roulette
  int importons = 32768;  // paths from the camera that tell where photons are of use
  float mostEmitted = 32;  // photons sent out for one that is kept, at most
};

}  // namespace roomlight
