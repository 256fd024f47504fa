// One reader and writer a picture format, behind image_io.h. They throw std::exception; image_io.cpp turns that into
// the one-line error of the contract.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/image_io.h"
#include "base/image_layers.h"

namespace roomlight::formats {

// Throws when a file claims a picture that is absurd: no pixels, an edge above 65536, more than 2^27 pixels, or so
// many that `fileBytes` cannot hold them under any compression in use. Called before anything is allocated.
void checkSize(int64_t width, int64_t height, uint64_t fileBytes);

void writeExr(const std::filesystem::path& file, const Image& image, const Metadata& metadata);
Image readExr(const std::filesystem::path& file);
ImageSize readExrSize(const std::filesystem::path& file);
Metadata readExrMetadata(const std::filesystem::path& file);

void writeLayers(const std::filesystem::path& file, const LayeredImage& image);
LayeredImage readLayers(const std::filesystem::path& file);

void writePng(const std::filesystem::path& file, const Image& encoded, const Metadata& metadata,
              std::span<const float> alpha);
std::string encodePng(const ByteImage& image, const Metadata& metadata);
void writePng(const std::filesystem::path& file, const ByteImage& image, const Metadata& metadata);
void writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes, const std::string& xmp);
void writeJpeg(const std::filesystem::path& file, const ByteImage& image, size_t mostBytes, const std::string& xmp);
std::string encodeJpeg(const ByteImage& image, int quality);
std::string encodeWebp(const ByteImage& image, float quality);
void writeWebp(const std::filesystem::path& file, const ByteImage& image, float quality);
Image readPng(std::span<const uint8_t> bytes);  // decoded from sRGB to linear; transparency over black
Metadata readPngMetadata(std::span<const uint8_t> bytes);

Image readJpeg(std::span<const uint8_t> bytes);  // decoded from sRGB to linear; three channels or grey
ImageSize readJpegSize(std::span<const uint8_t> bytes);

// The 8-bit RGBA numbers of a texture as they are: no colour space, gamma or transparency is applied. Deeper channels
// lose their low bits. `size` is what readPngSize told, so that a caller can refuse it before memory is taken.
struct PngSize {
  int width = 0, height = 0;
  int bitsPerPixel = 0;  // in the file, before compression
};
PngSize readPngSize(std::span<const uint8_t> bytes);
std::vector<uint8_t> readPngTexels(std::span<const uint8_t> bytes, const PngSize& size);

Image readHdr(std::span<const uint8_t> bytes);
ImageSize readHdrSize(std::span<const uint8_t> bytes);

}  // namespace roomlight::formats
