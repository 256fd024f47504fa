// Decodes textures: PNG, JPEG, WebP, KTX2, BMP and TGA from memory to 8-bit RGBA, several at a time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Limits of one picture and of all pictures of a file.
constexpr int kMaxPictureSide = 16384;
constexpr size_t kMaxPicturePixels = size_t{1} << 28;
constexpr size_t kMaxAllPixels = size_t{1} << 29;

struct PictureJob {
  std::string place;  // for error messages: "images[3] 'oak'"
  std::span<const uint8_t> bytes;
};

// The kind of a picture file that cannot be decoded here ("DDS", "AVIF", ...); none where it can.
std::optional<std::string> undecodable(std::span<const uint8_t> bytes);

// Pixels that the picture's header claims; 0 where it is no picture, or damaged.
size_t claimedPixels(std::span<const uint8_t> bytes);

struct DecodedPicture {
  Texture texture;      // without name and wrap modes; empty where it failed
  std::string failure;  // what is wrong with it: damaged, or beyond a limit
};

// In the order of the jobs. Sizes are checked against the number of bytes before anything is allocated. What a decoder
// complained about although it could go on is counted in `warnings`.
std::vector<DecodedPicture> tryPictures(const std::vector<PictureJob>& jobs, Warnings& warnings);

// The same; throws Failure that names the place of the first job that fails.
std::vector<Texture> decodePictures(const std::vector<PictureJob>& jobs, Warnings& warnings);

}  // namespace roomlight::importers
