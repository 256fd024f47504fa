// Pictures on disk: linear EXR and Radiance HDR in cd/m² (or the file's own unit), 8-bit sRGB PNG. Metadata is
// embedded as string attributes (EXR) or tEXt/iTXt chunks (PNG) under the given keys.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "base/image.h"
#include "base/result.h"

namespace roomlight {

using Metadata = std::map<std::string, std::string>;

// Linear values, 32-bit float, ZIP compressed. Written to a temporary name beside the file and renamed.
Status writeExr(const std::filesystem::path& file, const Image& image, const Metadata& metadata);
// Values already display-encoded (0..1, sRGB); clipped and rounded to 8 bits. `alpha`: opacity of each pixel, 0..1,
// whose colour is not multiplied by it; empty: all opaque.
Status writePng(const std::filesystem::path& file, const Image& encoded, const Metadata& metadata,
                std::span<const float> alpha = {});
// The same as JPEG: as good as fits into so many bytes, or as bad as is still a picture. `xmp`: metadata as an XMP
// packet; may be empty.
Status writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes,
                 const std::string& xmp = {});

// Values already display-encoded (0..1, sRGB), clipped and rounded to 8 bits; with `alpha`, as above, four channels.
ByteImage bytesOf(const Image& encoded, std::span<const float> alpha = {});

// Pictures of bytes as they are. JPEG takes three channels only. WebP: quality 0 to 100, of colour alone, alpha is
// always exact; kLossless: every byte comes back, but for colours where alpha is 0.
constexpr float kLossless = 101;
Status writePng(const std::filesystem::path& file, const ByteImage& image, const Metadata& metadata);
Status writeJpeg(const std::filesystem::path& file, const ByteImage& image, size_t mostBytes);
// JPEG of three channels as bytes, `quality` 1 to 100, for showing at once.
Result<std::string> encodeJpeg(const ByteImage& image, int quality);
// The same of values already display-encoded (0..1, sRGB).
Result<std::string> encodeJpeg(const Image& encoded, int quality);
// As writePng() and writeWebp() have it, as bytes.
Result<std::string> encodePng(const ByteImage& image);
Result<std::string> encodeWebp(const ByteImage& image, float quality);
Status writeWebp(const std::filesystem::path& file, const ByteImage& image, float quality);

// EXR (linear), Radiance .hdr (linear), PNG or JPEG (decoded from sRGB to linear), by content.
Result<Image> readImage(const std::filesystem::path& file);
// The size that readImage() would find, by the file's header: no pixel is decoded.
Result<ImageSize> readImageSize(const std::filesystem::path& file);
// Whether it holds what a display shows (PNG, JPEG), exposed and tone-mapped for good, rather than linear light; by
// content.
Result<bool> isForDisplay(const std::filesystem::path& file);
Result<Metadata> readMetadata(const std::filesystem::path& file);

}  // namespace roomlight
