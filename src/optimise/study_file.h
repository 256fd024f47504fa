// What a designer states: goals for rooms, what may change, what must hold. Schema: docs/reference/optimise.md.
#pragma once

#include <nlohmann/json.hpp>

#include "measure/meter_plan.h"
#include "optimise/catalogue.h"
#include "scene/scene.h"

namespace roomlight::optimise {

enum class Objective { TargetMiss, Uniformity, Glare, Energy, Cost, Fittings };
struct ObjectiveInfo {
  Objective objective;
  const char* name;   // in files: targetMiss
  const char* title;  // for people
  const char* unit;
};
const std::vector<ObjectiveInfo>& objectiveTable();
const ObjectiveInfo& infoOf(Objective objective);

// A light outdoors under which lamps are judged.
struct Condition {
  std::string name;
  nlohmann::json daylight;  // as lighting files have it; null: night
  double weight = 1;
  double hoursPerYear = 0;  // that lamps are on in it
  int line = 0;
};

struct Zone {
  std::string name;
  Room room;                       // where it is one: with its floor
  bool rectangle = false;          // else a rectangle:
  Vec3 corner, alongU, alongV;
  double workPlaneM = 0.75;
  double spacingM = 0, borderM = 0.5;
  double meanLux = 0;              // 0: nothing asked
  double u0 = 0;                   // least over mean; 0: nothing asked
  double weight = 1;
  std::vector<size_t> conditions;  // where it is judged
  int line = 0;
};

struct Eye {
  std::string name;
  Vec3 position, direction{0, 0, -1};
  double ugr = 19;  // at most
  std::vector<size_t> conditions;
};

// Luminance of one place over that of another, as an eye sees them.
struct Ratio {
  std::string name;
  Vec3 eye, task, surround;
  double most = 10;
  std::vector<size_t> conditions;
};

// Where lamps may go: one rule makes many places.
struct PlaceRule {
  std::string name;
  Mounting on = Mounting::Ceiling;
  Room room;
  std::vector<size_t> luminaires;  // of the catalogue
  std::vector<std::string> aimWords;  // "down", "up", "out", or a name of aimPoints
  std::vector<Vec3> aimPoints;
  double spacingM = 1, fromWallsM = 0.4, heightM = 1.8;
  double apartM = 0.3;             // between two lamps
  int most = 1000;                 // lamps
  std::vector<Vec3> at;            // places given one by one, instead of a grid
  int line = 0;
};

enum class Dimming { None, Common, ByCondition };

struct StudyFile {
  std::filesystem::path file, catalogueFile, lightingFile;  // lightingFile: what is fixed; may be empty
  std::string title;
  Catalogue catalogue;
  bool ownLamps = false;  // the home's own lamps stay
  std::vector<Condition> conditions;
  std::vector<Zone> zones;
  std::vector<Eye> eyes;
  std::vector<Ratio> ratios;
  std::vector<PlaceRule> places;
  Dimming dimming = Dimming::ByCondition;
  double mostWatts = 0, mostCost = 0;  // 0: no limit
  int mostFittings = 0;
  std::vector<Objective> objectives;
  size_t evaluations = 40000, population = 100;
  uint64_t seed = 1;
  int certified = 8;         // designs solved in full
  std::vector<std::string> cameras;  // of the home, for pictures of designs; empty: the first
  double maintenance = 1;    // targets are judged with lamps' light times this
  double areaM2 = 0;         // for kWh a m²; 0: of all rooms named
};

// `rooms`: of the home. The error is one line "file:line: what is wrong; what to do".
Result<StudyFile> readStudy(const std::filesystem::path& file, const std::vector<Room>& rooms);

}  // namespace roomlight::optimise
