// Pieces of furniture, doors and windows: their models, what of them moves, and the light of lamps.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "import/import.h"
#include "import/sh3d_archive.h"
#include "import/sh3d_content.h"
#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// A model in its own coordinates and unit, y up. Materials are indices into the home's scene.
struct Model {
  std::vector<Mesh> meshes;  // named after their group
  std::vector<int> objects;  // of each mesh: what belongs together
};

class Models {
 public:
  // Reads these entries, several at a time; their materials and textures are added to the scene. What is missing,
  // damaged, not what was saved or of a format that is not read is a warning. Throws Failure where all together are
// beyond a limit.
  Models(const Archive& archive, const ContentDigests& digests, const std::set<std::string>& entries,
         size_t maxTriangles, Scene& scene, Warnings& warnings);

  // Null where it could not be read.
  const Model* find(const std::string& entry) const;

 private:
  std::map<std::string, Model> models_;
};

// What of a model moves: the names of its groups say what turns about which hinge, and what slides on which rail.
// Whether a transformation of that name moves the group of that name.
bool moves(const std::string& transformation, const std::string& group);

// Appends what opens of a piece to the scene's leaves, and says of each of its meshes to which leaf it belongs, -1: to
// none. `posed` is how the home has the meshes turned and moved, in the model's own coordinates; `front` the way that
// the piece faces, unit, in the world.
std::vector<int> findLeaves(const std::vector<const Mesh*>& meshes, const std::vector<Affine>& posed,
                            const Affine& worldFrom, Vec3 front, Scene& scene);

// Every visible piece on a shown level becomes an object; a light also its sources (addLight). Furniture whose
// model cannot be shown stands as a box of its size; doors, windows and lights without a model leave their place empty.
// Throws Failure.
void addFurniture(const Home& home, const Models& models, Paints& paints, const ImportOptions& options, Draft& draft);

// Where a model stands: its bounding box, turned by the piece's modelRotation, fills width, height and depth; that is
// mirrored, pitched or rolled, then turned on the plan and put with its lowest point on its elevation. `positions` are
// those of the model in its own coordinates.
Affine worldFromModel(const Home& home, const Piece& piece, const std::vector<const Mesh*>& meshes,
                      const std::vector<Affine>& posed);

// From the piece's box (x to the right, y up, z to the front, metres, around its centre) to the world, without pitch
// and roll.
Affine worldFromPiece(const Home& home, const Piece& piece);

// A light of power p sends out p times `lumenAtFullPower`, shared by its sources as bright as their colours are: a ball
// of the source's diameter at its place in the piece's box, or a point where it has none. Without sources, the parts
// that its lightSourceMaterials name glow evenly. Sources of a light of power 0 become `offLamps`, at a new light's
// power. `firstInstance`: the instances from there on are the light's own. Throws Failure.
void addLight(const Home& home, const Piece& piece, size_t firstInstance, double lumenAtFullPower, Draft& draft);

}  // namespace roomlight::importers::sh3d
