// Pictures of parts of a whole.
#pragma once

#include <vector>

#include "base/image.h"

namespace roomlight {

// Makes the sum of the parts the whole, in each pixel and channel. What is missing or too much goes to parts by the
// squares of what they have, as is best where each is off by like fractions of its own (least squares): the bright ones
// take it, dim ones stay as they are. Where parts have nothing of a channel they get of it what they have of all
// channels, else of all the picture.
void splitLike(const Image& whole, std::vector<Image>& parts);

}  // namespace roomlight
