#include "started_programs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

#include "console.h"
#include "output_files.h"

extern char** environ;

namespace roomlight::cli {
namespace {

bool hasDesktop() { return getenv("DISPLAY") || getenv("WAYLAND_DISPLAY"); }

void spawnQuietly(const std::string& program, std::string argument) {
  std::string name = program;
  char* argv[] = {name.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  // It hands the page to the desktop and ends by itself.
  if (posix_spawnp(&child, program.c_str(), &files, nullptr, argv, environ) == 0) waitpid(child, nullptr, WNOHANG);
  posix_spawn_file_actions_destroy(&files);
}

}  // namespace

BrowserPage::BrowserPage(const std::string& link) {
  if (!hasDesktop()) return;
  std::error_code code;
  std::string pattern = (std::filesystem::temp_directory_path(code) / "roomlight-view-XXXXXX").string();
  if (code || !mkdtemp(pattern.data())) return;  // a folder of the owner's alone
  folder_ = pattern;
  const std::filesystem::path file = folder_ / "open.html";
  std::ofstream(file) << fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>roomlight</title><meta http-equiv=\"refresh\" "
      "content=\"0;url={}\"><a href=\"{}\">Open the home</a>\n",
      link, link);
  spawnQuietly("xdg-open", file.string());
}

BrowserPage::~BrowserPage() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

namespace {

constexpr auto kAskEvery = std::chrono::milliseconds(20);
constexpr size_t kMostKept = 4000;  // of what it says
constexpr int kNotStarted = 127;    // exit status

// The last line, without the program's name.
std::string lastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const size_t from = text.rfind('\n');
  std::string line = from == std::string::npos ? text : text.substr(from + 1);
  constexpr std::string_view kName = "roomlight: ";
  return line.starts_with(kName) ? line.substr(kName.size()) : line;
}

// Everything that is in the pipe now; false at its end.
bool drain(int pipe, std::string& text) {
  char block[1024];
  while (true) {
    const ssize_t n = read(pipe, block, sizeof block);
    if (n == 0) return false;
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    text.append(block, static_cast<size_t>(n));
    if (text.size() > 2 * kMostKept) text.erase(0, text.size() - kMostKept);
  }
}

// Not posix_spawn, which cannot ask for the signal of the parent's death. Between fork and exec only what is safe in a
// copy of a process that has threads.
[[noreturn]] void becomeProgram(char* const* argv, int said, [[maybe_unused]] pid_t parent) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kNotStarted);  // it was dead before that
#endif
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(said, STDERR_FILENO);
  execv(argv[0], argv);
  _exit(kNotStarted);
}

}  // namespace

std::filesystem::path pageFolder(const std::string& installed, const std::string& built) {
  std::error_code code;
  const std::filesystem::path program = std::filesystem::read_symlink(thisProgram(), code).parent_path();
  const std::filesystem::path places[] = {program / "../share/roomlight" / installed, program / "../../viewer" / built};
  for (const auto& place : places) {
    if (std::filesystem::exists(place / "index.html", code)) return std::filesystem::weakly_canonical(place, code);
  }
  return places[0].lexically_normal();
}

std::string reportPlots() {
  const Result<std::string> plots = readTextFile(pageFolder("reports", "dist-reports") / "index.html");
  if (plots) return plots.value();
  printWarnings({plots.error() + "; the page is without plots: build them with scripts/build"});
  return {};
}

std::filesystem::path thisProgram() {
  return "/proc/self/exe";  // the very one that runs, even where another has been built meanwhile
}

Status runThisProgram(const std::vector<std::string>& arguments, const std::atomic<bool>* cancelled) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
    return Error{fmt::format("a process cannot be started: {}", std::strerror(errno))};
  std::vector<std::string> words = {thisProgram().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);

  const pid_t self = getpid(), child = fork();
  const int failed = errno;
  if (child == 0) becomeProgram(argv.data(), ends[1], self);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return Error{fmt::format("a process cannot be started: {}", std::strerror(failed))};
  }
  std::string said;
  int status = 0;
  bool told = false;
  pid_t ended = 0;
  while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
    drain(ends[0], said);
    // Again and again: the second ends it at once, and its result is not wanted.
    if (cancelled && *cancelled) kill(child, SIGTERM), told = true;
    std::this_thread::sleep_for(kAskEvery);
  }
  drain(ends[0], said);
  close(ends[0]);
  if (told) return Error{"interrupted"};
  if (ended < 0) return Error{fmt::format("a process was lost: {}", std::strerror(errno))};
  if (WIFSIGNALED(status))
    return Error{
        fmt::format("the process was killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))};
  if (WEXITSTATUS(status) == kNotStarted) return Error{"a process cannot be started"};
  if (WEXITSTATUS(status) != 0)
    return Error{said.empty() ? fmt::format("the process ended with status {}", WEXITSTATUS(status)) : lastLine(said)};
  return Ok{};
}

}  // namespace roomlight::cli
