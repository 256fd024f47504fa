// EULUMDAT photometric files (.ldt; Stockmar 1990 and 1998), all symmetries.
#pragma once

#include <string_view>

#include "base/result.h"
#include "photometry/ies.h"

namespace roomlight {

// As parseIes does. Intensities in cd/klm are multiplied by the flux of the first set of lamps.
Result<WebFile> parseEulumdat(std::string_view text);

}  // namespace roomlight
