// What every stage that follows light needs: the scene's surfaces and its lights.
#pragma once

#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight {

// Refers to both.
struct TracedScene {
  const RayScene& rays;
  const Lights& lights;
};

}  // namespace roomlight
