// Light that an eye or a lens scatters around what shines.
#pragma once

#include "base/image.h"

namespace roomlight {

// `share` of every pixel's light goes to those around it, near ones more: as much to rings of twice the radius as to
// those within. Light is kept but for what leaves the picture.
void addGlare(Image& image, float share);

}  // namespace roomlight
