// Work that a hostile file could make crash, loop or fill the memory, in a program of its own. It is started anew: the
// forked copy of a process with threads may wait for ever for a lock that one of them held.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "import/file_access.h"

namespace roomlight::importers {

// The program roomlight-model-reader: what the environment's ROOMLIGHT_MODEL_READER names, else beside this program, or
// in ../libexec/roomlight.
std::filesystem::path modelReader();

// What the program writes to stdout, called with these arguments and with `input` as stdin; for programs that call
// serveParent(). Throws Failure: what `work` threw there, or that it crashed, met a limit or cannot be started.
Bytes inChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     std::span<const uint8_t> input);

// The program's side: what `work` makes of stdin goes to stdout, within limits of time (60 s of a core, 120 s) and
// memory (8 GiB beside the program itself). Whatever else is said on stdout goes to stderr. First thing in main, as the
// limits begin here.
[[noreturn]] void serveParent(const std::function<Bytes(const Bytes& input)>& work);

}  // namespace roomlight::importers
