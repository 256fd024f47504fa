#include <fmt/format.h>

#include <algorithm>

#include "batch/plan_kinds.h"
#include "study/study_plan.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;
using optimise::TomlPlace;

constexpr int kUsualParts = 8, kMostParts = 1000;
constexpr double kUsualPartS = 120;  // of a response, or a view of a study

// Study files: one text or a list.
void readStudies(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  Axis axis{"study", {}};
  const TomlPlace studies = table["studies"];
  const size_t count = studies.isArray() ? studies.size() : 1;
  for (size_t i = 0; i < count; ++i) {
    const TomlPlace place = studies.isArray() ? studies.at(i) : studies;
    const std::string name = place.text();
    std::error_code code;
    if (!fs::is_regular_file(paths.plan / name, code)) place.fail(fmt::format("{}: no such file", name));
    const std::string related = paths.related(name);
    axis.values.push_back({labelOf(name), {related}, {related}});
  }
  if (count == 0) studies.fail("must not be empty");
  addAxis(out, std::move(axis));
}

// Options that the batch gives itself.
bool refuses(const TomlPlace& table, std::initializer_list<const char*> options) {
  if (!table.has("options")) return false;
  const TomlPlace list = table["options"];
  for (size_t i = 0, n = list.isArray() ? list.size() : 0; i < n; ++i) {
    const std::string word = list.at(i).text();
    for (const char* option : options) {
      if (word == option || word.starts_with(std::string(option) + "="))
        return list.at(i).fail(fmt::format("the batch says which parts there are; leave {} out", option)), true;
    }
  }
  return false;
}

// Those that --technique leaves, as the tasks themselves will have it.
void narrowTechniques(const TomlPlace& table, StudyPlan& plan) {
  if (!table.has("options") || !table["options"].isArray()) return;
  std::vector<std::string> wanted;
  const TomlPlace options = table["options"];
  for (size_t i = 0, n = options.size(); i + 1 < n; ++i) {
    if (options.at(i).text() == "--technique") wanted.push_back(options.at(i + 1).text());
  }
  if (wanted.empty()) return;
  std::erase_if(plan.techniques, [&](const StudyTechnique& t) {
    return std::find(wanted.begin(), wanted.end(), t.name) == wanted.end();
  });
}

}  // namespace

// Each task finds a part of what all candidate lamps give (`optimise --part`).
void readOptimise(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!knowsKeys(table, {"name", "homes", "studies", "parts", "quality", "options", "seconds"})) return;
  if (refuses(table, {"--part", "--quality"})) return;
  out.words = {"optimise"};
  readHomes(table, paths, out);
  readStudies(table, paths, out);
  const int parts = table.whole("parts", 1, kMostParts, kUsualParts);
  Axis axis{"part", {}, true};
  for (int i = 1; i <= parts; ++i) {
    const std::string part = fmt::format("{}/{}", i, parts);
    axis.values.push_back({part, {"--part", part}, {}});
  }
  addAxis(out, std::move(axis));
  readEffort(table, out);
  out.seconds = kUsualPartS;
  readRest(table, paths, out);
  out.words.insert(out.words.end(), {"--quiet", "-o", "{folder}"});
}

// Each task measures a view or a walk of the study (`study --only`).
void readStudy(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!knowsKeys(table, {"name", "study", "options", "seconds"})) return;
  if (refuses(table, {"--only", "--report-only", "--quick", "--external"})) return;
  const std::string name = table["study"].text(), file = fileAt(table["study"], paths, out);
  Result<StudyPlan> plan = readStudyFile(paths.plan / name);
  if (!plan) return table["study"].fail(plan.error());
  narrowTechniques(table, plan.value());
  out.words = {"study", file};
  Axis axis{"view", {}, true};
  for (const std::string& part : partsOf(plan.value())) axis.values.push_back({part, {"--only", part}, {}});
  if (axis.values.empty()) return table["study"].fail("has neither views nor walks");
  addAxis(out, std::move(axis));
  out.seconds = kUsualPartS;
  readRest(table, paths, out);
  out.words.insert(out.words.end(), {"--quiet", "-o", "{folder}"});
}

}  // namespace roomlight::batch
