// Small scenes of rectangles and round things, for tests and validation: rooms, boxes, panels, lamps.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace roomlight {

// A material that reflects as a perfect Lambertian of this albedo.
Material lambertian(float albedo, float emissionCdM2 = 0);

int addMaterial(Scene& scene, const Material& material);

// Rectangle corner, corner + u, corner + u + v, corner + v, cut into n x n cells; front side along cross(u, v). Its own
// instance and object.
void addRectangle(Scene& scene, Vec3 corner, Vec3 u, Vec3 v, int material, int n = 1);

// Faces of a box in the order x-, x+, y-, y+, z-, z+, each with its own material; fronts look inwards.
void addRoom(Scene& scene, Vec3 lo, Vec3 hi, const std::vector<int>& materials);

// Fronts look outwards.
void addBox(Scene& scene, Vec3 lo, Vec3 hi, int material);

// Of n x 2n faces between parallels and meridians; fronts look outwards.
void addSphere(Scene& scene, Vec3 centre, float radius, int material, int n = 24);

// The wall of an upright cylinder without its ends, from base on up along +y, of n faces; fronts look outwards.
void addTube(Scene& scene, Vec3 base, float radius, float height, int material, int n = 48);

Lamp pointLamp(Vec3 position, float candela);

}  // namespace roomlight
