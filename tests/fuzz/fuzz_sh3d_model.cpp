// Any bytes as a model (OBJ, COLLADA, 3D Studio, a zip file with one) and its companions in a Sweet Home 3D home, with
// digests: those up to the first "\0//" are the model, those behind it its MTL file and its picture. A model that ends
// its reader may only end the child process.
#include <cstdlib>

#include "import/import.h"
#include "support/homes.h"
#include "unit/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace roomlight::testing;
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
  const auto imported = roomlight::importScene(folder / "a.sh3d", {.maxTriangles = 1 << 20});
  // A model is never the end of a home, unless it is beyond what all models together may hold.
  if (!imported && imported.error().find("together") == std::string::npos) std::abort();
  return 0;
}
