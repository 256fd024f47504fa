#include "base/shared_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string_view>
#include <thread>
#include <vector>

#include "base/platform/files.h"
#include "base/sealed_file.h"
#include "base/write_file.h"

namespace roomlight {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUnfinished = ".part-", kClaimed = ".claim";
constexpr size_t kShortestName = 16;  // of one hash
constexpr auto kBetweenLooks = std::chrono::milliseconds(50);
constexpr auto kAbandoned = std::chrono::hours(1);  // what is not finished by then never will be

// What follows the name in that of a file of ours; none where it is not one.
std::optional<std::string> afterName(const std::string& file) {
  const size_t end = std::min(file.find_first_not_of("0123456789abcdef-"), file.size());
  return end < kShortestName ? std::nullopt : std::optional(file.substr(end));
}

template <class Act>
void forEachFile(const fs::path& folder, Act&& act) {
  std::error_code code;
  for (fs::directory_iterator i(folder, code), end; !code && i != end; i.increment(code)) {
    if (const std::optional<std::string> rest = afterName(i->path().filename().string())) act(*i, *rest);
  }
}

bool isAbandoned(const fs::path& file) {
  std::error_code code;
  const fs::file_time_type written = fs::last_write_time(file, code);
  return !code && fs::file_time_type::clock::now() - written > kAbandoned;
}

}  // namespace

bool SharedFiles::has(const std::string& name) const {
  std::error_code code;
  return fs::exists(fileOf(name), code);
}

Result<std::optional<std::string>> SharedFiles::find(const std::string& name) const {
  const fs::path file = fileOf(name);
  std::error_code code;
  Result<std::optional<std::string>> found = loadSealed(file);
  if (found && !found.value()) return found;
  // One that was renamed is not what it is called.
  if (found && !found.value()->starts_with(name))
    found = Error{fmt::format("{}: holds something else; what it should hold is found anew", file.string())};
  if (!found) {
    fs::remove(file, code);
    return found;
  }
  fs::last_write_time(file, fs::file_time_type::clock::now(), code);
  found.value()->erase(0, name.size());
  return found;
}

Status SharedFiles::keep(const std::string& name, std::string bytes) const {
  const fs::path file = fileOf(name);
  bytes.insert(0, name);
  seal(bytes);
  if (bytes.size() > mostBytes_)
    return Error{fmt::format("{}: takes {:.0f} MB, more than the folder may hold ({:.0f} MB)", file.string(),
                             static_cast<double>(bytes.size()) * 1e-6, static_cast<double>(mostBytes_) * 1e-6)};
  std::error_code code;
  fs::create_directories(folder_, code);
  // A name that no other process or machine has.
  const fs::path part = folder_ / fmt::format("{}{}{}{:08x}", name, kind_, kUnfinished, std::random_device()());
  int reason = writeSynced(part, bytes);
  if (reason == 0) {
    fs::rename(part, file, code);
    reason = code.value();
  }
  if (reason != 0) {
    fs::remove(part, code);
    return cannotWrite(file, reason);
  }
  removeOldest();
  removeLeftovers();
  return Ok{};
}

void SharedFiles::removeOldest() const {
  struct Kept {
    fs::file_time_type used;
    uint64_t bytes;
    fs::path file;
  };
  std::vector<Kept> all;
  uint64_t sum = 0;
  forEachFile(folder_, [&](const fs::directory_entry& entry, const std::string& rest) {
    std::error_code noTime, noSize;
    const Kept kept{entry.last_write_time(noTime), entry.file_size(noSize), entry.path()};
    if (rest != kind_ || noTime || noSize) return;  // another process may have removed it
    sum += kept.bytes;
    all.push_back(kept);
  });
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (const Kept& kept : all) {
    if (sum <= mostBytes_) return;
    std::error_code code;
    fs::remove(kept.file, code);
    sum -= kept.bytes;
  }
}

// Of processes that were killed.
void SharedFiles::removeLeftovers() const {
  std::vector<fs::path> parts, claims;
  forEachFile(folder_, [&](const fs::directory_entry& entry, const std::string& rest) {
    const bool isPart = rest.starts_with(kind_ + std::string(kUnfinished)), isClaim = rest == kClaimed;
    if ((isPart || isClaim) && isAbandoned(entry.path())) (isPart ? parts : claims).push_back(entry.path());
  });
  std::error_code code;
  for (const fs::path& part : parts) fs::remove(part, code);
  for (const fs::path& claim : claims) {
    if (const Result<HeldFolder> held = holdFolder(claim); !held || !held.value()) continue;
    fs::remove(claim, code);  // empty now that its lock has gone
  }
}

HeldFolder SharedFiles::turn(const std::string& name, double seconds, const Progress& progress) const {
  const Stopwatch watch;
  while (true) {
    const Result<HeldFolder> held = holdFolder(folder_ / (name + std::string(kClaimed)));
    if (!held) return {};
    if (held.value() || has(name) || progress.stop() || watch.seconds() >= seconds) return held.value();
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

}  // namespace roomlight
