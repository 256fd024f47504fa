#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <set>

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

}  // namespace

void printError(const std::string& message) { fmt::print(stderr, "roomlight: {}\n", oneLine(message)); }

void printWarnings(const std::vector<std::string>& warnings) {
  std::set<std::string> said;
  for (const std::string& w : warnings) {
    if (said.insert(w).second) fmt::print(stderr, "warning: {}\n", oneLine(w));
  }
}

ProgressDisplay::ProgressDisplay(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

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
  const std::string left = fraction > 0.01f && elapsed > 0.5 ? duration(elapsed * (1 / static_cast<double>(fraction) - 1)) + " left" : "";
  fmt::print(stderr, "\r\x1b[K{:<12} [{:#>{}}{:.>{}}] {:3.0f} %  {}{}{}", stage, "", filled, "", kBarWidth - filled, fraction * 100, left, left.empty() || estimate_.empty() ? "" : ", ",
             estimate_);
  std::fflush(stderr);
  barShown_ = true;
}

}  // namespace roomlight::cli
