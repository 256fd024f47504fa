// Any bytes as a KTX2 picture, its magic number left out: texels as many as it claims, or one line of error.
#include "fuzz/fuzz_support.h"
#include "import/pictures.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace roomlight::importers;
  Bytes bytes = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
  bytes.insert(bytes.end(), data, data + size);
  if (claimedPixels(bytes) > (1 << 20)) return 0;  // honest, but slow to fill
  Warnings warnings;
  const DecodedPicture picture = tryPictures({{"picture", bytes}}, warnings)[0];
  const auto& t = picture.texture;
  if (picture.failure.empty())
    roomlight::fuzz::require(t.width > 0 && t.height > 0 &&
                             t.rgba.size() == 4 * static_cast<size_t>(t.width) * static_cast<size_t>(t.height));
  roomlight::fuzz::require(picture.failure.find('\n') == std::string::npos);
  return 0;
}
