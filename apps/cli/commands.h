// The program's commands. Each adds itself to the parser; what it returns is the program's exit status.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "exit_status.h"

namespace roomlight::cli {

using Command = std::function<int()>;

// Each returns the subcommand and what to run when the user asked for it. Options are bound to memory that the command
// owns, so a Command may be kept for as long as the parser.
struct Registered {
  CLI::App* app;
  Command run;
};
Registered addRender(CLI::App& program);
Registered addMeasure(CLI::App& program);
Registered addCompare(CLI::App& program);
Registered addDevelop(CLI::App& program);
Registered addInfo(CLI::App& program);
Registered addDoctor(CLI::App& program);
Registered addMix(CLI::App& program);
Registered addWalk(CLI::App& program);
Registered addValidate(CLI::App& program);
Registered addStudy(CLI::App& program);
Registered addOptimise(CLI::App& program);
Registered addView(CLI::App& program);
Registered addBake(CLI::App& program);
Registered addBatch(CLI::App& program);

// All of them, with what they have in common: --memory, and no empty values.
std::vector<Registered> addCommands(CLI::App& program);

// What would be said of these words after `roomlight`: unknown commands and options, values that cannot be read. Runs
// nothing.
Status checkCommandLine(const std::vector<std::string>& words);

// Adds --memory, which takes effect as it is read: allocations beyond it fail, and the command ends with one line. Code
// and files that are mapped into memory do not count.
void addMemoryLimit(CLI::App& command);
// What to tell when memory has run out, with the limit where there is one.
std::string outOfMemoryWords();

// What was typed, before it is read: are there such commands and options? The error, one line, says which word is
// unknown and what may have been meant. A file in the place of a command: how to
// see it.
Status checkWords(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace roomlight::cli
