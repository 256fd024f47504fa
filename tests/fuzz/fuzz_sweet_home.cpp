// Any bytes as homes and furniture libraries of Sweet Home 3D: a scene or one line of error.
#include <cstdlib>

#include "import/import.h"
#include "support/homes.h"
#include "unit/temporary_folder.h"

namespace roomlight::fuzz {

// Any bytes as Home.xml of a Sweet Home 3D home, with a small model beside it: a scene or one line of error.
void sh3d_xml(const uint8_t* data, size_t size) {
  using namespace testing;
  static const TemporaryFolder folder;
  static const std::string model =
      "g sweethome3d_window_pane_1\nv 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\ng sweethome3d_opening_on_hinge_1\nusemtl m\nf "
      "3 2 1\n";
  writeFile(folder / "a.sh3d", zipped({{"Home.xml", {reinterpret_cast<const char*>(data), size}}, {"1/a.obj", model}}));
  const auto imported = importScene(folder / "a.sh3d", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
}

// Any bytes as a Sweet Home 3D home: damaged zip files are refused, within time and memory.
void sh3d_zip(const uint8_t* data, size_t size) {
  static const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.sh3d", {data, data + size});
  const auto imported = importScene(folder / "a.sh3d", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
}

// Any bytes as a model (OBJ, COLLADA, 3D Studio, a zip file with one) and its companions in a Sweet Home 3D home, with
// digests: those up to the first "\0//" are the model, those behind it its MTL file and its picture. A model that ends
// its reader may only end the child process.
void sh3d_model(const uint8_t* data, size_t size) {
  using namespace testing;
  static const TemporaryFolder folder;
  static const std::string xml = homeXml(
      "<light name='l' x='0' y='0' width='10' depth='10' height='10' model='1/a.obj'><lightSourceMaterial "
      "name='m'/><material name='m' color='FF0000FF'/></light>"
      "<pieceOfFurniture name='p' x='90' y='0' width='10' depth='10' height='10' model='1/a.obj' "
      "pitch='0.5'><transformation name='sweethome3d_hinge_1' "
      "matrix='1 0 0 0 0 1 0 0 0 0 1 1'/><texture name='t' image='1/a.mtl' width='5' height='5'/></pieceOfFurniture>");
  const std::string input(reinterpret_cast<const char*>(data), size), mark("\0//", 3);
  const size_t end = std::min(input.find(mark), input.size());
  const std::string model = input.substr(0, end), companion = input.substr(std::min(end + mark.size(), input.size()));
  const std::string digests =
      "ContentDigests-Version: 1.0\n\nName: 1/a.obj\nSHA-1-Digest: 2jmj7l5rSw0yVb/vlWAYkK/YBwk=\n\n";
  writeFile(folder / "a.sh3d", zipped({{"Home.xml", xml},
                                       {"ContentDigests", digests},
                                       {"1/a.obj", model},
                                       {"1/a.mtl", companion},
                                       {"1/a.png", companion}}));
  const auto imported = importScene(folder / "a.sh3d", {.maxTriangles = 1 << 20});
  // A model is never the end of a home, unless it is beyond what all models together may hold.
  if (!imported && imported.error().find("together") == std::string::npos) std::abort();
}

// Any bytes as a Sweet Home 3D furniture library: as the zip file, or as the catalogue in one with a small model.
void sh3f(const uint8_t* data, size_t size) {
  using namespace testing;
  static const TemporaryFolder folder;
  static const std::string model = "v 0 0 0\nv 1 0 0\nv 0 1 1\nusemtl m\nf 3 2 1\n";
  const std::string input(reinterpret_cast<const char*>(data), size);
  writeFile(folder / "a.sh3f", input.starts_with("PK")
                                   ? input
                                   : zipped({{"PluginFurnitureCatalog.properties", input}, {"m/a.obj", model}}));
  const auto imported = importScene(folder / "a.sh3f", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
}

}  // namespace roomlight::fuzz
