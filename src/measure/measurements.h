// What was measured, as plain data: reports are made from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/meter_plan.h"

namespace roomlight {

// Readings on a lattice, row by row; not a number in cells that are not used.
struct Field {
  Lattice lattice;
  std::vector<float> lux;
  std::vector<float> daylightPercent;  // empty, or as long as lux
};

enum class SurfaceKind { WorkPlane,
                         Floor,
                         Wall,
                         Rectangle };

struct GridReading {
  std::string name;  // "Kitchen, work plane"
  std::string room;  // empty: of none
  SurfaceKind kind = SurfaceKind::WorkPlane;
  Targets targets;
  std::vector<Vec2> floor;  // outline, where known
  Field points;             // what statistics are of
  std::optional<Field> map; // finer and up to the walls, for a picture
  size_t leftOut = 0;       // points inside furniture
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
};

struct SpotReading {
  SpotPlan plan;
  double luminanceCdM2 = 0;
};

struct GlareReading {
  GlarePlan plan;
  std::optional<double> ugr;     // none: no background to judge by
  double ugrError = 0;           // standard error by the noise of the background
  double backgroundCdM2 = 0;
  double eyeLux = 0;             // on the plane that faces the view, all light
  size_t sources = 0;
};

// A target met or missed.
struct Verdict {
  std::string where, what, unit, source;
  double wanted = 0, got = 0;
  bool atMost = false;
  bool met() const { return atMost ? got <= wanted : got >= wanted; }
};

struct Measurements {
  std::vector<RoomReading> rooms;
  std::vector<GridReading> grids;
  std::vector<PointReading> points;
  std::vector<SpotReading> spots;
  std::vector<GlareReading> glares;
  double maintenanceFactor = 1;
  std::vector<std::string> warnings;
};

// Targets that nothing was measured for, each with the reason.
std::vector<std::string> notJudged(const Measurements& m);

// Numbers for people: three significant digits.
std::string threeDigits(double value);

std::vector<Verdict> verdictsOf(const Measurements& m);

}  // namespace roomlight
