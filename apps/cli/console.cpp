#include "console.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "base/platform/terminal.h"

namespace roomlight::cli {
namespace {

constexpr double kRedrawS = 0.1;
constexpr int kBarWidth = 30;

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

std::string duration(double s) {
  if (s < 1) return fmt::format("{:.0f} ms", s * 1e3);
  if (s < 60) return fmt::format("{:.1f} s", s);
  const auto whole = static_cast<long>(s + 0.5);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

// Each once, in the order in which they came first.
std::vector<std::string> once(const std::vector<std::string>& lines) {
  std::set<std::string> said;
  std::vector<std::string> out;
  for (const std::string& line : lines) {
    if (said.insert(line).second) out.push_back(line);
  }
  return out;
}

}  // namespace

void printError(const std::string& message) { fmt::print(stderr, "roomlight: {}\n", oneLine(message)); }

int failed(const std::string& message, int status) {
  printError(message);
  return status;
}

void printWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& w : once(warnings)) fmt::print(stderr, "warning: {}\n", oneLine(w));
}

void printFindings(const std::vector<std::string>& warnings, const std::vector<std::string>& faults, size_t faultCount,
                   bool verbose) {
  std::vector<std::string> shown = once(warnings);
  const size_t all = shown.size();
  // One more line than a cut list would have is no reason to cut.
  const bool cut = !verbose && all > kMostWarnings + 1;
  if (cut) shown.resize(kMostWarnings);
  for (const std::string& w : shown) fmt::print(stderr, "warning: {}\n", oneLine(w));
  if (cut) fmt::print(stderr, "warning: and {} more; --verbose lists them\n", all - shown.size());
  if (faultCount == 0) return;
  fmt::print(stderr, "{} small {} in models mended{}\n", faultCount, faultCount == 1 ? "fault" : "faults",
             verbose ? ":" : "; --verbose lists them");
  for (const std::string& f : verbose ? once(faults) : std::vector<std::string>())
    fmt::print(stderr, "  {}\n", oneLine(f));
}

void printNotes(const std::vector<std::string>& notes) {
  for (const std::string& n : notes) fmt::print(stderr, "note: {}\n", oneLine(n));
}

ProgressDisplay::ProgressDisplay(bool quiet) : quiet_(quiet), terminal_(isErrorOutputTerminal()) {}

void ProgressDisplay::clear() {
  if (barShown_) fmt::print(stderr, "\r\x1b[K");
  barShown_ = false;
}

void ProgressDisplay::line(const std::string& text) {
  if (quiet_) return;
  clear();
  fmt::print(stderr, "{}\n", oneLine(text));
  std::fflush(stderr);
}

void ProgressDisplay::estimate(double relativeError, double srgbMse) {
  estimate_ = fmt::format("estimated error {:.2g} % of a pixel's luminance, mse {:.1e}", 100 * relativeError, srgbMse);
}

void ProgressDisplay::lineOfEstimate() {
  if (!estimate_.empty()) line(estimate_);
  estimate_.clear();  // of the picture that is done
}

void ProgressDisplay::report(const std::string& stage, float fraction) {
  if (quiet_) return;
  if (stage != stage_ || fraction <= 0) {
    stage_ = stage;
    watch_ = Stopwatch();
    lastDrawnS_ = -1;
  }
  const double elapsed = watch_.seconds();
  if (fraction >= 1) {
    line(fmt::format("{:<12} {}", stage, duration(elapsed)));
    return;
  }
  if (!terminal_ || (lastDrawnS_ >= 0 && elapsed - lastDrawnS_ < kRedrawS)) return;
  lastDrawnS_ = elapsed;
  const int filled = static_cast<int>(fraction * kBarWidth);
  // No guess before there is something to guess from.
  const std::string left =
      fraction > 0.01f && elapsed > 0.5 ? duration(elapsed * (1 / static_cast<double>(fraction) - 1)) + " left" : "";
  fmt::print(stderr, "\r\x1b[K{:<12} [{:#>{}}{:.>{}}] {:3.0f} %  {}{}{}", stage, "", filled, "", kBarWidth - filled,
             fraction * 100, left, left.empty() || estimate_.empty() ? "" : ", ", estimate_);
  std::fflush(stderr);
  barShown_ = true;
}

}  // namespace roomlight::cli
