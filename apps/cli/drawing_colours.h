// How parts of plans look that are no light, encoded in sRGB.
#pragma once

#include "base/vec.h"

namespace roomlight::cli {

inline constexpr Vec3 kSectionColour{0.2f, 0.2f, 0.22f}, kPaperColour{1, 1, 1};

}  // namespace roomlight::cli
