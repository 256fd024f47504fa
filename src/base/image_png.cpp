// PNG (ISO/IEC 15948) through libpng. libpng leaves by longjmp on errors: in the functions that call it between
// setjmp and return, nothing with a destructor comes to life.
#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/image_formats.h"
#include "base/tone.h"

namespace roomlight::formats {
namespace {

struct Failure {
  char message[200] = {};
};

void onError(png_structp png, png_const_charp message) {
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::snprintf(failure->message, sizeof failure->message, "%s", message);
  std::longjmp(png_jmpbuf(png), 1);
}
void onWarning(png_structp, png_const_charp) {}

struct Bytes {
  const uint8_t* next;
  size_t left;
};
void readBytes(png_structp png, png_bytep out, size_t n) {
  auto* bytes = static_cast<Bytes*>(png_get_io_ptr(png));
  if (n > bytes->left) png_error(png, "file ends too early");
  std::memcpy(out, bytes->next, n);
  bytes->next += n;
  bytes->left -= n;
}

void appendBytes(png_structp png, png_bytep bytes, size_t n) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), n);
}
void nothingToFlush(png_structp) {}

bool writeTo(std::string& out, const ByteImage& image, png_bytep* rows, png_textp texts, int textCount,
             Failure& failure) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, info ? &info : nullptr);
    return false;
  }
  png_set_write_fn(png, &out, appendBytes, nothingToFlush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               image.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(png, info, texts, textCount);
  png_set_rows(png, info, rows);
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

// Reads the chunks before and after the pixels (which are skipped row by row) and hands out their texts.
bool readTexts(Bytes& bytes, std::vector<uint8_t>& row, Metadata& metadata, Failure& failure) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, info ? &info : nullptr, nullptr);
    return false;
  }
  png_set_read_fn(png, &bytes, readBytes);
  png_read_info(png, info);
  row.resize(png_get_rowbytes(png, info));
  for (int pass = png_set_interlace_handling(png); pass > 0; --pass) {
    for (png_uint_32 y = png_get_image_height(png, info); y > 0; --y) png_read_row(png, row.data(), nullptr);
  }
  png_read_end(png, info);
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i) {
    const size_t length =
        texts[i].compression >= PNG_ITXT_COMPRESSION_NONE ? texts[i].itxt_length : texts[i].text_length;
    metadata[texts[i].key].assign(texts[i].text, length);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

// Decodes into rows of 4 * width bytes, which the caller made for the size the header tells.
bool readRgba(Bytes& bytes, png_uint_32 width, png_uint_32 height, uint8_t* rgba, Failure& failure) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, info ? &info : nullptr, nullptr);
    return false;
  }
  png_set_read_fn(png, &bytes, readBytes);
  png_set_benign_errors(png, 1);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_image_width(png, info) != width || png_get_image_height(png, info) != height ||
      png_get_rowbytes(png, info) != size_t{4} * width) {
    png_error(png, "the size changes inside the file");
  }
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 y = 0; y < height; ++y) png_read_row(png, rgba + size_t{4} * width * y, nullptr);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

void writePng(const std::filesystem::path& file, const Image& encoded, const Metadata& metadata,
              std::span<const float> alpha) {
  if (encoded.width < 1 || encoded.height < 1) throw std::runtime_error("a picture without pixels cannot be written");
  if (!std::all_of(encoded.pixels.begin(), encoded.pixels.end(), [](Vec3 p) { return isFinite(p); }))
    throw std::runtime_error("a pixel is not a finite number; no PNG can hold it");
  formats::writePng(file, bytesOf(encoded, alpha), metadata);
}

std::string encodePng(const ByteImage& image, const Metadata& metadata) {
  if (image.width < 1 || image.height < 1) throw std::runtime_error("a picture without pixels cannot be written");
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.height; ++y) rows.push_back(const_cast<png_bytep>(image.row(y)));  // the library only reads
  std::vector<png_text> texts;
  for (const auto& [key, value] : metadata) {
    png_text text{};
    text.compression = PNG_ITXT_COMPRESSION_NONE;  // international text: UTF-8
    text.key = const_cast<char*>(key.c_str());
    text.text = const_cast<char*>(value.c_str());
    text.itxt_length = value.size();
    texts.push_back(text);
  }
  Failure failure;
  std::string out;
  if (!writeTo(out, image, rows.data(), texts.data(), static_cast<int>(texts.size()), failure))
    throw std::runtime_error(std::string("cannot be written: ") + failure.message);
  return out;
}

void writePng(const std::filesystem::path& file, const ByteImage& image, const Metadata& metadata) {
  const std::string bytes = encodePng(image, metadata);
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (!out) throw std::runtime_error(std::string("cannot be written: ") + std::strerror(errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  const int why = errno;
  if (std::fclose(out) != 0 || !written)
    throw std::runtime_error(std::string("cannot be written: ") + std::strerror(written ? errno : why));
}

Image readPng(std::span<const uint8_t> bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) throw std::runtime_error(png.message);
  try {
    checkSize(png.width, png.height, bytes.size());
  } catch (...) {
    png_image_free(&png);
    throw;
  }
  png.format = PNG_FORMAT_RGB;
  const png_color black{};
  std::vector<uint8_t> rgb(PNG_IMAGE_SIZE(png));
  if (!png_image_finish_read(&png, &black, rgb.data(), 0, nullptr)) throw std::runtime_error(png.message);
  float linear[256];
  for (int i = 0; i < 256; ++i) linear[i] = srgbDecode(static_cast<float>(i) / 255.0f);
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = {linear[rgb[3 * i]], linear[rgb[3 * i + 1]], linear[rgb[3 * i + 2]]};
  }
  return image;
}

// The header chunk comes first: length, "IHDR", width, height, all big-endian; bits a channel, kind of colour.
PngSize readPngSize(std::span<const uint8_t> bytes) {
  if (bytes.size() < 26 || std::memcmp(bytes.data() + 12, "IHDR", 4) != 0)
    throw std::runtime_error("the PNG file has no header");
  const png_uint_32 width = png_get_uint_32(bytes.data() + 16), height = png_get_uint_32(bytes.data() + 20);
  const int depth = bytes[24], kind = bytes[25];
  if (width > PNG_UINT_31_MAX || height > PNG_UINT_31_MAX || depth < 1 || depth > 16)
    throw std::runtime_error("the PNG header is damaged");
  const int channels = kind == PNG_COLOR_TYPE_RGB          ? 3
                       : kind == PNG_COLOR_TYPE_RGB_ALPHA  ? 4
                       : kind == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                                           : 1;
  return {static_cast<int>(width), static_cast<int>(height), channels * depth};
}

std::vector<uint8_t> readPngTexels(std::span<const uint8_t> bytes, const PngSize& size) {
  std::vector<uint8_t> rgba(size_t{4} * static_cast<size_t>(size.width) * static_cast<size_t>(size.height));
  Bytes source{bytes.data(), bytes.size()};
  Failure failure;
  if (!readRgba(source, static_cast<png_uint_32>(size.width), static_cast<png_uint_32>(size.height), rgba.data(),
                failure)) {
    throw std::runtime_error(failure.message);
  }
  return rgba;
}

Metadata readPngMetadata(std::span<const uint8_t> bytes) {
  Bytes source{bytes.data(), bytes.size()};
  std::vector<uint8_t> row;
  Metadata metadata;
  Failure failure;
  if (!readTexts(source, row, metadata, failure)) throw std::runtime_error(failure.message);
  return metadata;
}

}  // namespace roomlight::formats
