// Tasks of a batch on disk: tasks.jsonl, an index of it, and plan.json, all in the batch's folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/result.h"
#include "batch/task.h"

namespace roomlight::batch {

// Where things lie in the folder of a batch.
class Folder {
 public:
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path plan() const { return path_ / "plan.json"; }
  std::filesystem::path tasks() const { return path_ / "tasks.jsonl"; }
  std::filesystem::path index() const { return path_ / "tasks.idx"; }
  std::filesystem::path claims() const { return path_ / "claims"; }
  std::filesystem::path merged() const { return path_ / "merged"; }
  std::filesystem::path slurm() const { return path_ / "slurm"; }
  // Spread over 256 folders by the first two digits of the id; the folder is not made.
  std::filesystem::path out(const std::string& id) const { return spread("out", id); }
  std::filesystem::path done(const std::string& id) const { return spread("done", id); }
  std::filesystem::path failed(const std::string& id) const { return spread("failed", id); }
  // Output that is not finished; relative to path(), as the command that writes it is told.
  static std::string unfinished(const std::string& id);

 private:
  std::filesystem::path spread(const char* kind, const std::string& id) const {
    return path_ / kind / id.substr(0, 2) / id;
  }
  std::filesystem::path path_;
};

// A table of the plan file, such as one [[pictures]].
struct SectionInfo {
  std::string kind, name;
  int line = 0;
  uint64_t tasks = 0;
};

struct PlanInfo {
  std::string version, name, file;  // of the program; of the batch; the plan file
  uint64_t tasks = 0, bytes = 0;    // in tasks.jsonl
  std::vector<SectionInfo> sections;
};

// What is known of a task without reading its line. 24 bytes in the index, the lowest byte first.
struct Entry {
  uint64_t offset = 0, id = 0;
  uint32_t section = 0;
  float seconds = 0;  // estimate
};

// Writes tasks one by one; they take the place of an earlier plan when finish() is called, and not before.
class TaskWriter {
 public:
  // Makes the folder.
  static Result<TaskWriter> open(const Folder& folder);
  Status add(const Task& task, uint32_t section);
  Status finish(PlanInfo info);

 private:
  TaskWriter(const Folder& folder, std::filesystem::path tasks, std::filesystem::path index)
      : folder_(folder), tasksPart_(std::move(tasks)), indexPart_(std::move(index)) {}
  Folder folder_;
  std::filesystem::path tasksPart_, indexPart_;
  std::ofstream tasks_, index_;
  uint64_t offset_ = 0, count_ = 0;
};

class TaskList {
 public:
  static Result<TaskList> open(const Folder& folder);
  const Folder& folder() const { return folder_; }
  const PlanInfo& info() const { return info_; }
  size_t size() const { return entries_.size(); }
  const Entry& entry(size_t index) const { return entries_[index]; }
  const std::vector<Entry>& entries() const { return entries_; }
  // Reads one line.
  Result<Task> task(size_t index) const;

 private:
  explicit TaskList(const Folder& folder) : folder_(folder) {}
  Folder folder_;
  PlanInfo info_;
  std::vector<Entry> entries_;
};

}  // namespace roomlight::batch
