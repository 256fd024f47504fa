// Any bytes as a glTF file: a scene or one line of error. Bytes that are no binary glTF are taken as JSON, a zero byte,
// and the binary chunk, so that the fuzzer need not keep the lengths of a container right.
#include <cstdlib>
#include <cstring>

#include "import/import.h"
#include "unit/temporary_folder.h"

namespace {

std::string word(size_t v) {
  const auto u = static_cast<uint32_t>(v);
  return {reinterpret_cast<const char*>(&u), 4};
}

std::string asBinary(const std::string& input) {
  if (input.starts_with("glTF")) return input;
  const size_t end = std::min(input.find('\0'), input.size());
  const std::string json = input.substr(0, end), chunk = input.substr(std::min(end + 1, input.size()));
  return "glTF" + word(2) + word(28 + json.size() + chunk.size()) + word(json.size()) + "JSON" + json +
         word(chunk.size()) + std::string("BIN\0", 4) + chunk;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const roomlight::testing::TemporaryFolder folder;
  roomlight::testing::writeFile(folder / "a.glb", asBinary({reinterpret_cast<const char*>(data), size}));
  const auto imported = roomlight::importScene(folder / "a.glb", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
  return 0;
}
