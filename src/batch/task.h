// A task of a batch: one command of this program, known by everything that its result depends on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"

namespace roomlight::batch {

// Words of arguments that stand for what is known only when the task runs.
constexpr std::string_view kOutputWord = "{output}";  // the task's output file
constexpr std::string_view kFolderWord = "{folder}";  // the folder that it lies in

// An option of `render`: light is found for these cameras, too, and may be shared by tasks of one machine.
constexpr std::string_view kLightForWord = "--light-for";

struct Input {
  std::string file, hash;  // relative to the batch's folder; hash of its content
  bool operator==(const Input&) const = default;
};

struct Task {
  std::string id;                      // 16 hexadecimal digits
  std::string kind;                    // "pictures", "references", ...
  std::string group;                   // what merge puts together; one for all frames of a film, all seeds of a mean
  std::vector<std::pair<std::string, std::string>> labels;  // place on each axis: {"camera", "Kitchen"}
  std::vector<std::string> arguments;  // of `roomlight`; files relative to the batch's folder
  std::string output;                  // name of the output file; may have %d; empty: a folder of files
  std::vector<Input> inputs;
  double seconds = 0;                  // estimate
  bool operator==(const Task&) const = default;
};

// Of arguments, output, inputs and the program's version: where any of it changes, the task is another.
uint64_t idOf(const Task& task, std::string_view version);
std::string idText(uint64_t id);

// One line of JSON, without its end.
std::string lineOf(const Task& task);
// The error says what is wrong with the line.
Result<Task> taskOf(std::string_view line);

// Whether no argument says where output goes: what the command prints is the output.
bool printsOutput(const Task& task);

}  // namespace roomlight::batch
