// A home as a session has it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/result.h"
#include "view/editable.h"

namespace roomlight::view {

// Sun and sky of one moment; no sky: it stays as it is.
struct SunLight {
  std::vector<Sun> suns;
  std::optional<Sky> sky;
};

enum class PlaceFrom : uint8_t { Lighting, Home, Assumed };  // the lighting file, the home's file, nobody

// A sun that follows date and hour.
struct SunByDate {
  SunState atStart;  // off: the home opened with other light from outside, or none
  PlaceFrom placeFrom = PlaceFrom::Lighting;
  double latitudeDeg = 0, longitudeDeg = 0, utcOffsetH = 0;
  std::string sky;  // in words
  nlohmann::json source;                // of a lighting file: its `daylight` or `sun`
  bool isDaylight = true;               // `source` is a `daylight`
  std::function<Result<SunLight>(const SunState&)> at;
};

// Kinds of the scene's own light that a lighting file switches off as a whole.
struct KindsOff {
  bool lamps = false, emission = false;
  bool operator==(const KindsOff&) const = default;
};

// What a home opened with: to save its lighting as a file like the one it came from.
struct LightingSource {
  nlohmann::json document;  // of the lighting file, without comments; null: none was given
  size_t lamps = 0;         // the scene's last so many are the file's, in its order
  std::filesystem::path folder;  // that its paths are relative to
  KindsOff off;                // that the document says, while the scene has them shine (off_lamps.h)
  std::vector<uint8_t> keptOff;  // by lamp of the home: 1 if it is off for that reason; empty: none is
  bool keepsOff(size_t lamp) const { return lamp < keptOff.size() && keptOff[lamp] != 0; }
};

struct ViewHome {
  ViewHome(std::string homeName, Scene homeScene)
      : name(std::move(homeName)), scene(std::move(homeScene)), editable(makeEditable(scene)) {}

  std::string name;
  Scene scene;
  EditableHome editable;
  HomeState atStart() const;
  std::optional<HomeState>
      opened;  // the lamps as the files have them, dimmed or off; `scene` has all of them on and undimmed
  std::optional<SunByDate> sun;
  LightingSource lighting;
};

// The home's name, as a part of a file's name that any file system and header takes.
std::string fileNameOf(const ViewHome& home);

// The scene in that state, with its sun.
Result<Scene> sceneIn(const ViewHome& home, const HomeState& state);

// Brings a scene of the home from one state to another, its sun and sky too, and says what that changed. Where
// SunByDate::at has no light for the moment, suns and sky stay as they are.
SceneChange bring(const ViewHome& home, const HomeState& from, const HomeState& to, Scene& scene);

}  // namespace roomlight::view
