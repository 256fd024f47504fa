#include "batch/claim.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/platform/files.h"
#include "base/platform/machine.h"
#include "base/platform/process.h"
#include "base/write_file.h"
#include "batch/durable.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::string jsonOf(const Owner& o) {
  const Json json = {{"host", o.host}, {"machine", o.machine},   {"process", o.process}, {"started", o.started},
                     {"job", o.job},   {"restarts", o.restarts}, {"token", o.token}};
  return json.dump() + "\n";
}

Owner ownerOf(const std::string& text) {
  Owner o;
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return o;  // half written, or not ours: told by its age
  o.host = json.value("host", ""), o.machine = json.value("machine", ""), o.process = json.value("process", 0L);
  o.started = json.value("started", uint64_t{0}), o.job = json.value("job", ""), o.token = json.value("token", "");
  o.restarts = json.value("restarts", 0);
  return o;
}

constexpr double kSweptS = 3600;  // what is left of claims that were being made

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool isTask(const std::string& name) {
  return name.size() == 16 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

Owner thisOwner() {
  Owner o;
  o.host = hostName(), o.machine = machineIdentity();
  o.process = processNumber(), o.started = processStart(o.process), o.token = processToken();
  if (const std::string job = variable("SLURM_JOB_ID"); !job.empty()) {
    const std::string array = variable("SLURM_ARRAY_JOB_ID");
    o.job = array.empty() ? job : array + "_" + variable("SLURM_ARRAY_TASK_ID");
    o.restarts = std::atoi(variable("SLURM_RESTART_COUNT").c_str());
  }
  return o;
}

Claims::Claims(const Folder& folder, double staleS, Owner self)
    : folder_(folder), staleS_(staleS), self_(std::move(self)), lastBeatS_(steadySeconds()) {}

Claims::~Claims() {
  for (const std::string& id : std::set<std::string>(held_)) release(id);
}

// The file server's: clocks of machines differ.
double Claims::serverTime() const {
  const std::optional<double> now = fileServerTime(folder_.claims() / (".now-" + self_.token));
  if (now && *now != 0) return *now;
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

bool Claims::isStale(const Claim& c) const {
  const Owner& o = c.owner;
  if (o.host == self_.host && o.machine == self_.machine && o.process > 0) return processStart(o.process) != o.started;
  // Slurm has started the same job again: its first run is over.
  if (!o.job.empty() && o.job == self_.job && o.restarts < self_.restarts) return true;
  return c.ageS > staleS_;
}

std::optional<Claim> Claims::read(const std::string& id) const {
  double now = 0;
  return read(id, now);
}

// `now`: 0, or the time by the file server, which is asked for where it is needed.
std::optional<Claim> Claims::read(const std::string& id, double& now) const {
  const std::optional<FileFacts> about = factsOf(folder_.claims() / id);
  if (!about) return std::nullopt;
  Claim claim{id, ownerOf(textOf(folder_.claims() / id)), 0, false};
  const bool isHere = claim.owner.host == self_.host && claim.owner.machine == self_.machine;
  if (!isHere && now == 0) now = serverTime();
  if (!isHere) claim.ageS = now - about->modifiedS;
  claim.isStale = isStale(claim);
  return claim;
}

// As open(O_EXCL) is not atomic on old NFS. An answer that was lost is told by the number of links.
Result<bool> Claims::link(const std::string& id) const {
  const fs::path part = folder_.claims() / fmt::format(".{}-{}", id, self_.token);
  std::ofstream out(part, std::ios::binary);
  out << jsonOf(self_);
  out.close();
  const int writeError = errno;
  std::error_code code, ignored;
  if (!out) {
    fs::remove(part, ignored);
    return cannotWrite(part, writeError);
  }
  fs::create_hard_link(part, folder_.claims() / id, code);
  const std::optional<FileFacts> about = code ? factsOf(part) : std::nullopt;
  const bool mine = !code || (about && about->links == 2);
  fs::remove(part, ignored);
  if (mine) return true;
  if (code == std::errc::file_exists) return false;
  return cannotWrite(folder_.claims() / id, code.value());
}

bool Claims::takeOver(const Claim& stale) const {
  const fs::path file = folder_.claims() / stale.id;
  const fs::path aside = folder_.claims() / fmt::format(".{}-stale-{}", stale.id, self_.token);
  std::error_code code;
  fs::rename(file, aside, code);
  if (code) return false;  // another was faster
  const Owner taken = ownerOf(textOf(aside));
  const bool isIt = taken.token == stale.owner.token;
  if (!isIt) fs::create_hard_link(aside, file, code);  // a new one in the meantime: back to where it was
  fs::remove(aside, code);
  if (isIt && !taken.token.empty())
    fs::remove_all(folder_.path() / "out" / stale.id.substr(0, 2) / fmt::format("{}.{}.tmp", stale.id, taken.token),
                   code);
  return isIt;
}

Result<bool> Claims::take(const std::string& id) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    Result<bool> mine = link(id);
    if (!mine) return mine;
    if (mine.value()) {
      held_.insert(id);
      return true;
    }
    const std::optional<Claim> other = read(id);
    if (other && other->owner.token == self_.token && held_.insert(id).second) return true;  // had been let go in vain
    if (other && !other->isStale) return false;
    if (other && !takeOver(*other)) return false;
  }
  return false;
}

void Claims::release(const std::string& id) {
  held_.erase(id);
  const fs::path file = folder_.claims() / id;
  std::error_code code;
  if (ownerOf(textOf(file)).token == self_.token) fs::remove(file, code);
}

bool Claims::holds(const std::string& id) const {
  return held_.contains(id) && ownerOf(textOf(folder_.claims() / id)).token == self_.token;
}

void Claims::beat() {
  if (steadySeconds() - lastBeatS_ < kBeatS) return;
  lastBeatS_ = steadySeconds();
  for (const std::string& id : held_) touch(folder_.claims() / id);
}

void Claims::sweep() const {
  std::error_code code;
  const double now = serverTime();
  std::vector<fs::path> old;
  for (fs::directory_iterator it(folder_.claims(), code), end; !code && it != end; it.increment(code)) {
    if (!it->path().filename().string().starts_with('.')) continue;
    const std::optional<FileFacts> about = factsOf(it->path());
    if (about && now - about->modifiedS > kSweptS) old.push_back(it->path());
  }
  for (const fs::path& file : old) fs::remove(file, code);
  // Claims of tasks that are being done are of no interest here: each of many runners would read all of them.
  double serverNow = now;
  for (const std::string& id : ids()) {
    if (!fs::exists(folder_.done(id), code)) continue;
    const std::optional<Claim> claim = read(id, serverNow);
    if (claim && claim->isStale) fs::remove(folder_.claims() / id, code);
  }
}

std::vector<std::string> Claims::ids() const {
  std::vector<std::string> out;
  std::error_code code;
  for (fs::directory_iterator it(folder_.claims(), code), end; !code && it != end; it.increment(code)) {
    if (std::string name = it->path().filename().string(); isTask(name)) out.push_back(std::move(name));
  }
  return out;
}

std::vector<Claim> Claims::all() const {
  std::vector<Claim> out;
  double now = 0;
  for (const std::string& id : ids()) {
    if (const std::optional<Claim> claim = read(id, now)) out.push_back(*claim);
  }
  return out;
}

size_t Claims::liveCount() const {
  size_t count = 0;
  for (const Claim& claim : all()) count += !claim.isStale;
  return count;
}

}  // namespace roomlight::batch
