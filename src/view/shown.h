// From light to what a browser shows: exposure that follows like an eye, white balance and tone curve, or false
 // colours.
#pragma once

#include <optional>

#include "base/image.h"
#include "look/display.h"
#include "measure/false_colour.h"
#include "view/frame.h"
#include "view/message.h"

namespace roomlight::view {

// The usual look, with the fast local exposure.
Display displayOfFrames();

struct ViewDisplay {
  Display display = displayOfFrames();
  float compensationEv = 0;  // positive is brighter
  FalseColour falseColour = FalseColour::Off;
  std::optional<double> low, high;  // of the scale; none: by the picture
  bool white() const { return falseColour == FalseColour::Illuminance; }  // what is seen is whitened (scene/surface.h)
};
void apply(const DisplayChange& change, ViewDisplay& display);

// What the eye of a window is used to: automatic values go there over a fraction of a second.
struct Adaptation {
  std::optional<float> ev100;
  White white;
  void follow(float wantedEv100, const White& wanted, double seconds);
};

// `lightColour`: of the light in the picture, for the automatic white; `seconds`: since the window's last frame. Fills
// in the frame's exposure and white.
ByteImage showPicture(const Image& light, Vec3 lightColour, const ViewDisplay& display, double seconds, Adaptation& eye,
                      FrameInfo& info);
// `amounts`: lx or cd/m² in every channel; negative where there is none. Fills in the frame's scale.
ByteImage showAmounts(const Image& amounts, const ViewDisplay& display, FrameInfo& info);

}  // namespace roomlight::view
