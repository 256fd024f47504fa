// Homes of Sweet Home 3D 5.3 and later: a zip file with Home.xml, which names models and pictures that are other entries of it.
#include <fmt/format.h>

#include <set>

#include "import/failure.h"
#include "import/file_access.h"
#include "import/guarded.h"
#include "import/import.h"
#include "import/sh3d_archive.h"
#include "import/sh3d_cameras.h"
#include "import/sh3d_environment.h"
#include "import/sh3d_furniture.h"
#include "import/sh3d_models.h"
#include "import/sh3d_paints.h"
#include "import/sh3d_rooms.h"
#include "import/sh3d_walls.h"
#include "import/sh3d_xml.h"
#include "import/warnings.h"

namespace roomlight {
namespace importers {
namespace {

using namespace sh3d;

void addImage(const std::optional<TextureUse>& texture, std::set<std::string>& out) {
  if (texture) out.insert(texture->image);
}

std::set<std::string> imagesOf(const Home& home) {
  std::set<std::string> out;
  addImage(home.environment.groundTexture, out), addImage(home.environment.skyTexture, out);
  for (const sh3d::Wall& w : home.walls) {
    addImage(w.left.texture, out), addImage(w.right.texture, out);
    for (const auto* board : {&w.leftBaseboard, &w.rightBaseboard}) {
      if (*board) addImage((*board)->paint.texture, out);
    }
  }
  for (const sh3d::Room& r : home.rooms) addImage(r.floor.texture, out), addImage(r.ceiling.texture, out);
  for (const Piece& p : home.pieces) {
    addImage(p.paint.texture, out);
    for (const MaterialPaint& m : p.materials) addImage(m.paint.texture, out);
  }
  return out;
}

Imported readSh3d(const std::filesystem::path& file, const ImportOptions& options) {
  const Bytes bytes = readWholeFile(file, "");
  const Archive archive(bytes, "");
  Imported imported;
  Warnings warnings;
  warnings.add("entries whose names lead out of the file are left out", archive.refused());
  const auto xml = archive.read("Home.xml");
  if (!xml) {
    fail("", archive.has("Home") ? "holds no Home.xml, as files of before Sweet Home 3D 5.3; open it in Sweet Home 3D 5.3 or later and save it again"
                                 : "holds no Home.xml, so it is no home of Sweet Home 3D");
  }
  const Home home = readHomeXml(*xml, warnings);
  Scene& scene = imported.scene;
  Paints paints(archive, imagesOf(home), scene, warnings);
  int object = 0;
  Effort effort;
  addWalls(home, paints, scene, object, effort, warnings);
  addRooms(home, paints, scene, object, effort, warnings);
  Models models(archive, options.maxTriangles, scene, warnings);
  addFurniture(home, models, paints, options.maxTriangles, options.lumenAtFullPower, scene, object, warnings);
  addCameras(home, scene, warnings);
  addEnvironment(home, paints, scene, object, warnings);
  imported.warnings = warnings.lines();
  return imported;
}

}  // namespace
}  // namespace importers

Result<Imported> importSh3d(const std::filesystem::path& file, const ImportOptions& options) {
  return importers::guarded(file, [&] { return importers::readSh3d(file, options); });
}

}  // namespace roomlight
