#include "view/shown.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "look/display.h"

namespace roomlight::view {
namespace {

constexpr double kAdaptsInS = 0.2;
constexpr int kColours = 1024;
constexpr double kExposurePixels = 16384;

ByteImage bytesOf(const Image& encoded) {
  ByteImage out(encoded.width, encoded.height, 3);
  parallelFor(encoded.pixels.size(), 16384, [&](size_t i) {
    for (int c = 0; c < 3; ++c)
      out.samples[3 * i + static_cast<size_t>(c)] =
          static_cast<uint8_t>(std::clamp(encoded.pixels[i][c], 0.0f, 1.0f) * 255 + 0.5f);
  });
  return out;
}

// Enough pixels to tell the exposure by.
Image sparse(const Image& image) {
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(image.pixels.size()) / kExposurePixels)));
  Image out((image.width + step - 1) / step, (image.height + step - 1) / step);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) out.at(x, y) = image.at(x * step, y * step);
  }
  return out;
}

using Colour = std::array<uint8_t, 3>;
const std::array<Colour, kColours>& colours() {
  static const std::array<Colour, kColours> table = [] {
    std::array<Colour, kColours> t;
    for (int i = 0; i < kColours; ++i) {
      const Vec3 c = falseColour(static_cast<double>(i) / (kColours - 1));
      for (int k = 0; k < 3; ++k)
        t[static_cast<size_t>(i)][static_cast<size_t>(k)] =
            static_cast<uint8_t>(std::clamp(c[k], 0.0f, 1.0f) * 255 + 0.5f);
    }
    return t;
  }();
  return table;
}

}  // namespace

Display displayOfFrames() {
  Display display = usualDisplay();
  display.quickLocalExposure = true;
  return display;
}

void apply(const DisplayChange& change, ViewDisplay& d) {
  if (change.ev100) d.display.ev100 = *change.ev100;
  if (change.compensationEv) d.compensationEv = *change.compensationEv;
  if (change.curve) d.display.tone.curve = *change.curve;
  if (change.automaticWhite) d.display.automaticWhite = *change.automaticWhite;
  if (change.whiteK) d.display.whiteK = *change.whiteK;
  if (change.falseColour) d.falseColour = *change.falseColour;
  if (change.low) d.low = *change.low;
  if (change.high) d.high = *change.high;
}

void Adaptation::follow(float wantedEv100, const White& wanted, double seconds) {
  const auto share = static_cast<float>(1 - std::exp(-seconds / kAdaptsInS));
  ev100 = ev100 ? *ev100 + share * (wantedEv100 - *ev100) : wantedEv100;
  if (wanted.kelvin <= 0 || white.kelvin <= 0) {
    white = wanted;
  } else {
    white.gains = lerp(white.gains, wanted.gains, share);
    // Even steps of 1/K are even steps of colour.
    white.kelvin = 1 / (1 / white.kelvin + static_cast<double>(share) * (1 / wanted.kelvin - 1 / white.kelvin));
  }
}

ByteImage showPicture(const Image& light, Vec3 lightColour, const ViewDisplay& d, double seconds, Adaptation& eye,
                      FrameInfo& info) {
  // What is set by hand holds at once.
  eye.follow(ev100Of(d.display, sparse(light)), whiteOf(d.display, lightColour), d.display.ev100 ? kInfinity : seconds);
  if (d.display.whiteK) eye.white = whiteOf(d.display, lightColour);
  const float ev100 = *eye.ev100 - d.compensationEv;
  info.ev100 = ev100;
  info.whiteK = eye.white.kelvin > 0 ? static_cast<float>(eye.white.kelvin) : FrameInfo::kNone;
  return bytesOf(displayed(light, d.display, eye.white, ev100));
}

ByteImage showAmounts(const Image& amounts, const ViewDisplay& d, FrameInfo& info) {
  std::vector<float> values;
  for (const Vec3& p : amounts.pixels) {
    if (p.x > 0) values.push_back(p.x);
  }
  LightScale scale = values.empty() ? LightScale() : scaleOf(values);
  if (d.low) scale.low = *d.low;
  if (d.high) scale.high = *d.high;
  if (!(scale.high > scale.low * 1.01)) {  // what was set by hand stays
    if (d.high && !d.low) {
      scale.low = scale.high / 10;
    } else {
      scale.high = scale.low * 10;
    }
  }
  info.scaleLow = static_cast<float>(scale.low), info.scaleHigh = static_cast<float>(scale.high);
  ByteImage out(amounts.width, amounts.height, 3);
  parallelFor(amounts.pixels.size(), 4096, [&](size_t i) {
    if (amounts.pixels[i].x < 0) return;  // black
    const auto place =
        static_cast<size_t>(std::lround(scale.position(static_cast<double>(amounts.pixels[i].x)) * (kColours - 1)));
    std::copy(colours()[place].begin(), colours()[place].end(),
              out.samples.begin() + static_cast<std::ptrdiff_t>(3 * i));
  });
  return out;
}

}  // namespace roomlight::view
