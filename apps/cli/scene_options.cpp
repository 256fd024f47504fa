#include "arguments.h"

#include <fmt/format.h>

#include "base/write_file.h"
#include "console.h"
#include "output_files.h"

namespace roomlight::cli {

void addSceneOptions(CLI::App& app, SceneOptions& o, const std::string& positional) {
  app.add_option(positional, o.scene, "Home or room: " + supportedFiles())->required();
  app.add_option("--lighting", o.lighting,
                 "Lighting file: lamps, sun and sky with their units (docs/reference/lighting.md)");
  app.add_option("--light", o.light, listed("Light of a scene that --lighting does not light:", home::lightWishes()))
      ->capture_default_str();
  app.add_option("--write-lighting", o.writeLighting,
                 "Write the light that was added to this lighting file, to go on from");
  app.add_option(
      "--metres-per-unit", o.metresPerUnit,
      "Length of the scene's unit in metres; without it the file's, or guessed from the heights of rooms and things");
  app.add_option("--up", o.up,
                 "y or z: which axis of the file points up; without it the file's, or guessed (.obj, .stl, .ply, .3ds)")
      ->check(CLI::IsMember({"y", "z"}));
  app.add_option("--lumen-at-full-power", o.lumenAtFullPower,
                 "What lights of power 1 in Sweet Home 3D's files send out")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e9));
  app.add_flag("--verbose", o.verbose, "Also list every warning about the scene and what was mended in it");
}

Result<home::OpenWish> readSceneOptions(const SceneOptions& o, const std::string& camera) {
  home::OpenWish wish;
  const Result<home::LightWish> light = home::lightWishFromName(o.light);
  if (!light) return Error{light.error()};
  if (o.metresPerUnit && !(*o.metresPerUnit > 0 && *o.metresPerUnit <= 1e6f))
    return Error{"--metres-per-unit: must be above 0 and at most 1000000"};
  if (!o.writeLighting.empty()) {
    if (o.light == "none" || o.light == "file")
      return Error{fmt::format("--write-lighting {}: --light {} adds no light", o.writeLighting, o.light)};
    if (const Status s = checkWritable(o.writeLighting); !s) return Error{s.error()};
    if (const Status s = checkDistinct({o.writeLighting, o.scene, o.lighting}); !s) return Error{s.error()};
  }
  wish.scene = o.scene, wish.lighting = o.lighting;
  wish.light = light.value();
  wish.metresPerUnit = o.metresPerUnit;
  wish.import.lumenAtFullPower = o.lumenAtFullPower, wish.import.camera = camera;
  if (!o.up.empty()) wish.import.upAxis = o.up[0];
  wish.camera = camera;
  return wish;
}

void printOpened(const SceneOptions& o, const home::OpenedHome& home) {
  printFindings(home.warnings, home.faults, home.faultCount, o.verbose);
  printNotes(home.notes);
}

Status writeAddedLight(const SceneOptions& o, const home::OpenedHome& home) {
  if (o.writeLighting.empty()) return Ok{};
  if (home.lighting.is_null())
    return Error{fmt::format(
        "--write-lighting {}: no light was added; the scene has its own (--light day, evening or night adds some)",
        o.writeLighting)};
  return writeWhole(o.writeLighting, home.lighting.dump(2) + "\n");
}

}  // namespace roomlight::cli
