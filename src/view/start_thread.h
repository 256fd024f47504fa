// How threads are started: in one place, so that a test can be one on which there are no more.
#pragma once

#include <functional>
#include <system_error>
#include <thread>

#include "base/result.h"

namespace roomlight::view {

// A thread that does the work; throws std::system_error where there is none to be had.
using StartThread = std::function<std::thread(std::function<void()> work)>;

// The system's.
std::thread systemThread(std::function<void()> work);

// In one line: why there is no thread, and what to do.
std::string noThreadWords(const std::system_error& e);

// Error: there is no thread, and nothing was begun.
Result<std::thread> tryToStart(const StartThread& start, std::function<void()> work);

}  // namespace roomlight::view
