// What falls on the surfaces of a picture.
#pragma once

#include "base/image.h"
#include "trace/ray_scene.h"

namespace roomlight::view {

// Illuminance in lx in every channel, of a picture in cd/m²: pi times luminance over reflectance, which is exact on matt surfaces and on the mean
// over gloss. Negative where that tells nothing: sky, glass, mirrors and metal, what shines by itself, what reflects under 3 %.
Image illuminancePicture(const RayScene& rays, const Camera& camera, const Image& light);

}  // namespace roomlight::view
