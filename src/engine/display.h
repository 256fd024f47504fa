// How pictures in cd/m² are shown: exposure, white balance, tone curve (docs/conventions.md, exposure and display).
#pragma once

#include <optional>

#include "base/image.h"
#include "base/tone.h"

namespace roomlight {

struct Display {
  std::optional<float> ev100;  // none: automatic
  ToneCurve tone = ToneCurve::PbrNeutral;
  bool automaticWhite = true;
  std::optional<double> whiteK;  // none, and not automatic: no white balance
};

// What display pictures are adapted by: a temperature taken for white, and how far the eye goes along.
struct White {
  double kelvin = 0, degree = 0;
};
// `lightColour`: of the light in the picture, black where it is not known.
White whiteOf(const Display& display, Vec3 lightColour, float ev100);

// A picture in cd/m², exposed, white-balanced and tone-mapped.
Image displayed(const Image& image, const Display& display, const White& white, float ev100);

// The matrix of a white; that of no white changes nothing.
Affine matrixOf(const White& white);

}  // namespace roomlight
