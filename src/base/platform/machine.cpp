#include "base/platform/machine.h"

#if defined(__unix__) || defined(__APPLE__)

#include <sys/random.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/platform/system_facts.h"

namespace roomlight {

std::string hostName() {
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  return host;
}

std::string machineIdentity() {
  std::error_code code;
  return systemValue("/proc/sys/kernel/random/boot_id", "") + " " +
         std::filesystem::read_symlink("/proc/self/ns/pid", code).string();
}

double installedMemoryBytes() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

double machineLoad() {
  double load = 0;
  ::getloadavg(&load, 1);
  return load;
}

std::tm localTime(std::time_t time) {
  std::tm local{};
  ::localtime_r(&time, &local);
  return local;
}

int coresAllowed() {
#ifdef __linux__
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
#else
  return static_cast<int>(std::max(1l, ::sysconf(_SC_NPROCESSORS_ONLN)));
#endif
}

double processCpuSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peakMemoryMiB() {
  // Not ru_maxrss where it can be helped: it starts from what the parent process held before exec.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) != 0) continue;
    double kibibytes = 0;
    std::istringstream(line.substr(6)) >> kibibytes;
    return kibibytes / 1024;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<double>(usage.ru_maxrss) / (1024 * 1024);
#else
  return static_cast<double>(usage.ru_maxrss) / 1024;
#endif
}

int limitData(double bytes) {
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = static_cast<rlim_t>(std::min(bytes, 9e18));
  if (limit.rlim_max != RLIM_INFINITY) limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  return ::setrlimit(RLIMIT_DATA, &limit) == 0 ? 0 : errno;
}

void giveWay() {
#ifdef __linux__
  constexpr int kNiceness = 10;
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);  // on Linux niceness is a thread's own
#endif
}

void fillWithRandomBytes(std::span<unsigned char> bytes) {
#ifdef __linux__
  for (size_t filled = 0; filled < bytes.size();) {
    const ssize_t n = ::getrandom(bytes.data() + filled, bytes.size() - filled, 0);
    if (n < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "getrandom");
    filled += n > 0 ? static_cast<size_t>(n) : 0;
  }
#else
  constexpr size_t kMostAtOnce = 256;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), kMostAtOnce))) {
    if (::getentropy(bytes.data(), std::min(bytes.size(), kMostAtOnce)) != 0)
      throw std::system_error(errno, std::generic_category(), "getentropy");
  }
#endif
}

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

}  // namespace roomlight

#endif
