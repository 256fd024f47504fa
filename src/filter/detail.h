// Noise that passes made of independent pixels is correlated and looks like clouds. A filter that believes in all of it takes clouds away, and with them slopes of the light and wide soft
// shadows. So diffuse light is filtered twice, with doubt (narrow) and without (wide), and the wide one's light is corrected by the mean of what the narrow one shows beside it, over what lies
// on one surface: over so many pixels clouds are gone.
#pragma once

#include <vector>

#include "filter/filter_kernel.h"

namespace roomlight {

// How far passes look that pool what is near, in pixels.
std::vector<int> poolSteps();

// Sets diffuse light of row y, as the narrow filter left it, aside.
void keepNarrow(FilterRows& rows, const FilterPass& pass, int y);
// What it shows beside the wide filter's light, for pooling.
void takeDetail(FilterRows& rows, const FilterPass& pass, int y);
// Adds the pooled detail to the wide filter's light; `place`: where it is.
void addMeanDetail(FilterRows& rows, const FilterPass& pass, int place, int y);

}  // namespace roomlight
