// This program, run once more as a process of its own.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace roomlight::cli {

// The file this program was started from.
std::filesystem::path thisProgram();

// Runs it with these arguments, its output thrown away. Where `cancelled` becomes true it is told to end (SIGTERM)
// until it does, and its result is an error; where the calling thread ends, it is told too (Linux). Errors: what it
// said on stderr last, without "roomlight: "; or that it was killed.
Status runThisProgram(const std::vector<std::string>& arguments, const std::atomic<bool>* cancelled = nullptr);

}  // namespace roomlight::cli
