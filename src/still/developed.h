// How a rendered picture is shown: exposed by what matters in it, with what is no light drawn in.
#pragma once

#include <optional>
#include <vector>

#include "base/image_io.h"
#include "engine/render.h"
#include "look/display.h"

namespace roomlight {

// How parts of plans look that are no light, encoded in sRGB.
inline constexpr Vec3 kSectionColour{0.2f, 0.2f, 0.22f}, kPaperColour{1, 1, 1};

// Metadata of linear pictures: what to balance them by, linear Rec.709.
constexpr const char* kLightColourKey = "roomlight.lightColour";
// Of the light in a picture, as it was written; none: it does not say.
std::optional<Vec3> lightColourIn(const Metadata& metadata);

struct Development {
  Display display;
  White white;
  float ev100 = 0;
  std::vector<bool> rooms;  // of plans: the pixels inside rooms, which they are exposed by; empty: every other picture
};
// `scene`: as opened, whole.
Development developmentOf(const Scene& scene, const Camera& camera, const Rendered& rendered, const Display& display);

// Encoded in sRGB. `paper`: what is seen where there is nothing; none: colours as a writer of opacity wants them.
Image developed(const Rendered& rendered, const Development& how, std::optional<Vec3> paper);

// Of each pixel, 0 to 1; empty: all are opaque.
std::vector<float> opacityOf(const Rendered& rendered, const Camera& camera);

}  // namespace roomlight
