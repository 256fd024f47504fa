// Programs that this one starts: the browser, and itself once more.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace roomlight::cli {

// Shows a page in the browser of whoever runs the program. Asks the desktop (xdg-open) to open the link, through a file
// that only its owner can read: arguments of programs are seen by all users, and the link holds a secret. Without a
// desktop nothing happens. The file goes with the object.
class BrowserPage {
 public:
  explicit BrowserPage(const std::string& link);
  ~BrowserPage();
  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

 private:
  std::filesystem::path folder_;
};

// Where a page of ours lies: beside an installed program as `installed`, or in the tree that it was built in as
// `built`.
std::filesystem::path pageFolder(const std::string& installed, const std::string& built);

// What draws the plots of a page (report::page); empty where it has not been built, with a warning.
std::string reportPlots();

// Runs it once more as a process of its own, with these arguments, its output thrown away. Where `cancelled` becomes
// true, or the calling thread ends (Linux), it is killed. Errors: what it said on stderr last, without "roomlight: ";
// that it was killed; or "interrupted".
Status runThisProgram(const std::vector<std::string>& arguments, const std::atomic<bool>& cancelled);

}  // namespace roomlight::cli
