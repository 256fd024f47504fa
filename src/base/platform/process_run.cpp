// What process.h says of programs that get an input and give an output.
#include "base/platform/process.h"

#if defined(__unix__) || defined(__APPLE__)

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>

extern char** environ;

namespace roomlight {
namespace {

using Bytes = std::vector<uint8_t>;

// All from where the file stands to its end; none where it cannot be read.
std::optional<Bytes> readAll(int file) {
  struct stat about {};
  const bool known = ::fstat(file, &about) == 0 && about.st_size > 0;
  Bytes bytes(known ? static_cast<size_t>(about.st_size) + 1 : 0);
  for (size_t filled = 0;;) {
    if (filled == bytes.size()) bytes.resize(filled + (size_t{1} << 16));
    const ssize_t got = ::read(file, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    filled += static_cast<size_t>(got);
    if (got > 0) continue;
    bytes.resize(filled);
    return bytes;
  }
}

int openUnnamed() {
#ifdef __linux__
  return ::memfd_create("roomlight", MFD_CLOEXEC);
#else
  std::string name = (std::filesystem::temp_directory_path() / "roomlight-XXXXXX").string();
  const int made = ::mkstemp(name.data());
  if (made >= 0) ::unlink(name.c_str()), ::fcntl(made, F_SETFD, FD_CLOEXEC);
  return made;
#endif
}

// A file in memory instead of a pipe: nobody has to empty it while it is written, and children of other threads do not
// hold its end open.
class MemoryFile {
 public:
  // Behind the three numbers that the child's own files take.
  MemoryFile() {
    const int made = openUnnamed();
    if (made < 0) return;
    number_ = ::fcntl(made, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    ::close(made);
  }
  ~MemoryFile() {
    if (number_ >= 0) ::close(number_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int number() const { return number_; }
  bool rewind() const { return number_ >= 0 && ::lseek(number_, 0, SEEK_SET) == 0; }

 private:
  int number_ = -1;
};

// How a child is started: its three files and no other, signals as a new program expects them.
class Start {
 public:
  Start(int input, int output) {
    ::posix_spawn_file_actions_init(&files_);
    ::posix_spawn_file_actions_adddup2(&files_, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&files_, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(&files_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawnattr_init(&attributes_);
    short flags = POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK;
#ifdef __linux__
    ::posix_spawn_file_actions_addclosefrom_np(&files_, STDERR_FILENO + 1);
#else
    flags |= POSIX_SPAWN_CLOEXEC_DEFAULT;
#endif
    ::posix_spawnattr_setflags(&attributes_, flags);
    sigset_t signals;
    sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes_, &signals);  // or a thread that blocks them would make limits endless
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM, SIGXCPU}) sigaddset(&signals, number);
    ::posix_spawnattr_setsigdefault(&attributes_, &signals);
  }
  ~Start() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&files_);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  // 0, or the error's number.
  int operator()(const std::filesystem::path& program, std::vector<std::string> words, pid_t& child) const {
    words.insert(words.begin(), program.string());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    return ::posix_spawn(&child, program.c_str(), &files_, &attributes_, argv.data(), environ);
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

// Its exit status; -1 where it ended otherwise.
int waitFor(pid_t child) {
  int status = 0;
  pid_t ended = -1;
  do {
    ended = ::waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  return ended == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

template <class Resource>
void limit(Resource resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(resource, &both);
}

}  // namespace

bool writeAll(int file, std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(file, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(done));
  }
  return true;
}

void startQuietly(const std::string& program, std::string argument) {
  std::string name = program;
  char* argv[] = {name.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  // It hands the page to the desktop and ends by itself.
  if (::posix_spawnp(&child, program.c_str(), &files, nullptr, argv, environ) == 0) ::waitpid(child, nullptr, WNOHANG);
  ::posix_spawn_file_actions_destroy(&files);
}

RunToEnd runWithInput(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      std::span<const uint8_t> input, std::initializer_list<int> withOutput) {
  RunToEnd run;
  const MemoryFile in, out;
  if (out.number() < 0 || !writeAll(in.number(), input) || !in.rewind()) return run;
  pid_t child = -1;
  run.error = Start(in.number(), out.number())(program, arguments, child);
  run.isStarted = run.error == 0;
  if (!run.isStarted) return run;
  run.exitStatus = waitFor(child);
  const bool hasOutput = std::find(withOutput.begin(), withOutput.end(), run.exitStatus) != withOutput.end();
  if (hasOutput && out.rewind()) run.output = readAll(out.number());
  return run;
}

ShellCommand runInShell(const std::string& command) {
  ShellCommand run;
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "re");
  if (!pipe) return run;
  std::array<char, 4096> block{};
  while (const size_t n = std::fread(block.data(), 1, block.size(), pipe)) run.text.append(block.data(), n);
  run.isDone = ::pclose(pipe) == 0;
  while (!run.text.empty() && run.text.back() == '\n') run.text.pop_back();
  return run;
}

void limitThisProcess(const ProcessLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.coreSeconds);
  ::alarm(limits.seconds);
#ifdef __linux__
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  limit(RLIMIT_AS, pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + limits.memoryBytes);
#endif
}

int takeOverOutput() {
  const int result = ::dup(STDOUT_FILENO);
  return result < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0 ? -1 : result;
}

std::optional<std::vector<uint8_t>> readInput() { return readAll(STDIN_FILENO); }

}  // namespace roomlight

#endif
