// Any bytes as an OBJ file; those after a zero byte are the MTL file a.mtl beside it.
#include <algorithm>
#include <cstdlib>

#include "import/import.h"
#include "unit/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const roomlight::testing::TemporaryFolder folder;
  const uint8_t* end = std::find(data, data + size, uint8_t{0});
  roomlight::testing::writeFile(folder / "a.obj", {data, end});
  roomlight::testing::writeFile(folder / "a.mtl", {end == data + size ? end : end + 1, data + size});
  const auto imported = roomlight::importScene(folder / "a.obj", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
  return 0;
}
