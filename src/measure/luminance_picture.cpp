#include "measure/false_colour.h"

#include <fmt/format.h>

#include <cmath>

#include "base/parallel.h"
#include "base/tone.h"

namespace roomlight {
namespace {

constexpr int kGlyphWidth = 5, kGlyphHeight = 7;
constexpr int kBarWidth = 16, kLegendWidth = 68, kUnitHeight = 18;  // before enlarging

// Five by seven dots, a row each, the left one the highest bit.
struct Glyph {
  char letter;
  uint8_t rows[kGlyphHeight];
};
constexpr Glyph kGlyphs[] = {
    {'0', {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e}}, {'1', {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e}},
    {'2', {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f}}, {'3', {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e}},
    {'4', {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02}}, {'5', {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e}},
    {'6', {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e}}, {'7', {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08}},
    {'8', {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e}}, {'9', {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c}},
    {'.', {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c}}, {'/', {0x00, 0x01, 0x02, 0x04, 0x08, 0x10, 0x00}},
    {'c', {0x00, 0x00, 0x0e, 0x10, 0x10, 0x11, 0x0e}}, {'d', {0x01, 0x01, 0x0d, 0x13, 0x11, 0x11, 0x0f}},
    {'m', {0x00, 0x00, 0x1a, 0x15, 0x15, 0x11, 0x11}},
};

void fill(Image& image, int x0, int y0, int width, int height, Vec3 colour) {
  for (int y = std::max(0, y0); y < std::min(image.height, y0 + height); ++y) {
    for (int x = std::max(0, x0); x < std::min(image.width, x0 + width); ++x) image.at(x, y) = colour;
  }
}

void write(Image& image, int x, int y, int enlarged, const std::string& text) {
  for (const char letter : text) {
    for (const Glyph& g : kGlyphs) {
      if (g.letter != letter) continue;
      for (int row = 0; row < kGlyphHeight; ++row) {
        for (int column = 0; column < kGlyphWidth; ++column) {
          if (g.rows[row] >> (kGlyphWidth - 1 - column) & 1)
            fill(image, x + column * enlarged, y + row * enlarged, enlarged, enlarged, Vec3(0.1f));
        }
      }
    }
    x += (kGlyphWidth + 1) * enlarged;
  }
}

}  // namespace

Image luminanceOnly(const Image& image) {
  Image out(image.width, image.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) out.pixels[i] = Vec3(luminance(image.pixels[i]));
  return out;
}

LightScale luminanceScale(const Image& image) {
  std::vector<float> values;
  for (const Vec3& p : image.pixels) values.push_back(luminance(p));
  return scaleOf(values);
}

Image greyPicture(const Image& image, double whiteCdM2) {
  Image out(image.width, image.height);
  parallelFor(image.pixels.size(), 16384, [&](size_t i) {
    out.pixels[i] = Vec3(srgbEncode(luminance(image.pixels[i]) / static_cast<float>(whiteCdM2)));
  });
  return out;
}

Image falseColourPicture(const Image& image, const LightScale& scale) {
  const int enlarged = std::max(1, image.height / 400), left = image.width + 4 * enlarged;
  Image out(image.width + kLegendWidth * enlarged, image.height);
  std::fill(out.pixels.begin(), out.pixels.end(), Vec3(1));
  parallelFor(static_cast<size_t>(image.height), 16, [&](size_t y) {
    for (int x = 0; x < image.width; ++x)
      out.at(x, static_cast<int>(y)) =
          falseColour(scale.position(static_cast<double>(luminance(image.at(x, static_cast<int>(y))))));
  });
  const int top = kUnitHeight * enlarged, height = image.height - top - 6 * enlarged;
  if (height <= 0) return out;
  write(out, left, 5 * enlarged, enlarged, "cd/m2");
  for (int y = 0; y < height; ++y)
    fill(out, left, top + y, kBarWidth * enlarged, 1, falseColour(1 - (y + 0.5) / height));
  int below = image.height + kGlyphHeight * enlarged;
  for (const double step : roundSteps(scale.low, scale.high)) {
    const int y = top + static_cast<int>(std::lround((1 - scale.position(step)) * height));
    if (below - y < (kGlyphHeight + 2) * enlarged) continue;
    below = y;
    fill(out, left + kBarWidth * enlarged, y, 3 * enlarged, enlarged, Vec3(0.1f));
    write(out, left + (kBarWidth + 5) * enlarged, y - kGlyphHeight * enlarged / 2, enlarged, fmt::format("{:g}", step));
  }
  return out;
}

}  // namespace roomlight
