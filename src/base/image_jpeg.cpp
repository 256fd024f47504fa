#include <turbojpeg.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "base/image_formats.h"

namespace roomlight::formats {
namespace {

constexpr int kBest = 92, kWorst = 20, kStep = 6;  // of JPEG's quality

std::string compressed(const ByteImage& image, int quality) {
  const std::unique_ptr<void, int (*)(tjhandle)> compressor(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool done = compressor && tjCompress2(compressor.get(), image.samples.data(), image.width, 0, image.height, TJPF_RGB, &bytes, &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT) == 0;
  const std::string out = done ? std::string(reinterpret_cast<const char*>(bytes), size) : std::string();
  tjFree(bytes);
  if (!done) throw std::runtime_error("too large for JPEG");
  return out;
}

}  // namespace

void writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes) {
  ByteImage image(encoded.width, encoded.height, 3);
  auto* next = image.samples.data();
  for (const Vec3& p : encoded.pixels) {
    for (int c = 0; c < 3; ++c) *next++ = static_cast<uint8_t>(std::clamp(p[c], 0.0f, 1.0f) * 255 + 0.5f);
  }
  formats::writeJpeg(file, image, mostBytes);
}

void writeJpeg(const std::filesystem::path& file, const ByteImage& image, size_t mostBytes) {
  std::string bytes;
  for (int quality = kBest; quality >= kWorst; quality -= kStep) {
    bytes = compressed(image, quality);
    if (bytes.size() <= mostBytes) break;
  }
  std::ofstream out(file, std::ios::binary);
  out << bytes << std::flush;
  if (!out) throw std::runtime_error("cannot be written");
}

}  // namespace roomlight::formats
