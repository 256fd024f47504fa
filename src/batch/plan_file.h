// The plan file (docs/reference/batch.md): tables such as [[pictures]], each a product of axes, and the tasks they are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "batch/inputs.h"
#include "batch/task.h"
#include "batch/task_list.h"

namespace roomlight::batch {

// A place on an axis.
struct AxisValue {
  std::string label;  // for people, and for {axis} within a longer word
  std::vector<std::string> words;  // for {axis} alone; may be none
  std::vector<std::string> files;  // inputs, relative to the batch's folder
};

struct Axis {
  std::string name;  // "home", "camera", "seed", ...
  std::vector<AxisValue> values;
  bool together = false;  // merge makes one thing of all its values: a mean, a film
};

// A table of the plan file: a task for every combination of its axes, the last of which runs fastest.
struct Section {
  std::string kind, name;
  int line = 0;
  std::vector<Axis> axes;
  std::vector<std::string> words;  // of the command; {axis} stands for a value
  std::vector<std::string> files;  // inputs of all its tasks, relative to the batch's folder
  std::string output;
  double seconds = 0;  // estimate, of one task
  bool findFiles = false;  // words that name files are inputs: nothing else tells
};

struct Plan {
  std::filesystem::path file, folder;  // the plan file; the folder of the batch, for which paths are made
  std::string name;
  std::vector<Section> sections;
};

// Errors are "file:line: place: what is wrong": unknown keys with the nearest known one, values, files that are not
// there.
Result<Plan> readPlanFile(const std::filesystem::path& file, const std::filesystem::path& folder);

uint64_t taskCount(const Section& section);

// Takes a task and the number of its section.
using TakeTask = std::function<Status(const Task&, uint32_t)>;

// Gives all tasks one by one, with ids for this version of the program. Errors: an input that cannot be read; the same
// task twice; what `take` says.
Status expand(const Plan& plan, InputHashes& hashes, const std::string& version, const TakeTask& take);

// Its words are a command of this program that can be read: an unknown option is an error.
using CheckWords = std::function<Status(const std::vector<std::string>&)>;

struct Planned {
  uint64_t tasks = 0, done = 0;  // done: in the folder already
  std::vector<SectionInfo> sections;
};

// Reads the plan file and writes the tasks into the folder. The first task of each section is checked by `check`.
// Refuses while tasks of an earlier plan are being run.
Result<Planned> planBatch(const std::filesystem::path& file, const std::filesystem::path& folder,
                          const std::string& version, const CheckWords& check);

}  // namespace roomlight::batch
