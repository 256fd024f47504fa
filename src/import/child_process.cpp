#include "import/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <new>
#include <optional>
#include <system_error>

#include "base/platform/module.h"
#include "import/failure.h"

namespace roomlight::importers {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReader = "roomlight-model-reader";
constexpr unsigned kSeconds = 60;
constexpr rlim_t kMemoryBytes = rlim_t{8} << 30;
constexpr int kFailed = 3;  // exit status: stdout says why

bool writeAll(int file, std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = write(file, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(done));
  }
  return true;
}

// All from where the file stands to its end; none where it cannot be read.
std::optional<Bytes> readAll(int file) {
  struct stat about {};
  const bool known = fstat(file, &about) == 0 && about.st_size > 0;
  Bytes bytes(known ? static_cast<size_t>(about.st_size) + 1 : 0);
  for (size_t filled = 0;;) {
    if (filled == bytes.size()) bytes.resize(filled + (size_t{1} << 16));
    const ssize_t got = read(file, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    filled += static_cast<size_t>(got);
    if (got > 0) continue;
    bytes.resize(filled);
    return bytes;
  }
}

// A file in memory instead of a pipe: nobody has to empty it while it is written, and children of other threads do not
// hold its end open.
class MemoryFile {
 public:
  // Behind the three numbers that the child's own files take.
  MemoryFile() {
    const int made = memfd_create("roomlight", MFD_CLOEXEC);
    if (made < 0) return;
    number_ = fcntl(made, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(made);
  }
  ~MemoryFile() {
    if (number_ >= 0) close(number_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int number() const { return number_; }
  bool rewind() const { return number_ >= 0 && lseek(number_, 0, SEEK_SET) == 0; }

 private:
  int number_ = -1;
};

// How a child is started: its three files and no other, signals as a new program expects them.
class Start {
 public:
  Start(int input, int output) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files_, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&files_, STDERR_FILENO + 1);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);  // or a thread that blocks them would make limits endless
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM, SIGXCPU}) sigaddset(&signals, number);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
  }
  ~Start() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&files_);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  // 0, or the error's number.
  int operator()(const fs::path& program, std::vector<std::string> words, pid_t& child) const {
    words.insert(words.begin(), program.string());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    return posix_spawn(&child, program.c_str(), &files_, &attributes_, argv.data(), environ);
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
    ended = waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  return ended == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// Beside what the program itself takes, which is much in builds with sanitizers.
void limitMemory() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  limit(RLIMIT_AS, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kMemoryBytes);
}

std::span<const uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

}  // namespace

fs::path modelReader() {
  if (const char* told = std::getenv("ROOMLIGHT_MODEL_READER"); told && *told) return told;
  std::error_code code;
  for (const fs::path& folder : {moduleFolder(), programFolder()}) {
    if (fs::exists(folder / kReader, code)) return folder / kReader;
  }
  return installed(fs::path("libexec/roomlight") / kReader);
}

Bytes inChildProcess(const fs::path& program, const std::vector<std::string>& arguments,
                     std::span<const uint8_t> input) {
  constexpr const char* kNoProcess = "cannot be read, as no process can be started for it";
  const MemoryFile in, out;
  if (out.number() < 0 || !writeAll(in.number(), input) || !in.rewind()) fail("", kNoProcess);
  pid_t child = -1;
  const int code = Start(in.number(), out.number())(program, arguments, child);
  if (code != 0)
    fail("",
         fmt::format("{} ({}: {})", kNoProcess, program.filename().string(), std::generic_category().message(code)));
  const int status = waitFor(child);
  if (status != 0 && status != kFailed) fail("", "is damaged, or needs too much time or memory");
  std::optional<Bytes> bytes = out.rewind() ? readAll(out.number()) : std::nullopt;
  if (!bytes) fail("", "cannot be read back from its reader");
  if (status == kFailed)
    fail("", printable(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()), 300));
  return std::move(*bytes);
}

void serveParent(const std::function<Bytes(const Bytes& input)>& work) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kSeconds);
  alarm(2 * kSeconds);  // a busy machine may give it half of a core
  limitMemory();
  // Libraries complain on the terminal; what matters comes back as a failure.
  const int result = dup(STDOUT_FILENO);
  if (result < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) _exit(1);
  int status = 1;
  try {
    const std::optional<Bytes> input = readAll(STDIN_FILENO);
    if (input && writeAll(result, work(*input))) status = 0;
  } catch (const std::bad_alloc&) {
    status = 1;
  } catch (const std::exception& e) {
    if (writeAll(result, bytesOf(e.what()))) status = kFailed;
  } catch (...) {
    status = 1;
  }
  _exit(status);  // nothing is left to tidy up
}

}  // namespace roomlight::importers
