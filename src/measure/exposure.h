// What a photographer's light meter shows.
#pragma once

#include <cmath>

namespace roomlight {

// EV at ISO 100 of an incident meter with a flat receptor (C = 250, ISO 2720): 300 lx is 6.91.
inline double incidentEv100(double illuminanceLux) { return std::log2(illuminanceLux / 2.5); }

// EV at ISO 100 of a reflected-light meter (K = 12.5, ISO 2720): 17.19 cd/m² is 7.10.
inline double reflectedEv100(double luminanceCdM2) { return std::log2(8 * luminanceCdM2); }

}  // namespace roomlight
