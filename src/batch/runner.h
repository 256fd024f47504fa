// Runs tasks: each once, whatever happens to this process or machine.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "batch/claim.h"
#include "batch/task_list.h"

namespace roomlight::batch {

constexpr int kMostTries = 3;

struct RunWish {
  std::filesystem::path program;  // this one
  std::string version;            // which the plan must have been made for
  std::vector<size_t> tasks;      // numbers in the list
  int jobs = 1;                   // at once
  int cores = 1;                  // shared among them
  std::string lightCache;         // folder where tasks of this machine share light; empty: none
  double timeoutS = 0;            // of a task; 0: none
  double staleS = Claims::kUsualStaleS;
  bool again = false;             // tries anew what has failed for good
  bool wait = true;               // for tasks that others run
  const std::atomic<bool>* stop = nullptr;  // kills what runs and returns
  std::function<void(const std::string&)> tell;  // of tasks that fail, with their line
};

struct RunResult {
  size_t done = 0;       // by this run
  size_t already = 0;    // by an earlier one or by another process
  size_t failed = 0;     // for good
  size_t left = 0;       // not begun, stopped, or run by others still
  double workSeconds = 0;  // of commands
  bool stopped = false;
};

// The error is what ends all: a full disk, a folder that cannot be written, a plan of another version.
Result<RunResult> runTasks(const TaskList& list, const RunWish& wish);

}  // namespace roomlight::batch
