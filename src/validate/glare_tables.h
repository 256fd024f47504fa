// Rooms of tables of the Unified Glare Rating, rated by meters and by direct computation.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "engine/settings.h"
#include "scene/scene.h"

namespace roomlight {

// Edges in units of H, the luminaires' height above the eye.
struct GlareRoom {
  int x, y;
};
// The nineteen of CIE 117 (1995) and CIE 190 (2010).
const std::vector<GlareRoom>& glareRooms();

// H = 2 m, eye at 1.2 m in the middle of a wall, looking along y; Lambertian panels of 0.3 x 0.3 m and 1000 lm in the
// ceiling, 0.25 H apart; ceiling, walls and floor reflect 0.7, 0.5, 0.2.
struct GlareSetUp {
  Scene scene;
  Vec3 eye, view;
};
GlareSetUp glareSetUp(const GlareRoom& room);

// Of that, by summing up panels and by radiosity for the background.
double directUgr(const GlareRoom& room);

struct GlareRow {
  GlareRoom room;
  double expected = 0, got = 0;
};
// Of every room or, where brief, every fourth. Fewer once cancelled.
Result<std::vector<GlareRow>> validateGlare(const std::string& technique, bool brief, const RenderSettings& render,
                                            const Progress& progress = {});

}  // namespace roomlight
