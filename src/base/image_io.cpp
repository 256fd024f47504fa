#include "base/image_io.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "base/image_formats.h"
#include "base/write_file.h"

namespace roomlight {
namespace {

constexpr uint64_t kLargestFileBytes = uint64_t{2} << 30;
constexpr uint64_t kPngHeaderBytes = 64;  // that of its first chunk is among them
constexpr uint8_t kPngMagic[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr uint8_t kJpegMagic[] = {0xff, 0xd8, 0xff};
constexpr uint8_t kExrMagic[] = {0x76, 0x2f, 0x31, 0x01};

enum class Format {
  Exr,
  Png,
  Jpeg,
  Hdr,
};

// Libraries report over several lines; the contract is one.
Error errorAt(const std::filesystem::path& file, std::string_view what) {
  std::string line(what.substr(0, 300));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return {fmt::format("{}: {}", file.string(), line)};
}

// Runs `work` and turns whatever it throws into an error that names the file.
template <class T, class Work>
Result<T> guarded(const std::filesystem::path& file, Work&& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return errorAt(file, "not enough memory for this picture");
  } catch (const std::exception& e) {
    return errorAt(file, e.what());
  } catch (...) {
    return errorAt(file, "unknown failure");
  }
}

// A reader of `file` sees either the old file or the whole new one: write beside it, then rename.
template <class Write>
Status writeAtomically(const std::filesystem::path& file, Write&& write) {
  const std::filesystem::path temporary = unfinishedName(file);
  Status status = guarded<Ok>(file, [&] {
    write(temporary);
    std::filesystem::rename(temporary, file);
    return Ok{};
  });
  if (!status.ok()) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
  }
  return status;
}

std::vector<uint8_t> readBytes(const std::filesystem::path& file, uint64_t most) {
  if (std::filesystem::is_directory(file)) throw std::runtime_error("is a folder, not a picture");
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) throw std::runtime_error(std::filesystem::exists(file) ? "cannot be opened for reading" : "no such file");
  const auto size = static_cast<uint64_t>(std::max<std::streamoff>(0, in.tellg()));
  if (size > kLargestFileBytes) throw std::runtime_error("larger than 2 GiB; refused as a picture");
  std::vector<uint8_t> bytes(std::min(size, most));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw std::runtime_error("cannot be read");
  return bytes;
}

Format formatOf(const std::filesystem::path& file) {
  const std::vector<uint8_t> head = readBytes(file, 16);
  const auto startsWith = [&](const void* magic, size_t n) {
    return head.size() >= n && std::memcmp(head.data(), magic, n) == 0;
  };
  if (startsWith(kExrMagic, sizeof kExrMagic)) return Format::Exr;
  if (startsWith(kPngMagic, sizeof kPngMagic)) return Format::Png;
  if (startsWith(kJpegMagic, sizeof kJpegMagic)) return Format::Jpeg;
  if (startsWith("#?RADIANCE", 10) || startsWith("#?RGBE", 6)) return Format::Hdr;
  throw std::runtime_error("neither OpenEXR, PNG, JPEG nor Radiance HDR by its first bytes");
}

}  // namespace

void formats::checkSize(int64_t width, int64_t height, uint64_t fileBytes) {
  constexpr int64_t kLargestEdge = 65536, kMostPixels = int64_t{1} << 27;
  // Deflate packs at most 1032:1 and a texel takes at least one bit.
  constexpr uint64_t kMostPixelsPerByte = 1032 * 8;
  if (width < 1 || height < 1) throw std::runtime_error("header claims a picture without pixels");
  if (width > kLargestEdge || height > kLargestEdge || width * height > kMostPixels) {
    throw std::runtime_error(fmt::format(
        "header claims {} x {} pixels; at most 65536 a side and 134 million in all are read", width, height));
  }
  if (static_cast<uint64_t>(width * height) / kMostPixelsPerByte > fileBytes) {
    throw std::runtime_error(
        fmt::format("header claims {} x {} pixels, more than {} bytes can hold", width, height, fileBytes));
  }
}

Status writeExr(const std::filesystem::path& file, const Image& image, const Metadata& metadata) {
  return writeAtomically(file, [&](const auto& temporary) { formats::writeExr(temporary, image, metadata); });
}

ByteImage bytesOf(const Image& encoded, std::span<const float> alpha) {
  const auto eightBits = [](float v) { return static_cast<uint8_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f)); };
  ByteImage bytes(encoded.width, encoded.height, alpha.empty() ? 3 : 4);
  auto* next = bytes.samples.data();
  for (size_t i = 0; i < encoded.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) *next++ = eightBits(encoded.pixels[i][c]);
    if (!alpha.empty()) *next++ = eightBits(alpha[i]);
  }
  return bytes;
}

Status writePng(const std::filesystem::path& file, const Image& encoded, const Metadata& metadata,
                std::span<const float> alpha) {
  return writeAtomically(file, [&](const auto& temporary) { formats::writePng(temporary, encoded, metadata, alpha); });
}

Status writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes, const std::string& xmp) {
  return writeAtomically(file, [&](const auto& temporary) { formats::writeJpeg(temporary, encoded, mostBytes, xmp); });
}

Status writeLayers(const std::filesystem::path& file, const LayeredImage& image) {
  return writeAtomically(file, [&](const auto& temporary) { formats::writeLayers(temporary, image); });
}

Result<LayeredImage> readLayers(const std::filesystem::path& file) {
  return guarded<LayeredImage>(file, [&] {
    if (formatOf(file) != Format::Exr)
      throw std::runtime_error("no OpenEXR file; layers are written by render --layers");
    return formats::readLayers(file);
  });
}

Status writePng(const std::filesystem::path& file, const ByteImage& image, const Metadata& metadata) {
  return writeAtomically(file, [&](const auto& temporary) { formats::writePng(temporary, image, metadata); });
}

Status writeJpeg(const std::filesystem::path& file, const ByteImage& image, size_t mostBytes) {
  return writeAtomically(file, [&](const auto& temporary) { formats::writeJpeg(temporary, image, mostBytes, {}); });
}

Result<std::string> encodeJpeg(const ByteImage& image, int quality) {
  return guarded<std::string>("JPEG", [&] { return formats::encodeJpeg(image, quality); });
}

Result<std::string> encodeJpeg(const Image& encoded, int quality) {
  return guarded<std::string>("JPEG", [&] { return formats::encodeJpeg(bytesOf(encoded), quality); });
}

Result<std::string> encodePng(const ByteImage& image) {
  return guarded<std::string>("PNG", [&] { return formats::encodePng(image, {}); });
}

Result<std::string> encodeWebp(const ByteImage& image, float quality) {
  return guarded<std::string>("WebP", [&] { return formats::encodeWebp(image, quality); });
}

Status writeWebp(const std::filesystem::path& file, const ByteImage& image, float quality) {
  return writeAtomically(file, [&](const auto& temporary) { formats::writeWebp(temporary, image, quality); });
}

Result<Image> readImage(const std::filesystem::path& file) {
  return guarded<Image>(file, [&] {
    switch (formatOf(file)) {
      case Format::Exr: return formats::readExr(file);
      case Format::Png: return formats::readPng(readBytes(file, kLargestFileBytes));
      case Format::Jpeg: return formats::readJpeg(readBytes(file, kLargestFileBytes));
      case Format::Hdr: break;
    }
    return formats::readHdr(readBytes(file, kLargestFileBytes));
  });
}

Result<ImageSize> readImageSize(const std::filesystem::path& file) {
  return guarded<ImageSize>(file, [&]() -> ImageSize {
    switch (formatOf(file)) {
      case Format::Exr: return formats::readExrSize(file);
      case Format::Png: {
        const formats::PngSize size = formats::readPngSize(readBytes(file, kPngHeaderBytes));
        formats::checkSize(size.width, size.height, std::filesystem::file_size(file));
        return {size.width, size.height};
      }
      case Format::Jpeg: return formats::readJpegSize(readBytes(file, kLargestFileBytes));
      case Format::Hdr: break;
    }
    return formats::readHdrSize(readBytes(file, kLargestFileBytes));
  });
}

Result<bool> isForDisplay(const std::filesystem::path& file) {
  return guarded<bool>(file, [&] {
    const Format format = formatOf(file);
    return format == Format::Png || format == Format::Jpeg;
  });
}

Result<Metadata> readMetadata(const std::filesystem::path& file) {
  return guarded<Metadata>(file, [&] {
    switch (formatOf(file)) {
      case Format::Exr: return formats::readExrMetadata(file);
      case Format::Png: return formats::readPngMetadata(readBytes(file, kLargestFileBytes));
      case Format::Jpeg:
      case Format::Hdr: break;
    }
    return Metadata{};
  });
}

}  // namespace roomlight
