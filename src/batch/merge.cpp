#include "batch/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "base/write_file.h"
#include "batch/claim.h"
#include "batch/durable.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostListed = 100;      // failures and remarks on the page
constexpr size_t kMostOnSheets = 3000;   // pictures of one section
constexpr double kUsualRate = 10;        // frames a second of walk files

// A cell of a CSV file (RFC 4180).
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

bool isPicture(const fs::path& file) {
  const std::string e = file.extension().string();
  return e == ".png" || e == ".jpg" || e == ".exr" || e == ".webp";
}

double rateOf(const Folder& folder, const Task& task) {
  const auto walk = std::find(task.arguments.begin(), task.arguments.end(), "--walk");
  if (walk == task.arguments.end() || walk + 1 == task.arguments.end()) return kUsualRate;
  const auto json = nlohmann::json::parse(textOf(folder.path() / *(walk + 1)), nullptr, false);
  if (!json.is_object()) return kUsualRate;
  const auto number = [&](const nlohmann::json& from, const char* key, double otherwise) {
    return from.contains(key) && from[key].is_number() ? from[key].get<double>() : otherwise;
  };
  double rate = number(json, "framesPerSecond", kUsualRate);
  // Fewer frames, spread evenly over the same time.
  const auto frames = std::find(task.arguments.begin(), task.arguments.end(), "--frames");
  const double seconds = number(json, "seconds", 0);
  if (frames != task.arguments.end() && frames + 1 != task.arguments.end() && seconds > 0)
    rate = std::atof((frames + 1)->c_str()) / seconds;
  return std::clamp(rate, 0.1, 240.0);
}

class Merger {
 public:
  Merger(const TaskList& list, const fs::path& program)
      : list_(list), program_(program), folder_(list.folder().merged()) {
    out_.tasks = list.size();
  }

  Result<Merged> merge() {
    std::error_code code;
    fs::create_directories(folder_, code);
    if (code) return cannotWrite(folder_, code.value());
    figures_.open(folder_ / "figures.csv.part", std::ios::binary);
    figures_ << "task,id,section,kind,home,camera,light,technique,seed,other,state,seconds,peakMiB,tries,host,file\n";
    for (const SectionInfo& s : list_.info().sections)
      sheets_.emplace_back(folder_, s.name, "sheet_" + names_.of(s.name));
    onSheets_.assign(sheets_.size(), 0);
    for (size_t i = 0; i < list_.size(); ++i) {
      if (const Status s = addTask(i); !s) return Error{s.error()};
    }
    if (const Status s = makeGroups(); !s) return Error{s.error()};
    if (const Status s = finishFiles(); !s) return Error{s.error()};
    if (const Status s = writeDurably(folder_ / "index.html", mergedPage(list_, out_)); !s) return Error{s.error()};
    return std::move(out_);
  }

 private:
  void remark(const std::string& text) {
    if (out_.remarks.size() < kMostListed) out_.remarks.push_back(text);
  }

  Status addTask(size_t index) {
    Result<Task> task = list_.task(index);
    if (!task) return Error{task.error()};
    DoneTask done{index, list_.entry(index).section, std::move(task.value()), {}, {}};
    const std::optional<DoneRecord> record = doneRecord(list_.folder(), done.task.id);
    if (!record) {
      addMissing(done);
      return Ok{};
    }
    done.record = *record;
    std::error_code code;
    for (fs::recursive_directory_iterator it(list_.folder().out(done.task.id), code), end; !code && it != end;
         it.increment(code)) {
      if (it->is_regular_file(code)) done.files.push_back(it->path());
    }
    std::sort(done.files.begin(), done.files.end());
    if (done.files.empty()) remark(fmt::format("task {} ({}): its output is gone", index, done.task.id));
    ++out_.done, out_.workSeconds += record->seconds;
    addFigures(done, "done", done.record);
    return addContent(done);
  }

  void addMissing(const DoneTask& task) {
    const std::optional<FailedRecord> failure = failedRecord(list_.folder(), task.task.id);
    const bool failed = failure && failure->isFinal;
    addFigures(task, failed ? "failed" : "waiting", {0, 0, failure ? failure->tries : 0, {}});
    if (!failed) return;
    ++out_.failed;
    if (out_.failures.size() < kMostListed)
      out_.failures.emplace_back(fmt::format("{} {}", list_.info().sections[task.section].name, task.labels()),
                                 failure->line);
  }

  void addFigures(const DoneTask& t, const char* state, const DoneRecord& r) {
    static const std::vector<std::string> kAxes = {"home", "camera", "light", "technique", "seed"};
    std::string row =
        fmt::format("{},{},{},{}", t.index, t.task.id, cell(list_.info().sections[t.section].name), t.task.kind);
    for (const std::string& axis : kAxes) {
      const auto label =
          std::find_if(t.task.labels.begin(), t.task.labels.end(), [&](const auto& l) { return l.first == axis; });
      row += "," + (label == t.task.labels.end() ? "" : cell(label->second));
    }
    std::string other;
    for (const auto& [axis, label] : t.task.labels) {
      if (std::find(kAxes.begin(), kAxes.end(), axis) == kAxes.end())
        other += fmt::format("{}{}={}", other.empty() ? "" : " ", axis, label);
    }
    const std::string file = t.files.empty() ? "" : t.files.front().lexically_relative(folder_).string();
    figures_ << row
             << fmt::format(",{},{},{:.3f},{:.1f},{},{},{}\n", cell(other), state, r.seconds, r.peakMiB, r.tries,
                            cell(r.host), cell(file));
  }

  Status addContent(const DoneTask& done) {
    if (done.task.kind == "references") {
      for (const fs::path& file : done.files) means_[done.task.group + nameBeside(done, file)].push_back(file);
    } else if (done.task.kind == "walks") {
      Frames& frames = films_[done.task.group];
      if (frames.files.empty()) frames.rate = rateOf(list_.folder(), done.task);
      frames.files.insert(frames.files.end(), done.files.begin(), done.files.end());
    } else if (done.task.kind == "optimise" || done.task.kind == "study") {
      parts_[done.task.group].push_back(done);
    } else if (done.task.kind == "measure") {
      return addReadings(done);
    } else {
      for (const fs::path& file : done.files) {
        if (!isPicture(file) || ++onSheets_[done.section] > kMostOnSheets) continue;
        if (const Status s = sheets_[done.section].add(file); !s) remark(s.error());
      }
    }
    return Ok{};
  }

  // What tells files of one task apart, as with --camera all.
  static std::string nameBeside(const DoneTask& done, const fs::path& file) {
    const std::string stem = fs::path(done.task.output).stem().string(), name = file.stem().string();
    return name.starts_with(stem) ? name.substr(stem.size()) : " " + name;
  }

  // One table of all: a line each reading, with where it is from before it.
  Status addReadings(const DoneTask& done) {
    for (const fs::path& file : done.files) {
      if (file.extension() != ".csv") continue;
      std::istringstream lines(textOf(file));
      std::string line, from = fmt::format("{},{}", done.index, cell(list_.info().sections[done.section].name));
      for (const char* axis : {"home", "light", "technique", "seed"}) {
        const auto label = std::find_if(done.task.labels.begin(), done.task.labels.end(),
                                        [&](const auto& l) { return l.first == axis; });
        from += "," + (label == done.task.labels.end() ? "" : cell(label->second));
      }
      std::getline(lines, line);
      if (!out_.hasReadings) {
        readings_.open(folder_ / "readings.csv.part", std::ios::binary);
        readings_ << "task,section,home,light,technique,seed," << line << "\n";
        out_.hasReadings = true;
      }
      while (std::getline(lines, line)) readings_ << from << "," << line << "\n";
    }
    return Ok{};
  }

  Status makeGroups() {
    for (const auto& [group, files] : means_) {
      const std::string name = names_.of(group);
      const Result<SeedMean> mean =
          meanOfSeeds(group, files, folder_ / ("mean_" + name + ".exr"), folder_ / ("error_" + name + ".exr"));
      if (!mean && tellsOfFullDisk(mean.error())) return Error{mean.error()};
      if (mean)
        out_.means.push_back(mean.value());
      else
        remark(mean.error());
    }
    for (const auto& [group, frames] : films_)
      out_.films.push_back(makeFilm(group, frames.files, frames.rate, folder_, "film_" + names_.of(group)));
    for (const auto& [group, tasks] : parts_) {
      const std::string name = folders_.of(group);
      out_.wholes.push_back(tasks.front().task.kind == "study" ? joinStudy(list_.folder(), tasks, name, program_)
                                                               : joinResponse(list_.folder(), tasks, name));
    }
    for (SheetMaker& maker : sheets_) {
      if (const Status s = maker.finish(); !s) return s;
      out_.sheets.insert(out_.sheets.end(), maker.sheets().begin(), maker.sheets().end());
    }
    for (size_t i = 0; i < onSheets_.size(); ++i) {
      if (onSheets_[i] > kMostOnSheets)
        remark(fmt::format("{}: {} pictures are not on sheets, which hold {}", list_.info().sections[i].name,
                           onSheets_[i] - kMostOnSheets, kMostOnSheets));
    }
    return Ok{};
  }

  Status finishFiles() {
    figures_.close();
    if (!figures_) return cannotWrite(folder_ / "figures.csv", errno);
    std::error_code code;
    fs::rename(folder_ / "figures.csv.part", folder_ / "figures.csv", code);
    if (!out_.hasReadings) return Ok{};
    readings_.close();
    if (!readings_) return cannotWrite(folder_ / "readings.csv", errno);
    fs::rename(folder_ / "readings.csv.part", folder_ / "readings.csv", code);
    return Ok{};
  }

  struct Frames {
    std::vector<fs::path> files;
    double rate = kUsualRate;
  };

  const TaskList& list_;
  const fs::path& program_;
  const fs::path folder_;
  std::ofstream figures_, readings_;
  FileNames names_, folders_;
  std::map<std::string, std::vector<fs::path>> means_;
  std::map<std::string, Frames> films_;
  std::map<std::string, std::vector<DoneTask>> parts_;
  std::vector<SheetMaker> sheets_;
  std::vector<size_t> onSheets_;  // pictures of a section
  Merged out_;
};

}  // namespace

std::string DoneTask::labels() const {
  std::string out;
  for (const auto& [axis, label] : task.labels) out += (out.empty() ? "" : " ") + label;
  return out;
}

std::string FileNames::of(const std::string& text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' ? c : '_';
  const int count = ++taken_[name];
  return count == 1 ? name : fmt::format("{}_{}", name, count);
}

Result<Merged> mergeBatch(const TaskList& list, const fs::path& program) {
  Claims(list.folder()).sweep();
  return Merger(list, program).merge();
}

}  // namespace roomlight::batch
