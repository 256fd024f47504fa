// Any bytes as a Sweet Home 3D home: damaged zip files are refused, within time and memory.
#include <cstdlib>

#include "import/import.h"
#include "unit/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const roomlight::testing::TemporaryFolder folder;
  roomlight::testing::writeFile(folder / "a.sh3d", {data, data + size});
  const auto imported = roomlight::importScene(folder / "a.sh3d", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
  return 0;
}
