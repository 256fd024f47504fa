// Lights of formats that give them an intensity without a photometric unit.
#pragma once

#include <vector>

#include "import/foreign_model.h"

namespace roomlight::importers {

// In the model's axes, lengths times `metresPerUnit`. The brightest point, spot or area light is taken as a lamp of 800
// lm and the brightest directional one as a sun of 50000 lx, others of their kind in proportion; a warning says so.
void addForeignLights(const std::vector<ForeignLight>& lights, float metresPerUnit, Scene& scene, Warnings& warnings);

}  // namespace roomlight::importers
