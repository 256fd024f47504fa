// Small scenes of rectangles for tests: rooms, lamps, panels, and pictures of them.
#pragma once

#include <string>

#include "base/image.h"
#include "scene/primitives.h"
#include "scene/scene.h"

namespace roomlight::test {

using roomlight::addBox;
using roomlight::addMaterial;
using roomlight::addRectangle;
using roomlight::addRoom;
using roomlight::addSphere;
using roomlight::addTube;
using roomlight::lambertian;
using roomlight::pointLamp;

// A lamp on a table in a grey room, its shade open above and below: a white bulb, which takes none of the light, or a
// point as bright.
inline Scene tableLamp(bool bulb) {
  constexpr float kRadiusM = 0.03f, kLuminance = 30000;
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.6f)), paper = addMaterial(scene, lambertian(0.7f));
  addRoom(scene, {0, 0, 0}, {4.03f, 2.53f, 3.53f}, std::vector<int>(6, grey));
  addBox(scene, {0.3f, 0.7f, 0.3f}, {1.5f, 0.74f, 1.1f}, grey);
  addTube(scene, {0.8f, 1.0f, 0.7f}, 0.12f, 0.22f, paper);
  const Vec3 place{0.8f, 1.12f, 0.7f};
  if (bulb) {
    addSphere(scene, place, kRadiusM, addMaterial(scene, lambertian(1, kLuminance)));
  } else {
    scene.lamps.push_back(pointLamp(place, kPi * kRadiusM * kRadiusM * kLuminance));
  }
  return scene;
}

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
