// What was typed, before it is read: commands and options that there are none of, and what may have been meant.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace roomlight::cli {

// The error, one line, says which word is unknown and what may have been meant. A file in the place of a command: how
// to see it.
Status checkWords(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace roomlight::cli
