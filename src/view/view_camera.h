// Cameras and windows as browsers tell them, and as the engine has them.
#pragma once

#include <utility>

#include "scene/scene.h"
#include "view/message.h"

namespace roomlight::view {

constexpr int kMostFrameWidth = 1920, kMostFrameHeight = 1080;

// Size of a frame in that window, in pixels of the display, within limits.
std::pair<int, int> frameSize(const Viewport& viewport, float scale);
Camera cameraOf(const ViewCamera& camera);
ViewCamera viewOf(const Camera& camera);

}  // namespace roomlight::view
