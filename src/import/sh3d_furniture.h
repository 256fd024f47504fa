// Pieces of furniture, doors, windows and the bodies of lights.
#pragma once

#include "import/import.h"
#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"
#include "import/sh3d_models.h"
#include "import/sh3d_paints.h"

namespace roomlight::importers::sh3d {

// Every visible piece on a shown level becomes an object; a light also its sources (sh3d_lights.h). Furniture whose
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

}  // namespace roomlight::importers::sh3d
