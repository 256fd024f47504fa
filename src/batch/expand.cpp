// Sections into tasks.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "batch/plan_axes.h"
#include "batch/plan_file.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

// All combinations of one section, as a counter whose last digit runs fastest.
class Expansion {
 public:
  Expansion(const Plan& plan, const Section& section, InputHashes& hashes)
      : plan_(plan), section_(section), hashes_(hashes), at_(section.axes.size(), 0) {}

  // The task here, without its id. Errors: an input that cannot be read.
  Result<Task> task() {
    Task task;
    task.kind = section_.kind, task.output = section_.output, task.seconds = section_.seconds;
    task.group = section_.name;
    std::vector<std::string> files = section_.files;
    for (size_t i = 0; i < at_.size(); ++i) {
      const Axis& axis = section_.axes[i];
      const AxisValue& value = axis.values[at_[i]];
      task.labels.emplace_back(axis.name, value.label);
      if (!axis.together) task.group += " " + value.label;
      files.insert(files.end(), value.files.begin(), value.files.end());
    }
    for (const std::string& word : section_.words) addWords(word, task.arguments);
    if (section_.findFiles) findFiles(task.arguments, files);
    if (const Status s = addInputs(files, task); !s) return Error{s.error()};
    return task;
  }

  // On to the next; false after the last.
  bool next() {
    for (size_t i = at_.size(); i-- > 0;) {
      if (++at_[i] < section_.axes[i].values.size()) return true;
      at_[i] = 0;
    }
    return false;
  }

 private:
  void addWords(const std::string& word, std::vector<std::string>& out) const {
    std::string replaced = word;
    for (size_t i = 0; i < at_.size(); ++i) {
      const Axis& axis = section_.axes[i];
      const AxisValue& value = axis.values[at_[i]];
      const std::string place = "{" + axis.name + "}";
      if (word == place) {
        out.insert(out.end(), value.words.begin(), value.words.end());
        return;
      }
      for (size_t from = replaced.find(place); from != std::string::npos;
           from = replaced.find(place, from + value.label.size()))
        replaced.replace(from, place.size(), value.label);
    }
    out.push_back(std::move(replaced));
  }

  // Words that name files beside the plan become the batch's names of them.
  void findFiles(std::vector<std::string>& words, std::vector<std::string>& files) {
    for (std::string& word : words) {
      if (word.find_first_of("./") == std::string::npos || word.find('{') != std::string::npos) continue;
      const auto known = related_.find(word);
      std::string& related = known != related_.end() ? known->second : related_[word];
      std::error_code code;
      const fs::path here = fs::absolute(plan_.file, code).parent_path();
      if (known == related_.end() && fs::exists(here / word, code))
        related = PlanPaths{fs::weakly_canonical(here, code), plan_.folder}.related(word);
      if (related.empty()) continue;
      word = related;
      if (fs::is_regular_file(plan_.folder / related, code)) files.push_back(related);
    }
  }

  Status addInputs(const std::vector<std::string>& files, Task& task) {
    for (const std::string& file : files) {
      auto& inputs = inputs_[file];
      if (inputs.empty()) {
        const fs::path whole = (plan_.folder / file).lexically_normal();
        inputs.push_back({file, hashes_.of(whole)});
        for (const fs::path& named : hashes_.named(whole))
          inputs.push_back({named.lexically_relative(plan_.folder).string(), hashes_.of(named)});
      }
      if (inputs.front().hash.empty())
        return Error{fmt::format("{}:{}: {}: {} cannot be read", plan_.file.string(), section_.line, section_.kind,
                                 (plan_.folder / file).lexically_normal().string())};
      task.inputs.insert(task.inputs.end(), inputs.begin(), inputs.end());
    }
    std::sort(task.inputs.begin(), task.inputs.end(), [](const Input& a, const Input& b) { return a.file < b.file; });
    task.inputs.erase(std::unique(task.inputs.begin(), task.inputs.end()), task.inputs.end());
    return Ok{};
  }

  const Plan& plan_;
  const Section& section_;
  InputHashes& hashes_;
  std::vector<size_t> at_;  // a value on each axis
  std::unordered_map<std::string, std::string> related_;
  std::unordered_map<std::string, std::vector<Input>> inputs_;
};

}  // namespace

Status expand(const Plan& plan, InputHashes& hashes, const std::string& version, const TakeTask& take) {
  std::unordered_map<uint64_t, uint32_t> sectionOf;  // by id
  for (uint32_t number = 0; number < plan.sections.size(); ++number) {
    const Section& section = plan.sections[number];
    if (taskCount(section) == 0) continue;
    Expansion expansion(plan, section, hashes);
    do {
      Result<Task> task = expansion.task();
      if (!task) return Error{task.error()};
      const uint64_t id = idOf(task.value(), version);
      task.value().id = idText(id);
      const auto [known, isNew] = sectionOf.emplace(id, number);
      if (!isNew) {
        std::string where;
        for (const auto& [axis, label] : task.value().labels) where += fmt::format(" {} {}", axis, label);
        return Error{fmt::format("{}:{}: {}: asks twice for{}; line {} has it already", plan.file.string(),
                                 section.line, section.kind, where.empty() ? " the same" : where,
                                 plan.sections[known->second].line)};
      }
      if (const Status s = take(task.value(), number); !s) return s;
    } while (expansion.next());
  }
  return Ok{};
}

}  // namespace roomlight::batch
