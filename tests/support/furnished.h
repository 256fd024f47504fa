// Rooms with some furniture, as boxes: for what looks at proportions and views.
#pragma once

#include "support/rooms.h"

namespace roomlight::test {

// A wall along x from x0 to x1 at z with a window between, sill at 0.9 m, of the given thickness inwards from z.
inline void addWindowWall(Scene& scene, float x0, float x1, float height, float z, float thick, float w0, float w1,
                          int material) {
  addBox(scene, {x0, 0, z}, {x1, 0.9f, z + thick}, material);
  addBox(scene, {x0, 2.1f, z}, {x1, height, z + thick}, material);
  addBox(scene, {x0, 0.9f, z}, {w0, 2.1f, z + thick}, material);
  addBox(scene, {w1, 0.9f, z}, {x1, 2.1f, z + thick}, material);
}

// 5 x 2.6 x 4 m with walls of 20 cm, a window of 1.6 x 1.2 m towards -z (or none), a table, a bench, a shelf.
inline Scene furnishedRoom(bool window = true) {
  Scene scene;
  const int white = addMaterial(scene, lambertian(0.75f)), wood = addMaterial(scene, lambertian(0.4f));
  addBox(scene, {-0.2f, -0.2f, -0.2f}, {5.2f, 0, 4.2f}, wood);
  addBox(scene, {-0.2f, 2.6f, -0.2f}, {5.2f, 2.8f, 4.2f}, white);
  addBox(scene, {-0.2f, 0, -0.2f}, {0, 2.6f, 4.2f}, white);
  addBox(scene, {5, 0, -0.2f}, {5.2f, 2.6f, 4.2f}, white);
  addBox(scene, {0, 0, 4}, {5, 2.6f, 4.2f}, white);
  if (window) {
    addWindowWall(scene, 0, 5, 2.6f, -0.2f, 0.2f, 1.7f, 3.3f, white);
  } else {
    addBox(scene, {0, 0, -0.2f}, {5, 2.6f, 0}, white);
  }
  addBox(scene, {1.2f, 0.7f, 1.2f}, {2.8f, 0.75f, 2.1f}, wood);
  for (const float x : {1.25f, 2.7f}) addBox(scene, {x, 0, 1.6f}, {x + 0.05f, 0.7f, 1.7f}, wood);
  addBox(scene, {1.2f, 0, 2.4f}, {2.8f, 0.45f, 2.8f}, wood);
  addBox(scene, {4.6f, 0, 0.6f}, {5, 1.9f, 1.8f}, wood);
  return scene;
}

// A chair of boxes, 0.9 m high.
inline Scene chair() {
  Scene scene;
  const int wood = addMaterial(scene, lambertian(0.5f));
  addBox(scene, {0, 0.42f, 0}, {0.45f, 0.46f, 0.45f}, wood);
  addBox(scene, {0, 0.46f, 0}, {0.45f, 0.9f, 0.04f}, wood);
  for (const float x : {0.0f, 0.41f}) {
    for (const float z : {0.0f, 0.41f}) addBox(scene, {x, 0, z}, {x + 0.04f, 0.42f, z + 0.04f}, wood);
  }
  return scene;
}

}  // namespace roomlight::test
