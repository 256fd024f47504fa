// Who works on a task: a file each in the folder `claims`, made and taken over by link() and rename() alone, so that it
// works on NFS without locks. A claim that two hold for a moment does no harm: both results are the same.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.h"
#include "batch/task_list.h"

namespace roomlight::batch {

// A process, among those of all machines.
struct Owner {
  std::string host, machine;  // name; boot and process namespace: process numbers are told apart by it
  long process = 0;
  uint64_t started = 0;  // of the process, in clock ticks since the machine's start
  std::string job;  // of Slurm: "1234_5"; empty: none
  int restarts = 0;  // of that job
  std::string token;  // processToken()
};
Owner thisOwner();

struct Claim {
  std::string id;
  Owner owner;
  double ageS = 0;  // since its last sign of life, by the clock of the file server
  bool isStale = false;
};

class Claims {
 public:
  static constexpr double kUsualStaleS = 300;
  static constexpr double kBeatS = 20;  // between signs of life

  // `staleS`: claims of other machines without a sign of life for so long are taken over. Those of this machine are as
  // soon as their process is gone.
  explicit Claims(const Folder& folder, double staleS = kUsualStaleS, Owner self = thisOwner());
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  // False: another process has it. What a dead one has left is taken over, its unfinished output removed.
  Result<bool> take(const std::string& id);
  void release(const std::string& id);
  // False: another has taken over what this process has taken, since it showed no sign of life for so long.
  bool holds(const std::string& id) const;
  // A sign of life of all that are held, if the last was kBeatS ago.
  void beat();

  // Removes what processes that were killed have left: claims half made, and those of tasks that are done. Looks at all
  // claims.
  void sweep() const;

  std::vector<Claim> all() const;
  size_t liveCount() const;

 private:
  std::optional<Claim> read(const std::string& id) const;
  std::optional<Claim> read(const std::string& id, double& now) const;
  std::vector<std::string> ids() const;
  bool isStale(const Claim& claim) const;
  Result<bool> link(const std::string& id) const;
  bool takeOver(const Claim& stale) const;
  double serverTime() const;  // seconds

  Folder folder_;
  double staleS_;
  Owner self_;
  std::set<std::string> held_;
  double lastBeatS_ = 0;
};

}  // namespace roomlight::batch
