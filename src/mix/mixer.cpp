#include "mix/mixer.h"

#include <cassert>

#include "base/parallel.h"
#include "base/simd.h"
#include "base/tone_curves.h"

namespace roomlight {
namespace {

constexpr size_t kRunsAtOnce = 8;

// Light of a run of pixels, a plane a primary: loops over it are vector code.
struct Planes {
  alignas(64) float rgb[3][kTilePixels];
};

// Left to the compiler this takes three times as long.
void addPlane(float* sum, const PackedTile& tile, int c, float gain) {
  const Float8 g(gain);
  for (size_t i = 0; i < kTilePixels; i += 8) {
    fma(g, fromTopBits(tile.high[c] + i, tile.low[c] + i), Float8::load(sum + i)).store(sum + i);
  }
}

void sumRun(const LayerStack& stack, std::span<const Vec3> gains, size_t run, Planes& sum) {
  sum = {};
  for (size_t layer = 0; layer < stack.layerCount; ++layer) {
    const size_t at = run * stack.layerCount + layer;
    if (stack.black[at] || isBlack(gains[layer])) continue;
    const PackedTile& tile = stack.tiles[at];
    for (int c = 0; c < 3; ++c) addPlane(sum.rgb[c], tile, c, gains[layer][c]);
  }
}

// Of each pixel of a run, to be added before a value is cut to a byte.
void ditherRun(const LayerStack& stack, size_t run, float* __restrict noise) {
  const size_t width = static_cast<size_t>(stack.width), begin = run * kTilePixels;
  for (size_t i = 0; i < kTilePixels;) {
    const size_t x = (begin + i) % width, count = std::min(kTilePixels - i, width - x);
    const int y = static_cast<int>((begin + i) / width);
    for (size_t k = 0; k < count; ++k) noise[i + k] = ditherAt(static_cast<int>(x + k), y);
    i += count;
  }
}

// Exposure is in the matrix.
template <Vec3 (*Curve)(Vec3), bool kGraded>
void showRun(const Planes& light, const Affine& matrix, const Tone& tone, const float* __restrict noise,
             uint8_t* __restrict out) {
  const float contrast = tone.contrast, saturation = tone.saturation;
  const float* __restrict r = light.rgb[0];
  const float* __restrict g = light.rgb[1];
  const float* __restrict b = light.rgb[2];
  for (size_t i = 0; i < kTilePixels; ++i) {
    const Vec3 v = matrix.vector({r[i], g[i], b[i]});
    const Vec3 lit{v.x > 0 ? v.x : 0.0f, v.y > 0 ? v.y : 0.0f, v.z > 0 ? v.z : 0.0f};
    const Vec3 shown = Curve(kGraded ? curves::graded(lit, contrast, saturation) : lit);
    out[3 * i] = static_cast<uint8_t>(static_cast<int>(srgbEncode(shown.x) * 255 + noise[i]));
    out[3 * i + 1] = static_cast<uint8_t>(static_cast<int>(srgbEncode(shown.y) * 255 + noise[i]));
    out[3 * i + 2] = static_cast<uint8_t>(static_cast<int>(srgbEncode(shown.z) * 255 + noise[i]));
  }
}

using ShowRun = void (*)(const Planes&, const Affine&, const Tone&, const float* __restrict, uint8_t* __restrict);
template <bool kGraded>
ShowRun showRunOf(ToneCurve curve) {
  switch (curve) {
    case ToneCurve::PbrNeutral: return showRun<curves::neutral, kGraded>;
    case ToneCurve::AgX: return showRun<curves::agx, kGraded>;
    case ToneCurve::Filmic: return showRun<curves::filmic, kGraded>;
    case ToneCurve::Clip: break;
  }
  return showRun<curves::clip, kGraded>;
}

size_t pixelsOfRun(const LayerStack& stack, size_t run) {
  return std::min(kTilePixels, stack.pixelCount() - run * kTilePixels);
}

}  // namespace

Image mixLinear(const LayerStack& stack, std::span<const Vec3> gains) {
  assert(gains.size() == stack.layerCount);
  Image out(stack.width, stack.height);
  parallelFor(stack.runCount(), kRunsAtOnce, [&](size_t run) {
    Planes sum;
    sumRun(stack, gains, run, sum);
    Vec3* pixels = out.pixels.data() + run * kTilePixels;
    for (size_t i = 0; i < pixelsOfRun(stack, run); ++i) pixels[i] = {sum.rgb[0][i], sum.rgb[1][i], sum.rgb[2][i]};
  });
  return out;
}

ByteImage mixDisplay(const LayerStack& stack, std::span<const Vec3> gains, const Look& look) {
  assert(gains.size() == stack.layerCount);
  ByteImage out(stack.width, stack.height, 3);
  const ShowRun show = look.tone.plain() ? showRunOf<false>(look.tone.curve) : showRunOf<true>(look.tone.curve);
  const float exposure = exposureFromEv100(look.ev100);
  const Affine matrix{
      look.whiteBalance.x * exposure, look.whiteBalance.y * exposure, look.whiteBalance.z * exposure, {}};
  parallelFor(stack.runCount(), kRunsAtOnce, [&](size_t run) {
    Planes sum;
    uint8_t bytes[3 * kTilePixels];
    float noise[kTilePixels];
    sumRun(stack, gains, run, sum);
    ditherRun(stack, run, noise);
    show(sum, matrix, look.tone, noise, bytes);
    std::copy_n(bytes, 3 * pixelsOfRun(stack, run), out.samples.data() + 3 * run * kTilePixels);
  });
  return out;
}

std::vector<Vec3> gainsOfState(const Switches& switches, uint64_t mask) {
  std::vector<Vec3> gains = switches.gains;
  for (size_t i = 0; i < switches.lamps.size(); ++i) {
    if (!((mask >> i) & 1)) gains[switches.lamps[i]] = Vec3(0);
  }
  return gains;
}

std::vector<uint32_t> allStates(size_t lampCount) {
  std::vector<uint32_t> states(size_t{1} << lampCount);
  for (uint32_t i = 0; i < states.size(); ++i) states[i] = i ^ (i >> 1);  // Gray 1953
  return states;
}

std::string stateName(uint32_t mask, size_t lampCount) {
  std::string name;
  for (size_t i = 0; i < lampCount; ++i) name += (mask >> i) & 1 ? '1' : '0';
  return name;
}

}  // namespace roomlight
