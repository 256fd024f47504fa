#include "import/child_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>

#include "import/failure.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ROOMLIGHT_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define ROOMLIGHT_SANITIZED true
#endif
#endif
#ifndef ROOMLIGHT_SANITIZED
#define ROOMLIGHT_SANITIZED false
#endif

namespace roomlight::importers {
namespace {

constexpr unsigned kSeconds = 60;
constexpr rlim_t kMemoryBytes = rlim_t{8} << 30;
constexpr int kFailed = 3;  // exit status: the file holds why

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// What the child may take beside what the parent has.
void limitMemory() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  limit(RLIMIT_AS, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kMemoryBytes);
}

void writeAll(int file, const uint8_t* bytes, size_t count) {
  while (count > 0) {
    const ssize_t done = write(file, bytes, count);
    if (done <= 0) _exit(1);
    bytes += done, count -= static_cast<size_t>(done);
  }
}

// Libraries complain on the terminal; what matters comes back as a failure.
void silence() {
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
}

[[noreturn]] void runChild(const std::function<Bytes()>& work, int file) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
  std::signal(SIGALRM, SIG_DFL);
  silence();
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kSeconds);
  alarm(2 * kSeconds);  // a busy machine may give it half of a core
  limitMemory();
  int status = 0;
  try {
    const Bytes bytes = work();
    writeAll(file, bytes.data(), bytes.size());
  } catch (const std::exception& e) {
    const std::string_view why = e.what();
    writeAll(file, reinterpret_cast<const uint8_t*>(why.data()), why.size());
    status = kFailed;
  } catch (...) {
    status = 1;
  }
  _exit(status);  // without the destructors of what is the parent's
}

struct File {
  int number;
  ~File() { close(number); }
};

Bytes readAll(int file) {
  const off_t size = lseek(file, 0, SEEK_END);
  Bytes bytes(size > 0 ? static_cast<size_t>(size) : 0);
  size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = pread(file, bytes.data() + filled, bytes.size() - filled, static_cast<off_t>(filled));
    if (got <= 0) fail("", "cannot be read back from its reader");
    filled += static_cast<size_t>(got);
  }
  return bytes;
}

}  // namespace

Bytes inChildProcess(const std::function<Bytes()>& work) {
  // Sanitizers' allocators may be locked by another thread at the moment of the fork; the child would wait for ever.
  if (ROOMLIGHT_SANITIZED) fail("", "is not read by a build with sanitizers, which cannot start a process for it");
  // A file in memory instead of a pipe: nobody has to empty it while it is written, and children of other threads do
// not hold its end open.
  const File file{memfd_create("roomlight", MFD_CLOEXEC)};
  const pid_t child = file.number < 0 ? -1 : fork();
  if (child < 0) fail("", "cannot be read, as no process can be started for it");
  if (child == 0) runChild(work, file.number);
  int status = 0;
  pid_t ended = -1;
  do {
    ended = waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  const int code = ended == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code != 0 && code != kFailed) fail("", "is damaged, or needs too much time or memory");
  Bytes bytes = readAll(file.number);
  if (code == kFailed)
    fail("", printable(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), 300));
  return bytes;
}

}  // namespace roomlight::importers
