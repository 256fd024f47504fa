// How far a batch is: told by its folder alone, while others work on it.
#pragma once

#include <string>
#include <vector>

#include "batch/claim.h"
#include "batch/records.h"
#include "batch/task_list.h"

namespace roomlight::batch {

// What tasks take, by those of their section that are done; where none is, as estimated.
class Costs {
 public:
  Costs(const TaskList& list, const IdSet& done);
  double seconds(const Entry& e) const { return e.seconds * ratio_[e.section]; }
  bool isMeasured(uint32_t section) const { return measured_[section]; }

 private:
  std::vector<double> ratio_;  // of what was measured to the estimate
  std::vector<bool> measured_;
};

struct SectionCount {
  SectionInfo info;
  size_t done = 0, running = 0, failed = 0, waiting = 0;
};

struct Failure {
  size_t index = 0;
  std::string id;
  FailedRecord record;
};

struct BatchStatus {
  size_t done = 0, running = 0, failed = 0, waiting = 0;  // each task counts once
  size_t abandoned = 0;      // of those that wait: their process has gone, the next run takes them over
  double workLeftS = 0;      // of what runs and waits, one after the other
  double timeLeftS = -1;     // with as many at once as run now; -1: none runs
  bool isMeasured = false;   // times are of tasks that are done, not estimates
  std::vector<SectionCount> sections;
  std::vector<Failure> failures;  // the first kMostFailures
  std::vector<Claim> claims;      // of what runs
  static constexpr size_t kMostFailures = 20;
};
BatchStatus statusOf(const TaskList& list, double staleS = Claims::kUsualStaleS);

// Numbers of tasks that are neither done nor being run, in order; with `failed` those that have failed for good, too.
std::vector<size_t> tasksLeft(const TaskList& list, bool failed, double staleS = Claims::kUsualStaleS);

std::string statusText(const TaskList& list, const BatchStatus& status);
std::string statusJson(const TaskList& list, const BatchStatus& status);

}  // namespace roomlight::batch
