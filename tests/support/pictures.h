// Small pictures for tests of techniques.
#pragma once

#include "base/image.h"
#include "scene/scene.h"

namespace roomlight::test {

// Looks along -z.
inline Camera cameraAt(Vec3 eye) {
  Camera camera;
  camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, eye};
  camera.yFovRad = 1.2f;
  return camera;
}

inline double meanLuminance(const Image& image) {
  double sum = 0;
  for (const Vec3 p : image.pixels) sum += luminance(p);
  return sum / static_cast<double>(image.pixels.size());
}

}  // namespace roomlight::test
