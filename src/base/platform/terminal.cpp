#include "base/platform/terminal.h"

#if defined(__unix__) || defined(__APPLE__)

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>

namespace roomlight {
namespace {

class PipesMayBreak {
 public:
  PipesMayBreak() {
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    ::sigaction(SIGPIPE, &ignore, &before_);
  }
  ~PipesMayBreak() { ::sigaction(SIGPIPE, &before_, nullptr); }
  PipesMayBreak(const PipesMayBreak&) = delete;
  PipesMayBreak& operator=(const PipesMayBreak&) = delete;

 private:
  struct sigaction before_ = {};
};

bool isIgnored(int number) {
  struct sigaction now = {};
  return ::sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

bool isErrorOutputTerminal() { return ::isatty(STDERR_FILENO) != 0; }

bool isOutputOpen() { return ::fcntl(STDOUT_FILENO, F_GETFD) >= 0; }

int writeToOutput(std::string_view text) {
  const PipesMayBreak whileWriting;
  while (!text.empty()) {
    const ssize_t n = ::write(STDOUT_FILENO, text.data(), text.size());
    if (n < 0 && errno != EINTR) return errno;
    if (n > 0) text.remove_prefix(static_cast<size_t>(n));
  }
  return 0;
}

void onInterruption(void (*handler)(int number)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // a file that is being read or written is not cut short
  for (const int number : {SIGINT, SIGTERM}) ::sigaction(number, &action, nullptr);
  if (!isIgnored(SIGHUP)) ::sigaction(SIGHUP, &action, nullptr);  // nohup: it is to go on
}

}  // namespace roomlight

#endif
