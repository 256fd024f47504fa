// One search by any of the methods, a generation at a time:
//
//     Settings settings{.method = Method::hybrid, .seed = 7, .evaluations = 200'000};
//     State state = start(problem, settings);               // check(problem, settings) first
//     run(problem, state, progress, [&](const State& s) { ... s.archive ... s.evaluations ... });
//     state.archive.designs, state.archive.objectives        // the front
//
// The same seed gives the same front with any number of threads, and after any number of stops in between.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "search/archive.h"
#include "search/methods.h"

namespace roomlight::search {

// Everything a search knows, as plain data. Random numbers are keyed by seed, generation and place, so there is no
// state of a generator.
struct State {
  Settings settings;
  size_t generation = 0;
  size_t evaluations = 0;  // of designs, polishing included
  size_t polished = 0;           // designs
  size_t polishEvaluations = 0;  // what polishing took of `evaluations`
  double seconds = 0;      // wall time, over all stops
  Genomes population;
  std::vector<double> objectives;  // of the population
  Archive archive;
};

// Evaluates the first generation: `first`, repaired (designs known to be good; at most a population), and random ones.
State start(const Problem& problem, const Settings& settings, const Genomes& first = {});

// No budget is left.
bool finished(const State& state);

// One more generation. Never ends amid one: the last may exceed the budget by less than a generation.
void advance(const Problem& problem, State& state);

// Advances until finished or told to stop; reports the fraction of the budget. `watch` is called after every
// generation.
void run(const Problem& problem, State& state, const Progress& progress = {},
         const std::function<void(const State&)>& watch = {});

// Of the budget, by evaluations or by time, whichever is further; seconds left by the pace so far.
double fractionDone(const State& state);
double secondsLeft(const State& state);

// A search as text, to go on later: every number comes back bit by bit. JSON of some 20 bytes a number: with 50
// variables, 100 designs and 500 in the archive about 0.6 MB and 5 ms.
std::string toJson(const State& state);

// `where` begins the error's line. Errors: not such JSON, another version, designs that do not fit the problem.
// The budget (Settings::evaluations, seconds) may be raised afterwards; every other setting stays that of the first
// run.
Result<State> stateFromJson(std::string_view text, const Problem& problem, const std::string& where);

}  // namespace roomlight::search
