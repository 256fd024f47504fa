#include "view/view_camera.h"

#include <algorithm>
#include <cmath>

namespace roomlight::view {

std::pair<int, int> frameSize(const Viewport& viewport, float scale) {
  const double width = static_cast<double>(viewport.width) * static_cast<double>(viewport.pixelRatio),
               height = static_cast<double>(viewport.height) * static_cast<double>(viewport.pixelRatio);
  const double fits = std::min({1.0, kMostFrameWidth / width, kMostFrameHeight / height}) * static_cast<double>(scale);
  const auto pixels = [&](double v) { return std::max(16, static_cast<int>(std::lround(v * fits))); };
  return {pixels(width), pixels(height)};
}

Camera cameraOf(const ViewCamera& v) {
  Camera camera;
  camera.name = "view";
  camera.worldFromCamera = looking(v.position, v.direction);
  const Vec3 back = -v.direction, side = cross(v.up, back);
  if (length(side) > 1e-4f) {
    const Vec3 right = normalize(side);
    camera.worldFromCamera = {right, cross(back, right), back, v.position};
  }
  camera.yFovRad = v.yFovDeg * kPi / 180;
  camera.cutHeightM = v.cutHeightM;
  return camera;
}

ViewCamera viewOf(const Camera& camera) {
  ViewCamera v;
  v.position = camera.worldFromCamera.w;
  v.direction = -normalize(camera.worldFromCamera.z);
  v.yFovDeg = std::clamp(camera.yFovRad * 180 / kPi, 5.0f, 150.0f);
  v.cutHeightM = camera.cutHeightM;
  return v;
}

}  // namespace roomlight::view
