#include "commands.h"

#include <fmt/format.h>

#include <algorithm>

namespace roomlight::cli {

std::vector<Registered> addCommands(CLI::App& program) {
  const std::vector<Registered> commands = {
      addRender(program),  addView(program),     addWalk(program),  addBake(program),     addMix(program),
      addMeasure(program), addValidate(program), addStudy(program), addOptimise(program), addBatch(program),
      addCompare(program), addDevelop(program),  addInfo(program),  addDoctor(program)};
  // An empty word, as an unset variable of a shell leaves it, would pass for "not given".
  const auto notEmpty = [](const std::string& value) { return std::string(value.empty() ? "has an empty value" : ""); };
  for (const Registered& command : commands) {
    std::vector<CLI::App*> apps = command.app->get_subcommands(nullptr);
    if (apps.empty()) apps.push_back(command.app);
    for (CLI::App* app : apps) {
      addMemoryLimit(*app);
      for (CLI::Option* option : app->get_options()) {
        if (option->get_items_expected_max() > 0) option->check(notEmpty, "");
      }
    }
  }
  return commands;
}

Status checkCommandLine(const std::vector<std::string>& words) {
  CLI::App program("", "roomlight");
  program.require_subcommand(1);
  const std::vector<Registered> commands = addCommands(program);
  if (const Status s = checkWords(program, words); !s) return s;
  // The limit would hold for this process.
  if (std::any_of(words.begin(), words.end(), [](const auto& w) { return w.starts_with("--memory"); })) return Ok{};
  try {
    std::vector<std::string> lastFirst(words.rbegin(), words.rend());
    program.parse(lastFirst);
  } catch (const CLI::Success&) {
    return Error{"asks for help; leave --help out"};
  } catch (const CLI::ParseError& e) {
    return Error{e.what()};
  }
  return Ok{};
}

}  // namespace roomlight::cli
