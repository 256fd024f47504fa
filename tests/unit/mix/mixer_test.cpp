#include "mix/mixer.h"

#include <gtest/gtest.h>

#include "base/tone_curves.h"
#include "unit/mix/layers.h"

namespace roomlight {
namespace {

using namespace testing;
constexpr int kWidth = 161, kHeight = 90;  // several runs and a part of one

Image exactSum(const std::vector<Image>& pictures, const std::vector<Vec3>& gains) {
  Image sum(pictures[0].width, pictures[0].height);
  for (size_t i = 0; i < pictures.size(); ++i) {
    for (size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += pictures[i].pixels[p] * gains[i];
  }
  return sum;
}

TEST(Mixer, isTheLinearSumToOnePartInTwoToTheSeventeen) {
  const std::vector<Image> pictures = somePictures(kWidth, kHeight);
  const std::vector<Vec3> gains = {Vec3(1), Vec3(0), Vec3(0.3f), {2, 1, 0.1f}};
  const Image expected = exactSum(pictures, gains), mixed = mixLinear(stackOf(pictures), gains);
  ASSERT_EQ(mixed.pixels.size(), expected.pixels.size());
  for (size_t p = 0; p < mixed.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(mixed.pixels[p][c] / expected.pixels[p][c], 1, 1.0 / 131072 + 1e-6) << p;
  }
}

TEST(Mixer, lightsOffAreBlackAndNothingIsLeftOfThem) {
  const LayerStack stack = stackOf(somePictures(kWidth, kHeight));
  for (const Vec3 p : mixLinear(stack, std::vector<Vec3>(4)).pixels) ASSERT_TRUE(isBlack(p));
}

// What the picture shows differs from that of unpacked floats by less than 1/512 of a display step, before it is
// rounded to bytes.
TEST(Mixer, packingIsBelowOneFiveHundredTwelfthOfADisplayStep) {
  const std::vector<Image> pictures = somePictures(kWidth, kHeight);
  const std::vector<Vec3> gains = {{0.7f, 0.9f, 1.5f}, Vec3(1), Vec3(0.05f), Vec3(1)};
  const Image exact = exactSum(pictures, gains), mixed = mixLinear(stackOf(pictures), gains);
  for (const std::string& name : toneCurveNames()) {
    const ToneCurve tone = toneCurveFromName(name).value();
    for (const float ev100 : {1.0f, 4.0f, 8.0f}) {
      const Image a = toneMap(exact, ev100, tone), b = toneMap(mixed, ev100, tone);
      float worst = 0;
      for (size_t p = 0; p < a.pixels.size(); ++p)
        worst = std::max(worst, maxComponent(abs(a.pixels[p] - b.pixels[p])) * 255);
      EXPECT_LT(worst, 1.0f / 512) << name << " at EV " << ev100;
    }
  }
}

TEST(Mixer, bytesAreThoseOfTheToneMappedMixDithered) {
  const std::vector<Image> pictures = somePictures(kWidth, kHeight);
  const LayerStack stack = stackOf(pictures);
  const std::vector<Vec3> gains(4, Vec3(1));
  const Affine balance{{0.6f, 0, 0}, {0, 1.1f, 0}, {0, 0, 2.5f}, {}};
  std::vector<Tone> tones = {Tone(ToneCurve::PbrNeutral, 1.2f, 0.9f)};
  for (const std::string& name : toneCurveNames()) tones.emplace_back(toneCurveFromName(name).value());
  for (const Tone& tone : tones) {
    Image light = mixLinear(stack, gains);
    for (Vec3& p : light.pixels) p = balance.vector(p);
    const Image expected = toneMap(light, 4, tone);
    const ByteImage bytes = mixDisplay(stack, gains, {4, tone, balance});
    ASSERT_EQ(bytes.samples.size(), 3 * expected.pixels.size());
    for (size_t i = 0; i < bytes.samples.size(); ++i) {
      ASSERT_NEAR(static_cast<float>(bytes.samples[i]),
                  expected.pixels[i / 3][static_cast<int>(i % 3)] * 255 - 0.5f +
                      ditherAt(static_cast<int>(i / 3) % kWidth, static_cast<int>(i / 3) / kWidth),
                  0.501f)
          << toneCurveName(tone.curve);
    }
  }
}

TEST(Mixer, doesNotDependOnTheMeanOfAVisibleBulb) {
  Image plain(64, 64), bulb(64, 64);
  for (size_t i = 0; i < plain.pixels.size(); ++i) plain.pixels[i] = bulb.pixels[i] = Vec3(10);
  bulb.pixels[100] = Vec3(1e6f);
  LayerStack stack = makeLayerStack(64, 64, 2);
  setLayer(stack, 0, plain);
  setLayer(stack, 1, bulb);
  EXPECT_NEAR(stack.meanRgb[0].x, 10, 1e-4f);
  EXPECT_LT(stack.meanRgb[1].x, 11);
}

}  // namespace
}  // namespace roomlight
