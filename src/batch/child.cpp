#include "batch/child.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <thread>

#include "base/platform/machine.h"
#include "base/utf8.h"
#include "base/write_file.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostKept = 4000;  // of what it says
constexpr int kOutOfMemory = 3;  // exit status of this program
constexpr int kInterrupted = 130;
constexpr size_t kLongestLine = 400;

// The last line, without the program's name.
std::string lastLine(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  const size_t from = text.rfind('\n');
  std::string_view line = from == std::string_view::npos ? text : text.substr(from + 1);
  constexpr std::string_view kName = "roomlight: ";
  if (line.starts_with(kName)) line.remove_prefix(kName.size());
  return printable(asUtf8(line), kLongestLine);
}

Error notStarted(int reason) { return {fmt::format("a process cannot be started: {}", std::strerror(reason))}; }

}  // namespace

Child::Child(StartedProcess process)
    : process_(std::move(process)),
      outOfMemoryBefore_(outOfMemoryKills()),
      started_(std::chrono::steady_clock::now()) {}

Result<Child> Child::start(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& folder,
                           const fs::path& printed) {
  const int out = printed.empty() ? -1 : openForOutput(printed);
  if (!printed.empty() && out < 0) return cannotWrite(printed, -out);
  int reason = 0;
  std::optional<StartedProcess> process = StartedProcess::start(program, arguments, folder, out, reason);
  if (out >= 0) closeOutput(out);
  if (!process) return notStarted(reason);
  return Child(std::move(*process));
}

double Child::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

bool Child::hasEnded() {
  constexpr auto kMoment = std::chrono::microseconds(500);
  auto said = StartedProcess::Said::Something;
  while (said == StartedProcess::Said::Something) {
    said = process_.read(text_);
    if (text_.size() > 2 * kMostKept) text_.erase(0, text_.size() - kMostKept);
  }
  if (process_.hasEnded()) return true;
  const std::optional<ProcessEnd> end = process_.end();
  if (!end) {
    // It is about to end, or has closed stderr.
    if (said == StartedProcess::Said::Closed) std::this_thread::sleep_for(kMoment);
    return false;
  }
  ended_.seconds = seconds(), ended_.peakMiB = end->peakMiB;
  judge(*end);
  return true;
}

void Child::kill(const std::string& why) {
  if (process_.hasEnded()) return;
  if (why_.empty()) why_ = why;
  process_.kill();
}

void Child::judge(const ProcessEnd& end) {
  const std::string said = lastLine(text_);
  Ended& e = ended_;
  if (!why_.empty()) {
    e.how = "time", e.line = why_;
  } else if (end.signal != 0) {
    const bool starved = end.wasKilled && outOfMemoryKills() > outOfMemoryBefore_;
    e.how = starved ? "memory" : "signal";
    e.line = starved ? "killed by the system: out of memory"
                     : fmt::format("killed by signal {} ({})", end.signal, end.signalName);
    if (end.wasKilled && !starved) e.line += ", by hand or for want of memory";
  } else if (end.exitStatus < 0) {
    e.how = "signal", e.line = "the process was lost";
  } else {
    e.exitStatus = end.exitStatus;
    e.isDone = e.exitStatus == 0;
    e.how = e.exitStatus == kOutOfMemory ? "memory" : e.exitStatus == kInterrupted ? "signal" : "exit";
    e.line = e.exitStatus == StartedProcess::kNotStarted ? "the program cannot be started"
             : said.empty()                              ? fmt::format("ended with status {}", e.exitStatus)
                                                         : said;
  }
}

Status runToItsEnd(const std::filesystem::path& program, const std::vector<std::string>& words,
                   const std::filesystem::path& folder, const std::atomic<bool>* cancelled) {
  constexpr auto kAskEvery = std::chrono::milliseconds(20);
  Result<Child> child = Child::start(program, words, folder, {});
  if (!child) return Error{child.error()};
  while (!child.value().hasEnded()) {
    if (cancelled && *cancelled) child.value().kill("interrupted");
    std::this_thread::sleep_for(kAskEvery);
  }
  const Ended& ended = child.value().ended();
  return ended.isDone ? Status(Ok{}) : Error{ended.line};
}

}  // namespace roomlight::batch
