// How deep TOML is nested, found before it is parsed: parsers and trees go down by recursion.
#pragma once

#include <cstddef>
#include <string_view>

namespace roomlight::optimise {

// The line, from 1, where more than `most` tables and lists lie inside each other, made by headers, dotted keys or
// brackets; 0: nowhere. Of text that is no TOML it follows as much as could be.
int lineTooDeep(std::string_view text, size_t most);

}  // namespace roomlight::optimise
