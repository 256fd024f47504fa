#include "still/developed.h"

#include <sstream>

#include "engine/views.h"
#include "look/exposure.h"

namespace roomlight {

std::optional<Vec3> lightColourIn(const Metadata& metadata) {
  const auto found = metadata.find(kLightColourKey);
  if (found == metadata.end()) return std::nullopt;
  std::istringstream text(found->second);
  Vec3 colour;
  return text >> colour.x >> colour.y >> colour.z ? std::optional(colour) : std::nullopt;
}

Development developmentOf(const Scene& scene, const Camera& camera, const Rendered& rendered, const Display& display) {
  const Image& image = rendered.image;
  Development how{display, {}, 0, roomMask(scene, camera, image.width, image.height)};
  how.ev100 = ev100Of(display, how.rooms.empty() ? image : pixelsWhere(image, how.rooms, true));
  how.white = whiteOf(display, rendered.lightColour);
  return how;
}

Image developed(const Rendered& rendered, const Development& how, std::optional<Vec3> paper) {
  Image light = unmixed(rendered.image, rendered.sights);
  if (!how.rooms.empty()) holdGrounds(light, how.rooms, how.ev100);
  return drawn(displayed(light, how.display, how.white, how.ev100), rendered.sights, kSectionColour, paper);
}

std::vector<float> opacityOf(const Rendered& rendered, const Camera& camera) {
  std::vector<float> opacity;
  if (!camera.emptyBackdrop) return opacity;
  for (const float nothing : rendered.sights.backdrop) opacity.push_back(1 - nothing);
  return opacity;
}

}  // namespace roomlight
