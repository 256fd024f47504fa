// Any bytes as a zip file with a scene, and as the names of a folder's files, one a line.
#include "import/scene_package.h"

#include "fuzz_support.h"
#include "import/companion_search.h"
#include "import/failure.h"
#include "import/scene_kind.h"
#include "unit/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace roomlight;
  static const testing::TemporaryFolder folder;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  testing::writeFile(folder / "a.zip", bytes);
  const Result<Imported> imported = importers::importZip(folder / "a.zip", {.maxTriangles = 1 << 20});
  fuzz::require(imported || (!imported.error().empty() && imported.error().find('\n') == std::string::npos));
  std::vector<importers::PackedFile> files;
  std::vector<std::string> names;
  for (size_t at = 0; at < bytes.size();) {
    const size_t end = std::min(bytes.find('\n', at), bytes.size());
    names.push_back(bytes.substr(at, end - at)), files.push_back({names.back(), end});
    at = end + 1;
  }
  (void)importers::kindByContent(bytes, size);
  if (!names.empty()) (void)importers::meantName(names, "a/", names.back());
  try {
    (void)importers::pickScene(files);
  } catch (const importers::Failure&) {}
  return 0;
}
