// What the program tells the person in front of it: everything on stderr, results on stdout.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "exit_status.h"

namespace roomlight::cli {

// One line "roomlight: ..." on stderr, whatever line breaks the message has.
void printError(const std::string& message);
// printError, and the status to leave with.
int failed(const std::string& message, int status = kBadInput);
// "warning: ..." once each, in the order in which they came first.
void printWarnings(const std::vector<std::string>& warnings);
// What was found in a scene's files: the first kMostWarnings warnings, and how many small faults were mended; with
// `verbose` all of them. `faults` are kinds, `faultCount` is how many of all kinds there were.
constexpr size_t kMostWarnings = 8;
void printFindings(const std::vector<std::string>& warnings, const std::vector<std::string>& faults, size_t faultCount,
                   bool verbose);

// "note: ..." each: what was guessed or added for the user.
void printNotes(const std::vector<std::string>& notes);

// A bar with the time left on a terminal; elsewhere one line a stage when it is done. Called from one thread at a time.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet);
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;
  // fraction 0 begins the stage, 1 ends it.
  void report(const std::string& stage, float fraction);
  // Of the error that the picture still has: shown beside the bar, and at last in a line of its own.
  void estimate(double relativeError, double srgbMse);
  void lineOfEstimate();
  void line(const std::string& text);  // not shown when quiet

 private:
  void clear();
  bool quiet_, terminal_, barShown_ = false;
  std::string stage_, estimate_;
  Stopwatch watch_;
  double lastDrawnS_ = -1;
};

}  // namespace roomlight::cli
