// Options of commands that open a home: which file, in which unit, under which light.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "home/open_home.h"

namespace roomlight::cli {

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
