// A room with things made of boxes, for tests of how things lie to each other.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "support/rooms.h"
#include "view/home.h"

namespace roomlight::view {

struct Box {
  Vec3 lo, hi;
};

// One thing of several boxes.
inline void addThing(Scene& scene, const std::string& name, std::initializer_list<Box> boxes) {
  const auto first = static_cast<uint32_t>(scene.instances.size());
  for (const Box& b : boxes) test::addBox(scene, b.lo, b.hi, 0);
  for (uint32_t i = first; i < scene.instances.size(); ++i)
    scene.instances[i].object = scene.instances[first].object, scene.instances[i].name = name;
}

inline void addTable(Scene& scene, const std::string& name, float x, float z) {
  const auto leg = [&](float dx, float dz) {
    return Box{{x + dx, 0, z + dz}, {x + dx + 0.05f, 0.72f, z + dz + 0.05f}};
  };
  addThing(scene, name,
           {{{x, 0.72f, z}, {x + 1.2f, 0.75f, z + 0.8f}}, leg(0, 0), leg(1.15f, 0), leg(0, 0.75f), leg(1.15f, 0.75f)});
}

inline Scene emptyRoom() {
  Scene scene;
  test::addMaterial(scene, test::lambertian(0.7f));
  test::addRoom(scene, {0, 0, 0}, {6, 2.6f, 5}, std::vector<int>(6, 0));
  return scene;
}

inline size_t thingNamed(const EditableHome& home, const std::string& name) {
  for (size_t i = 0; i < home.objects.size(); ++i) {
    if (home.objects[i].name == name) return i;
  }
  ADD_FAILURE() << name;
  return 0;
}

}  // namespace roomlight::view
