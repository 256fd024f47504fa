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

// A packet as the APP1 segment of XMP part 3, 1.1.3: marker, length, name with its zero, packet; behind the first segment, JFIF's.
void insertXmp(std::string& jpeg, const std::string& xmp) {
  static constexpr char kName[] = "http://ns.adobe.com/xap/1.0/";
  const size_t length = 2 + sizeof kName + xmp.size();
  if (length > 0xffff) throw std::runtime_error("the XMP packet is too long for one segment");
  const auto twoBytes = [](size_t v) { return std::string{static_cast<char>(v >> 8), static_cast<char>(v & 0xff)}; };
  const auto byteAt = [&](size_t i) { return static_cast<size_t>(static_cast<unsigned char>(jpeg.at(i))); };
  const size_t place = 4 + 256 * byteAt(4) + byteAt(5);
  jpeg.insert(place, "\xff\xe1" + twoBytes(length) + std::string(kName, sizeof kName) + xmp);
}

}  // namespace

std::string encodeJpeg(const ByteImage& image, int quality) { return compressed(image, quality); }

void writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes, const std::string& xmp) {
  ByteImage image(encoded.width, encoded.height, 3);
  auto* next = image.samples.data();
  for (const Vec3& p : encoded.pixels) {
    for (int c = 0; c < 3; ++c) *next++ = static_cast<uint8_t>(std::clamp(p[c], 0.0f, 1.0f) * 255 + 0.5f);
  }
  formats::writeJpeg(file, image, mostBytes, xmp);
}

void writeJpeg(const std::filesystem::path& file, const ByteImage& image, size_t mostBytes, const std::string& xmp) {
  std::string bytes;
  for (int quality = kBest; quality >= kWorst; quality -= kStep) {
    bytes = compressed(image, quality);
    if (bytes.size() <= mostBytes) break;
  }
  if (!xmp.empty()) insertXmp(bytes, xmp);
  std::ofstream out(file, std::ios::binary);
  out << bytes << std::flush;
  if (!out) throw std::runtime_error("cannot be written");
}

}  // namespace roomlight::formats
