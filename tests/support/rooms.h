// Small scenes of rectangles for tests: rooms, lamps, panels.
#pragma once

#include <string>

#include "scene/primitives.h"

namespace roomlight::test {

using roomlight::addBox;
using roomlight::addMaterial;
using roomlight::addRectangle;
using roomlight::addRoom;
using roomlight::addSphere;
using roomlight::addTube;
using roomlight::lambertian;
using roomlight::pointLamp;

}  // namespace roomlight::test
