// Shows a page in the browser of whoever runs the program.
#pragma once

#include <filesystem>
#include <string>

namespace roomlight::cli {

// Asks the desktop (xdg-open) to open the link, through a file that only its owner can read: arguments of programs are
// seen by all users, and the link holds a secret. Without a desktop nothing happens. The file goes with the object.
class BrowserPage {
 public:
  explicit BrowserPage(const std::string& link);
  ~BrowserPage();
  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

 private:
  std::filesystem::path folder_;
};

}  // namespace roomlight::cli
