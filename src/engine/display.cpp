#include "engine/display.h"

#include "base/parallel.h"
#include "photometry/white_balance.h"

namespace roomlight {

White whiteOf(const Display& display, Vec3 lightColour, float ev100) {
  if (display.whiteK) return {*display.whiteK, 1};
  if (!display.automaticWhite || isBlack(lightColour)) return {};
  // The luminance that the exposure makes a middle grey.
  return {nearestWhiteK(lightColour), degreeOfAdaptation(0.18 / static_cast<double>(exposureFromEv100(ev100)))};
}

Affine matrixOf(const White& white) { return white.degree == 0 ? Affine{} : whiteBalance(white.kelvin, white.degree); }

Image displayed(const Image& image, const Display& display, const White& white, float ev100) {
  if (white.degree == 0) return toneMap(image, ev100, display.tone);
  const Affine adapt = matrixOf(white);
  Image adapted(image.width, image.height);
  parallelFor(image.pixels.size(), 16384, [&](size_t i) { adapted.pixels[i] = adapt.vector(image.pixels[i]); });
  return toneMap(adapted, ev100, display.tone);
}

}  // namespace roomlight
