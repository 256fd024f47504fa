#include "browser.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

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

}  // namespace roomlight::cli
