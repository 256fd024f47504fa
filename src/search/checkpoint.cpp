#include "search/search.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace roomlight::search {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;

json designsJson(const Genomes& designs, const std::vector<double>& objectives) {
  return {
      {"count", designs.count}, {"integers", designs.integers}, {"reals", designs.reals}, {"objectives", objectives}};
}

json settingsJson(const Settings& s) {
  json j;
  j["method"] = nameOf(s.method), j["seed"] = s.seed, j["evaluations"] = s.evaluations, j["seconds"] = s.seconds;
  j["population"] = s.population, j["archive"] = s.archive;
  j["crossoverRate"] = s.crossoverRate, j["crossoverIndex"] = s.crossoverIndex;
  j["mutationRate"] = s.mutationRate, j["mutationIndex"] = s.mutationIndex;
  j["polishShare"] = s.polishShare, j["weightings"] = s.weightings;
  return j;
}

// Throws json::exception where something is missing or of another kind; so do the other readers.
Result<Settings> settingsFrom(const json& j) {
  Settings s;
  Result<Method> method = methodNamed(j.at("method").get<std::string>());
  if (!method) return Error{method.error()};
  s.method = method.value();
  j.at("seed").get_to(s.seed), j.at("evaluations").get_to(s.evaluations), j.at("seconds").get_to(s.seconds);
  j.at("population").get_to(s.population), j.at("archive").get_to(s.archive);
  j.at("crossoverRate").get_to(s.crossoverRate), j.at("crossoverIndex").get_to(s.crossoverIndex);
  j.at("mutationRate").get_to(s.mutationRate), j.at("mutationIndex").get_to(s.mutationIndex);
  j.at("polishShare").get_to(s.polishShare), j.at("weightings").get_to(s.weightings);
  return s;
}

Status designsFrom(const json& j, const char* place, const Problem& problem, Genomes& designs,
                   std::vector<double>& objectives) {
  designs = problem.none();
  j.at("count").get_to(designs.count), j.at("integers").get_to(designs.integers), j.at("reals").get_to(designs.reals);
  j.at("objectives").get_to(objectives);
  if (!fits(problem, designs) || objectives.size() != designs.count * problem.objectives)
    return Error{std::string(place) +
                 ": designs of another problem; go on with the study the checkpoint was made from"};
  return Ok{};
}

Result<State> stateFrom(const json& j, const Problem& problem) {
  if (j.at("version").get<int>() != kVersion) return Error{"version: not " + std::to_string(kVersion) + "; start anew"};
  State state;
  Result<Settings> settings = settingsFrom(j.at("settings"));
  if (!settings) return Error{settings.error()};
  state.settings = settings.value();
  if (Status bad = check(problem, state.settings); !bad) return Error{bad.error()};
  j.at("generation").get_to(state.generation), j.at("evaluations").get_to(state.evaluations),
      j.at("polished").get_to(state.polished);
  j.at("polishEvaluations").get_to(state.polishEvaluations), j.at("seconds").get_to(state.seconds);
  if (Status bad = designsFrom(j.at("population"), "population", problem, state.population, state.objectives); !bad)
    return Error{bad.error()};
  state.archive.limit = archiveLimit(state.settings, problem.objectives);
  state.archive.objectivesEach = problem.objectives;
  if (Status bad = designsFrom(j.at("archive"), "archive", problem, state.archive.designs, state.archive.objectives);
      !bad)
    return Error{bad.error()};
  if (state.population.count == 0) return Error{"population: is empty; start anew"};
  return state;
}

}  // namespace

std::string toJson(const State& state) {
  json j;
  j["version"] = kVersion, j["settings"] = settingsJson(state.settings);
  j["generation"] = state.generation, j["evaluations"] = state.evaluations, j["seconds"] = state.seconds;
  j["polished"] = state.polished, j["polishEvaluations"] = state.polishEvaluations;
  j["population"] = designsJson(state.population, state.objectives);
  j["archive"] = designsJson(state.archive.designs, state.archive.objectives);
  return j.dump();
}

Result<State> stateFromJson(std::string_view text, const Problem& problem, const std::string& where) {
  try {
    Result<State> state = stateFrom(json::parse(text), problem);
    if (!state) return Error{where + ": " + state.error()};
    return state;
  } catch (const json::exception& e) {
    return Error{where + ": not a checkpoint of a search: " + e.what() + "; start anew"};
  }
}

}  // namespace roomlight::search
