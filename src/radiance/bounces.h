// Bounces of light between slots, until what is missing is small.
#pragma once

#include <span>

#include "radiance/links.h"

namespace roomlight {

struct Bounces {
  int done = 0;
  int withMomentum = 0;  // of them; the rest went on without
  double residual = 0;  // estimate of light still missing where it is missing, fraction of what is there
};

// Weights of Chebyshev's iteration, step by step.
class Momentum {
 public:
  static constexpr double kSlowest = 0.8;  // mode of light that it is fastest for
  float next(bool on) {
    const double slowest = on ? kSlowest : 0;
    if (step_ > 0) omega_ = 1 / (1 - slowest * slowest * omega_ / (step_ == 1 ? 2 : 4));
    ++step_;
    return static_cast<float>(omega_);
  }

 private:
  int step_ = 0;
  double omega_ = 1;
};

// E = direct + G E for each slot. `indirect` (lx per channel) is where the iteration starts, and its result without
// `direct`: zero, or the solution for slightly different light. `settings` gives the residual to stop at and the most
// bounces.
Bounces bounce(const Voxels& voxels, const Links& links, std::span<const Vec3> direct, std::vector<Vec3>& indirect,
               const RadianceSettings& settings, const Progress& progress);

// Means over slots and their kin on flat sheets: the noise of few links falls, and no wall is crossed.
void smooth(const Links& links, std::vector<Vec3>& perSlot);

}  // namespace roomlight
