#include "import/sh3d_scene.h"

#include <algorithm>
#include <set>

#include "import/sh3d_draft.h"
#include "import/sh3d_environment.h"
#include "import/sh3d_furniture.h"
#include "import/sh3d_paints.h"
#include "import/sh3d_plan.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr size_t kMostModelTriangles = 40'000'000;  // of all models, each counted once

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

HomeScene sceneOfHome(const Home& home, const Archive& archive, const ContentDigests& digests,
                      const ImportOptions& options, Warnings& warnings) {
  HomeScene out;
  Scene& scene = out.scene;
  Paints paints(archive, digests, imagesOf(home), scene, warnings);
  Draft draft{scene, warnings, Effort(options.maxTriangles)};
  addWalls(home, paints, draft);
  addRooms(home, paints, draft);
  const Models models(archive, digests, modelsOf(home), std::min(options.maxTriangles, kMostModelTriangles), scene,
                      warnings);
  addFurniture(home, models, paints, options, draft);
  addPolylines(home, paints, draft);
  addCameras(home, scene, warnings);
  out.daylight = addEnvironment(home, paints, options.camera, draft);
  out.offLamps = std::move(draft.offLamps);
  return out;
}

}  // namespace roomlight::importers::sh3d
