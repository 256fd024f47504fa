// Cameras that look down at a home from above see into it, not its roof.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/views.h"
#include "home/cameras.h"
#include "scene/outline.h"

namespace roomlight::home {
namespace {

constexpr float kLeastDown = 0.499f;  // sine of how far such a camera looks down at least: 30 degrees
constexpr float kUnderCeilingM = 0.05f;
constexpr std::array kLowerM = {2.0f, 1.6f, 1.2f};  // cuts above a level's floor, under ceilings that slope
constexpr double kLeastShown = 0.02;                // of the picture: else the home is too far off
// Of what the best cut shows: what the highest level must show, its highest cut, and what is open from above.
constexpr double kOfBestLevel = 0.6, kOfBestCut = 0.3, kOpen = 0.4;

bool standsAbove(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera) {
  if (camera.projection != Projection::Perspective && camera.projection != Projection::Orthographic) return false;
  const Vec3 eye = camera.worldFromCamera.w, back = normalize(camera.worldFromCamera.z);
  if (back.y < kLeastDown) return false;
  const auto isBelow = [&](const Room& r) { return r.elevationM + r.heightM < eye.y; };
  return std::all_of(rooms.begin(), rooms.end(), isBelow) && !rays.intersect({eye, {0, 1, 0}, 0, kInfinity}).valid();
}

// The share of the picture that shows floors of rooms, or what lies low on them.
double floorsSeen(const RayScene& rays, const std::vector<Room>& rooms, Camera camera, float cutHeightM) {
  constexpr float kLowM = 0.3f;
  camera.cutHeightM = cutHeightM;
  const Sights sights = sightsOf(rays, camera);
  const auto isOnFloor = [&](const Seen& s) {
    return std::any_of(rooms.begin(), rooms.end(), [&](const Room& r) {
      return std::abs(s.p.y - r.elevationM) < kLowM && contains(r.floor, {s.p.x, s.p.z});
    });
  };
  const auto count = std::count_if(sights.surfaces.begin(), sights.surfaces.end(), isOnFloor);
  return static_cast<double>(count) / static_cast<double>(std::max<size_t>(1, sights.rays));
}

struct Cut {
  float heightM = 0;
  double shown = 0;  // of the picture
};

// Of one level, the highest first.
std::vector<Cut> cutsOf(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera,
                        const Level& level) {
  std::vector<Cut> cuts = {{level.ceilingM - kUnderCeilingM}};
  for (const float above : kLowerM) {
    if (level.elevationM + above < cuts.front().heightM) cuts.push_back({level.elevationM + above});
  }
  for (Cut& cut : cuts) cut.shown = floorsSeen(rays, rooms, camera, cut.heightM);
  return cuts;
}

double bestOf(const std::vector<Cut>& cuts) {
  double best = 0;
  for (const Cut& cut : cuts) best = std::max(best, cut.shown);
  return best;
}

}  // namespace

std::optional<float> cutHeightFor(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera) {
  if (rooms.empty() || camera.cutHeightM < kInfinity || !standsAbove(rays, rooms, camera)) return std::nullopt;
  std::vector<std::vector<Cut>> levels;  // the highest first
  double best = 0;
  for (const Level& level : levelsOf(rooms)) {
    levels.insert(levels.begin(), cutsOf(rays, rooms, camera, level));
    best = std::max(best, bestOf(levels.front()));
  }
  if (best < kLeastShown || floorsSeen(rays, rooms, camera, kInfinity) > kOpen * best) return std::nullopt;
  const auto level =
      std::find_if(levels.begin(), levels.end(), [&](const auto& cuts) { return bestOf(cuts) >= kOfBestLevel * best; });
  const double enough = kOfBestCut * bestOf(*level);
  return std::find_if(level->begin(), level->end(), [&](const Cut& cut) { return cut.shown >= enough; })->heightM;
}

}  // namespace roomlight::home
