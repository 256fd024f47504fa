// Any bytes as Home.xml of a Sweet Home 3D home, with a small model beside it: a scene or one line of error.
#include <cstdlib>

#include "import/import.h"
#include "support/homes.h"
#include "unit/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace roomlight::testing;
  static const TemporaryFolder folder;
  static const std::string model =
      "g sweethome3d_window_pane_1\nv 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\ng sweethome3d_opening_on_hinge_1\nusemtl m\nf "
      "3 2 1\n";
  writeFile(folder / "a.sh3d", zipped({{"Home.xml", {reinterpret_cast<const char*>(data), size}}, {"1/a.obj", model}}));
  const auto imported = roomlight::importScene(folder / "a.sh3d", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
  return 0;
}
