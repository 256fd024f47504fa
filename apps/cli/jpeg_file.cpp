#include "jpeg_file.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>

#include "output_files.h"

namespace roomlight::cli {
namespace {

constexpr int kBest = 92, kWorst = 20, kStep = 6;  // of JPEG's quality

std::string compressed(const Image& image, const std::vector<unsigned char>& rgb, int quality) {
  const std::unique_ptr<void, int (*)(tjhandle)> compressor(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int failed = !compressor || tjCompress2(compressor.get(), rgb.data(), image.width, 0, image.height, TJPF_RGB, &bytes, &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT);
  std::string out;
  if (!failed) out.assign(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  return out;
}

}  // namespace

Status writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes) {
  std::vector<unsigned char> rgb;
  rgb.reserve(3 * encoded.pixels.size());
  for (const Vec3& p : encoded.pixels) {
    for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<unsigned char>(std::clamp(p[c], 0.0f, 1.0f) * 255 + 0.5f));
  }
  for (int quality = kBest; quality >= kWorst; quality -= kStep) {
    const std::string bytes = compressed(encoded, rgb, quality);
    if (bytes.empty()) return Error{fmt::format("{}: {} x {} pixels cannot be written as JPEG", file.string(), encoded.width, encoded.height)};
    if (bytes.size() <= mostBytes || quality - kStep < kWorst) return writeTextFile(file, bytes);
  }
  return Ok{};
}

}  // namespace roomlight::cli
