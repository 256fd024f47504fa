// From luminance in cd/m² to display values 0..1: exposure, then a tone curve, then the sRGB transfer function.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/tone_curves.h"

namespace roomlight {

enum class ToneCurve {
  PbrNeutral,  // Khronos PBR neutral (Khronos specification, 2024)
  AgX,         // AgX base look (Sobotka 2022), polynomial fit
  Filmic,      // ACES-like filmic curve (Narkowicz 2015) of the largest channel, so that hues stay
  Clip         // no curve: clip to 0..1; what error measures use
};

// A curve, and what is done to exposed light before it.
struct Tone {
  ToneCurve curve = ToneCurve::PbrNeutral;
  float contrast = 1;    // exponent of luminance about middle grey
  float saturation = 1;  // factor of what differs from grey
  Tone() = default;
  Tone(ToneCurve c, float withContrast = 1, float withSaturation = 1)
      : curve(c), contrast(withContrast), saturation(withSaturation) {}
  bool plain() const { return contrast == 1 && saturation == 1; }
};

// What curves are called in options, messages and files: "neutral", ... The default first.
std::vector<std::string> toneCurveNames();
Result<ToneCurve> toneCurveFromName(std::string_view name);  // errors: an unknown name; the line lists those there are
std::string_view toneCurveName(ToneCurve curve);

// The factor by which cd/m² are multiplied so that the saturation-based exposure of EV100 maps its maximum
// luminance 1.2 * 2^EV100 to 1 (ISO 12232, Lagarde & de Rousiers 2014, section 4.1).
float exposureFromEv100(float ev100);

// EV100 that puts the picture's geometric mean luminance (darkest and brightest percent left out) at 18 % grey after
// exposure; deterministic, and the same for every technique up to the noise in the picture.
float automaticEv100(const Image& luminanceImage);

float srgbDecode(float encoded);  // of srgbEncode (base/tone_curves.h)

// Exposed, tone-mapped and encoded, every channel in 0..1.
Image toneMap(Image image, float ev100, const Tone& tone);

}  // namespace roomlight
