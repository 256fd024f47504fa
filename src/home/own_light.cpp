#include <cmath>

#include "home/light.h"
#include "photometry/spot.h"
#include "trace/lights.h"

namespace roomlight::home {
namespace {

constexpr float kFarLamp = 3;  // times the scene's size beside it, and at least
constexpr float kFarLampM = 20;

// Of the image in rough steps, or of the even sky.
double meanSkyLuminance(const Sky& sky) {
  if (sky.image.width == 0) return static_cast<double>(luminance(sky.luminanceCdM2));
  double sum = 0;
  for (const Vec3& p : sky.image.pixels) sum += static_cast<double>(luminance(p));
  return sum / static_cast<double>(sky.image.pixels.size());
}

}  // namespace

OwnLight ownLightOf(const Scene& scene) {
  OwnLight own;
  const Bounds3 bounds = scene.bounds();
  const Vec3 size = bounds.size();
  const double surfaceM2 =
      std::max(1e-6, 2.0 * static_cast<double>(size.x * size.y + size.y * size.z + size.z * size.x));
  const float reach = std::max(kFarLampM, kFarLamp * maxComponent(size));
  double fluxLm = Lights(scene).emittedFluxLm();
  for (const Lamp& lamp : scene.lamps) {
    if (lamp.kind == LampKind::Area) {
      own.lamps = own.lamps || luminance(lamp.luminanceCdM2) > 0;  // its mesh is among the shining surfaces
      continue;
    }
    const double cd = static_cast<double>(luminance(lamp.intensityCd));
    if (!(cd > 0)) continue;
    const Vec3 beside = max(max(bounds.lo - lamp.position, lamp.position - bounds.hi), Vec3(0));
    if (length(beside) > reach) {
      own.farLamps.push_back(lamp.name);
      continue;
    }
    own.lamps = true;
    fluxLm +=
        cd * (lamp.kind == LampKind::Spot ? spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad))
                                          : 4.0 * static_cast<double>(kPi));
  }
  own.indoorLux = fluxLm / surfaceM2;
  for (const Sun& sun : scene.suns) own.outdoorLux += static_cast<double>(luminance(sun.illuminanceLux)) * 0.3;
  own.outdoorLux += meanSkyLuminance(scene.sky) * static_cast<double>(kPi);
  return own;
}

}  // namespace roomlight::home
