#include "import/pictures.h"

#include <fmt/format.h>
#include <turbojpeg.h>
#include <webp/decode.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>

#include "base/image_formats.h"
#include "import/failure.h"
#include "import/ktx2.h"

namespace roomlight::importers {
namespace {

using ByteView = std::span<const uint8_t>;

enum class Format {
  Png,
  Jpeg,
  WebP,
  Ktx2,
  Bmp,
  Tga,
  Unknown,
};

bool startsWith(ByteView bytes, std::string_view magic, size_t at = 0) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

Format formatOf(ByteView bytes) {
  if (startsWith(bytes, "\x89PNG\r\n\x1a\n")) return Format::Png;
  if (startsWith(bytes, "\xff\xd8\xff")) return Format::Jpeg;
  if (startsWith(bytes, "RIFF") && startsWith(bytes, "WEBP", 8)) return Format::WebP;
  if (isKtx2(bytes)) return Format::Ktx2;
  if (startsWith(bytes, "BM")) return Format::Bmp;
  int w = 0, h = 0, n = 0;
  // TGA has no magic number: believed only when its header makes sense.
  if (bytes.size() <= INT32_MAX && stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &w, &h, &n))
    return Format::Tga;
  return Format::Unknown;
}

using JpegDecoder = std::unique_ptr<void, decltype([](void* handle) { tjDestroy(handle); })>;

struct Header {
  Format format = Format::Unknown;
  int width = 0, height = 0;
  int jpegColours = 0;
  formats::PngSize png;
  Ktx2Header ktx2;
};

Header readHeader(ByteView bytes) {
  Header h;
  if (bytes.size() > INT32_MAX) fail("", "the picture file is larger than 2 GiB");
  h.format = formatOf(bytes);
  const int size = static_cast<int>(bytes.size());
  int channels = 0, subsampling = 0;
  bool fine = true;
  switch (h.format) {
    case Format::Png:
      h.png = formats::readPngSize(bytes);
      h.width = h.png.width, h.height = h.png.height;
      break;
    case Format::Jpeg: {
      const JpegDecoder decoder(tjInitDecompress());
      fine = tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &h.width, &h.height, &subsampling,
                                 &h.jpegColours) == 0;
      break;
    }
    case Format::WebP: fine = WebPGetInfo(bytes.data(), bytes.size(), &h.width, &h.height) != 0; break;
    case Format::Ktx2:
      h.ktx2 = readKtx2Header(bytes);
      h.width = h.ktx2.width, h.height = h.ktx2.height;
      break;
    case Format::Unknown: fail("", "is no PNG, JPEG, WebP, KTX2, BMP or TGA picture");
    default: fine = stbi_info_from_memory(bytes.data(), size, &h.width, &h.height, &channels) != 0;
  }
  if (!fine) fail("", "the picture's header is damaged, or the picture is too large");
  return h;
}

// Most pixels that a picture can hold in so many bytes: what claims more is cut off or a bomb. PNG: deflate reaches
// 1:1032. JPEG: end-of-band runs of 8x8 blocks. TGA: runs of 128 pixels in two bytes. BMP: one bit.
// A WebP or KTX2 picture of one colour takes a few bytes whatever its size, so these get a flat allowance.
size_t mostPixels(const Header& h, size_t bytes) {
  switch (h.format) {
    case Format::Png: return bytes * 1040 * 8 / static_cast<size_t>(h.png.bitsPerPixel);
    case Format::Jpeg: return bytes * 4096;
    case Format::Tga: return bytes * 64;
    case Format::Bmp: return bytes * 8;
    default: return (size_t{1} << 24) + bytes * 4096;
  }
}

size_t checkedPixels(const Header& h, size_t bytes) {
  if (h.width <= 0 || h.height <= 0) fail("", "the picture is empty");
  const size_t pixels = static_cast<size_t>(h.width) * static_cast<size_t>(h.height);
  if (h.width > kMaxPictureSide || h.height > kMaxPictureSide || pixels > kMaxPicturePixels) {
    fail("", fmt::format("the picture claims {} x {} pixels; the limits are {} a side and {} in all", h.width, h.height,
                         kMaxPictureSide, kMaxPicturePixels));
  }
  if (pixels > mostPixels(h, bytes)) {
    fail("", fmt::format("the picture claims {} x {} pixels, but has only {} bytes", h.width, h.height, bytes));
  }
  return pixels;
}

// Adobe's CMYK is stored inverted: 255 is no ink.
void cmykToRgba(std::vector<uint8_t>& texels) {
  for (size_t i = 0; i + 3 < texels.size(); i += 4) {
    const int k = texels[i + 3];
    for (size_t c = 0; c < 3; ++c) texels[i + c] = static_cast<uint8_t>(texels[i + c] * k / 255);
    texels[i + 3] = 255;
  }
}

// Returns what the decoder complained about although it could go on.
std::string decodeJpeg(ByteView bytes, const Header& h, std::vector<uint8_t>& rgba) {
  const JpegDecoder decoder(tjInitDecompress());
  const bool cmyk = h.jpegColours == TJCS_CMYK || h.jpegColours == TJCS_YCCK;
  const int rc = tjDecompress2(decoder.get(), bytes.data(), bytes.size(), rgba.data(), h.width, 0, h.height,
                               cmyk ? TJPF_CMYK : TJPF_RGBA, TJFLAG_LIMITSCANS);
  std::string complaint;
  if (rc != 0) {
    complaint = printable(tjGetErrorStr2(decoder.get()));
    if (tjGetErrorCode(decoder.get()) != TJERR_WARNING) fail("", "damaged JPEG picture: " + complaint);
  }
  if (cmyk) cmykToRgba(rgba);
  return complaint;
}

void decodeByStb(ByteView bytes, const Header& h, std::vector<uint8_t>& rgba) {
  int w = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, decltype([](stbi_uc* t) { stbi_image_free(t); })> texels(
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &w, &height, &channels, 4));
  if (!texels || w != h.width || height != h.height) {
    const char* why = stbi_failure_reason();
    fail("", fmt::format("damaged picture: {}", why ? why : "cannot be decoded"));
  }
  std::memcpy(rgba.data(), texels.get(), rgba.size());
}

Texture decode(ByteView bytes, const Header& h, std::string& complaint) {
  Texture t;
  t.width = h.width, t.height = h.height;
  if (h.format == Format::Png) {
    t.rgba = formats::readPngTexels(bytes, h.png);
    return t;
  }
  if (h.format == Format::Ktx2) {
    t.rgba = decodeKtx2(h.ktx2);
    return t;
  }
  t.rgba.resize(static_cast<size_t>(h.width) * static_cast<size_t>(h.height) * 4);
  if (h.format == Format::Jpeg) {
    complaint = decodeJpeg(bytes, h, t.rgba);
  } else if (h.format == Format::WebP) {
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), t.rgba.data(), t.rgba.size(), h.width * 4))
      fail("", "damaged or animated WebP picture");
  } else {
    decodeByStb(bytes, h, t.rgba);
  }
  return t;
}

// Runs `work`; returns what it throws, empty: nothing.
template <class Work>
std::string failureOf(Work&& work) {
  try {
    work();
    return {};
  } catch (const std::exception& e) {
    return printable(e.what(), 300);
  }
}

}  // namespace

std::optional<std::string> undecodable(ByteView bytes) {
  const Format format = formatOf(bytes);
  if (format == Format::Ktx2) return undecodableKtx2(bytes);
  if (format != Format::Unknown) return std::nullopt;
  if (startsWith(bytes, "DDS ")) return "DDS";
  if (startsWith(bytes, "GIF8")) return "GIF";
  if (startsWith(bytes, "II*") || startsWith(bytes, std::string_view("MM\0*", 4))) return "TIFF";
  if (startsWith(bytes, "ftypavif", 4)) return "AVIF";
  return "unknown";
}

size_t claimedPixels(ByteView bytes) {
  try {
    return checkedPixels(readHeader(bytes), bytes.size());
  } catch (const std::exception&) {
    return 0;
  }
}

std::vector<DecodedPicture> tryPictures(const std::vector<PictureJob>& jobs, Warnings& warnings) {
  std::vector<Header> headers(jobs.size());
  std::vector<DecodedPicture> out(jobs.size());
  size_t pixels = 0;
  for (size_t i = 0; i < jobs.size(); ++i) {
    out[i].failure = failureOf([&] {
      headers[i] = readHeader(jobs[i].bytes);
      const size_t more = checkedPixels(headers[i], jobs[i].bytes.size());
      if (pixels + more > kMaxAllPixels)
        fail("", fmt::format("all pictures together have more than {} pixels", kMaxAllPixels));
      pixels += more;
    });
  }
  std::vector<std::string> complaints(jobs.size());
  parallelOrFail(jobs.size(), [&](size_t i) {
    if (out[i].failure.empty())
      out[i].failure = failureOf([&] { out[i].texture = decode(jobs[i].bytes, headers[i], complaints[i]); });
  });
  for (const std::string& complaint : complaints) {
    if (!complaint.empty()) warnings.add("damaged JPEG pictures are shown as far as they could be read");
  }
  return out;
}

std::vector<Texture> decodePictures(const std::vector<PictureJob>& jobs, Warnings& warnings) {
  std::vector<DecodedPicture> pictures = tryPictures(jobs, warnings);
  std::vector<Texture> textures;
  for (size_t i = 0; i < jobs.size(); ++i) {
    if (!pictures[i].failure.empty()) fail(jobs[i].place, pictures[i].failure);
    textures.push_back(std::move(pictures[i].texture));
  }
  return textures;
}

}  // namespace roomlight::importers
