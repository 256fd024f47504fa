// The all-weather sky from measured irradiance: luminance by direction after Perez, Seals & Michalsky 1993
// ("All-weather model for sky luminance distribution"), lux per W/m² after Perez, Ineichen, Seals, Michalsky & Stewart
// 1990 ("Modeling daylight availability and irradiance components from direct and global irradiance", table 4).
//   clearness  epsilon = ((Ed + Eb) / Ed + 1.041 Z³) / (1 + 1.041 Z³),  brightness  Delta = m Ed / E0
//   L ~ (1 + a exp(b / cos zeta)) (1 + c exp(d gamma) + e cos² gamma);  a..e by Z and Delta in eight classes of epsilon
// Z: of the sun from the zenith; zeta, gamma: of the direction from zenith and sun; m: air mass.
#pragma once

namespace roomlight {

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
