// The command line as a function.
#pragma once

namespace roomlight::cli {

// Runs the command that these words are, the program's name first, and returns its exit status (exit_status.h). Results
// go to stdout, all else to stderr; SIGINT and SIGTERM are taken while a command runs.
int runProgram(int argc, const char* const* argv);

}  // namespace roomlight::cli
