#include "import/foreign_lights.h"

#include <algorithm>
#include <cmath>

#include "photometry/spot.h"

namespace roomlight::importers {
namespace {

constexpr float kLampLm = 800, kSunLux = 50'000;
constexpr float kSunHalfAngleRad = 0.00465f;
constexpr float kUsualAreaM = 0.3f;  // a side of an area light whose size the file does not say
constexpr float kLeastConeRad = 0.02f;
constexpr float kLeastSideM = 1e-3f, kMostSideM = 1e3f;
constexpr float kFaintest = 1e-20f;  // in the file's unit; below it is none

float strength(const ForeignLight& l) { return luminance(max(l.colour, Vec3(0))); }

Lamp lampOf(const ForeignLight& in, float metresPerUnit, Vec3 fluxLm) {
  Lamp lamp;
  lamp.name = in.name;
  lamp.position = in.position * metresPerUnit;
  lamp.direction = in.direction;
  const Vec3 across = cross(in.direction, cross(in.up, in.direction));
  lamp.up = length(across) > 1e-4f ? normalize(across) : looking({}, in.direction).y;
  if (in.kind == ForeignLightKind::Point) {
    lamp.kind = LampKind::Point;
    lamp.intensityCd = fluxLm / (4 * kPi);
  } else if (in.kind == ForeignLightKind::Spot) {
    lamp.kind = LampKind::Spot;
    lamp.outerConeRad = std::clamp(std::max(in.outerConeRad, in.innerConeRad), kLeastConeRad, kPi / 2);
    lamp.innerConeRad = std::clamp(in.innerConeRad, 0.0f, lamp.outerConeRad);
    lamp.intensityCd =
        fluxLm / static_cast<float>(spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad)));
  } else {
    lamp.kind = LampKind::Area;
    const auto side = [&](float size) {
      return size > 0 ? std::clamp(size * metresPerUnit, kLeastSideM, kMostSideM) : kUsualAreaM;
    };
    lamp.widthM = side(in.width), lamp.heightM = side(in.height);
    lamp.luminanceCdM2 = fluxLm / (kPi * lamp.widthM * lamp.heightM);
  }
  return lamp;
}

}  // namespace

void addForeignLights(const std::vector<ForeignLight>& lights, float metresPerUnit, Scene& scene, Warnings& warnings) {
  float brightestLamp = 0, brightestSun = 0;
  for (const ForeignLight& l : lights) {
    float& brightest = l.kind == ForeignLightKind::Directional ? brightestSun : brightestLamp;
    brightest = std::max(brightest, strength(l));
  }
  const size_t firstLamp = scene.lamps.size();
  size_t taken = 0;
  for (const ForeignLight& l : lights) {
    if (!(strength(l) > kFaintest)) {
      warnings.mended("lights of intensity 0 are left out");
      continue;
    }
    ++taken;
    const Vec3 colour = max(l.colour, Vec3(0));
    if (l.kind == ForeignLightKind::Directional) {
      scene.suns.push_back({l.name, -l.direction, colour * (kSunLux / brightestSun), kSunHalfAngleRad});
    } else {
      scene.lamps.push_back(lampOf(l, metresPerUnit, colour * (kLampLm / brightestLamp)));
    }
  }
  addAreaLampMeshes(scene, firstLamp);
  warnings.add(
      "lights of this format have no photometric unit: the brightest lamp is taken as 800 lm, the brightest "
      "directional light as a sun of 50000 lx",
      taken);
}

}  // namespace roomlight::importers
