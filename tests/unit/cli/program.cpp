#include "unit/cli/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace roomlight::testing {
namespace {

using namespace std::chrono_literals;
constexpr auto kPatience = 120s;

// Between fork and exec only what is safe in a copy of a process that had threads.
[[noreturn]] void becomeProgram(char* const* argv, int out, int err) {
  if (out == kClosed) {
    close(STDOUT_FILENO);
  } else {
    dup2(out, STDOUT_FILENO);
  }
  dup2(err, STDERR_FILENO);
  execv(argv[0], argv);
  _exit(127);
}

}  // namespace

ProgramRun runProgram(const std::vector<std::string>& arguments, const std::string& interruptAt) {
  const TemporaryFolder folder;
  const int out = open((folder / "out").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  ProgramRun run = runProgramInto(out, arguments, interruptAt);
  close(out);
  run.out = readFile(folder / "out");
  return run;
}

ProgramRun runProgramInto(int out, const std::vector<std::string>& arguments, const std::string& interruptAt) {
  const TemporaryFolder folder;
  std::vector<std::string> words = {ROOMLIGHT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const int err = open((folder / "err").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const pid_t child = fork();
  if (child == 0) becomeProgram(argv.data(), out, err);
  close(err);

  int status = 0;
  bool interrupted = interruptAt.empty();
  const auto start = std::chrono::steady_clock::now();
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (!interrupted && readFile(folder / "err").find(interruptAt) != std::string::npos) {
      interrupted = true;
      kill(child, SIGINT);
    }
    if (std::chrono::steady_clock::now() - start > kPatience) kill(child, SIGKILL);
    std::this_thread::sleep_for(2ms);
  }
  const int exitStatus = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {exitStatus, "", readFile(folder / "err")};
}

}  // namespace roomlight::testing
