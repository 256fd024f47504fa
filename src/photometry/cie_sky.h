// Luminance of the sky by direction after ISO 15469:2004 / CIE S 011 (Spatial distribution of daylight: CIE standard
// general sky), and what such a sky is worth in lux where nobody measured it.
//   L / L_z = f(chi) phi(Z) / (f(Z_s) phi(0))
//   phi(Z) = 1 + a exp(b / cos Z)
//   f(chi) = 1 + c (exp(d chi) - exp(d pi / 2)) + e cos² chi
// Z: angle of the direction from the zenith, chi: from the sun, Z_s: of the sun from the zenith.
#pragma once

namespace roomlight {

constexpr int kCieSkyTypes = 16;

// Types 1 to 5 and 16 are overcast, 6 to 10 intermediate, 11 to 15 clear.
enum class SkyCover {
  Overcast,
  Intermediate,
  Clear,
};
SkyCover skyCover(int cieType);

// Whether luminance depends on where the sun stands: not for types 1, 3, 5 and 16.
bool dependsOnSun(int cieType);

// Luminance relative to the zenith of type 1..16; 16 is the traditional overcast sky, (1 + 2 cos Z) / 3. Cosine of the
// direction's angle from the zenith, above 0; angle between direction and sun; sun's angle from the zenith, at most pi
// / 2.
double cieSkyLuminance(int cieType, double cosZenith, double sunAngleRad, double sunZenithRad);

// Illuminance in lux that the sky without its sun gives to open level ground: A + B sin^C(altitude) of IES RP-21
// (Gillette, Pierpoint & Treado 1984). With the sun below the horizon it falls as twilight does, to that of a night
// with some moon.
constexpr double kNightLux = 0.05;
double skyHorizontalLux(SkyCover cover, double sunAltitudeRad);

// Extinction of sunlight per air mass in the same model, for sunLux(). An overcast sky hides the sun.
double sunExtinction(SkyCover cover);

}  // namespace roomlight
