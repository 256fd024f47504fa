#include "photometry/colour_temperature.h"

#include <algorithm>
#include <cmath>

namespace roomlight {
namespace {

struct Xyz {
  double x = 0, y = 0, z = 0;
};

// One lobe: a Gaussian with different widths left and right of its centre.
double lobe(double nm, double scale, double centre, double left, double right) {
  const double t = (nm - centre) * (nm < centre ? left : right);
  return scale * std::exp(-0.5 * t * t);
}

// Wyman, Sloan, Shirley 2013, "Simple analytic approximations to the CIE XYZ color matching functions", multi-lobe fit.
Xyz observer(double nm) {
  return {lobe(nm, 0.362, 442.0, 0.0624, 0.0374) + lobe(nm, 1.056, 599.8, 0.0264, 0.0323) +
              lobe(nm, -0.065, 501.1, 0.0490, 0.0382),
          lobe(nm, 0.821, 568.8, 0.0213, 0.0247) + lobe(nm, 0.286, 530.9, 0.0613, 0.0322),
          lobe(nm, 1.217, 437.0, 0.0845, 0.0278) + lobe(nm, 0.681, 459.0, 0.0385, 0.0725)};
}

Xyz blackBody(double kelvin) {
  constexpr double kSecondRadiation = 1.4387769e7;  // hc/k in nm K (CODATA 2018)
  Xyz sum;
  for (double nm = 360; nm <= 830; nm += 2) {
    const double planck = std::pow(nm / 560, -5) / std::expm1(kSecondRadiation / (nm * kelvin));
    const Xyz o = observer(nm);
    sum.x += planck * o.x, sum.y += planck * o.y, sum.z += planck * o.z;
  }
  return sum;
}

}  // namespace

Vec2 blackBodyChromaticity(double kelvin) {
  const Xyz c = blackBody(kelvin);
  const double sum = c.x + c.y + c.z;
  return {static_cast<float>(c.x / sum), static_cast<float>(c.y / sum)};
}

Vec3 blackBodyColour(double kelvin) {
  const Xyz c = blackBody(kelvin);
  const double x = c.x / c.y, z = c.z / c.y;
  // IEC 61966-2-1: XYZ (D65) to linear Rec.709.
  const Vec3 rgb{static_cast<float>(std::max(0.0, 3.2404542 * x - 1.5371385 - 0.4985314 * z)),
                 static_cast<float>(std::max(0.0, -0.9692660 * x + 1.8760108 + 0.0415560 * z)),
                 static_cast<float>(std::max(0.0, 0.0556434 * x - 0.2040259 + 1.0572252 * z))};
  return rgb / luminance(rgb);
}

}  // namespace roomlight
