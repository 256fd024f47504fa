#include "import/sh3d_scene.h"

#include <set>

#include "import/sh3d_cameras.h"
#include "import/sh3d_effort.h"
#include "import/sh3d_environment.h"
#include "import/sh3d_furniture.h"
#include "import/sh3d_models.h"
#include "import/sh3d_paints.h"
#include "import/sh3d_polylines.h"
#include "import/sh3d_rooms.h"
#include "import/sh3d_walls.h"

namespace roomlight::importers::sh3d {
namespace {

void addImage(const std::optional<TextureUse>& texture, std::set<std::string>& out) {
  if (texture) out.insert(texture->image);
}

std::set<std::string> imagesOf(const Home& home) {
  std::set<std::string> out;
  addImage(home.environment.groundTexture, out), addImage(home.environment.skyTexture, out);
  for (const Wall& w : home.walls) {
    addImage(w.left.texture, out), addImage(w.right.texture, out);
    for (const auto* board : {&w.leftBaseboard, &w.rightBaseboard}) {
      if (*board) addImage((*board)->paint.texture, out);
    }
  }
  for (const Room& r : home.rooms) addImage(r.floor.texture, out), addImage(r.ceiling.texture, out);
  for (const Piece& p : home.pieces) {
    addImage(p.paint.texture, out);
    for (const MaterialPaint& m : p.materials) addImage(m.paint.texture, out);
  }
  return out;
}

std::set<std::string> modelsOf(const Home& home) {
  std::set<std::string> out;
  for (const Piece& p : home.pieces) {
    if (isShown(home, p.level) && !p.model.empty()) out.insert(p.model);
  }
  return out;
}

}  // namespace

Scene sceneOfHome(const Home& home, const Archive& archive, const ContentDigests& digests, const ImportOptions& options,
                  Warnings& warnings, std::string& daylight) {
  Scene scene;
  Paints paints(archive, digests, imagesOf(home), scene, warnings);
  int object = 0;
  Effort effort;
  addWalls(home, paints, scene, object, effort, warnings);
  addRooms(home, paints, scene, object, effort, warnings);
  const Models models(archive, digests, modelsOf(home), options.maxTriangles, scene, warnings);
  addFurniture(home, models, paints, options.maxTriangles, options.lumenAtFullPower, scene, object, warnings);
  addPolylines(home, paints, scene, object);
  addCameras(home, scene, warnings);
  daylight = addEnvironment(home, paints, options.camera, scene, object, warnings);
  return scene;
}

}  // namespace roomlight::importers::sh3d
