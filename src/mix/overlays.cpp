#include "mix/overlays.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace roomlight {
namespace {

constexpr size_t kTrialPixels = 1 << 16;
constexpr int kTrialStates = 64;

// The share by which b has to move towards 255, or towards 0, to become d.
float leastAlpha(float b, float d) {
  if (d > b) return (d - b) / (255 - b);
  return d < b ? (b - d) / b : 0.0f;
}

uint8_t rounded(float v) { return static_cast<uint8_t>(std::clamp(v + 0.5f, 0.0f, 255.0f)); }

// Colour and alpha of one pixel. Alpha is as small as it can be, rounded up, and the colour made for the rounded one.
void overlayPixel(const uint8_t* base, const uint8_t* lit, BlendMode blend, uint8_t* out) {
  float alpha = 0, wanted[3] = {};
  for (int c = 0; c < 3; ++c) {
    const auto b = static_cast<float>(base[c]), d = static_cast<float>(lit[c]);
    switch (blend) {
      case BlendMode::Screen: wanted[c] = d > b ? (d - b) / (255 - b) : 0.0f; break;  // 1 - (1 - b)(1 - s)
      case BlendMode::PlusLighter: wanted[c] = d > b ? (d - b) / 255 : 0.0f; break;
      case BlendMode::Normal: wanted[c] = leastAlpha(b, d); break;
      case BlendMode::Lighten: wanted[c] = d > b ? 1.0f : 0.0f; break;
    }
    alpha = std::max(alpha, wanted[c]);
  }
  const auto byte = static_cast<uint8_t>(std::min(255.0f, std::ceil(alpha * 255)));
  const float a = static_cast<float>(byte) / 255;
  out[3] = byte;
  for (int c = 0; c < 3; ++c) {
    const auto b = static_cast<float>(base[c]), d = static_cast<float>(lit[c]);
    if (byte == 0) {
      out[c] = 0;
    } else if (blend == BlendMode::Lighten) {
      out[c] = lit[c];
    } else {
      out[c] = rounded(blend == BlendMode::Normal ? b + (d - b) / a : 255 * wanted[c] / a);
    }
  }
}

float blended(float b, float s, float a, BlendMode blend) {
  switch (blend) {
    case BlendMode::Screen: return b + a * s * (1 - b / 255);
    case BlendMode::PlusLighter: return std::min(255.0f, b + a * s);
    case BlendMode::Normal: return b + a * (s - b);
    case BlendMode::Lighten: break;
  }
  return b + a * (std::max(b, s) - b);
}

LayerStack spreadPixels(const LayerStack& stack) {
  const size_t count = std::min(stack.pixelCount(), kTrialPixels);
  LayerStack few = makeLayerStack(static_cast<int>(count), 1, stack.layerCount);
  std::fill(few.black.begin(), few.black.end(), uint8_t{0});
  few.meanRgb = stack.meanRgb;
  for (size_t i = 0; i < count; ++i) {
    const size_t from = i * stack.pixelCount() / count;
    for (size_t layer = 0; layer < stack.layerCount; ++layer) {
      const PackedTile& source = stack.tiles[from / kTilePixels * stack.layerCount + layer];
      PackedTile& target = few.tiles[i / kTilePixels * stack.layerCount + layer];
      for (int c = 0; c < 3; ++c) {
        target.high[c][i % kTilePixels] = source.high[c][from % kTilePixels];
        target.low[c][i % kTilePixels] = source.low[c][from % kTilePixels];
      }
    }
  }
  return few;
}

BlendError errorOf(std::vector<float>& steps) {
  BlendError error;
  for (const float s : steps) {
    error.mean += static_cast<double>(s);
    error.rms += static_cast<double>(s * s);
  }
  const auto count = static_cast<double>(steps.size());
  const auto most = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 99 / 100);
  std::nth_element(steps.begin(), most, steps.end());
  return {error.mean / count, std::sqrt(error.rms / count), static_cast<double>(*most)};
}

// Which lamps are on in the states of a trial: half of them, at random, the same ones in every run.
std::vector<uint64_t> trialStates(size_t lampCount) {
  std::vector<uint64_t> masks;
  for (int i = 0; i < kTrialStates; ++i) {
    Rng random(static_cast<uint64_t>(i), 0, 1);
    uint64_t mask = 0;
    for (size_t lamp = 0; lamp < lampCount; ++lamp) mask |= static_cast<uint64_t>(random.uniform() < 0.5f) << lamp;
    masks.push_back(mask);
  }
  return masks;
}

std::array<float, 11> opacitiesOf(const LayerStack& stack, const Switches& switches, const Look& look, size_t lamp,
                                  const ByteImage& base, const ByteImage& lit) {
  std::array<float, 11> opacities{};
  std::vector<Vec3> gains = gainsOfState(switches, uint64_t{1} << lamp);
  const Vec3 full = gains[switches.lamps[lamp]];
  for (size_t step = 1; step <= 10; ++step) {
    gains[switches.lamps[lamp]] = full * (0.1f * static_cast<float>(step));
    const ByteImage dimmed = mixDisplay(stack, gains, look);
    double products = 0, squares = 0;
    for (size_t i = 0; i < base.samples.size(); ++i) {
      const int whole = lit.samples[i] - base.samples[i], part = dimmed.samples[i] - base.samples[i];
      products += whole * part;
      squares += whole * whole;
    }
    opacities[step] =
        squares > 0 ? std::clamp(static_cast<float>(products / squares), 0.0f, 1.0f) : 0.1f * static_cast<float>(step);
  }
  return opacities;
}

}  // namespace

std::string_view cssName(BlendMode blend) {
  switch (blend) {
    case BlendMode::Screen: return "screen";
    case BlendMode::Normal: return "normal";
    case BlendMode::PlusLighter: return "plus-lighter";
    case BlendMode::Lighten: break;
  }
  return "lighten";
}

ByteImage overlayOf(const ByteImage& base, const ByteImage& lit, BlendMode blend) {
  ByteImage overlay(base.width, base.height, 4);
  parallelFor(base.pixelCount(), 4096, [&](size_t i) {
    overlayPixel(&base.samples[3 * i], &lit.samples[3 * i], blend, &overlay.samples[4 * i]);
  });
  return overlay;
}

std::vector<float> composite(const ByteImage& base, const std::vector<ByteImage>& overlays,
                             std::span<const float> opacities, BlendMode blend) {
  std::vector<float> canvas(base.samples.begin(), base.samples.end());
  for (size_t k = 0; k < overlays.size(); ++k) {
    if (opacities[k] == 0) continue;
    for (size_t i = 0; i < base.pixelCount(); ++i) {
      const uint8_t* over = &overlays[k].samples[4 * i];
      const float alpha = opacities[k] * static_cast<float>(over[3]) / 255;
      for (size_t c = 0; c < 3; ++c)
        canvas[3 * i + c] = blended(canvas[3 * i + c], static_cast<float>(over[c]), alpha, blend);
    }
  }
  return canvas;
}

OverlayTrial tryOverlays(const LayerStack& stack, const Switches& switches, const Look& look) {
  const LayerStack few = spreadPixels(stack);
  const ByteImage base = mixDisplay(few, gainsOfState(switches, 0), look);
  OverlayTrial trial;
  std::vector<ByteImage> lit;
  for (size_t lamp = 0; lamp < switches.lamps.size(); ++lamp) {
    lit.push_back(mixDisplay(few, gainsOfState(switches, uint64_t{1} << lamp), look));
    trial.opacities.push_back(opacitiesOf(few, switches, look, lamp, base, lit.back()));
  }
  const std::vector<uint64_t> masks = trialStates(switches.lamps.size());
  for (size_t blend = 0; blend < kBlendModes.size(); ++blend) {
    std::vector<ByteImage> overlays;
    for (const ByteImage& picture : lit) overlays.push_back(overlayOf(base, picture, kBlendModes[blend]));
    std::vector<std::vector<float>> steps(masks.size());
    parallelFor(masks.size(), 1, [&](size_t m) {
      std::vector<float> on;
      for (size_t lamp = 0; lamp < switches.lamps.size(); ++lamp)
        on.push_back(static_cast<float>((masks[m] >> lamp) & 1));
      steps[m] = composite(base, overlays, on, kBlendModes[blend]);
      const ByteImage truth = mixDisplay(few, gainsOfState(switches, masks[m]), look);
      for (size_t i = 0; i < truth.samples.size(); ++i)
        steps[m][i] = std::abs(steps[m][i] - static_cast<float>(truth.samples[i]));
    });
    std::vector<float> all;
    for (const std::vector<float>& s : steps) all.insert(all.end(), s.begin(), s.end());
    trial.errors[blend] = errorOf(all);
  }
  return trial;
}

}  // namespace roomlight
