// Bounces of light between slots, until what is missing is small.
#pragma once

#include <span>

#include "radiance/links.h"
#include "radiance/slot_paths.h"

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

// Bounces of several lights at once: links are read once for all of them.
constexpr size_t kLayersAtOnce = 8;  // lights

// As bounce() for each of at most kLayersAtOnce lights from darkness on, with as many steps as `like` took
// for their sum. direct[k] and indirect[k]: lx per slot. Half floats in between: within about a thousandth.
void bounceLayers(const Voxels& voxels, const Links& links, std::span<const std::vector<Vec3>> direct,
                  std::span<std::vector<Vec3>> indirect, const Bounces& like, const Progress& progress);

// Bounces as the published study has them: slots gather from the directional pyramid by cones, which is built anew for
// each bounce. As bounce(), by cones in place of links, which is far slower.
Bounces bounceByCones(const Voxels& voxels, const SlotPaths& paths, std::span<const Vec3> direct,
                      std::vector<Vec3>& indirect, const RadianceSettings& settings, const Progress& progress);

}  // namespace roomlight
