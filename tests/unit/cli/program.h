// Runs the built program as a user does, and the small room it is run on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/room_file.h"
#include "unit/temporary_folder.h"

namespace roomlight::testing {

struct ProgramRun {
  int exitStatus = -1;
  std::string out, err;
};

// Runs `roomlight ARGUMENTS` with stdout and stderr in files, so neither is a terminal. With `interruptAt`, sends
// SIGINT as soon as stderr contains that text.
ProgramRun runProgram(const std::vector<std::string>& arguments, const std::string& interruptAt = "");

// The same with stdout where it is told: an open file, or closed.
constexpr int kClosed = -1;
ProgramRun runProgramInto(int out, const std::vector<std::string>& arguments, const std::string& interruptAt = "");

}  // namespace roomlight::testing
