#include "batch/task.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "base/hash.h"

namespace roomlight::batch {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

uint64_t idOf(const Task& task, std::string_view version) {
  Hash hash;
  hash.bytes(version);
  hash.word(task.arguments.size());
  for (const std::string& word : task.arguments) hash.bytes(word);
  hash.bytes(task.output);
  for (const Input& input : task.inputs) hash.bytes(input.file), hash.bytes(input.hash);
  const std::string text = hash.text();
  uint64_t id = 0;
  std::from_chars(text.data(), text.data() + text.size(), id, 16);
  return id;
}

std::string idText(uint64_t id) { return fmt::format("{:016x}", id); }

std::string lineOf(const Task& task) {
  Json labels = Json::object(), inputs = Json::object();
  for (const auto& [name, value] : task.labels) labels[name] = value;
  for (const Input& input : task.inputs) inputs[input.file] = input.hash;
  return dumped({{"id", task.id},
                 {"kind", task.kind},
                 {"group", task.group},
                 {"labels", std::move(labels)},
                 {"arguments", task.arguments},
                 {"output", task.output},
                 {"inputs", std::move(inputs)},
                 {"seconds", task.seconds}});
}

Result<Task> taskOf(std::string_view line) {
  try {
    const Json json = Json::parse(line);
    Task task;
    task.id = json.at("id"), task.kind = json.at("kind"), task.group = json.at("group");
    task.output = json.at("output"), task.seconds = json.at("seconds");
    task.arguments = json.at("arguments").get<std::vector<std::string>>();
    for (const auto& [name, value] : json.at("labels").items()) task.labels.emplace_back(name, value);
    for (const auto& [file, hash] : json.at("inputs").items()) task.inputs.push_back({file, hash});
    return task;
  } catch (const Json::exception&) {
    return Error{"is no task; plan again"};
  }
}

bool printsOutput(const Task& task) {
  return std::none_of(task.arguments.begin(), task.arguments.end(), [](const std::string& word) {
    return word.find(kOutputWord) != std::string::npos || word.find(kFolderWord) != std::string::npos;
  });
}

}  // namespace roomlight::batch
