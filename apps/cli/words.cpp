#include "commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "arguments.h"
#include "base/words.h"

namespace roomlight::cli {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// A file alone: what to do with it.
std::string howToSee(const std::string& file) {
  const std::string kind = lowerExtension(file);
  if (kind == ".exr" || kind == ".hdr") return fmt::format("to see it: roomlight develop {} -o picture.png", file);
  if (kind == ".ies" || kind == ".ldt") return fmt::format("to read it: roomlight info {}", file);
  return fmt::format("to see it: roomlight render {0} -o picture.png, or roomlight view {0}", file);
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands(nullptr)) commands.push_back(command->get_name());
  return commands;
}

Status checkCommand(const CLI::App& program, const std::string& word) {
  const std::vector<std::string> commands = commandsOf(program);
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return Ok{};
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored)) return Error{howToSee(word)};
  const std::string nearest = nearestWord(word, commands);
  if (!nearest.empty()) return Error{fmt::format("unknown command '{}'; did you mean {}?", word, nearest)};
  if (word.find('/') != std::string::npos || !std::filesystem::path(word).extension().empty())
    return Error{fmt::format("{}: no such file", word)};
  return Error{fmt::format("unknown command '{}'; there are {}", word, joined(commands))};
}

Status checkOption(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (command.get_option_no_throw(name)) return Ok{};
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& known : option->get_lnames()) names.push_back("--" + known);
  }
  const std::string nearest = nearestWord(name, names), of = command.get_name();
  return Error{fmt::format(
      "unknown option '{}' of {}; {}", name, of,
      nearest.empty() ? fmt::format("see roomlight {} --help", of) : fmt::format("did you mean {}?", nearest))};
}

// The command of a command, such as plan in `batch plan`.
Status checkSubcommand(const CLI::App& command, const std::string& word) {
  const std::vector<std::string> commands = commandsOf(command);
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return Ok{};
  const std::string nearest = nearestWord(word, commands);
  return Error{fmt::format("unknown command '{} {}'; {}", command.get_name(), word,
                           nearest.empty() ? "there are " + joined(commands) : "did you mean " + nearest + "?")};
}

}  // namespace

Status checkWords(const CLI::App& program, const std::vector<std::string>& words) {
  if (words.empty())
    return Error{"say what to do: a command and a file, such as 'roomlight view home.glb'; see roomlight --help"};
  if (words.front().starts_with('-')) return Ok{};  // of the program itself
  if (const Status s = checkCommand(program, words.front()); !s) return s;
  const CLI::App* command = program.get_subcommand(words.front());
  size_t first = 1;
  if (!commandsOf(*command).empty() && words.size() > 1 && !words[1].starts_with('-')) {
    if (const Status s = checkSubcommand(*command, words[1]); !s) return s;
    command = command->get_subcommand(words[1]), first = 2;
  }
  for (size_t i = first; i < words.size() && words[i] != "--"; ++i) {
    if (!words[i].starts_with("--")) continue;
    if (const Status s = checkOption(*command, words[i]); !s) return s;
  }
  return Ok{};
}

}  // namespace roomlight::cli
