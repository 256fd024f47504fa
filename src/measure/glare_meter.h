// The Unified Glare Rating of an eye in a lit scene.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/lit_scene.h"
#include "measure/glare.h"
#include "measure/measurements.h"

namespace roomlight {

// The luminaires that an eye sees, and what they send straight to it.
struct SeenLamps {
  std::vector<GlareSource> sources;
  double directLux = 0;  // on the plane that faces the view
  size_t large = 0;      // of more than kLargeSourceM2: UGR is too mild for them
};
// Every instance that emits is one, integrated over what is visible of it; point and spot lamps, which have no size,
// count as small sources.
SeenLamps seenLamps(const RayScene& rays, Vec3 eye, Vec3 view);

// One lamp without a mesh; not of kind Area.
struct SeenLamp {
  double directLux = 0;               // on the plane that faces the view
  std::optional<GlareSource> source;  // none: not seen, or behind the view
  double areaM2 = 0;                  // projected
};
SeenLamp seenLamp(const RayScene& rays, const Lamp& lamp, Vec3 eye, Vec3 view);

// The background is the light on the eye less what comes straight from luminaires, over π (CIE 117); daylight is part
// of it. What lamps make of shades that do not emit themselves is background too.
std::vector<GlareReading> readGlares(const LitScene& lit, std::span<const GlarePlan> plans,
                                     const MeterSettings& settings, const Progress& progress,
                                     std::vector<std::string>& warnings);

}  // namespace roomlight
