#include <turbojpeg.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "base/image_formats.h"
#include "base/tone.h"

namespace roomlight::formats {
namespace {

constexpr int kBest = 92, kWorst = 20, kStep = 6;  // of JPEG's quality

std::string compressed(const ByteImage& image, int quality) {
  const std::unique_ptr<void, int (*)(tjhandle)> compressor(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool done = compressor && tjCompress2(compressor.get(), image.samples.data(), image.width, 0, image.height,
                                              TJPF_RGB, &bytes, &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT) == 0;
  const std::string out = done ? std::string(reinterpret_cast<const char*>(bytes), size) : std::string();
  tjFree(bytes);
  if (!done) throw std::runtime_error("too large for JPEG");
  return out;
}

// A packet as the APP1 segment of XMP part 3, 1.1.3: marker, length, name with its zero, packet; behind the first
// segment, JFIF's.
void insertXmp(std::string& jpeg, const std::string& xmp) {
  static constexpr char kName[] = "http://ns.adobe.com/xap/1.0/";
  const size_t length = 2 + sizeof kName + xmp.size();
  if (length > 0xffff) throw std::runtime_error("the XMP packet is too long for one segment");
  const auto twoBytes = [](size_t v) { return std::string{static_cast<char>(v >> 8), static_cast<char>(v & 0xff)}; };
  const auto byteAt = [&](size_t i) { return static_cast<size_t>(static_cast<unsigned char>(jpeg.at(i))); };
  const size_t place = 4 + 256 * byteAt(4) + byteAt(5);
  jpeg.insert(place, "\xff\xe1" + twoBytes(length) + std::string(kName, sizeof kName) + xmp);
}

using Decoder = std::unique_ptr<void, int (*)(tjhandle)>;

// Checked, before memory is taken for the pixels.
ImageSize checkedSize(const Decoder& decoder, std::span<const uint8_t> bytes) {
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (!decoder ||
      tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &subsampling, &colours) != 0)
    throw std::runtime_error("a damaged JPEG file");
  if (colours == TJCS_CMYK || colours == TJCS_YCCK)
    throw std::runtime_error("a JPEG file of printing colours (CMYK) is not read");
  // A few bits may stand for thousands of empty blocks of 64 pixels.
  checkSize(width, height, 64 * uint64_t{bytes.size()});
  return {width, height};
}

}  // namespace

std::string encodeJpeg(const ByteImage& image, int quality) { return compressed(image, quality); }

Image readJpeg(std::span<const uint8_t> bytes) {
  const Decoder decoder(tjInitDecompress(), tjDestroy);
  const auto [width, height] = checkedSize(decoder, bytes);
  std::vector<uint8_t> samples(3 * static_cast<size_t>(width) * static_cast<size_t>(height));
  if (tjDecompress2(decoder.get(), bytes.data(), bytes.size(), samples.data(), width, 0, height, TJPF_RGB,
                    TJFLAG_ACCURATEDCT) != 0)
    throw std::runtime_error("a damaged JPEG file");
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      image.pixels[i][c] = srgbDecode(static_cast<float>(samples[3 * i + static_cast<size_t>(c)]) / 255);
  }
  return image;
}

ImageSize readJpegSize(std::span<const uint8_t> bytes) {
  return checkedSize(Decoder(tjInitDecompress(), tjDestroy), bytes);
}

void writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes, const std::string& xmp) {
  formats::writeJpeg(file, bytesOf(encoded), mostBytes, xmp);
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
