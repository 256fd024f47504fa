// Homes of Sweet Home 3D 5.3 and later: a zip file with Home.xml, which names models and pictures that are other
 // entries of it.
#include "import/failure.h"
#include "import/file_access.h"
#include "import/guarded.h"
#include "import/import.h"
#include "import/sh3d_archive.h"
#include "import/sh3d_home.h"
#include "import/sh3d_scene.h"
#include "import/warnings.h"

namespace roomlight {
namespace importers {
namespace {

using namespace sh3d;

Imported readSh3d(const std::filesystem::path& file, const ImportOptions& options) {
  const Bytes bytes = readWholeFile(file, "");
  const Archive archive(bytes, "");
  Warnings warnings;
  warnings.add("entries whose names lead out of the file are left out", archive.refused());
  const auto xml = archive.read("Home.xml");
  if (!xml) {
    fail("", archive.has("Home") ? "is of before Sweet Home 3D 5.3 and holds no Home.xml; open it in Sweet Home 3D 5.3 "
                                   "or newer and save it again"
                                 : "holds no Home.xml, so it is no home of Sweet Home 3D");
  }
  const Home home = readHomeXml(*xml, warnings);
  const ContentDigests digests(archive, warnings);
  HomeScene built = sceneOfHome(home, archive, digests, options, warnings);
  Imported imported = importedScene(std::move(built.scene), warnings, StatedUnit::Certain);
  imported.photo = home.environment.photo, imported.daylight = std::move(built.daylight);
  imported.offLamps = std::move(built.offLamps);
  return imported;
}

}  // namespace
}  // namespace importers

Result<Imported> importSh3d(const std::filesystem::path& file, const ImportOptions& options) {
  return importers::guarded(file, [&] { return importers::readSh3d(file, options); });
}

}  // namespace roomlight
