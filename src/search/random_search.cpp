// The simplest rival: nothing is learnt from one design to the next.
#include "search/generation.h"

namespace roomlight::search {

void randomGeneration(const Problem& problem, State& state) {
  state.population = randomDesigns(problem, state, state.settings.population);
  state.objectives = evaluate(problem, state, state.population);
}

}  // namespace roomlight::search
