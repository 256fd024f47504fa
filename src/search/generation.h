// What the methods share: designs are repaired, evaluated, counted and offered to the archive here and nowhere else.
#pragma once

#include <vector>

#include "search/front.h"
#include "search/search.h"

namespace roomlight::search {

// Random designs (Problem::draw), repaired. Each method draws its first generation from it.
Genomes randomDesigns(const Problem& problem, const State& state, size_t count);

// In parallel; nothing without Problem::repair.
void repairAll(const Problem& problem, Genomes& designs);

// Evaluates repaired designs, counts them and adds them to the archive. Returns objectives, design after design.
std::vector<double> evaluate(const Problem& problem, State& state, const Genomes& designs);

// The points at `order` alone, in that order.
Genomes pick(const Genomes& designs, const std::vector<size_t>& order);
std::vector<double> pick(const std::vector<double>& objectives, size_t objectivesEach,
                         const std::vector<size_t>& order);

// A method's two verbs: what stands after the first designs are evaluated, and a generation.
using Generation = void (*)(const Problem&, State&);
void nsga2Generation(const Problem& problem, State& state);
void hybridStart(const Problem& problem, State& state);
void hybridGeneration(const Problem& problem, State& state);
void pagmoGeneration(const Problem& problem, State& state);
void weightedGeneration(const Problem& problem, State& state);
void randomGeneration(const Problem& problem, State& state);

// weightedSum keeps a small population for each weighting, one after the other.
constexpr size_t kWeightedPopulation = 20;
std::vector<std::vector<double>> weightings(size_t objectives, size_t about);

// Of NSGA-II: winners of `count` binary tournaments by the crowded comparison.
std::vector<size_t> tournaments(const Ranking& ranking, const State& state, size_t count);

// Σ = 1, >= 0: more weight on the objectives in which the design is already good, so that a polish takes it on towards
// its part of the front (Deb and Goel 2001); then divided by the objectives' ranges.
std::vector<double> weightsFor(std::span<const double> objectives, const Range& range);

}  // namespace roomlight::search
