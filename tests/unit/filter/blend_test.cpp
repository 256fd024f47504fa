#include "filter/blend.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "noisy_wall.h"

namespace roomlight {
namespace {

constexpr int kWidth = 160, kHeight = 120;

// A wall lit by `true` light; a picture of it with this relative error, in patches of some pixels, and samples with
// noise.
struct Case {
  Image truth{kWidth, kHeight}, first{kWidth, kHeight}, mean{kWidth, kHeight}, variance{kWidth, kHeight};
  FilterInput guide = test::noisyWall(kWidth, kHeight, 1, 0);

  Case(float error, int patch, float deviation, int samples) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const Vec3 t(2 + std::sin(0.05f * static_cast<float>(x)));
        Rng rng(static_cast<uint64_t>(x), static_cast<uint64_t>(y), 5);
        Vec3 sum, squares;
        for (int i = 0; i < samples; ++i) {
          const Vec3 sample = t + Vec3(deviation * test::gaussian(rng));
          sum += sample, squares += sample * sample;
        }
        const float n = static_cast<float>(samples);
        truth.at(x, y) = t;
        first.at(x, y) = t * (1 + ((x / patch + y / patch) % 2 ? error : -error));
        mean.at(x, y) = sum / n;
        variance.at(x, y) = max(squares / n - mean.at(x, y) * mean.at(x, y), Vec3(0)) / (n - 1);
      }
    }
  }
  double error(const Image& image) const {
    double sum = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) sum += lengthSquared(image.pixels[i] - truth.pixels[i]) / 3;
    return sum / static_cast<double>(image.pixels.size());
  }
  Blend blended() const { return blend(first, mean, variance, guide); }
};

class Blending : public testing::TestWithParam<std::tuple<float, int, float>> {};

// Of the samples' noise a hundredth may get into a picture that was perfect.
TEST_P(Blending, IsNoWorseThanEitherPicture) {
  const auto [error, patch, deviation] = GetParam();
  for (const int samples : {2, 4, 16, 64}) {
    const Case c(error, patch, deviation, samples);
    EXPECT_LT(c.error(c.blended().image), 1.05 * std::min(c.error(c.first), c.error(c.mean)) + 0.01 * c.error(c.mean))
        << samples;
  }
}
INSTANTIATE_TEST_SUITE_P(Errors, Blending,
                         testing::Combine(testing::Values(0.0f, 0.02f, 0.2f), testing::Values(1, 4, 40),
                                          testing::Values(0.3f, 3.0f)));

TEST(Blend, ConvergesToTheSamples) {
  const Case few(0.2f, 8, 0.5f, 4), many(0.2f, 8, 0.5f, 1024);
  EXPECT_LT(many.error(many.blended().image), 0.02 * few.error(few.blended().image));
  EXPECT_LT(many.error(many.blended().image), 1.2 * many.error(many.mean));
}

TEST(Blend, CorrectsErrorsAtLargeFromFewSamples) {
  const Case c(0.2f, 40, 1, 4);
  EXPECT_LT(c.error(c.blended().image), 0.3 * c.error(c.first));
}

TEST(Blend, EstimatesWhatIsLeft) {
  for (const int samples : {4, 16, 64}) {
    const Case c(0.1f, 8, 0.5f, samples);
    const Blend b = c.blended();
    double truth = 0;
    for (size_t i = 0; i < b.image.pixels.size(); ++i)
      truth += lengthSquared((b.image.pixels[i] - c.truth.pixels[i]) / c.truth.pixels[i]) / 3;
    truth = std::sqrt(truth / static_cast<double>(b.image.pixels.size()));
    EXPECT_LT(b.relativeError, 1.5 * truth) << samples;
    EXPECT_GT(b.relativeError, truth / 1.5) << samples;
  }
}

TEST(Blend, DoesNotDependOnThreads) {
  const Case c(0.2f, 8, 1, 4);
  Image one;
  withThreads(1, [&] { one = c.blended().image; });
  EXPECT_EQ(one.pixels, c.blended().image.pixels);
}

}  // namespace
}  // namespace roomlight
