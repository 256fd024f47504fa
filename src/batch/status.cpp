#include "batch/status.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "report/table.h"

namespace roomlight::batch {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMostSamples = 100;  // of each section

std::string duration(double s) {
  if (s < 90) return fmt::format("{:.0f} s", s);
  if (s < 5400) return fmt::format("{:.0f} min", s / 60);
  return s < 172800 ? fmt::format("{:.1f} h", s / 3600) : fmt::format("{:.1f} days", s / 86400);
}

// What is known of all tasks. Claims are listed first and what is done last: a task that goes on meanwhile is seen in
// both places rather than in neither, and counts where it is now.
struct Listing {
  std::unordered_map<uint64_t, Claim> claims;
  IdSet failed, done;

  Listing(const TaskList& list, double staleS) {
    for (Claim& c : Claims(list.folder(), staleS).all()) claims.emplace(std::stoull(c.id, nullptr, 16), std::move(c));
    failed = idsIn(list.folder().path() / "failed");
    done = idsIn(list.folder().path() / "done");
  }
  const Claim* live(uint64_t id) const {
    const auto found = claims.find(id);
    return found == claims.end() || found->second.isStale ? nullptr : &found->second;
  }
};

std::optional<FailedRecord> finalFailure(const TaskList& list, const Listing& all, uint64_t id) {
  if (!all.failed.contains(id)) return std::nullopt;
  std::optional<FailedRecord> record = failedRecord(list.folder(), idText(id));
  return record && record->isFinal ? record : std::nullopt;
}

}  // namespace

Costs::Costs(const TaskList& list, const IdSet& done)
    : ratio_(list.info().sections.size(), 1), measured_(list.info().sections.size(), false) {
  std::vector<size_t> count(ratio_.size(), 0), seen(ratio_.size(), 0);
  std::vector<double> measured(ratio_.size(), 0), estimated(ratio_.size(), 0);
  for (const Entry& e : list.entries()) count[e.section] += done.contains(e.id);
  for (const Entry& e : list.entries()) {
    if (!done.contains(e.id)) continue;
    const size_t each = std::max<size_t>(1, count[e.section] / kMostSamples);
    if (seen[e.section]++ % each != 0) continue;
    const std::optional<DoneRecord> record = doneRecord(list.folder(), idText(e.id));
    if (record && record->seconds > 0) measured[e.section] += record->seconds, estimated[e.section] += e.seconds;
  }
  for (size_t i = 0; i < ratio_.size(); ++i) {
    measured_[i] = measured[i] > 0 && estimated[i] > 0;
    if (measured_[i]) ratio_[i] = measured[i] / estimated[i];
  }
}

BatchStatus statusOf(const TaskList& list, double staleS) {
  BatchStatus out;
  for (const SectionInfo& info : list.info().sections) out.sections.push_back({info});
  const Listing all(list, staleS);
  const Costs costs(list, all.done);
  for (size_t i = 0; i < list.size(); ++i) {
    const Entry& e = list.entry(i);
    SectionCount& section = out.sections[e.section];
    if (all.done.contains(e.id)) {
      ++out.done, ++section.done;
      continue;
    }
    const Claim* live = all.live(e.id);
    const std::optional<FailedRecord> failure = live ? std::nullopt : finalFailure(list, all, e.id);
    if (failure) {
      ++out.failed, ++section.failed;
      if (out.failures.size() < BatchStatus::kMostFailures) out.failures.push_back({i, idText(e.id), *failure});
      continue;
    }
    out.workLeftS += costs.seconds(e) * (live ? 0.5 : 1);
    out.isMeasured = out.isMeasured || costs.isMeasured(e.section);
    if (live) {
      ++out.running, ++section.running;
      out.claims.push_back(*live);
    } else {
      ++out.waiting, ++section.waiting;
      out.abandoned += all.claims.contains(e.id);
    }
  }
  if (out.running > 0) out.timeLeftS = out.workLeftS / static_cast<double>(out.running);
  return out;
}

std::vector<size_t> tasksLeft(const TaskList& list, bool failed, double staleS) {
  const Listing all(list, staleS);
  std::vector<size_t> out;
  for (size_t i = 0; i < list.size(); ++i) {
    const uint64_t id = list.entry(i).id;
    if (all.done.contains(id) || all.live(id)) continue;
    if (failed || !finalFailure(list, all, id)) out.push_back(i);
  }
  return out;
}

std::string statusText(const TaskList& list, const BatchStatus& s) {
  std::string out = fmt::format("{}: {} tasks: {} done, {} running, {} failed, {} waiting\n", list.info().name,
                                list.size(), s.done, s.running, s.failed, s.waiting);
  if (s.abandoned > 0)
    out += fmt::format("{} of those waiting were given up by a process that has gone; the next run takes them over\n",
                       s.abandoned);
  if (s.running + s.waiting > 0)
    out += fmt::format("left: {} of work{}{}\n", duration(s.workLeftS),
                       s.timeLeftS < 0 ? "" : fmt::format(", {} with {} at once", duration(s.timeLeftS), s.running),
                       s.isMeasured ? "" : " (estimated: none is done yet)");
  report::Table table({"", "done", "running", "failed", "waiting"});
  for (const SectionCount& c : s.sections) table.row({c.info.name, c.done, c.running, c.failed, c.waiting});
  if (s.sections.size() > 1) out += table.text();
  for (const Failure& f : s.failures)
    out += fmt::format("failed: task {} ({}), {} {}: {}\n", f.index, f.id, f.record.tries,
                       f.record.tries == 1 ? "try" : "tries", f.record.line);
  if (s.failed > s.failures.size()) out += fmt::format("and {} more\n", s.failed - s.failures.size());
  return out;
}

std::string statusJson(const TaskList& list, const BatchStatus& s) {
  Json sections = Json::array(), failures = Json::array(), running = Json::array();
  for (const SectionCount& c : s.sections)
    sections.push_back({{"name", c.info.name},
                        {"kind", c.info.kind},
                        {"done", c.done},
                        {"running", c.running},
                        {"failed", c.failed},
                        {"waiting", c.waiting}});
  for (const Failure& f : s.failures)
    failures.push_back({{"task", f.index},
                        {"id", f.id},
                        {"how", f.record.how},
                        {"line", f.record.line},
                        {"tries", f.record.tries},
                        {"host", f.record.host}});
  for (const Claim& c : s.claims)
    running.push_back({{"id", c.id}, {"host", c.owner.host}, {"process", c.owner.process}, {"job", c.owner.job}});
  const Json json = {{"name", list.info().name},
                     {"tasks", list.size()},
                     {"done", s.done},
                     {"running", s.running},
                     {"failed", s.failed},
                     {"waiting", s.waiting},
                     {"abandoned", s.abandoned},
                     {"workLeftS", s.workLeftS},
                     {"timeLeftS", s.timeLeftS < 0 ? Json(nullptr) : Json(s.timeLeftS)},
                     {"measured", s.isMeasured},
                     {"sections", sections},
                     {"failures", failures},
                     {"runningTasks", running}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace roomlight::batch
