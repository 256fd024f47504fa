// Luminance of the sky by direction: of the standard skies of the CIE, and from measured irradiance.
#pragma once

namespace roomlight {

// Luminance of the sky by direction after ISO 15469:2004 / CIE S 011 (Spatial distribution of daylight: CIE standard
// general sky), and what such a sky is worth in lux where nobody measured it.
//   L / L_z = f(chi) phi(Z) / (f(Z_s) phi(0))
//   phi(Z) = 1 + a exp(b / cos Z)
//   f(chi) = 1 + c (exp(d chi) - exp(d pi / 2)) + e cos² chi
// Z: angle of the direction from the zenith, chi: from the sun, Z_s: of the sun from the zenith.
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

// The all-weather sky from measured irradiance: luminance by direction after Perez, Seals & Michalsky 1993
// ("All-weather model for sky luminance distribution"), lux per W/m² after Perez, Ineichen, Seals, Michalsky & Stewart
// 1990 ("Modeling daylight availability and irradiance components from direct and global irradiance", table 4).
//   clearness  epsilon = ((Ed + Eb) / Ed + 1.041 Z³) / (1 + 1.041 Z³),  brightness  Delta = m Ed / E0
//   L ~ (1 + a exp(b / cos zeta)) (1 + c exp(d gamma) + e cos² gamma);  a..e by Z and Delta in eight classes of epsilon
// Z: of the sun from the zenith; zeta, gamma: of the direction from zenith and sun; m: air mass.
struct SkyIrradiance {
  double directNormal = 0, diffuseHorizontal = 0;  // W/m²; not negative
};

struct PerezSky {
  int clearnessClass = 0;  // 0..7 of eight
  double clearness = 1, brightness = 0;
  double a = 0, b = 0, c = 0, d = 0, e = 0;
  double sunZenithRad = 0;
  double directEfficacy = 0, diffuseEfficacy = 0;  // lm/W
};

constexpr double kSolarConstant = 1367;  // W/m²
constexpr double kUsualWaterCm = 2;  // precipitable water

// Precipitable water in cm by the dew point near the ground in °C (Wright, Perez & Michalsky 1989): exp(0.07 T -
// 0.075).
double precipitableWaterCm(double dewPointC);

// `irradiance` with some diffuse light; sun's angle from the zenith, taken as on the horizon below it; W/m² outside the
// atmosphere on a surface that faces the sun; precipitable water in cm. Of classes 2 to 5 the brightness counts as 0.2
// at least in the distribution, as in Radiance's gendaylit: below, the fit gives skies brightest away from the sun.
PerezSky perezSky(const SkyIrradiance& irradiance, double sunZenithRad, double outsideWm2 = kSolarConstant,
                  double waterCm = kUsualWaterCm);

// Relative luminance, of no unit: scale it by the illuminance wanted. Not negative, though the fit may be.
double perezLuminance(const PerezSky& sky, double cosZenith, double sunAngleRad);

// Relative optical air mass (Kasten & Young 1989), 38 on the horizon.
double airMass(double zenithRad);

}  // namespace roomlight
