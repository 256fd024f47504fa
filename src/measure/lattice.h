// Where light is measured on a surface: the cells of a grid, and what can be said of the readings in them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "trace/meter.h"
#include "trace/ray_scene.h"

namespace roomlight {

// Cells of a rectangle, those that are used marked. A reading stands for its cell and is taken in the middle of it.
struct MeterGrid {
  Vec3 corner;                       // of the first cell
  Vec3 u{1, 0, 0}, v{0, 0, 1};       // unit, along columns and rows
  Vec3 normal{0, 1, 0};              // of the side that light falls on
  float stepUM = 1, stepVM = 1;
  int columns = 0, rows = 0;
  std::vector<uint8_t> used;         // row by row

  size_t index(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column);
  }
  Vec3 centre(int column, int row) const {
    return corner + u * ((static_cast<float>(column) + 0.5f) * stepUM) +
           v * ((static_cast<float>(row) + 0.5f) * stepVM);
  }
  size_t count() const;
  std::vector<SurfaceElement> elements() const;  // of the used cells, in their order
  // One value for each used cell onto all cells; not a number in the others.
  std::vector<float> spread(std::span<const float> ofUsed) const;
};

struct GridSettings {
  double spacingM = 0;        // at most so far apart; 0: by gridSpacingM()
  double borderM = 0.5;       // a band along walls that is left out, as EN 12464-1 (2011) has it ...
  double borderShare = 0.15;  // ... in small rooms at most this share of the shorter side (its edition of 2021)
};

// The largest distance of points on an area of these sides: p = 0.2 · 5^(log10 d), at most 10 m; d is the longer side,
// or the shorter where the longer is twice as long (EN 12464-1, 4.4).
double gridSpacingM(double sideM, double otherSideM);

// The rectangle corner, corner + alongU, corner + alongV.
MeterGrid rectangleLattice(Vec3 corner, Vec3 alongU, Vec3 alongV, Vec3 normal, const GridSettings& settings);
// A horizontal plane over a floor at height yM, its columns along or across the longest side. Has no used cell where
// the floor is too narrow.
MeterGrid floorLattice(std::span<const Vec2> floor, float yM, const GridSettings& settings);
// The walls around a floor, one for each side longer than 0.3 m, a centimetre in front of them.
std::vector<MeterGrid> wallLattices(std::span<const Vec2> floor, float elevationM, float heightM,
                                    const GridSettings& settings);

struct Statistics {
  size_t points = 0;
  double mean = 0, least = 0, most = 0;
  double u0() const { return mean > 0 ? least / mean : 0; }
  double u1() const { return most > 0 ? least / most : 0; }
};
// Of the values that are numbers.
Statistics statisticsOf(std::span<const float> values);

// In a wardrobe, in a pillar? Five of six rays along the axes meet the backs of things smaller than a room; the sixth
// may meet the floor that the thing stands on.
bool insideThing(const RayScene& rays, Vec3 p);

// Cells whose middle is in a wardrobe say nothing of the room: they are no longer used. Returns how many.
size_t leaveOutThings(const RayScene& rays, MeterGrid& lattice);

// A place indoors where a person could stand, parted from others at walls, for scenes of which no rooms are known.
struct Area {
  std::string name;  // "Area 1", the largest first
  float elevationM = 0;  // of the floor
  double areaM2 = 0;
  MeterGrid points;  // workPlaneM above the floor, spaced and kept from the walls as `settings` say
  MeterGrid map;  // the same up to the walls and finer, for a picture of the light
};

// A floor is a level that many rays from above end on with 1.9 m of room and a ceiling over it. Areas are parted by
// what stands 2.2 m above the floor, where doors have ended. Costs some hundred thousand rays.
std::vector<Area> findAreas(const RayScene& rays, double workPlaneM, const GridSettings& settings);

}  // namespace roomlight
