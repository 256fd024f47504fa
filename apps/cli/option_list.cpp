#include "option_list.h"

#include "output_files.h"

namespace roomlight::cli {
namespace {

std::vector<std::string> namesOf(const CLI::Option& option) {
  if (option.get_positional()) return {option.get_name()};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

Json optionJson(const CLI::Option& option) {
  const bool takesValue = option.get_items_expected_max() > 0;
  Json j = {{"names", namesOf(option)}, {"about", option.get_description()}};
  j["value"] = takesValue ? Json(option.get_type_name()) : Json();
  j["isRequired"] = option.get_required();
  if (!option.get_default_str().empty()) j["default"] = option.get_default_str();
  return j;
}

Json commandJson(const CLI::App& app) {
  Json j = {{"name", app.get_name()}, {"about", app.get_description()}, {"footer", app.get_footer()}};
  j["arguments"] = j["options"] = j["commands"] = Json::array();
  for (const CLI::Option* option : app.get_options())
    j[option->get_positional() ? "arguments" : "options"].push_back(optionJson(*option));
  for (const CLI::App* command : app.get_subcommands(nullptr)) j["commands"].push_back(commandJson(*command));
  return j;
}

}  // namespace

std::string optionsJson(const CLI::App& program) { return commandJson(program).dump(1); }

}  // namespace roomlight::cli
