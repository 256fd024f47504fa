// How pictures in cd/m² are shown: exposure, white balance, tone curve (docs/reference/conventions.md, exposure and
// display).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/tone.h"

namespace roomlight {

constexpr double kUsualWarmth =
    0.05;  // how much of the way from daylight to lamp light an automatic white balance leaves

struct Display {
  std::optional<float> ev100;  // none: automatic
  float brighterEv = 0;        // than the automatic exposure
  Tone tone;
  bool automaticWhite = true;
  std::optional<double> whiteK;  // of what shall be white; none, and not automatic: no white balance
  std::optional<double> warmth;  // of automatic white: share of the light's own warmth that is kept, 0 to 1; none:
 // kUsualWarmth and a little
  float localExposure = 0;  // 0: none, 1: shadows are opened by up to two stops and highlights held by up to five
  bool quickLocalExposure = false;  // approximate but fast; for frames of view
  float glare = 0;  // share of the light that the eye or lens scatters around what shines
  float vignette = 0;  // how much darker the corners are, 0 to 1
};

// What display pictures are adapted by.
struct White {
  Vec3 gains{1, 1, 1};  // of linear Rec.709
  double kelvin = 0;  // nearest temperature of the light that is taken for white; 0: none is
};
// `lightColour`: of the light in the picture, black where it is not known. Light and reflectance are multiplied channel
// by channel in Rec.709, so gains in the same space give surfaces the colours they have under D65. Light that is far
// from any white keeps its colour.
White whiteOf(const Display& display, Vec3 lightColour);

// A white of luminance 1, and what a surface that is white shows under it: whiteOf() for programs that reckon
// themselves (pages of baked homes). Linear Rec.709.
struct ShownWhite {
  Vec3 light, shown;
};
// From the warmest white to the bluest; empty where white is not automatic.
std::vector<ShownWhite> shownWhites(const Display& display);

// What a look does to places of a picture before it is exposed as a whole: linear in light, so that it holds for each
// layer of a mix as for their sum.
struct Retouch {
  Plane gains;  // of local exposure, one a pixel; empty: none
  float glare = 0, vignette = 0;
};
// `adapted`: white-balanced already; `ev100`: what it will be exposed by.
Retouch retouchOf(const Image& adapted, const Display& display, float ev100);
void retouch(Image& image, const Retouch& by);

// A picture in cd/m², exposed, white-balanced, tone-mapped and encoded. Values carry a noise below the last of 8 bits,
// the same in every run, against bands.
Image displayed(const Image& image, const Display& display, const White& white, float ev100);

// As the display says, or automatic.
float ev100Of(const Display& display, const Image& image);

// The gains as a matrix.
Affine matrixOf(const White& white);

// Looks: settings of Display that go together, by name. "natural", "bright", "evening", "technical", each with a line
// of explanation.
const std::vector<std::pair<std::string, std::string>>& lookNames();

Display usualDisplay();  // "natural"

// The error names them.
Result<Display> displayOfLook(const std::string& name);

// Light that an eye or a lens scatters around what shines. `share` of every pixel's light goes to those around it, near
// ones more: as much to rings of twice the radius as to those within. Light is kept but for what leaves the picture.
void addGlare(Image& image, float share);

}  // namespace roomlight
