// JPEG files, for pictures that shall be small.
#pragma once

#include <filesystem>

#include "base/image.h"
#include "base/result.h"

namespace roomlight::cli {

// Values already display-encoded (0..1, sRGB). As good as fits into so many bytes. Written to a temporary name beside the file and renamed.
Status writeJpeg(const std::filesystem::path& file, const Image& encoded, size_t mostBytes);

}  // namespace roomlight::cli
