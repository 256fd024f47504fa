// Discomfort glare by lamps: the Unified Glare Rating, computed and as an eye in a lit scene has it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "engine/lit_scene.h"
#include "measure/measurements.h"

namespace roomlight {

// A luminaire as an eye sees it.
struct GlareSource {
  Vec3 direction;            // unit, from the eye to it
  double luminanceCdM2 = 0;  // mean of its luminous parts towards the eye
  double solidAngleSr = 0;   // of those
};

// Guth's position index of a direction for an eye that looks along `view`, upright: how much less a source disturbs
// there than on the line of sight. Above it and on its level the closed form of CIE 117 (1995), below it p = 1 + 0.8 r
// up to r = 0.6, 1 + 1.2 r beyond, r the tangent of the angle off the line of sight (Iwata & Tokura 1997). At most 16;
// infinite behind the eye.
double positionIndex(Vec3 direction, Vec3 view);

// UGR = 8 log10(0.25 / L_b · Σ L² ω / p²), CIE 117 (1995). Minus infinity without sources; the background must be above
// zero.
double ugr(std::span<const GlareSource> sources, Vec3 view, double backgroundCdM2);

// A source of less than 0.005 m² of projected area counts as one of that area with the same intensity: CIE 147 (2002),
// "Glare from small, large and complex sources". L² ω becomes 200 I² / r².
constexpr double kSmallSourceM2 = 0.005;
// Beyond this projected area UGR is too mild (the same report).
constexpr double kLargeSourceM2 = 1.5;
GlareSource smallSource(Vec3 direction, double intensityCd, double distanceM);

// The luminaires that an eye sees, and what they send straight to it.
struct SeenLamps {
  std::vector<GlareSource> sources;
  double directLux = 0;  // on the plane that faces the view
  size_t large = 0;  // of more than kLargeSourceM2: UGR is too mild for them
};
// Every instance that emits is one, integrated over what is visible of it; point and spot lamps, which have no size,
// count as small sources.
SeenLamps seenLamps(const RayScene& rays, Vec3 eye, Vec3 view);

// One lamp without a mesh; not of kind Area.
struct SeenLamp {
  double directLux = 0;  // on the plane that faces the view
  std::optional<GlareSource> source;  // none: not seen, or behind the view
  double areaM2 = 0;  // projected
};
SeenLamp seenLamp(const RayScene& rays, const Lamp& lamp, Vec3 eye, Vec3 view);

// The background is the light on the eye less what comes straight from luminaires, over π (CIE 117); daylight is part
// of it. What lamps make of shades that do not emit themselves is background too.
std::vector<GlareReading> readGlares(const LitScene& lit, std::span<const GlarePlan> plans,
                                     const MeterSettings& settings, const Progress& progress,
                                     std::vector<std::string>& warnings);

}  // namespace roomlight
