// What the parts of a home are added to.
#pragma once

#include "import/sh3d_effort.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

struct Draft {
  Scene& scene;
  Warnings& warnings;
  Effort effort = Effort();
  int object = 0;  // the first free number
};

}  // namespace roomlight::importers::sh3d
