// --memory of every command: more than that is refused by the system, and the command ends with one line.
#pragma once

#include <string>

#include "commands.h"

namespace roomlight::cli {

// Adds --memory, which takes effect as it is read: allocations beyond it fail. Code and files that are mapped into
// memory do not count.
void addMemoryLimit(CLI::App& command);
// What to tell when memory has run out, with the limit where there is one.
std::string outOfMemoryWords();

}  // namespace roomlight::cli
