// What of a model moves: the names of its groups say what turns about which hinge, and what slides on which rail.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// Whether a transformation of that name moves the group of that name.
bool moves(const std::string& transformation, const std::string& group);

// Appends what opens of a piece to the scene's leaves, and says of each of its meshes to which leaf it belongs, -1: to
// none. `posed` is how the home has the meshes turned and moved, in the model's own coordinates; `front` the way that
// the piece faces, unit, in the world.
std::vector<int> findLeaves(const std::vector<const Mesh*>& meshes, const std::vector<Affine>& posed,
                            const Affine& worldFrom, Vec3 front, Scene& scene);

}  // namespace roomlight::importers::sh3d
