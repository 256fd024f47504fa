// What comes of a batch: figures as tables, means of seeds, sheets of pictures, films, one page.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/image_io.h"
#include "base/result.h"
#include "batch/records.h"
#include "batch/task_list.h"

namespace roomlight::batch {

// A task that is done, with the files that it has written.
struct DoneTask {
  size_t index = 0;
  uint32_t section = 0;
  Task task;
  DoneRecord record;
  std::vector<std::filesystem::path> files;  // sorted by name

  std::string labels() const;  // "house Kitchen evening"
};

// Of seeds of one view.
struct SeedMean {
  std::string group, mean, error;  // name; files in the folder `merged`
  size_t seeds = 0;
  double standardError = 0;  // of the mean: root mean square over pixels, relative to the mean luminance
};

struct Sheet {
  std::string title, file;
  size_t pictures = 0;
};

struct Film {
  std::string group, file, command;  // file: empty where ffmpeg is not there or has failed; command: what makes it
  size_t frames = 0;
};

// Of the parts of a long command, in a folder of `merged`.
struct Whole {
  std::string group, file;  // what to open or to go on with; empty: not all of it is there
  std::string command;      // what goes on with it; empty: nothing is left to do
  std::string missing;      // why there is no file
};

struct Merged {
  size_t tasks = 0, done = 0, failed = 0;
  double workSeconds = 0;
  std::vector<SeedMean> means;
  std::vector<Sheet> sheets;
  std::vector<Film> films;
  std::vector<Whole> wholes;
  std::vector<std::pair<std::string, std::string>> failures;  // task, line
  std::vector<std::string> remarks;  // of what could not be read or made
  bool hasReadings = false;          // readings.csv is there
};

// Puts together what is done so far into the folder `merged`; `program` writes the reports of studies. The error is of
// files that cannot be written.
Result<Merged> mergeBatch(const TaskList& list, const std::filesystem::path& program);

// As one word of a shell's command.
std::string quotedForShell(const std::string& text);

// Names for files that differ from one another.
class FileNames {
 public:
  std::string of(const std::string& text);

 private:
  std::map<std::string, int> taken_;
};

// The mean of pictures of one size, and in grey the standard error of their mean; both as .exr.
Result<SeedMean> meanOfSeeds(const std::string& group, const std::vector<std::filesystem::path>& pictures,
                             const std::filesystem::path& mean, const std::filesystem::path& error);

// Pictures side by side, small, on sheets as JPEG; of .exr by the usual look.
class SheetMaker {
 public:
  SheetMaker(std::filesystem::path folder, std::string title, std::string name)
      : folder_(std::move(folder)), title_(std::move(title)), name_(std::move(name)) {}
  Status add(const std::filesystem::path& picture);
  Status finish();
  const std::vector<Sheet>& sheets() const { return sheets_; }

 private:
  std::filesystem::path folder_;
  std::string title_, name_;
  std::vector<Image> small_;
  std::vector<Sheet> sheets_;
};

// `frames`: of one film, in order. `list`: name of the list that ffmpeg reads.
Film makeFilm(const std::string& group, const std::vector<std::filesystem::path>& frames, double framesPerSecond,
              const std::filesystem::path& folder, const std::string& name);

// `tasks`: of one group, those that are done. `name`: of a folder in `merged`. The response of all candidates, with
// which `optimise` goes on.
Whole joinResponse(const Folder& folder, const std::vector<DoneTask>& tasks, const std::string& name);
// The study with what all its tasks have measured; its reports are written by `program`.
Whole joinStudy(const Folder& folder, const std::vector<DoneTask>& tasks, const std::string& name,
                const std::filesystem::path& program);

std::string mergedPage(const TaskList& list, const Merged& merged);

}  // namespace roomlight::batch
