#include "started_programs.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "base/platform/files.h"
#include "base/platform/module.h"
#include "base/platform/process.h"
#include "batch/child.h"
#include "console.h"
#include "output_files.h"

namespace roomlight::cli {
namespace {

bool hasDesktop() { return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY"); }

}  // namespace

BrowserPage::BrowserPage(const std::string& link) {
  if (!hasDesktop()) return;
  folder_ = makeTemporaryFolder("roomlight-view");  // of the owner's alone
  if (folder_.empty()) return;
  const std::filesystem::path file = folder_ / "open.html";
  std::ofstream(file) << fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>roomlight</title><meta http-equiv=\"refresh\" "
      "content=\"0;url={}\"><a href=\"{}\">Open the home</a>\n",
      link, link);
  startQuietly("xdg-open", file.string());
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

Status runThisProgram(const std::vector<std::string>& arguments, const std::atomic<bool>& cancelled) {
  std::error_code code;
  return batch::runToItsEnd(runningProgram(), arguments, std::filesystem::current_path(code), &cancelled);
}

}  // namespace roomlight::cli
