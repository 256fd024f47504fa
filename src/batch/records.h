// What is kept of tasks that are done or have failed: a small JSON file each, and lists of which there are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_set>

#include "base/result.h"
#include "batch/task_list.h"

namespace roomlight::batch {

struct DoneRecord {
  double seconds = 0, peakMiB = 0;  // of the command; 0: not known
  int tries = 1;
  std::string host;
};

struct FailedRecord {
  std::string line;    // what it said, or how it ended
  std::string how;     // "exit", "signal", "memory", "time", "input", "output"
  int tries = 0;
  bool isFinal = false;  // is not tried again by itself
  std::string host;
};

Status keepDone(const Folder& folder, const std::string& id, const DoneRecord& record);
std::optional<DoneRecord> doneRecord(const Folder& folder, const std::string& id);
Status keepFailed(const Folder& folder, const std::string& id, const FailedRecord& record);
std::optional<FailedRecord> failedRecord(const Folder& folder, const std::string& id);
void forgetFailed(const Folder& folder, const std::string& id);

using IdSet = std::unordered_set<uint64_t>;
// Ids that files of `folder`/xx are named by; folders are listed, no file is opened.
IdSet idsIn(const std::filesystem::path& folder);

}  // namespace roomlight::batch
