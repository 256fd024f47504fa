// Processes that this one starts, and this one as the child of another. Errors are the system's numbers (errno).
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace roomlight {

long processNumber();  // of this one

// When a process of this machine started, in the system's own unit; 0: there is none, or it is dead and only waits for
// its parent to ask.
uint64_t processStart(long process);

struct ProcessEnd {
  int exitStatus = -1;     // -1: it has none
  int signal = 0;          // that ended it; 0: none did. With neither the process was lost
  std::string signalName;
  bool wasKilled = false;  // by the one signal that cannot be caught
  double peakMiB = 0;
};

// A program in a group of its own, so that Ctrl-C does not reach it. It ends when the thread ends that started it
// (Linux), and when this object does.
class StartedProcess {
 public:
  static constexpr int kNotStarted = 127;  // exit status where the program itself could not be started

  // Its stdin is empty; stdout goes to `printed`, or nowhere where that is negative; stderr comes here. `error`: why it
  // could not be.
  static std::optional<StartedProcess> start(const std::filesystem::path& program,
                                             const std::vector<std::string>& arguments,
                                             const std::filesystem::path& folder, int printed, int& error);
  StartedProcess(StartedProcess&& other) noexcept;
  StartedProcess& operator=(StartedProcess&&) = delete;
  ~StartedProcess();  // kills it where it still runs

  enum class Said { Nothing, Something, Closed };
  // Appends some of what it has said on stderr since, without waiting.
  Said read(std::string& text) const;
  // Once: how it ended, if it has by now.
  std::optional<ProcessEnd> end();
  bool hasEnded() const { return process_ == 0; }
  void kill() const;  // with all that it has started
  int handle() const { return said_; }

 private:
  StartedProcess(long process, int said) : process_(process), said_(said) {}

  long process_ = 0;  // 0: has ended
  int said_ = -1;
};

// Waits until one of the processes of these handles has said something or ended, at most so long.
void waitForAny(std::span<const int> handles, int milliseconds);

// A file to write to, made or emptied; children get it only as their stdout. Negative: errno, negated.
int openForOutput(const std::filesystem::path& file);
void closeOutput(int file);

// Starts a program of the search path without a stream and goes on.
void startQuietly(const std::string& program, std::string argument);

// A program that gets `input` as its stdin, no other files and signals as a new program expects them, run to its end.
struct RunToEnd {
  bool isStarted = false;
  int error = 0;  // why it is not; 0: there is no room for its input
  int exitStatus = -1;  // -1: it ended otherwise
  std::optional<std::vector<uint8_t>> output;  // what it wrote to stdout; none where it cannot be read back
};
// The output is read where the program ends with one of the statuses `withOutput`.
RunToEnd runWithInput(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      std::span<const uint8_t> input, std::initializer_list<int> withOutput);

// A command of the shell, run to its end.
struct ShellCommand {
  bool isDone = false;  // with status 0
  std::string text;  // both streams, without line ends at its end
};
ShellCommand runInShell(const std::string& command);

// The side of such a program. Without a memory image (core) either.
struct ProcessLimits {
  unsigned coreSeconds = 0, seconds = 0;
  uint64_t memoryBytes = 0;  // beside what the process has by now, which is much in builds with sanitizers
};
void limitThisProcess(const ProcessLimits& limits);
// A file that leads to what is stdout; whatever else is said there goes to stderr from then on. Negative: cannot be.
int takeOverOutput();
std::optional<std::vector<uint8_t>> readInput();  // all of it; none where it cannot be read
bool writeAll(int file, std::span<const uint8_t> bytes);

}  // namespace roomlight
