// What commands that light a scene share in reading their options.
#pragma once

#include <CLI/CLI.hpp>

#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/settings.h"
#include "home/open_home.h"
#include "still/picture_file.h"

namespace roomlight::cli {

// The whole text as a number.
template <class T>
std::optional<T> parseNumber(std::string_view text) {
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Numbers between commas, as many as one of `counts` says, none above a million. `shape`: what to write, for the error.
Result<std::vector<float>> parseList(const std::string& option, const std::string& text, const std::string& shape,
                                     std::initializer_list<size_t> counts);

// "960x540"; anything from 0 to what an int holds.
struct Size {
  int width = 0, height = 0;
};
Result<Size> parseSize(const std::string& option, const std::string& text);

// Options that decide how a picture or a frame is made; they go before what a settings file says.
struct SettingsOptions {
  std::string settingsFile, quality, size;
  std::optional<std::string> technique, seed;
  std::optional<int> samples, threads;
};
// `settings`: what holds where neither options nor the file say otherwise. Values in range are left to checkSettings().
Result<RenderSettings> readSettings(const SettingsOptions& o, RenderSettings settings);

// "2GB", "1.5 GiB", "800MB"; none: not a size.
std::optional<double> parseBytes(const std::string& text);

// Files that are written must differ from each other and from those that are read; empty names are none.
Status checkDistinct(const std::vector<std::string>& files);

Status checkTechnique(const std::string& name);

// `text` and the choices with their explanations, for the help of an option.
std::string listed(std::string text, const std::vector<std::pair<std::string, std::string>>& choices);

// Options of commands that open a home: which file, in which unit, under which light.
struct SceneOptions {
  std::string scene, lighting, light = "auto", writeLighting;
  std::optional<float> metresPerUnit;
  std::string up;  // "y", "z"; empty: as the file says, or guessed
  double lumenAtFullPower = ImportOptions().lumenAtFullPower;
  bool verbose = false;
};

// `positional`: what the file is called in the help, SCENE or HOME.
void addSceneOptions(CLI::App& app, SceneOptions& options, const std::string& positional);

// Everything that can be known to be wrong before the file is opened.
Result<home::OpenWish> readSceneOptions(const SceneOptions& options, const std::string& camera = {});

// Warnings, small faults that were mended, and what was guessed or added, on stderr.
void printOpened(const SceneOptions& options, const home::OpenedHome& home);

// What was added, for --write-lighting; nothing where that was not asked for.
Status writeAddedLight(const SceneOptions& options, const home::OpenedHome& home);

}  // namespace roomlight::cli
