// Batches as array jobs of Slurm.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "batch/task_list.h"

namespace roomlight::batch {

struct SlurmWish {
  std::filesystem::path program;
  std::string partition, time;   // empty: Slurm's own
  int arrayLimit = 0;            // chunks at once; 0: no limit
  int cpus = 1;                  // of each chunk
  double chunkMinutes = 10;      // of work, at least
  size_t mostInArray = 1000;     // MaxArraySize of the cluster, less one
};

// What is left to do, in chunks that take as long as wished.
struct SlurmPlan {
  size_t tasks = 0, chunk = 1, chunks = 0;  // chunk: tasks of each
  double seconds = 0;                       // of all work
  std::filesystem::path list;               // file of what is left, a line of fixed width for each
  std::vector<std::filesystem::path> arrays;  // scripts for sbatch, of at most mostInArray chunks
  std::filesystem::path merge;                // the script that follows them
  std::vector<std::string> contents;          // of arrays and merge
};
// Nothing is written. `left`: numbers of tasks.
SlurmPlan slurmPlan(const TaskList& list, const std::vector<size_t>& left, const SlurmWish& wish);

// Writes list and scripts.
Status writeSlurm(const SlurmPlan& plan, const std::vector<size_t>& left);

// Submits the arrays, then the merge; returns their job numbers, which are kept for status.
Result<std::vector<std::string>> submitSlurm(const Folder& folder, const SlurmPlan& plan);

// Whether jobs that were submitted are still in the queue; the error: there is no Slurm to ask.
Result<bool> isQueued(const Folder& folder);

// What the queue says of submitted jobs, one line; empty where nothing was submitted or there is no Slurm.
std::string slurmStatus(const Folder& folder);

// Numbers first to first + count - 1 of a list written by writeSlurm().
Result<std::vector<size_t>> readTaskNumbers(const std::filesystem::path& list, size_t first, size_t count);

}  // namespace roomlight::batch
