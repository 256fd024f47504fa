// What gives light in a scene and can be dimmed apart: lamps, and parts of things that shine.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace roomlight {

// Lamps and shining meshes of one name in one thing are one.
struct SceneLamp {
  std::string name;
  int object = -1;  // number of the thing that it is part of; -1: none, or it is an Area lamp with its rectangle
  std::vector<size_t> lamps;  // of the scene's
  std::vector<uint32_t> instances;  // that shine
};

// In the order of the scene: first those of its lamps, then what else shines.
std::vector<SceneLamp> findLamps(const Scene& scene);

// Afterwards no two things, and no shining and other part of one, share a material: each can be changed alone. Meshes
// and materials are copied for that; what is seen stays as it is.
void partMaterials(Scene& scene);

// What a lamp sends out, lm.
double lampFluxLm(const Lamp& lamp);

// Makes it send out so much, in its own colour; a black one becomes white. Of an Area lamp not its rectangle.
void setLampFlux(Lamp& lamp, double fluxLm);

// Whether the instance's material emits light.
bool shines(const Scene& scene, const Instance& instance);

}  // namespace roomlight
