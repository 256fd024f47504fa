#include "view/frame.h"

#include <bit>

#include "base/image_io.h"

namespace roomlight::view {
namespace {

void put(std::string& out, uint32_t value, int bytes) {
  for (int k = 0; k < bytes; ++k) out.push_back(static_cast<char>(value >> (8 * k) & 0xff));
}
void put(std::string& out, float value) { put(out, std::bit_cast<uint32_t>(value), 4); }

}  // namespace

Result<std::string> packFrame(const FrameInfo& info, const ByteImage& picture) {
  const Result<std::string> jpeg = encodeJpeg(picture, info.jpegQuality);
  if (!jpeg) return jpeg;
  std::string out;
  out.reserve(kFrameHeaderBytes + jpeg.value().size());
  put(out, 1, 1), put(out, 1, 1), put(out, kFrameHeaderBytes, 2);
  put(out, info.number, 4);
  put(out, static_cast<uint32_t>(picture.width), 2), put(out, static_cast<uint32_t>(picture.height), 2);
  put(out, info.side, 1), put(out, info.flags, 1), put(out, info.jpegQuality, 2);
  put(out, info.camera, 4), put(out, info.revision, 4), put(out, info.samples, 4);
  for (const float v :
       {info.relativeError, info.ev100, info.scaleLow, info.scaleHigh, info.latencyMs, info.pictureMs, info.whiteK})
    put(out, v);
  put(out, info.samplesInAll, 4), put(out, 0, 4);
  return out + jpeg.value();
}

}  // namespace roomlight::view
