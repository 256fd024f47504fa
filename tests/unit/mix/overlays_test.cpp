#include "mix/overlays.h"

#include <gtest/gtest.h>

#include <bit>

#include "unit/mix/layers.h"

namespace roomlight {
namespace {

using namespace testing;

const Switches kThreeLamps = {{Vec3(1), Vec3(0.8f), Vec3(1), Vec3(0.5f)}, {0, 1, 2}};
const Look kLook = {4, ToneCurve::PbrNeutral, {}};

TEST(Switches, aStateTakesLampsThatAreOffAndKeepsTheRest) {
  const std::vector<Vec3> gains = gainsOfState(kThreeLamps, 0b010);
  EXPECT_EQ(gains, (std::vector<Vec3>{Vec3(0), Vec3(0.8f), Vec3(0), Vec3(0.5f)}));
}

TEST(Switches, everyStateComesOnceAndDiffersFromTheOneBeforeInOneLamp) {
  const std::vector<uint32_t> states = allStates(5);
  ASSERT_EQ(states.size(), 32u);
  EXPECT_EQ(states[0], 0u);
  std::vector<int> seen(32);
  for (size_t i = 0; i < states.size(); ++i) {
    ++seen.at(states[i]);
    EXPECT_EQ(std::popcount(states[i] ^ states[i == 0 ? states.size() - 1 : i - 1]), 1) << "the code is cyclic";
  }
  EXPECT_EQ(seen, std::vector<int>(32, 1));
  EXPECT_EQ(stateName(0b00101, 5), "10100");
}

TEST(Overlays, oneLampOverTheBaseIsExactToRoundingWithEveryBlend) {
  const LayerStack stack = stackOf(somePictures(120, 67));
  const ByteImage base = mixDisplay(stack, gainsOfState(kThreeLamps, 0), kLook);
  for (const BlendMode blend : kBlendModes) {
    for (const uint64_t lamp : {1, 2, 4}) {
      const ByteImage lit = mixDisplay(stack, gainsOfState(kThreeLamps, lamp), kLook);
      const std::vector<float> shown = composite(base, {overlayOf(base, lit, blend)}, std::vector<float>{1}, blend);
      for (size_t i = 0; i < shown.size(); ++i) {
        // The neutral curve's toe darkens a channel by a few steps where another one gets light; that only normal can
        // show.
        const uint8_t expected =
            blend == BlendMode::Normal ? lit.samples[i] : std::max(lit.samples[i], base.samples[i]);
        ASSERT_LE(expected - lit.samples[i], 4);
        ASSERT_NEAR(shown[i], static_cast<float>(expected), 0.75f) << cssName(blend);
      }
    }
  }
}

TEST(Overlays, whereTheLampDoesNotReachTheyAreTransparent) {
  ByteImage base(2, 1, 3), lit(2, 1, 3);
  base.samples = {10, 20, 30, 40, 50, 60};
  lit.samples = {10, 20, 30, 90, 80, 70};
  for (const BlendMode blend : kBlendModes) {
    const ByteImage overlay = overlayOf(base, lit, blend);
    EXPECT_EQ(overlay.samples[3], 0) << cssName(blend);
    EXPECT_GT(overlay.samples[7], 0) << cssName(blend);
  }
}

// The errors that are told are those of states laid together by hand; lighten is too dark, plus-lighter too bright, and
// brighter than screen.
TEST(Overlays, theTrialTellsTheErrorOfStates) {
  const LayerStack stack = stackOf(somePictures(200, 112));
  const OverlayTrial trial = tryOverlays(stack, kThreeLamps, kLook);
  EXPECT_LT(trial.errors[0].rms, trial.errors[2].rms);
  const ByteImage base = mixDisplay(stack, gainsOfState(kThreeLamps, 0), kLook),
                  all = mixDisplay(stack, gainsOfState(kThreeLamps, 7), kLook);
  for (size_t blend = 0; blend < kBlendModes.size(); ++blend) {
    std::vector<ByteImage> overlays;
    for (const uint64_t lamp : {1, 2, 4})
      overlays.push_back(
          overlayOf(base, mixDisplay(stack, gainsOfState(kThreeLamps, lamp), kLook), kBlendModes[blend]));
    const std::vector<float> shown = composite(base, overlays, std::vector<float>{1, 1, 1}, kBlendModes[blend]);
    double squares = 0, signedSum = 0;
    for (size_t i = 0; i < shown.size(); ++i) {
      const double d = static_cast<double>(shown[i]) - all.samples[i];
      squares += d * d, signedSum += d;
    }
    const double rms = std::sqrt(squares / static_cast<double>(shown.size()));
    EXPECT_LT(trial.errors[blend].rms, rms * 1.05)
        << "all lamps at once are the hardest state: " << cssName(kBlendModes[blend]);
    EXPECT_GT(trial.errors[blend].rms, rms * 0.2) << cssName(kBlendModes[blend]);
    EXPECT_TRUE(kBlendModes[blend] != BlendMode::PlusLighter || signedSum > 0);
    EXPECT_TRUE(kBlendModes[blend] != BlendMode::Lighten || signedSum < 0);
  }
}

TEST(Overlays, opacitiesRiseFromNothingToAll) {
  const OverlayTrial trial = tryOverlays(stackOf(somePictures(100, 56)), kThreeLamps, kLook);
  for (const auto& steps : trial.opacities) {
    EXPECT_EQ(steps[0], 0);
    EXPECT_NEAR(steps[10], 1, 1e-6f);
    for (size_t i = 1; i <= 10; ++i) EXPECT_GT(steps[i], steps[i - 1]);
    EXPECT_GT(steps[5], 0.5f) << "half the light is more than half the encoded difference";
  }
}

}  // namespace
}  // namespace roomlight
