// What falls on the surfaces of a picture.
#pragma once

#include "base/image.h"
#include "trace/ray_scene.h"

namespace roomlight::view {

// Illuminance in lx in every channel, of a picture in cd/m² whose surfaces are whitened (PictureWish::white). Negative
// where there is none to tell: sky, glass, gauze, what shines by itself.
Image illuminancePicture(const RayScene& rays, const Camera& camera, const Image& light);

}  // namespace roomlight::view
