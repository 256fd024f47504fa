// WebP (developers.google.com/speed/webp) through libwebp.
#include <webp/encode.h>

#include <fstream>
#include <memory>
#include <stdexcept>

#include "base/image_formats.h"

namespace roomlight::formats {

std::string encodeWebp(const ByteImage& image, float quality) {
  if (image.width < 1 || image.height < 1) throw std::runtime_error("a picture without pixels cannot be written");
  if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION)
    throw std::runtime_error("WebP holds at most 16383 pixels a side; use .png");
  const int stride = image.width * image.channels;
  const bool alpha = image.channels == 4;
  uint8_t* bytes = nullptr;
  size_t size = 0;
  if (quality >= kLossless) {
    size = (alpha ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB)(image.samples.data(), image.width, image.height,
                                                                    stride, &bytes);
  } else {
    size = (alpha ? WebPEncodeRGBA : WebPEncodeRGB)(image.samples.data(), image.width, image.height, stride, quality,
                                                    &bytes);
  }
  const std::unique_ptr<uint8_t, void (*)(void*)> owner(bytes, WebPFree);
  if (size == 0) throw std::runtime_error("WebP cannot hold this picture");
  return {reinterpret_cast<const char*>(bytes), size};
}

void writeWebp(const std::filesystem::path& file, const ByteImage& image, float quality) {
  const std::string bytes = formats::encodeWebp(image, quality);
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.flush();
  if (!out) throw std::runtime_error("cannot be written");
}

}  // namespace roomlight::formats
