#include "started_programs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "base/platform/module.h"
#include "batch/child.h"
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

std::filesystem::path pageFolder(const std::string& name, const std::string& built) {
  std::error_code code;
  const std::filesystem::path places[] = {installed(std::filesystem::path("share/roomlight") / name),
                                          moduleFolder() / "../../viewer" / built};
  for (const auto& place : places) {
    if (std::filesystem::exists(place / "index.html", code)) return std::filesystem::weakly_canonical(place, code);
  }
  return places[0];
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

Status runThisProgram(const std::vector<std::string>& arguments, const std::atomic<bool>& cancelled) {
  std::error_code code;
  return batch::runToItsEnd(thisProgram(), arguments, std::filesystem::current_path(code), &cancelled);
}

}  // namespace roomlight::cli
