#include "photometry/photometric_web.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "photometry/web_files.h"
#include "unit/base/chi_square.h"
#include "unit/photometry/web_files.h"

namespace roomlight {
namespace {

using testing::IesText;
using testing::radians;
using testing::steps;

PhotometricWeb lopsided() {
  IesText file;
  file.vertical = {0, 2.5, 10, 30, 45, 47, 90, 110, 180}, file.horizontal = {0, 10, 45, 90, 200, 300, 360};
  file.candela = [](double c, double g) {
    return c == 90 || g == 110 || g == 180 ? 0 : 100 + 3 * g + 80 * std::cos(radians(c));
  };
  return parseIes(file.text()).value().web;
}

TEST(WebSampler, directionsFollowTheLight) {
  const PhotometricWeb web = lopsided();
  const WebSampler sampler(web);
  constexpr int kPolar = 24, kAzimuth = 48, kSamples = 2'000'000, kFine = 40;
  std::vector<double> counts(kPolar * kAzimuth), expected(kPolar * kAzimuth);
  // The density's own integral over each bin.
  double total = 0;
  for (int p = 0; p < kPolar * kFine; ++p) {
    for (int a = 0; a < kAzimuth * kFine; ++a) {
      const double z = -1 + 2 * (p + 0.5) / (kPolar * kFine),
                   phi = 2 * std::numbers::pi * (a + 0.5) / (kAzimuth * kFine), r = std::sqrt(1 - z * z);
      const double steradians = 4 * std::numbers::pi / (kPolar * kAzimuth * kFine * kFine);
      const double share =
          static_cast<double>(sampler.pdf(
              {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)})) *
          steradians;
      expected[static_cast<size_t>(p / kFine * kAzimuth + a / kFine)] += share * kSamples;
      total += share;
    }
  }
  EXPECT_NEAR(total, 1, 1e-3);
  Rng rng(1, 2, 3);
  double flux = 0;
  for (int i = 0; i < kSamples; ++i) {
    float pdf = 0;
    const Vec3 d = sampler.sample(rng.uniform2(), pdf);
    ASSERT_NEAR(length(d), 1, 1e-5f);
    ASSERT_GT(pdf, 0);
    flux += static_cast<double>(intensityCd(web, d) / pdf) / kSamples;
    double turn = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / (2 * std::numbers::pi);
    turn -= std::floor(turn);
    const int p = std::min(kPolar - 1, static_cast<int>((static_cast<double>(d.z) + 1) / 2 * kPolar)),
              a = std::min(kAzimuth - 1, static_cast<int>(turn * kAzimuth));
    counts[static_cast<size_t>(p * kAzimuth + a)] += 1;
  }
  EXPECT_TRUE(testing::fits(counts, expected));
  EXPECT_NEAR(flux / web.fluxLm, 1, 2e-3);
}

TEST(WebSampler, aSampleHasTheDensityOfItsDirection) {
  const PhotometricWeb web = lopsided();
  const WebSampler sampler(web);
  Rng rng(4, 5, 6);
  int differ = 0;
  for (int i = 0; i < 10'000; ++i) {
    float pdf = 0;
    const Vec3 d = sampler.sample(rng.uniform2(), pdf);
    differ += std::abs(sampler.pdf(d) / pdf - 1) > 1e-4f;  // on the border of a cell rounding may tell another
  }
  EXPECT_LT(differ, 5);
  EXPECT_EQ(sampler.pdf({0, 0, 1}), 0);
}

}  // namespace
}  // namespace roomlight
