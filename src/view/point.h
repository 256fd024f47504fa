// What is under the pointer, and what a light meter shows there.
#pragma once

#include <atomic>
#include <optional>

#include "engine/technique.h"
#include "view/editable.h"

namespace roomlight::view {

struct PickedPoint {
  Vec3 point, normal;  // of the side that is seen
  float distanceM = 0;
  float cutHeightM = kInfinity;  // of the camera that sees it
  int object = -1, lamp = -1;  // in the lists of EditableHome
  std::string material;  // what people call it
};

// A pointer over a picture.
struct Pointer {
  const Camera& camera;
  std::pair<int, int> size;    // of the picture, pixels
  float x = 0, y = 0;          // fractions of the picture, from its upper left corner
  float viewportHeightPx = 1;  // of the window that shows it
};

// A lamp without a body is found within 12 pixels of the viewport where nothing stands before it.
std::optional<PickedPoint> pickAt(const EditableHome& home, const HomeState& state, const RayScene& rays,
                                  const Pointer& pointer);

struct Metered {
  double illuminanceLux = 0, standardErrorLux = 0;  // on the side that is seen
  double luminanceCdM2 = 0;                         // towards the camera, mean over a third of a degree
};
// Empty if stopped.
std::optional<Metered> meterAt(const LitScene& lit, const PickedPoint& point, Vec3 eye, const std::atomic<bool>& stop);

}  // namespace roomlight::view
