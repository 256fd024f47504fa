// Stands for the program that reads models, and does what its first argument says.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "import/child_process.h"
#include "import/failure.h"

namespace {

using roomlight::importers::Bytes;

Bytes bytesOf(const std::string& text) { return Bytes(text.begin(), text.end()); }

std::string limits() {
  rlimit cpu{}, core{}, memory{};
  getrlimit(RLIMIT_CPU, &cpu), getrlimit(RLIMIT_CORE, &core), getrlimit(RLIMIT_AS, &memory);
  sigset_t blocked;
  sigprocmask(SIG_BLOCK, nullptr, &blocked);
  std::string out = std::to_string(cpu.rlim_cur) + " s";
  if (core.rlim_max == 0) out += ", no core";
  if (memory.rlim_cur > rlim_t{8} << 30 && memory.rlim_cur != RLIM_INFINITY) out += ", memory";
  if (const unsigned left = alarm(0); left > 0 && left <= 120) out += ", alarm";
  if (!sigismember(&blocked, SIGALRM)) out += ", wakes";
  return out;
}

Bytes work(const std::string& what, const std::string& how, const Bytes& input) {
  if (what == "reverse") return Bytes(input.rbegin(), input.rend());
  if (what == "chatter") std::puts("chatter"), std::fputs("chatter", stderr), std::fflush(stdout);
  if (what == "chatter") return bytesOf("result");
  if (what == "fail") throw roomlight::importers::Failure("because");
  if (what == "limits") return bytesOf(limits());
  if (what == "open") return bytesOf(fcntl(std::atoi(how.c_str()), F_GETFD) < 0 ? "no" : "yes");
  if (what == "greed") {
    Bytes bytes;
    bytes.reserve(size_t{9} << 30);  // more than it may have; never touched
    return bytes;
  }
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  roomlight::importers::serveParent(
      [&](const Bytes& input) { return work(argc > 1 ? argv[1] : "", argc > 2 ? argv[2] : "", input); });
}
