// Pictures of small rooms against golden ones: `path` by a z-test of every block, `cone` within stated tolerances. A
// picture that fails is written as golden_<scene>_<what>.exr beside the test, with the difference of the blocks as
// .png.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/image_io.h"
#include "compare/compare.h"
#include "engine/render.h"
#include "golden/blocks.h"
#include "golden/scenes.h"

namespace roomlight::test {
namespace {

constexpr int kSamples = 288;
constexpr double kFalseAlarm = 1e-6;  // over all scenes, blocks and channels

double limit() {
  return threshold(kFalseAlarm, goldenScenes().size() * 3 * (kGoldenWidth / kBlock * kGoldenHeight / kBlock + 1));
}

void keepPicture(const std::string& name, const Image& image, const std::vector<Block>& golden) {
  EXPECT_TRUE(writeExr(name + ".exr", image, {}).ok());
  EXPECT_TRUE(writePng(name + ".png", differencePicture(pictureOf(golden), pictureOf(blocksOf(image))), {}).ok());
}

class Golden : public testing::TestWithParam<int> {
 protected:
  const GoldenScene g_ = goldenScenes()[static_cast<size_t>(GetParam())];
  std::vector<Block> golden_;
  void SetUp() override {
    const Result<std::vector<Block>> read = readGolden(g_.name);
    ASSERT_TRUE(read.ok()) << read.error();
    golden_ = read.value();
  }
  Deviation deviation(const Scene& scene, Image& image) const {
    PathResult r = pathOf(scene, g_.camera, kSamples, 2);
    image = std::move(r.image);
    return largestDeviation(golden_, blocksOf(image, &r.variance));
  }
};

TEST_P(Golden, pathAgreesInEveryBlock) {
  Image image;
  const Deviation d = deviation(g_.scene, image);
  EXPECT_LT(d.z, limit()) << d.where;
  if (HasFailure()) keepPicture(fmt::format("golden_{}_path", g_.name), image, golden_);
}

// The test above is worth something only if it sees little.
TEST_P(Golden, threePercentMoreOfOneLightIsSeen) {
  for (const auto& [light, scene] : withOneLightBrighter(g_.scene, 1.03f)) {
    Image image;
    EXPECT_GT(deviation(scene, image).z, limit()) << light;
  }
}

// Of blocks that hold light enough to judge: a tenth of the picture's mean.
struct Errors {
  double meanPercent = 0, rmsPercent = 0, worstPercent = 0;
};

Errors errorsOf(const std::vector<Block>& golden, const Image& image) {
  const std::vector<Block> fresh = blocksOf(image);
  Errors e;
  e.meanPercent = 100 * (luminanceOf(fresh.back()) / luminanceOf(golden.back()) - 1);
  double squares = 0, count = 0;
  for (size_t i = 0; i + 1 < golden.size(); ++i) {
    if (luminanceOf(golden[i]) < 0.1 * luminanceOf(golden.back())) continue;
    const double percent = 100 * (luminanceOf(fresh[i]) / luminanceOf(golden[i]) - 1);
    squares += percent * percent, count += 1;
    e.worstPercent = std::max(e.worstPercent, std::abs(percent));
  }
  e.rmsPercent = std::sqrt(squares / count);
  return e;
}

// The mean of four pictures: one alone is off by 3 to 5 % in blocks by chance.
TEST_P(Golden, hybridAgreesWithinTolerance) {
  constexpr int kPictures = 4;
  RenderSettings settings;
  settings.width = kGoldenWidth, settings.height = kGoldenHeight;
  Image mean(kGoldenWidth, kGoldenHeight);
  for (; settings.seed < kPictures; ++settings.seed) {
    const Result<Rendered> r = render(g_.scene, g_.camera, settings);
    ASSERT_TRUE(r.ok()) << r.error();
    for (size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] += r.value().image.pixels[i] / kPictures;
  }
  const Errors e = errorsOf(golden_, mean);
  const std::string figures =
      fmt::format("mean {:.2f} rms {:.2f} worst {:.2f} %", e.meanPercent, e.rmsPercent, e.worstPercent);
  EXPECT_LT(std::abs(e.meanPercent), 1.5) << figures;
  EXPECT_LT(e.rmsPercent, 4) << figures;
  EXPECT_LT(e.worstPercent, 15) << figures;
  if (HasFailure()) keepPicture(fmt::format("golden_{}_hybrid", g_.name), mean, golden_);
}

INSTANTIATE_TEST_SUITE_P(Rooms, Golden, testing::Values(0, 1, 2),
                         [](const auto& room) { return goldenScenes()[static_cast<size_t>(room.param)].name; });

TEST(GoldenThreshold, isThatOfTheNormalDistribution) {
  EXPECT_NEAR(threshold(0.05, 1), 1.95996, 1e-4);
  EXPECT_NEAR(threshold(2 * 9.865876e-10, 1), 6, 1e-4);
  EXPECT_NEAR(threshold(0.05, 50), threshold(0.001, 1), 1e-9);
}

}  // namespace
}  // namespace roomlight::test
