// Pictures that add up: one OpenEXR file with the light of every lamp apart. Channels R, G, B hold the whole picture,
// <channel>.R, .G and .B a layer each; all 32-bit float, linear, in the picture's unit, ZIP compressed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/image_io.h"

namespace roomlight {

// The header's string attribute that tells what the layers are, as JSON (docs/reference/layers.md).
constexpr const char* kLayersKey = "roomlight:layers";

struct PictureLayer {
  std::string channel;  // letters, digits and _ alone
  Image image;
};

struct LayeredImage {
  Image whole;
  std::vector<PictureLayer> layers;  // sorted by channel once read
  Metadata metadata;                 // kLayersKey among them
};

// On all threads allowed. An error names the file, as those of writeExr() and readImage() do.
Status writeLayers(const std::filesystem::path& file, const LayeredImage& image);
// Channels that are neither R, G, B nor complete layers are left out; a file without any layer is an error.
Result<LayeredImage> readLayers(const std::filesystem::path& file);

// Makes the sum of the parts the whole, in each pixel and channel. What is missing or too much goes to parts by the
// squares of what they have, as is best where each is off by like fractions of its own (least squares): the bright ones
// take it, dim ones stay as they are. Where parts have nothing of a channel they get of it what they have of all
// channels, else of all the picture.
void splitLike(const Image& whole, std::vector<Image>& parts);

}  // namespace roomlight
