// Parts of long commands, put together.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/write_file.h"
#include "batch/child.h"
#include "batch/durable.h"
#include "batch/merge.h"
#include "optimise/store.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

// The words of a task without the option that says which part, for all of it in this folder.
std::vector<std::string> wordsOfWhole(const Task& task, const std::string& option, const std::string& folder) {
  std::vector<std::string> words;
  for (size_t i = 0; i < task.arguments.size(); ++i) {
    if (task.arguments[i] == option) {
      ++i;  // and its value
    } else if (task.arguments[i] != "--quiet") {
      words.push_back(task.arguments[i] == kFolderWord ? folder : task.arguments[i]);
    }
  }
  return words;
}

std::string commandOf(const Folder& folder, const std::vector<std::string>& words) {
  std::string out = fmt::format("cd {} && roomlight", quotedForShell(folder.path().string()));
  for (const std::string& word : words) out += " " + quotedForShell(word);
  return out;
}

// Of a folder of runs into another; what is there already stays, and where it differs `differs` becomes true.
Status addRuns(const fs::path& from, const fs::path& to, bool& differs) {
  std::error_code code;
  for (fs::directory_iterator it(from, code), end; !code && it != end; it.increment(code)) {
    if (!it->is_regular_file(code)) continue;
    const fs::path target = to / it->path().filename();
    if (!fs::exists(target, code)) {
      fs::copy_file(it->path(), target, code);
      if (code) return cannotWrite(target, code.value());
    } else if (target.filename().string().starts_with("machine") && textOf(target) != textOf(it->path())) {
      differs = true;
    }
  }
  return Ok{};
}

}  // namespace

std::string quotedForShell(const std::string& text) {
  const bool isPlain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '/' || c == '.' || c == '_' || c == '-';
  });
  if (isPlain) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

Whole joinResponse(const Folder& folder, const std::vector<DoneTask>& tasks, const std::string& name) {
  Whole out{tasks.front().task.group, {}, {}, {}};
  std::vector<fs::path> files;
  for (const DoneTask& t : tasks) files.insert(files.end(), t.files.begin(), t.files.end());
  std::error_code code;
  fs::create_directories(folder.merged() / name, code);
  const Result<size_t> joined = optimise::joinItems(files, folder.merged() / name / "response.bin");
  if (!joined) {
    out.missing = joined.error();
    return out;
  }
  out.file = name + "/response.bin";
  out.command = commandOf(folder, wordsOfWhole(tasks.front().task, "--part", "merged/" + name));
  return out;
}

Whole joinStudy(const Folder& folder, const std::vector<DoneTask>& tasks, const std::string& name,
                const fs::path& program) {
  Whole out{tasks.front().task.group, {}, {}, {}};
  const fs::path runs = folder.merged() / name / "runs";
  std::error_code code;
  fs::remove_all(folder.merged() / name, code);
  fs::create_directories(runs, code);
  bool differs = false;
  for (const DoneTask& t : tasks) {
    if (const Status s = addRuns(folder.out(t.task.id) / "runs", runs, differs); !s) out.missing = s.error();
  }
  std::vector<std::string> words = wordsOfWhole(tasks.front().task, "--only", "merged/" + name);
  words.push_back("--report-only");
  if (out.missing.empty()) {
    if (const Status s = runToItsEnd(program, words, folder.path()); !s) out.missing = s.error();
  }
  if (out.missing.empty()) out.file = name + "/study.html";
  if (differs) out.missing = "was measured on machines that differ; those of the first machine alone are told";
  return out;
}

}  // namespace roomlight::batch
