// Light sources of a home's lamps.
#pragma once

#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"

namespace roomlight::importers::sh3d {

// A light of power p sends out p times `lumenAtFullPower`, shared by its sources as bright as their colours are: a ball
// of the source's diameter at its place in the piece's box, or a point where it has none. Without sources, the parts
// that its lightSourceMaterials name glow evenly. `firstInstance`: the instances from there on are the light's own.
// Throws Failure.
void addLight(const Home& home, const Piece& piece, size_t firstInstance, double lumenAtFullPower, Draft& draft);

}  // namespace roomlight::importers::sh3d
