// Pictures: linear light, and what displays show of it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "roomlight/basics.h"

namespace ROOMLIGHT_NAMESPACE {

// Linear light, row by row from the top: Rec.709 red, green and blue a pixel, whose luminance
// (0.2126 R + 0.7152 G + 0.0722 B) is in cd/m². Never changes.
class ROOMLIGHT_API Image {
 public:
  int width() const;
  int height() const;
  std::span<const float> rgb() const;  // 3 * width * height; lives as long as any copy of the image
  Status write(const std::string& file) const;  // .exr

  struct State;
  explicit Image(std::shared_ptr<const State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<const State> state_;
};

// sRGB as displays and files have it, row by row from the top.
struct DisplayImage {
  int width = 0, height = 0, channels = 3;  // 4: with opacity
  std::vector<uint8_t> samples = {};  // channels * width * height
};

// How light is shown (docs/reference/conventions.md, exposure and display).
struct DisplayOptions {
  std::string look = "natural";  // natural, bright, evening or technical; what is empty below is the look's
  std::string exposure = "auto";  // auto, home, or EV100 as on a light meter
  std::string whiteBalance = {};  // auto, none, a warmth such as "20%", or a temperature such as "3000K"
  std::string tone = {};  // tone curve
  std::optional<float> contrast = {}, saturation = {}, localExposure = {}, glare = {}, vignette = {};
};

class Layers;

// A picture of a home.
class ROOMLIGHT_API Picture {
 public:
  const Image& image() const;
  bool complete() const;  // false: stopped early, the best so far
  const std::string& camera() const;  // its name
  // Time and memory of each stage and what was counted, as JSON: what `render --stats` writes.
  std::string stats() const;
  Result<DisplayImage> display(const DisplayOptions& options = {}) const;
  // .exr (linear, in layers where there are any), .png or .jpg (for displays).
  Status write(const std::string& file, const DisplayOptions& options = {}) const;
  // Of a picture that was rendered with Settings::layers. Errors: of another.
  Result<Layers> layers() const;

  struct State;
  explicit Picture(std::shared_ptr<const State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<const State> state_;
};

// Writes .png, .jpg or .webp.
ROOMLIGHT_API Status write(const DisplayImage& image, const std::string& file);

}  // namespace ROOMLIGHT_NAMESPACE
