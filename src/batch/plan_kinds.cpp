#include "batch/plan_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "batch/durable.h"
#include "batch/plan_axes.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;
using optimise::TomlPlace;

constexpr double kUsualRate = 10;  // of walk files, in frames a second

const std::vector<std::string> kViewKeys = {"name", "homes",   "cameras",  "lights",  "seeds",  "quality",
                                            "size", "samples", "settings", "options", "seconds"};

bool viewKeys(const TomlPlace& table, std::initializer_list<const char*> more) {
  std::vector<std::string> keys = kViewKeys;
  keys.insert(keys.end(), more.begin(), more.end());
  return knowsKeys(table, keys);
}

// So many cameras a task, which share its light in memory.
void groupCameras(const TomlPlace& table, Section& out) {
  const size_t each = static_cast<size_t>(table["camerasPerTask"].whole(1, 10000));
  if (table.has("shareLight"))
    table["shareLight"].fail("cameras of one task share their light as they are; leave it out");
  if (out.axes.back().name != "camera") return table["camerasPerTask"].fail("needs cameras");
  std::vector<AxisValue> groups;
  for (size_t i = 0; i < out.axes.back().values.size(); ++i) {
    const AxisValue& camera = out.axes.back().values[i];
    if (i % each == 0) groups.push_back({});
    AxisValue& group = groups.back();
    group.label += (group.label.empty() ? "" : ", ") + camera.label;
    group.words.insert(group.words.end(), camera.words.begin(), camera.words.end());
  }
  out.axes.back().values = std::move(groups);
}

void readView(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  out.words = {"render"};
  readHomes(table, paths, out);
  readCameras(table, out);
  if (table.has("camerasPerTask")) groupCameras(table, out);
  readLights(table, paths, out);
  readTechniques(table, out);
}

void endView(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  const double pixels = readSize(table, out);
  out.seconds = std::max(0.5, readEffort(table, out) * pixels);
  readRest(table, paths, out);
  out.words.insert(out.words.end(), {"--reproducible", "--quiet", "-o", "{output}"});
}

// Tasks of one home and light find the same light, that of all their cameras, so that they can share it.
void shareLight(const TomlPlace& table, Section& out) {
  const auto cameras =
      std::find_if(out.axes.begin(), out.axes.end(), [](const Axis& axis) { return axis.name == "camera"; });
  if (cameras == out.axes.end()) return table["shareLight"].fail("needs cameras, those that share it");
  for (const AxisValue& camera : cameras->values)
    out.words.insert(out.words.end(), {std::string(kLightForWord), camera.label});
}

void readPictures(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!viewKeys(table, {"techniques", "output", "shareLight", "camerasPerTask"})) return;
  readView(table, paths, out);
  if (table.flag("shareLight", false)) shareLight(table, out);
  readSeeds(table, false, out);
  out.output = "picture." + (table.has("output") ? table["output"].oneOf({"png", "jpg", "exr"}) : "png");
  endView(table, paths, out);
}

void readReferences(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!viewKeys(table, {})) return;
  readView(table, paths, out);
  out.words.insert(out.words.end(), {"--technique", "path"});
  if (table.has("seeds")) readSeeds(table, true, out);
  if (!table.has("seeds") || out.axes.back().values.size() < 2)
    table.fail("needs seeds, two or more: the error of their mean is told by how they differ");
  out.output = "seed.exr";
  endView(table, paths, out);
}

void readLayers(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!viewKeys(table, {"techniques", "groups"})) return;
  readView(table, paths, out);
  readSeeds(table, false, out);
  out.words.push_back("--layers");
  if (table.has("groups"))
    out.words.insert(out.words.end(), {"--layer-groups", table["groups"].oneOf({"name", "room"})});
  out.output = "layers.exr";
  endView(table, paths, out);
}

void readMeasure(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!knowsKeys(table, {"name", "homes", "lights", "techniques", "seeds", "meters", "quality", "options", "seconds"}))
    return;
  out.words = {"measure"};
  readHomes(table, paths, out);
  readLights(table, paths, out);
  readTechniques(table, out);
  readSeeds(table, false, out);
  if (table.has("meters")) {
    const std::string file = fileAt(table["meters"], paths, out);
    out.words.insert(out.words.end(), {"--meters", file});
  }
  out.output = "measure.json";
  out.seconds = readEffort(table, out);
  readRest(table, paths, out);
  out.words.insert(out.words.end(), {"--quiet", "--json", "{output}", "--csv", "{folder}/measure.csv"});
}

// How many frames the walk file has; 0: that cannot be read from it.
int framesOf(const fs::path& file) {
  const auto json = nlohmann::json::parse(textOf(file), nullptr, false);
  if (!json.is_object() || !json.contains("seconds") || !json["seconds"].is_number()) return 0;
  const double rate = json.contains("framesPerSecond") && json["framesPerSecond"].is_number()
                          ? json["framesPerSecond"].get<double>()
                          : kUsualRate;
  const double frames = std::floor(json["seconds"].get<double>() * rate + 1e-6);  // as Walk::frameCount()
  return frames <= 10000000 ? std::max(1, static_cast<int>(frames)) : 0;
}

void readWalks(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!viewKeys(table, {"walk", "techniques", "frames", "framesPerTask", "output"})) return;
  if (table.has("cameras")) return table["cameras"].fail("a walk has its own camera; leave it out");
  out.words = {"walk"};
  readHomes(table, paths, out);
  const std::string walk = table["walk"].text();
  out.words.insert(out.words.end(), {"--walk", fileAt(table["walk"], paths, out)});
  const int all = framesOf(paths.plan / walk);
  if (all == 0) table["walk"].fail("has no 'seconds' of a walk");
  readLights(table, paths, out);
  readTechniques(table, out);
  readSeeds(table, false, out);
  const int frames = table.whole("frames", 1, 10000000, std::max(1, all));
  const int each = table.whole("framesPerTask", 1, 100000, 1);
  if (frames < all) out.words.insert(out.words.end(), {"--frames", std::to_string(frames)});
  Axis axis{"frames", {}, true};
  for (int from = 0; from < frames; from += each) {
    const std::string range = fmt::format("{}-{}", from, std::min(from + each, frames) - 1);
    axis.values.push_back({range, {"--stills", range}, {}});
  }
  addAxis(out, std::move(axis));
  const double pixels = readSize(table, out);
  out.seconds = std::max(0.5, readEffort(table, out) * pixels) * each;
  readRest(table, paths, out);
  out.output = "frame_%06d." + (table.has("output") ? table["output"].oneOf({"png", "jpg", "exr"}) : "png");
  out.words.insert(out.words.end(), {"--quiet", "-o", "{output}"});
}

void readEach(const TomlPlace& table, Section& out) {
  const TomlPlace each = table["each"];
  if (each.node().kind != optimise::TomlNode::Kind::Table) return each.fail("must be a table of lists");
  for (const optimise::TomlNode& child : each.node().children) {
    Axis axis{child.key, {}};
    const TomlPlace list = each[child.key.c_str()];
    if (child.key == "output" || child.key == "folder") list.fail("is the name of a place for outputs; take another");
    for (size_t i = 0, n = list.size(); i < n; ++i) {
      const TomlPlace value = list.at(i);
      const bool number = value.node().kind == optimise::TomlNode::Kind::Number;
      const std::string text = number ? fmt::format("{}", value.node().number) : value.text();
      axis.values.push_back({text, {text}, {}});
    }
    if (axis.values.empty()) list.fail("must not be empty");
    const std::string word = "{" + child.key + "}";
    if (std::none_of(out.words.begin(), out.words.end(), [&](const auto& w) { return w.find(word) != w.npos; }))
      list.fail(fmt::format("no argument holds {}", word));
    out.axes.push_back(std::move(axis));
  }
}

void readCommands(const TomlPlace& table, const PlanPaths&, Section& out) {
  if (!knowsKeys(table, {"name", "arguments", "each", "output", "seconds"})) return;
  out.words = table["arguments"].texts();
  out.findFiles = true;
  if (out.words.empty()) return table["arguments"].fail("must not be empty");
  if (out.words.front() == "batch" || out.words.front() == "view")
    return table["arguments"].fail(fmt::format("{} cannot be a task", out.words.front()));
  if (table.has("each")) readEach(table, out);
  if (table.has("output")) {
    out.output = table["output"].text();
    if (out.output.find('/') != std::string::npos || out.output.starts_with('.'))
      table["output"].fail("must be the name of a file, without a folder");
  }
  const auto holds = [&](std::string_view what) {
    return std::any_of(out.words.begin(), out.words.end(), [&](const auto& w) { return w.find(what) != w.npos; });
  };
  if (!table.has("output") && (holds(kOutputWord) || !holds(kFolderWord)))
    table.fail("needs output, the name of its file; or arguments with {folder}");
  for (const std::string& word : out.words) {
    const size_t from = word.find('{'), end = from == word.npos ? from : word.find('}', from);
    if (end == word.npos) continue;
    const std::string name = word.substr(from + 1, end - from - 1);
    const bool known = std::any_of(out.axes.begin(), out.axes.end(), [&](const Axis& a) { return a.name == name; });
    if (!known && name != "output" && name != "folder")
      table["arguments"].fail(fmt::format("{{{}}}: is neither {{output}}, {{folder}} nor a key of 'each'", name));
  }
  out.seconds = table.number("seconds", 0.001, 1e7, 20);
}

}  // namespace

const std::vector<SectionKind>& sectionKinds() {
  static const std::vector<SectionKind> kinds = {{"pictures", readPictures},     {"walks", readWalks},
                                                 {"references", readReferences}, {"layers", readLayers},
                                                 {"measure", readMeasure},       {"optimise", readOptimise},
                                                 {"study", readStudy},           {"commands", readCommands}};
  return kinds;
}

}  // namespace roomlight::batch
