#include "photometry/stated_flux.h"

#include <fmt/format.h>

#include <cmath>

namespace roomlight::photometric {
namespace {

constexpr double kTolerance = 0.02;

}  // namespace

void checkFlux(const PhotometricWeb& web, const std::string& whose, Oddities& odd) {
  if (!(web.fluxLm > 0)) damage(0, "all intensities are zero; there is no light");
  if (!(web.statedFluxLm > 0)) return;
  const double ratio = web.fluxLm / web.statedFluxLm;
  if (std::abs(ratio - 1) > kTolerance)
    odd.add(fmt::format("the intensities add up to {:.6g} lm, {:.3g} % of the {:.6g} lm stated for {}", web.fluxLm,
                        100 * ratio, web.statedFluxLm, whose));
}

}  // namespace roomlight::photometric
