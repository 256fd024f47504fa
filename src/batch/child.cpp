#include "batch/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <thread>

#include "base/utf8.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostKept = 4000;  // of what it says
constexpr int kNotStarted = 127;
constexpr int kOutOfMemory = 3;  // exit status of this program
constexpr int kInterrupted = 130;
constexpr size_t kLongestLine = 400;

// The last line, without the program's name.
std::string lastLine(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  const size_t from = text.rfind('\n');
  std::string_view line = from == std::string_view::npos ? text : text.substr(from + 1);
  constexpr std::string_view kName = "roomlight: ";
  if (line.starts_with(kName)) line.remove_prefix(kName.size());
  return printable(asUtf8(line), kLongestLine);
}

// How often the kernel has killed for want of memory in this process's control group.
uint64_t outOfMemoryKills() {
  std::ifstream group("/proc/self/cgroup");
  std::string line;
  while (std::getline(group, line)) {
    if (!line.starts_with("0::")) continue;
    std::ifstream events("/sys/fs/cgroup" + line.substr(3) + "/memory.events");
    std::string name;
    for (uint64_t count = 0; events >> name >> count;) {
      if (name == "oom_kill") return count;
    }
  }
  return 0;
}

// Between fork and exec: only what is safe in a copy of a process that may have threads.
[[noreturn]] void become(char* const* argv, const char* folder, int out, int said, [[maybe_unused]] pid_t parent) {
  setpgid(0, 0);  // Ctrl-C is for the runner, which tells its children
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNotStarted);
#endif
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(out >= 0 ? out : nothing, STDOUT_FILENO);
  dup2(said, STDERR_FILENO);
  if (chdir(folder) == 0) execv(argv[0], argv);
  _exit(kNotStarted);
}

Error notStarted(int reason) { return {fmt::format("a process cannot be started: {}", std::strerror(reason))}; }

}  // namespace

Child::Child(pid_t process, int said)
    : process_(process),
      said_(said),
      outOfMemoryBefore_(outOfMemoryKills()),
      started_(std::chrono::steady_clock::now()) {}

Child::Child(Child&& o) noexcept
    : process_(std::exchange(o.process_, 0)),
      said_(std::exchange(o.said_, -1)),
      outOfMemoryBefore_(o.outOfMemoryBefore_),
      text_(std::move(o.text_)),
      why_(std::move(o.why_)),
      started_(o.started_),
      ended_(std::move(o.ended_)) {}

Child::~Child() {
  if (process_ > 0) {
    kill("is not wanted any more");
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {}
  }
  if (said_ >= 0) close(said_);
}

Result<Child> Child::start(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& folder,
                           const fs::path& printed) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return notStarted(errno);
  int out = -1;
  if (!printed.empty()) out = open(printed.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (!printed.empty() && out < 0) {
    const int reason = errno;
    close(ends[0]), close(ends[1]);
    return Error{fmt::format("{}: cannot be written: {}", printed.string(), std::strerror(reason))};
  }
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const pid_t self = getpid(), child = fork();
  const int reason = errno;
  if (child == 0) become(argv.data(), folder.c_str(), out, ends[1], self);
  if (out >= 0) close(out);
  close(ends[1]);
  if (child > 0) return Child(child, ends[0]);
  close(ends[0]);
  return notStarted(reason);
}

double Child::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

bool Child::hasEnded() {
  char block[1024];
  bool atEnd = false;
  while (said_ >= 0) {
    const ssize_t n = read(said_, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      atEnd = n == 0;
      break;
    }
    text_.append(block, static_cast<size_t>(n));
    if (text_.size() > 2 * kMostKept) text_.erase(0, text_.size() - kMostKept);
  }
  if (process_ == 0) return true;
  int status = 0;
  rusage used{};
  const pid_t got = wait4(process_, &status, WNOHANG, &used);
  if (got == 0 || (got < 0 && errno == EINTR)) {
    if (atEnd) usleep(500);  // it is about to end, or has closed stderr
    return false;
  }
  ended_.seconds = seconds(), ended_.peakMiB = static_cast<double>(used.ru_maxrss) / 1024;
  process_ = 0;
  judge(got < 0 ? -1 : status);
  return true;
}

void Child::kill(const std::string& why) {
  if (process_ <= 0) return;
  if (why_.empty()) why_ = why;
  ::kill(-process_, SIGKILL);
  ::kill(process_, SIGKILL);  // not yet in its group
}

void Child::judge(int status) {
  const std::string said = lastLine(text_);
  Ended& e = ended_;
  if (!why_.empty()) {
    e.how = "time", e.line = why_;
  } else if (status == -1) {
    e.how = "signal", e.line = "the process was lost";
  } else if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    const bool starved = number == SIGKILL && outOfMemoryKills() > outOfMemoryBefore_;
    e.how = starved ? "memory" : "signal";
    e.line = starved ? "killed by the system: out of memory"
                     : fmt::format("killed by signal {} ({})", number, strsignal(number));
    if (number == SIGKILL && !starved) e.line += ", by hand or for want of memory";
  } else {
    e.exitStatus = WEXITSTATUS(status);
    e.isDone = e.exitStatus == 0;
    e.how = e.exitStatus == kOutOfMemory ? "memory" : e.exitStatus == kInterrupted ? "signal" : "exit";
    e.line = e.exitStatus == kNotStarted ? "the program cannot be started"
             : said.empty()              ? fmt::format("ended with status {}", e.exitStatus)
                                         : said;
  }
}

Status runToItsEnd(const std::filesystem::path& program, const std::vector<std::string>& words,
                   const std::filesystem::path& folder, const std::atomic<bool>* cancelled) {
  constexpr auto kAskEvery = std::chrono::milliseconds(20);
  Result<Child> child = Child::start(program, words, folder, {});
  if (!child) return Error{child.error()};
  while (!child.value().hasEnded()) {
    if (cancelled && *cancelled) child.value().kill("interrupted");
    std::this_thread::sleep_for(kAskEvery);
  }
  const Ended& ended = child.value().ended();
  return ended.isDone ? Status(Ok{}) : Error{ended.line};
}

}  // namespace roomlight::batch
