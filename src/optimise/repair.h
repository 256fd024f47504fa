// Designs that keep what must hold.
#pragma once

#include "optimise/model.h"

namespace roomlight::optimise {

// Takes lamps out until those left keep their distance, the most of their rule, and the limits of watts, cost and
// fittings: lamps that are dimmed least stay, of equal ones those of earlier places. A design that keeps all of it
// stays as it is.
void repair(const Model& model, search::Genome design);

// What a design breaks, in words; empty: nothing.
std::string brokenBy(const Model& model, search::ConstGenome design);

}  // namespace roomlight::optimise
