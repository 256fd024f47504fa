// A web's own flux against what its file states.
#pragma once

#include "photometry/photometric_text.h"
#include "photometry/photometric_web.h"

namespace roomlight::photometric {

// More than 2 % off is an oddity with both numbers. `whose`: the flux is that of "its lamps" or "the luminaire". A web
// without light is damage.
void checkFlux(const PhotometricWeb& web, const std::string& whose, Oddities& odd);

}  // namespace roomlight::photometric
