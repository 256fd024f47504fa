// What was typed, before it is read: commands and options that there are none of, and what may have been meant.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace roomlight::cli {

// The candidate that fewest edits make of the word (letters changed, left out, added or swapped: Damerau and
// Levenshtein), if they are at most a third of its letters; else empty.
std::string nearestWord(const std::string& word, const std::vector<std::string>& candidates);

// The error, one line, says which word is unknown and what may have been meant. A file in the place of a command: how
// to see it.
Status checkWords(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace roomlight::cli
