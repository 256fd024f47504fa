// The program's commands. Each adds itself to the parser; what it returns is the program's exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

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
Registered addMix(CLI::App& program);
Registered addWalk(CLI::App& program);
Registered addValidate(CLI::App& program);
Registered addStudy(CLI::App& program);
Registered addOptimise(CLI::App& program);
Registered addView(CLI::App& program);

}  // namespace roomlight::cli
