// A search as text, to go on later: every number comes back bit by bit.
#pragma once

#include <string>
#include <string_view>

#include "search/search.h"

namespace roomlight::search {

// JSON of some 20 bytes a number: with 50 variables, 100 designs and 500 in the archive about 0.6 MB and 5 ms.
std::string toJson(const State& state);

// `where` begins the error's line. Errors: not such JSON, another version, designs that do not fit the problem.
// The budget (Settings::evaluations, seconds) may be raised afterwards; every other setting stays that of the first
// run.
Result<State> stateFromJson(std::string_view text, const Problem& problem, const std::string& where);

}  // namespace roomlight::search
