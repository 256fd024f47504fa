// Any bytes as a Sweet Home 3D furniture library: as the zip file, or as the catalogue in one with a small model.
#include <cstdlib>

#include "import/import.h"
#include "support/homes.h"
#include "unit/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace roomlight::testing;
  static const TemporaryFolder folder;
  static const std::string model = "v 0 0 0\nv 1 0 0\nv 0 1 1\nusemtl m\nf 3 2 1\n";
  const std::string input(reinterpret_cast<const char*>(data), size);
  writeFile(folder / "a.sh3f", input.starts_with("PK")
                                   ? input
                                   : zipped({{"PluginFurnitureCatalog.properties", input}, {"m/a.obj", model}}));
  const auto imported = roomlight::importScene(folder / "a.sh3f", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
  return 0;
}
