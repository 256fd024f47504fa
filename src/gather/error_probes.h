// How far a picture is off, told by samples that have no part in it. Some of its pixels get two samples each,
// independent of one another and of the picture: the mean of the product of what the picture differs by from either is
// its squared error, however noisy samples are (cross-validation, as Buisine et al. 2021 and Zheng et al. 2021 do it
// for filtered renderings by halves of their samples). Noise and what a filter spreads are in it; errors of the caches
// that samples share with the picture are not.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "gather/picture.h"
#include "trace/traced_scene.h"

namespace roomlight {

class ErrorProbes {
 public:
  // `closely`: for pictures whose error shall be small.
  ErrorProbes(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
              const PictureSettings& settings, bool closely, const Progress& progress);
  // Of a picture of the same size; nothing is known of one of a few pixels.
  ErrorLeft of(const Image& picture) const;
  uint64_t rays() const { return rays_; }

 private:
  struct Probe {
    uint32_t pixel;
    Vec3 sample[2];  // cd/m²
  };
  std::vector<Probe> probes_;
  uint64_t rays_ = 0;
};

}  // namespace roomlight
