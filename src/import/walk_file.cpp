// Walk files, version 1 (docs/reference/walk.md):
//   { "version": 1, "comment", "seconds": 6, "framesPerSecond": 10,
//     "camera": [ { "time", "position": [x,y,z], "target": [x,y,z], "verticalFov": degrees }, .. ],
//     "objects": [ { "name", "number", "about": [x,y,z], "keys": [ { "time", "move": [x,y,z], "turn": degrees }, .. ]
//     }, .. ], "lamps": [ { "name", "keys": [ { "time", "dimming": 0..1 }, .. ] }, .. ] }
#include "import/walk_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/utf8.h"
#include "import/lighting_values.h"
#include "json/json_file.h"
#include "scene/shown_names.h"

namespace roomlight {
namespace {

constexpr size_t kMostKeys = 10'000, kMostNames = 40;
constexpr double kLongestS = 3600;
constexpr float kUsualFovDeg = 55;

// Reads the keys of one track: `read` appends a value to each channel.
template <class Read>
WalkTrack readTrack(const JsonPlace& keys, size_t channels, double secondsS, Read&& read) {
  WalkTrack track;
  track.channels.resize(channels);
  const size_t count = keys.arraySize();
  if (count < 1 || count > kMostKeys) keys.fail(fmt::format("must have from 1 to {} keys", kMostKeys));
  for (size_t i = 0; i < std::min(count, kMostKeys); ++i) {
    const JsonPlace key = keys[i];
    const std::vector<float> values = read(key);
    if (values.empty() || !key.has("time")) {
      key.fail("needs a time");
      break;
    }
    track.timesS.push_back(key["time"].number(0, secondsS));
    if (i > 0 && !(track.timesS[i] > track.timesS[i - 1])) key["time"].fail("must be later than the one before");
    for (size_t c = 0; c < channels; ++c) track.channels[c].push_back(values[c]);
  }
  return track;
}

std::vector<float> cameraKey(const JsonPlace& j) {
  if (!j.isObject({"time", "position", "target", "verticalFov"})) return {};
  if (!j.has("position") || !j.has("target")) {
    j.fail("needs position and target");
    return {};
  }
  const Vec3 p = j["position"].vector(-kFarthestM, kFarthestM), t = j["target"].vector(-kFarthestM, kFarthestM);
  if (!(length(t - p) > 1e-3f)) j["target"].fail("is where the camera is");
  return {p.x,
          p.y,
          p.z,
          t.x,
          t.y,
          t.z,
          static_cast<float>(rad(j.number("verticalFov", 1, 170, static_cast<double>(kUsualFovDeg))))};
}

std::vector<float> objectKey(const JsonPlace& j) {
  if (!j.isObject({"time", "move", "turn"})) return {};
  const Vec3 move = j.has("move") ? j["move"].vector(-kFarthestM, kFarthestM) : Vec3();
  return {move.x, move.y, move.z, static_cast<float>(rad(j.number("turn", -36000, 36000, 0)))};
}

std::vector<float> lampKey(const JsonPlace& j) {
  if (!j.isObject({"time", "dimming"})) return {};
  if (!j.has("dimming")) j.fail("needs a dimming");
  return {static_cast<float>(j.number("dimming", 0, 1, 1))};
}

void failUnknown(const JsonPlace& name, const char* what, const std::set<std::string>& known) {
  std::string list;
  size_t count = 0;
  for (const std::string& k : known) {
    if (k.empty() || ++count > kMostNames) continue;
    list += fmt::format("{}'{}'", list.empty() ? "" : ", ", printable(k));
  }
  name.fail(fmt::format("no {} '{}'; there are {}{}", what, printable(name.text()), list.empty() ? "none" : list,
                        count > kMostNames ? fmt::format(" and {} more", count - kMostNames) : ""));
}

bool glows(const Scene& scene, const Instance& i) {
  return !isBlack(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)].emission);
}

std::string lampName(const Instance& i) {
  return i.name.ends_with(kLightSuffix) ? i.name.substr(0, i.name.size() - std::string_view(kLightSuffix).size())
                                        : i.name;
}

// The objects one of whose instances bears the name, in order; where there is none, those that people call so.
std::vector<int> objectsNamed(const Scene& scene, const std::string& name) {
  std::vector<int> objects;
  for (const Instance& i : scene.instances) {
    if (i.name == name && std::find(objects.begin(), objects.end(), i.object) == objects.end())
      objects.push_back(i.object);
  }
  if (!objects.empty()) return objects;
  for (const auto& [object, shown] : shownObjectNames(scene)) {
    if (shown == name) objects.push_back(object);
  }
  return objects;
}

Walk::Thing readThing(const JsonPlace& j, double secondsS, const Scene& scene) {
  Walk::Thing thing;
  if (!j.isObject({"name", "number", "about", "keys"})) return thing;
  if (!j.has("name") || !j.has("keys")) {
    j.fail("needs name and keys");
    return thing;
  }
  thing.track = readTrack(j["keys"], 4, secondsS, objectKey);
  const std::vector<int> objects = objectsNamed(scene, j["name"].text());
  if (objects.empty()) {
    std::set<std::string> known;
    for (const Instance& i : scene.instances) known.insert(i.name);
    failUnknown(j["name"], "object", known);
    return thing;
  }
  if (objects.size() > 1 && !j.has("number")) {
    j["name"].fail(fmt::format("names {} objects; add \"number\": 1 to {}, in their order in the scene", objects.size(),
                               objects.size()));
    return thing;
  }
  const double number = j.number("number", 1, static_cast<double>(objects.size()), 1);
  const int object = objects[static_cast<size_t>(number) - 1];
  Bounds3 bounds;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].object != object) continue;
    thing.instances.push_back(i);
    thing.atRest.push_back(scene.instances[i].worldFromObject);
    bounds.add(instanceBounds(scene, scene.instances[i]));
  }
  thing.about = j.has("about") ? j["about"].vector(-kFarthestM, kFarthestM) : bounds.centre();
  return thing;
}

// The name in the file of a lamp that people call so, where none has that name itself.
std::string lampNamed(const Scene& scene, const std::string& name) {
  const auto isNamed = [&](const Lamp& l) { return l.name == name || l.group == name; };
  const auto isLit = [&](const Instance& i) { return glows(scene, i) && lampName(i) == name; };
  if (std::any_of(scene.lamps.begin(), scene.lamps.end(), isNamed) ||
      std::any_of(scene.instances.begin(), scene.instances.end(), isLit))
    return name;
  const std::vector<SceneLamp> lamps = findLamps(scene);
  const std::vector<std::string> shown = shownLampNames(scene, lamps);
  const auto found = std::find(shown.begin(), shown.end(), name);
  return found == shown.end() ? name : lamps[static_cast<size_t>(found - shown.begin())].name;
}

Walk::Dimmed readDimmed(const JsonPlace& j, double secondsS, const Scene& scene) {
  Walk::Dimmed dimmed;
  if (!j.isObject({"name", "keys"})) return dimmed;
  if (!j.has("name") || !j.has("keys")) {
    j.fail("needs name and keys");
    return dimmed;
  }
  dimmed.track = readTrack(j["keys"], 1, secondsS, lampKey);
  const std::string name = lampNamed(scene, j["name"].text());
  std::set<std::string> known;
  for (size_t i = 0; i < scene.lamps.size(); ++i) {
    known.insert(scene.lamps[i].name), known.insert(scene.lamps[i].group);
    if (scene.lamps[i].name != name && scene.lamps[i].group != name) continue;
    dimmed.lamps.push_back(i);
    dimmed.intensityCd.push_back(scene.lamps[i].intensityCd),
        dimmed.luminanceCdM2.push_back(scene.lamps[i].luminanceCdM2);
  }
  std::set<size_t> materials;
  for (const Instance& i : scene.instances) {
    if (!glows(scene, i)) continue;
    known.insert(lampName(i));
    const bool ofGroup = std::any_of(dimmed.lamps.begin(), dimmed.lamps.end(), [&](size_t l) {
      return scene.lamps[l].kind == LampKind::Area && scene.lamps[l].name == i.name;
    });
    if (lampName(i) == name || ofGroup)
      materials.insert(static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material));
  }
  for (const size_t m : materials)
    dimmed.materials.push_back(m), dimmed.emission.push_back(scene.materials[m].emission);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (materials.count(static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material)))
      dimmed.instances.push_back(i);
  }
  if (dimmed.lamps.empty() && dimmed.materials.empty()) failUnknown(j["name"], "lamp", known);
  return dimmed;
}

// One thing or lamp that is named twice would be where the last says.
template <class Entry>
void refuseTwins(const JsonPlace& entries, const std::vector<Entry>& read) {
  std::set<uint32_t> taken;
  std::set<size_t> lamps;
  for (size_t i = 0; i < read.size(); ++i) {
    bool twice = false;
    for (const uint32_t instance : read[i].instances) twice = !taken.insert(instance).second || twice;
    if constexpr (requires { read[i].lamps; }) {
      for (const size_t lamp : read[i].lamps) twice = !lamps.insert(lamp).second || twice;
    }
    if (twice) entries[i].fail("is named a second time");
  }
}

template <class Read>
auto readEntries(const JsonPlace& j, const char* key, Read&& read) {
  std::vector<decltype(read(j))> list;
  if (!j.has(key)) return list;
  const JsonPlace entries = j[key];
  const size_t count = entries.arraySize();
  if (count > kMostKeys) entries.fail(fmt::format("has more than {} entries", kMostKeys));
  for (size_t i = 0; i < std::min(count, kMostKeys); ++i) list.push_back(read(entries[i]));
  refuseTwins(entries, list);
  return list;
}

Affine placed(const Walk::Thing& thing, const Affine& rest, double timeS) {
  const Vec3 move{thing.track.at(0, timeS), thing.track.at(1, timeS), thing.track.at(2, timeS)};
  const float turnRad = thing.track.at(3, timeS);
  if (isBlack(move) && turnRad == 0) return rest;  // back in the very place
  const float c = std::cos(turnRad), s = std::sin(turnRad);
  Affine turn{{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {}};
  turn.w = thing.about - turn.vector(thing.about) + move;
  return turn * rest;
}

bool dim(Vec3& light, Vec3 full, float dimming) {
  const Vec3 before = light;
  light = full * dimming;
  return !(light == before);
}

}  // namespace

float WalkTrack::at(size_t channel, double timeS) const {
  const std::vector<float>& v = channels[channel];
  if (timeS <= timesS.front()) return v.front();
  if (timeS >= timesS.back()) return v.back();
  const auto k = static_cast<size_t>(std::upper_bound(timesS.begin(), timesS.end(), timeS) - timesS.begin()) - 1;
  const auto slope = [&](size_t i) {
    return (static_cast<double>(v[i + 1]) - static_cast<double>(v[i])) / (timesS[i + 1] - timesS[i]);
  };
  // Harmonic mean of the slopes on both sides, weighed by the gaps; zero at the ends and where they differ in sign.
  const auto tangent = [&](size_t i) {
    if (i == 0 || i + 1 == v.size()) return 0.0;
    const double before = slope(i - 1), after = slope(i);
    if (before * after <= 0) return 0.0;
    const double g = timesS[i] - timesS[i - 1], h = timesS[i + 1] - timesS[i];
    return 3 * (g + h) / ((2 * h + g) / before + (h + 2 * g) / after);
  };
  const double h = timesS[k + 1] - timesS[k], u = (timeS - timesS[k]) / h;
  const double rise = static_cast<double>(v[k + 1]) - static_cast<double>(v[k]), step = u * u * (3 - 2 * u);
  return static_cast<float>(static_cast<double>(v[k]) + rise * step +
                            h * u * (1 - u) * (tangent(k) * (1 - u) - tangent(k + 1) * u));
}

int Walk::frameCount() const { return std::max(1, static_cast<int>(std::floor(seconds * framesPerSecond + 1e-6))); }

Result<Walk> readWalkFile(const std::filesystem::path& file, const Scene& scene) {
  const Result<nlohmann::json> document = readJsonFile(file);
  if (!document) return Error{document.error()};
  std::string error;
  const JsonPlace j(document.value(), "", error);
  Walk walk;
  if (j.isObject({"version", "comment", "seconds", "framesPerSecond", "camera", "objects", "lamps"})) {
    if (j.has("version") && j["version"].number(1, 1e6) != 1) j["version"].fail("must be 1");
    if (j.has("comment")) j["comment"].text();
    walk.framesPerSecond = j.number("framesPerSecond", 0.1, 240, 10);
    if (j.has("seconds") && j.has("camera")) {
      walk.seconds = j["seconds"].number(0.01, kLongestS);
      walk.camera = readTrack(j["camera"], 7, walk.seconds, cameraKey);
      walk.things = readEntries(j, "objects", [&](const JsonPlace& o) { return readThing(o, walk.seconds, scene); });
      walk.lamps = readEntries(j, "lamps", [&](const JsonPlace& l) { return readDimmed(l, walk.seconds, scene); });
    } else {
      j.fail("needs seconds and camera");
    }
  }
  if (!error.empty()) return Error{fmt::format("{}: {}", file.string(), error)};
  return walk;
}

Camera cameraAt(const Walk& walk, double timeS) {
  const auto point = [&](size_t first) {
    return Vec3{walk.camera.at(first, timeS), walk.camera.at(first + 1, timeS), walk.camera.at(first + 2, timeS)};
  };
  Camera camera;
  camera.name = "walk";
  const Vec3 eye = point(0), forward = point(3) - eye;
  camera.worldFromCamera = looking(eye, length(forward) > 1e-6f ? forward : Vec3{0, 0, -1});
  camera.yFovRad = walk.camera.at(6, timeS);
  return camera;
}

SceneChange stage(const Walk& walk, double timeS, Scene& scene) {
  SceneChange change;
  for (const Walk::Thing& thing : walk.things) {
    for (size_t k = 0; k < thing.instances.size(); ++k) {
      Affine& now = scene.instances[thing.instances[k]].worldFromObject;
      const Affine next = placed(thing, thing.atRest[k], timeS);
      if (now != next) change.moved.push_back(thing.instances[k]);
      now = next;
    }
  }
  for (const Walk::Dimmed& dimmed : walk.lamps) {
    const float dimming = dimmed.track.at(0, timeS);
    for (size_t k = 0; k < dimmed.lamps.size(); ++k) {
      Lamp& lamp = scene.lamps[dimmed.lamps[k]];
      const bool dimmedCd = dim(lamp.intensityCd, dimmed.intensityCd[k], dimming),
                 dimmedCdM2 = dim(lamp.luminanceCdM2, dimmed.luminanceCdM2[k], dimming);
      change.lamps = change.lamps || dimmedCd || dimmedCdM2;
    }
    bool glow = false;
    for (size_t k = 0; k < dimmed.materials.size(); ++k)
      glow = dim(scene.materials[dimmed.materials[k]].emission, dimmed.emission[k], dimming) || glow;
    if (glow) change.glow.insert(change.glow.end(), dimmed.instances.begin(), dimmed.instances.end());
  }
  return change;
}

void atRest(const Walk& walk, Scene& scene) {
  for (const Walk::Thing& thing : walk.things) {
    for (size_t k = 0; k < thing.instances.size(); ++k)
      scene.instances[thing.instances[k]].worldFromObject = thing.atRest[k];
  }
  for (const Walk::Dimmed& dimmed : walk.lamps) {
    for (size_t k = 0; k < dimmed.lamps.size(); ++k)
      scene.lamps[dimmed.lamps[k]].intensityCd = dimmed.intensityCd[k],
      scene.lamps[dimmed.lamps[k]].luminanceCdM2 = dimmed.luminanceCdM2[k];
    for (size_t k = 0; k < dimmed.materials.size(); ++k)
      scene.materials[dimmed.materials[k]].emission = dimmed.emission[k];
  }
}

SceneChange everythingIn(const Walk& walk) {
  SceneChange change;
  for (const Walk::Thing& thing : walk.things)
    change.moved.insert(change.moved.end(), thing.instances.begin(), thing.instances.end());
  for (const Walk::Dimmed& dimmed : walk.lamps) {
    change.glow.insert(change.glow.end(), dimmed.instances.begin(), dimmed.instances.end());
    change.lamps = change.lamps || !dimmed.lamps.empty();
  }
  return change;
}

}  // namespace roomlight
