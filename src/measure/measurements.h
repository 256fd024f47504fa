// What was measured, as plain data: reports are made from it.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "measure/luminaires.h"
#include "measure/meter_place.h"
#include "measure/meter_plan.h"

namespace roomlight {

// Readings on a lattice, row by row; not a number in cells that are not used.
struct Field {
  MeterGrid lattice;
  std::vector<float> lux;
  std::vector<float> daylightPercent;  // empty, or as long as lux
};

enum class SurfaceKind { WorkPlane, Floor, Wall, Rectangle };

struct GridReading {
  std::string name;  // "Kitchen, work plane"
  std::string room;  // empty: of none
  SurfaceKind kind = SurfaceKind::WorkPlane;
  Targets targets;
  std::vector<Vec2> floor;  // outline, where known
  Field points;             // what statistics are of
  std::optional<Field> map; // finer and up to the walls, for a picture
  double areaM2 = 0;        // of the room; 0: of none
  std::vector<LeftOutCell> leftOut;  // points in furniture, in walls, or outdoors while others are not
  bool outdoors = false;    // as a whole: measured, but no part of the home's means
  Statistics lux() const { return statisticsOf(points.lux); }
};

struct RoomReading {
  Room room;
  Targets targets;
  double areaM2 = 0;
  size_t lamps = 0, lampsWithoutWatts = 0;
  double wattsW = 0;
  bool wattsKnown() const { return wattsW > 0 && lampsWithoutWatts == 0; }
};

struct PointReading {
  PointPlan plan;
  double lux = 0, standardErrorLux = 0;
  std::optional<double> daylightPercent;
  MeterPlace place = MeterPlace::Free;
};

struct SpotReading {
  SpotPlan plan;
  double luminanceCdM2 = 0;
  MeterPlace place = MeterPlace::Free;
};

struct GlareReading {
  GlarePlan plan;
  std::optional<double> ugr;     // none: no background to judge by
  double ugrError = 0;           // standard error by the noise of the background
  double backgroundCdM2 = 0;
  double eyeLux = 0;             // on the plane that faces the view, all light
  size_t sources = 0;
  MeterPlace place = MeterPlace::Free;
};

// In furniture or in a wall: what is read there is told, but judged by no target.
inline bool isMisplaced(MeterPlace place) { return place == MeterPlace::Furniture || place == MeterPlace::Wall; }

// Work planes of all rooms indoors together.
struct HomeMeans {
  size_t rooms = 0;
  double areaM2 = 0;
  double ofRoomsLux = 0;  // every room alike
  double ofAreaLux = 0;   // every square metre alike
};

// A target met or missed.
struct Verdict {
  std::string where, what, unit, source;
  double wanted = 0, got = 0;
  bool atMost = false;
  bool met() const { return atMost ? got <= wanted : got >= wanted; }
};

// How certain the readings of grids and points are: relative standard errors.
struct Certainty {
  size_t meters = 0;
  double worst = 0, median = 0;
};

struct Measurements {
  std::vector<RoomReading> rooms;
  std::vector<GridReading> grids;
  std::vector<PointReading> points;
  std::vector<SpotReading> spots;
  std::vector<GlareReading> glares;
  std::vector<Luminaire> luminaires;  // of the whole scene
  Certainty certainty;
  double maintenanceFactor = 1;
  std::vector<std::string> warnings;
};

// None without a work plane indoors that was measured.
std::optional<HomeMeans> homeMeans(const Measurements& m);

// Meters that stand where none belongs: a line for each kind of place.
std::vector<std::string> misplaced(const Measurements& m);

bool isIn(const Room& room, Vec3 p);

// Targets that nothing was measured for, each with the reason.
std::vector<std::string> notJudged(const Measurements& m);

// Numbers for people: three significant digits.
std::string threeDigits(double value);

std::vector<Verdict> verdictsOf(const Measurements& m);

// What a photographer's light meter shows. EV at ISO 100 of an incident meter with a flat receptor (C = 250, ISO 2720):
// 300 lx is 6.91.
inline double incidentEv100(double illuminanceLux) { return std::log2(illuminanceLux / 2.5); }

// EV at ISO 100 of a reflected-light meter (K = 12.5, ISO 2720): 17.19 cd/m² is 7.10.
inline double reflectedEv100(double luminanceCdM2) { return std::log2(8 * luminanceCdM2); }

constexpr const char* kAssumedUse = "living";  // of rooms of which nothing is known

// A room beside what rooms of its use should be lit to.
struct RoomTarget {
  std::string room, use;
  std::string
      origin;  // of the use: "stated", "name" (of the room), or "assumed"; "target": the illuminance itself was stated
  std::string source;  // of the illuminance: a standard, or the file that says so
  double wantedLux = 0;
  std::optional<double> foundLux;  // mean on the work plane, times the maintenance factor; none: not measured
  bool met() const { return foundLux && *foundLux >= wantedLux; }
};

// One for each room indoors, in their order.
std::vector<RoomTarget> roomTargets(const Measurements& m);

}  // namespace roomlight
