// What Home.xml of a Sweet Home 3D home says, after SweetHome3D.dtd, as plain data in the file's own units:
// centimetres, radians, plan coordinates with x to the right and y down (towards the viewer), angles clockwise as seen
// on the plan, colours 0xRRGGBB in sRGB.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "import/import.h"
#include "import/plan_area.h"
#include "import/warnings.h"

namespace roomlight::importers::sh3d {

struct TextureUse {
  std::string image;                   // name of the archive's entry
  std::string name;                    // in the catalogue that it is from; empty: none
  double widthCm = 100, heightCm = 100;
  double xOffset = 0, yOffset = 0;     // of its width and height
  double angleRad = 0, scale = 1;
  bool fittingArea = false;            // once over the whole room instead of by size
};

struct Paint {
  std::optional<uint32_t> colour;
  std::optional<TextureUse> texture;
  double shininess = 0;
};

struct Level {
  std::string id, name;
  double elevationCm = 0, floorThicknessCm = 0, heightCm = 250;
  bool viewable = true;
};

struct Baseboard {
  double thicknessCm = 0, heightCm = 0;
  Paint paint;
};

struct Wall {
  std::string id, place;              // place: for messages, "line 12: wall 'wall3'"
  int level = -1;                     // index into Home::levels, -1: none
  int atStart = -1, atEnd = -1;       // indices into Home::walls
  PlanPoint start, end;
  std::optional<double> heightCm, heightAtEndCm;
  double thicknessCm = 0;
  double arcExtentRad = 0;            // 0: straight
  std::optional<uint32_t> topColour;
  Paint left, right;                  // as seen walking from start to end
  std::optional<Baseboard> leftBaseboard, rightBaseboard;
};

struct Room {
  std::string name, place;
  int level = -1;
  std::vector<PlanPoint> points;
  bool floorVisible = true, ceilingVisible = true, ceilingFlat = false;
  Paint floor, ceiling;
};

struct LightSource {
  double x = 0.5, y = 0.5, z = 0.5;   // of width, depth and height; from the left, the front and the bottom
  uint32_t colour = 0xffffff;
  std::optional<double> diameter;     // of the width
};

struct MaterialPaint {
  std::string name, key;
  Paint paint;
  bool shininessGiven = false;
};

struct Transformation {
  std::string name;
  std::array<double, 12> rows{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // 3 x 4
};

struct DoorOrWindow {
  bool cutOutOnBothSides = false;
  std::string cutOutShape;            // SVG path in the unit square; empty: all of it
};

enum class PieceKind : uint8_t {
  Furniture,
  DoorOrWindow,
  Light,
};

// A piece of furniture; groups are unfolded into their pieces.
struct Piece {
  PieceKind kind = PieceKind::Furniture;
  std::string name, place;
  int level = -1;
  PlanPoint centre;
  double elevationCm = 0, angleRad = 0, pitchRad = 0, rollRad = 0;
  double widthCm = 0, depthCm = 0, heightCm = 0;
  std::optional<double> heightInPlanCm;
  bool mirrored = false;
  std::string model;                  // name of the archive's entry; empty: none
  std::array<double, 9> modelRotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  int modelFlags = 0;
  Paint paint;                        // of the whole piece
  bool shininessGiven = false;
  std::vector<MaterialPaint> materials;
  std::vector<Transformation> transformations;
  std::string staircaseCutOutShape;
  DoorOrWindow door;
  double power = 0.5;                 // of a light
  std::vector<LightSource> lightSources;
  std::vector<std::string> lightSourceMaterials;
};

struct Camera {
  std::string name, kind;             // kind: observerCamera, topCamera, storedCamera
  double x = 0, y = 0, z = 0, yawRad = 0, pitchRad = 0, fieldOfViewRad = 1.1;
  std::optional<int64_t> timeMs;      // the clock on the wall, counted as if it were UTC
  bool pinhole = true;
};

struct Compass {
  double northRad = 0;                // of north on the plan, clockwise from up
  std::optional<double> latitudeRad, longitudeRad;
  std::string timeZone;
};

struct Environment {
  std::optional<uint32_t> groundColour, skyColour, lightColour;
  std::optional<TextureUse> groundTexture, skyTexture;
  double photoAspect = 4.0 / 3;
  std::optional<PhotoWish> photo;     // none: as a new home has it
};

// A line drawn on the plan that is shown in 3D too.
struct Polyline {
  std::string place;
  int level = -1;
  std::vector<PlanPoint> points;
  double thicknessCm = 1, elevationCm = 0;
  uint32_t colour = 0;
  bool closed = false;
};

struct Home {
  double wallHeightCm = 250;
  std::string camera;                 // which one is on: observerCamera or topCamera
  Environment environment;
  std::optional<Compass> compass;
  std::vector<Camera> cameras;
  std::vector<Level> levels;
  std::vector<Piece> pieces;
  std::vector<Wall> walls;
  std::vector<Room> rooms;
  std::vector<Polyline> polylines;
};

inline double elevationOf(const Home& home, int level) {
  return level < 0 ? 0 : home.levels[static_cast<size_t>(level)].elevationCm;
}
inline bool isShown(const Home& home, int level) {
  return level < 0 || home.levels[static_cast<size_t>(level)].viewable;
}
// Levels stand on the slab of their floor, except the lowest, which stands on the ground.
double slabBelowCm(const Home& home, int level);

// Throws Failure that names line and element: not well-formed, no home, a number that is none or beyond every home, a
// missing attribute that the DTD requires. Elements and attributes that are not known are passed over, as later
// versions add some.
Home readHomeXml(std::span<const uint8_t> xml, Warnings& warnings);

}  // namespace roomlight::importers::sh3d
