// A command of this program as a process of its own, which ends when its parent does.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "base/platform/process.h"
#include "base/result.h"

namespace roomlight::batch {

struct Ended {
  bool isDone = false;             // exit status 0
  std::string how, line;           // else "exit", "signal", "memory" or "time", and one line of why
  int exitStatus = -1;             // -1: none
  double seconds = 0, peakMiB = 0;
};

// It is killed, where it still runs, when its object goes.
class Child {
 public:
  // `program` with these words in this folder. What it prints goes to `printed`, or nowhere where that is empty. To be
  // called from the thread that lives as long as the child shall: its end kills the child.
  static Result<Child> start(const std::filesystem::path& program, const std::vector<std::string>& words,
                             const std::filesystem::path& folder, const std::filesystem::path& printed);
  Child(Child&&) noexcept = default;
  Child& operator=(Child&&) = delete;

  // For waitForAny().
  int handle() const { return process_.handle(); }
  double seconds() const;
  // Takes what it has said; true once it has ended.
  bool hasEnded();
  // Kills it with all that it has started. `why`: what to tell instead of the signal, such as "took longer than 60 s".
  void kill(const std::string& why);
  const Ended& ended() const { return ended_; }

 private:
  explicit Child(StartedProcess process);
  void judge(const ProcessEnd& end);

  StartedProcess process_;
  uint64_t outOfMemoryBefore_ = 0;
  std::string text_, why_;
  std::chrono::steady_clock::time_point started_;
  Ended ended_;
};

// Runs it to its end, its output thrown away. Where `cancelled`, if given, becomes true it is killed. Errors: what it
// said last, that it was killed, or "interrupted".
Status runToItsEnd(const std::filesystem::path& program, const std::vector<std::string>& words,
                   const std::filesystem::path& folder, const std::atomic<bool>* cancelled = nullptr);

}  // namespace roomlight::batch
