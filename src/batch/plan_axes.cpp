#include "batch/plan_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/platform/files.h"
#include "base/utf8.h"
#include "base/words.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "home/open_home.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;
using optimise::TomlPlace;

constexpr int kMostSeeds = 1000000;
constexpr double kUsualPixels = 960.0 * 540;

// A text, or a list of texts.
std::vector<std::pair<std::string, TomlPlace>> textsAt(const TomlPlace& place) {
  std::vector<std::pair<std::string, TomlPlace>> out;
  if (!place.isArray()) return {{place.text(), place}};
  for (size_t i = 0, n = place.size(); i < n; ++i) out.emplace_back(place.at(i).text(), place.at(i));
  if (out.empty()) place.fail("must not be empty");
  return out;
}

// Files that a pattern with * and ? names; one without these must be there.
std::vector<std::string> filesNamed(const TomlPlace& place, const std::string& pattern, const PlanPaths& paths) {
  std::vector<std::string> out;
  if (pattern.find_first_of("*?") == std::string::npos) {
    std::error_code code;
    if (!fs::is_regular_file(paths.plan / pattern, code))
      place.fail(fmt::format("{}: no such file", printable(pattern)));
    return {pattern};
  }
  for (const fs::path& found : filesNamedLike(paths.plan / pattern))
    out.push_back(found.lexically_relative(paths.plan).string());
  if (out.empty()) place.fail(fmt::format("{}: no file is named so", printable(pattern)));
  return out;
}

}  // namespace

std::string PlanPaths::related(const fs::path& written) const {
  std::error_code code;
  const fs::path whole = fs::weakly_canonical(plan / written, code);
  return whole.lexically_relative(batch).string();
}

std::string labelOf(const std::string& file) {
  const fs::path path = fs::path(file).replace_extension();
  return path.is_absolute() ? path.filename().string() : path.string();
}

bool knowsKeys(const TomlPlace& table, const std::vector<std::string>& keys) {
  if (table.node().kind != optimise::TomlNode::Kind::Table) return table.fail("must be a table"), false;
  for (const optimise::TomlNode& child : table.node().children) {
    if (std::find(keys.begin(), keys.end(), child.key) != keys.end()) continue;
    const std::string nearest = nearestWord(child.key, keys);
    std::string all;
    for (const std::string& key : keys) all += (all.empty() ? "" : ", ") + key;
    table[child.key.c_str()].fail("unknown key; " +
                                  (nearest.empty() ? "there are " + all : "did you mean " + nearest + "?"));
    return false;
  }
  return true;
}

std::string fileAt(const TomlPlace& place, const PlanPaths& paths, Section& out) {
  const std::string file = paths.related(filesNamed(place, place.text(), paths).front());
  out.files.push_back(file);
  return file;
}

void addAxis(Section& out, Axis axis) {
  out.words.push_back("{" + axis.name + "}");
  out.axes.push_back(std::move(axis));
}

void readHomes(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  Axis axis{"home", {}};
  for (const auto& [pattern, place] : textsAt(table["homes"])) {
    for (const std::string& file : filesNamed(place, pattern, paths)) {
      const std::string related = paths.related(file);
      axis.values.push_back({labelOf(file), {related}, {related}});
    }
  }
  addAxis(out, std::move(axis));
}

void readCameras(const TomlPlace& table, Section& out) {
  if (!table.has("cameras")) return;
  Axis axis{"camera", {}};
  for (const auto& [name, place] : textsAt(table["cameras"])) axis.values.push_back({name, {"--camera", name}, {}});
  addAxis(out, std::move(axis));
}

void readLights(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (!table.has("lights")) return;
  Axis axis{"light", {}};
  for (const auto& [name, place] : textsAt(table["lights"])) {
    if (fs::path(name).extension() != ".json") {
      if (const auto known = home::lightWishFromName(name); !known)
        place.fail(known.error() + "; or a lighting file that ends in .json");
      axis.values.push_back({name, {"--light", name}, {}});
      continue;
    }
    for (const std::string& file : filesNamed(place, name, paths)) {
      const std::string related = paths.related(file);
      axis.values.push_back({labelOf(file), {"--lighting", related}, {related}});
    }
  }
  addAxis(out, std::move(axis));
}

void readTechniques(const TomlPlace& table, Section& out) {
  if (!table.has("techniques")) return;
  Axis axis{"technique", {}};
  for (const auto& [name, place] : textsAt(table["techniques"])) {
    if (const auto known = techniqueNamed(name); !known) place.fail(known.error());
    axis.values.push_back({name, {"--technique", name}, {}});
  }
  addAxis(out, std::move(axis));
}

// A number of them, from 0, or a list.
void readSeeds(const TomlPlace& table, bool together, Section& out) {
  if (!table.has("seeds")) return;
  Axis axis{"seed", {}, together};
  const TomlPlace seeds = table["seeds"];
  const auto add = [&](int seed) {
    axis.values.push_back({std::to_string(seed), {"--seed", std::to_string(seed)}, {}});
  };
  if (seeds.isArray()) {
    for (size_t i = 0, n = seeds.size(); i < n; ++i) add(seeds.at(i).whole(0, 2000000000));
    if (seeds.size() == 0) seeds.fail("must not be empty");
  } else {
    for (int seed = 0, n = seeds.whole(1, kMostSeeds); seed < n; ++seed) add(seed);
  }
  addAxis(out, std::move(axis));
}

// Pixels over those of a usual picture; 1 without a size.
double readSize(const TomlPlace& table, Section& out) {
  if (!table.has("size")) return 1;
  const std::string text = table["size"].text();
  const size_t x = text.find('x');
  int width = 0, height = 0;
  const char* const end = text.data() + text.size();
  const char* const middle = text.data() + std::min(x, text.size());
  const bool read = x != std::string::npos && std::from_chars(text.data(), middle, width).ptr == middle &&
                    std::from_chars(middle + 1, end, height).ptr == end;
  if (!read || width < 1 || height < 1 || std::max(width, height) > 65536)
    table["size"].fail(fmt::format("must be WIDTHxHEIGHT, for example \"960x540\", but is '{}'", printable(text)));
  out.words.insert(out.words.end(), {"--size", text});
  return static_cast<double>(width) * height / kUsualPixels;
}

// What quality and samples say of the time of a usual picture, in seconds.
double readEffort(const TomlPlace& table, Section& out) {
  double seconds = 20;
  if (table.has("quality")) {
    const std::string quality = table["quality"].text();
    RenderSettings ignored;
    if (const Status s = applyQuality(quality, ignored); !s) table["quality"].fail(s.error());
    out.words.insert(out.words.end(), {"--quality", quality});
    seconds = quality == "draft" ? 4 : quality == "best" ? 300 : seconds;
  }
  if (table.has("samples")) {
    const int samples = table["samples"].whole(0, 1000000);
    out.words.insert(out.words.end(), {"--samples", std::to_string(samples)});
    if (samples > 0) seconds = 0.3 * samples;
  }
  return seconds;
}

void readRest(const TomlPlace& table, const PlanPaths& paths, Section& out) {
  if (table.has("settings")) {
    const std::string file = fileAt(table["settings"], paths, out);
    out.words.insert(out.words.end(), {"--settings", file});
  }
  if (table.has("options")) {
    for (const auto& [word, place] : textsAt(table["options"])) {
      if (word == "-o" || word == "--output") place.fail("outputs are named by the batch; leave -o out");
      if (word == "--stats") place.fail("holds times, which differ from run to run; leave --stats out");
      out.words.push_back(word);
    }
  }
  out.seconds = table.number("seconds", 0.001, 1e7, out.seconds);
}

}  // namespace roomlight::batch
