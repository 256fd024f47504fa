#include "base/platform/process.h"

#if defined(__unix__) || defined(__APPLE__)

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

namespace roomlight {
namespace {

// Between fork and exec: only what is safe in a copy of a process that may have threads.
[[noreturn]] void become(char* const* argv, const char* folder, int out, int said, [[maybe_unused]] pid_t parent) {
  ::setpgid(0, 0);  // Ctrl-C is for the parent, which tells its children
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(StartedProcess::kNotStarted);
#endif
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out >= 0 ? out : nothing, STDOUT_FILENO);
  ::dup2(said, STDERR_FILENO);
  if (::chdir(folder) == 0) ::execv(argv[0], argv);
  ::_exit(StartedProcess::kNotStarted);
}

// Whose ends no child keeps and nobody waits at.
bool makePipe(int (&ends)[2]) {
#ifdef __linux__
  return ::pipe2(ends, O_CLOEXEC | O_NONBLOCK) == 0;
#else
  if (::pipe(ends) != 0) return false;
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC), ::fcntl(end, F_SETFL, O_NONBLOCK);
  return true;
#endif
}

double mebibytes(const rusage& used) {
#ifdef __APPLE__
  return static_cast<double>(used.ru_maxrss) / (1024 * 1024);
#else
  return static_cast<double>(used.ru_maxrss) / 1024;
#endif
}

}  // namespace

long processNumber() { return ::getpid(); }

// Field 22 of /proc/N/stat; the second is a name in parentheses, the third its state.
uint64_t processStart(long process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(in, line);
  const size_t name = line.rfind(')');
  if (name == std::string::npos || name + 2 >= line.size()) return 0;
  if (const char state = line[name + 2]; state == 'Z' || state == 'X') return 0;
  size_t at = name + 1;
  for (int field = 2; field < 21 && at != std::string::npos; ++field) at = line.find(' ', at + 1);
  return at == std::string::npos ? 0 : std::strtoull(line.c_str() + at, nullptr, 10);
}

StartedProcess::StartedProcess(StartedProcess&& o) noexcept
    : process_(std::exchange(o.process_, 0)), said_(std::exchange(o.said_, -1)) {}

StartedProcess::~StartedProcess() {
  if (process_ > 0) {
    kill();
    int status = 0;
    while (::waitpid(static_cast<pid_t>(process_), &status, 0) < 0 && errno == EINTR) {}
  }
  if (said_ >= 0) ::close(said_);
}

std::optional<StartedProcess> StartedProcess::start(const std::filesystem::path& program,
                                                    const std::vector<std::string>& arguments,
                                                    const std::filesystem::path& folder, int printed, int& error) {
  int ends[2];
  if (!makePipe(ends)) {
    error = errno;
    return std::nullopt;
  }
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const pid_t self = ::getpid(), child = ::fork();
  error = errno;
  if (child == 0) become(argv.data(), folder.c_str(), printed, ends[1], self);
  ::close(ends[1]);
  if (child > 0) return StartedProcess(child, ends[0]);
  ::close(ends[0]);
  return std::nullopt;
}

StartedProcess::Said StartedProcess::read(std::string& text) const {
  char block[1024];
  ssize_t n = -1;
  do {
    n = said_ < 0 ? -1 : ::read(said_, block, sizeof block);
  } while (said_ >= 0 && n < 0 && errno == EINTR);
  if (n <= 0) return n == 0 ? Said::Closed : Said::Nothing;
  text.append(block, static_cast<size_t>(n));
  return Said::Something;
}

std::optional<ProcessEnd> StartedProcess::end() {
  if (process_ <= 0) return std::nullopt;
  int status = 0;
  rusage used{};
  const pid_t got = ::wait4(static_cast<pid_t>(process_), &status, WNOHANG, &used);
  if (got == 0 || (got < 0 && errno == EINTR)) return std::nullopt;
  process_ = 0;
  ProcessEnd end;
  end.peakMiB = mebibytes(used);
  if (got < 0) return end;
  if (WIFSIGNALED(status)) {
    end.signal = WTERMSIG(status);
    end.signalName = ::strsignal(end.signal);
    end.wasKilled = end.signal == SIGKILL;
  } else {
    end.exitStatus = WEXITSTATUS(status);
  }
  return end;
}

void StartedProcess::kill() const {
  if (process_ <= 0) return;
  ::kill(static_cast<pid_t>(-process_), SIGKILL);
  ::kill(static_cast<pid_t>(process_), SIGKILL);  // not yet in its group
}

void waitForAny(std::span<const int> handles, int milliseconds) {
  std::vector<pollfd> all;
  for (const int handle : handles) all.push_back({handle, POLLIN, 0});
  ::poll(all.data(), static_cast<nfds_t>(all.size()), milliseconds);
}

int openForOutput(const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  return opened >= 0 ? opened : -errno;
}

void closeOutput(int file) { ::close(file); }

}  // namespace roomlight

#endif
