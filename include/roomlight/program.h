// The commands of the program `roomlight`, for programs that offer them as their own.
#pragma once

#include "roomlight/basics.h"

namespace ROOMLIGHT_NAMESPACE {

// Runs a command as the program does and returns its exit status: 0 where all went well. `argv`: the program's name,
// then the words of the command line. Writes to stdout and stderr, and takes SIGINT and SIGTERM while it works, so a
// process runs one at a time. Commands that start others (`batch run`) start the program that runs, with the command's
// words.
ROOMLIGHT_API int runProgram(int argc, const char* const* argv);

}  // namespace ROOMLIGHT_NAMESPACE
