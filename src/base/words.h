// The word that somebody meant.
#pragma once

#include <string>
#include <vector>

namespace roomlight {

// The candidate that fewest edits make of the word (letters changed, left out, added or swapped: Damerau and
// Levenshtein), if they are at most a third of its letters; else empty.
std::string nearestWord(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace roomlight
