// Filtering where rare light is apart, so that variances have no outliers: by levels.
#include "filter/levels.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "noisy_wall.h"

namespace roomlight {
namespace {

using test::momentsOf;
using test::noisyWall;

constexpr int kWidth = 192, kHeight = 128, kPasses = 6;

// Light on a wall, with noise of that part of it. Rare light of next to nothing.
template <class Light>
FilterInput wallWith(Light&& light, float noise, uint64_t seed = 0) {
  FilterInput in = noisyWall(kWidth, kHeight, 0, 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      FilterPixel& p = in.at(x, y);
      Rng rng(static_cast<uint64_t>(y) * 65536 + static_cast<uint64_t>(x), 1, seed);
      const float l = light(x, y);
      p.diffuse = p.albedo * (l * std::max(0.0f, 1 + noise * test::gaussian(rng)));
      p.diffuseVariance = l * l * noise * noise, p.rare = Vec3(1e-6f);
    }
  }
  return in;
}

// Root mean square of the relative error over pixels that `judged` takes.
template <class Light, class Judged>
double errorOf(const Image& image, Light&& light, Judged&& judged) {
  double sum = 0, count = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!judged(x, y)) continue;
      const double off = static_cast<double>(luminance(image.at(x, y)) / (0.5f * light(x, y))) - 1;
      sum += off * off, count += 1;
    }
  }
  return std::sqrt(sum / count);
}
bool inside(int x, int y) { return x >= 16 && y >= 16 && x < kWidth - 16 && y < kHeight - 16; }

TEST(Levels, wallsComeOutClean) {
  const auto light = [](int, int) { return 10.0f; };
  const Image after = filtered(wallWith(light, 0.4f), kPasses);
  EXPECT_LT(errorOf(after, light, inside), 0.015);
  EXPECT_NEAR(momentsOf(after, 0, kWidth).mean, 5, 0.03);
}

// A dark line, narrower than noise lets see, where openness shows one too.
TEST(Levels, contactsStayWhereOpennessTellsOfThem) {
  const auto line = [](int x, int) { return x >= 94 && x < 98 ? 1.0f : 0.0f; };
  const auto light = [&](int x, int y) { return 10 - 6 * line(x, y); };
  const auto onLine = [&](int x, int y) { return inside(x, y) && line(x, y) > 0; };
  FilterInput wall = wallWith(light, 0.8f);
  const auto beside = [&](int x, int y) { return inside(x, y) && std::abs(x - 96) > 16; };
  const Image blurred = filtered(wall, kPasses);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) wall.at(x, y).open = 1 - 0.5f * line(x, y);
  }
  const Image told = filtered(wall, kPasses);
  EXPECT_LT(errorOf(told, light, onLine), 0.6 * errorOf(blurred, light, onLine));
  EXPECT_LT(errorOf(told, light, beside), 1.1 * errorOf(blurred, light, beside));
}

// Where light has nothing to do with it openness adds nothing, noisy as it is itself.
TEST(Levels, opennessThatTellsNothingDoesNoHarm) {
  const auto light = [](int, int) { return 10.0f; };
  FilterInput wall = wallWith(light, 0.4f);
  for (size_t i = 0; i < wall.pixels.size(); ++i) {
    Rng rng(i, 2, 7);
    wall.pixels[i].open = (i / 16 % 2 ? 0.5f : 0.9f) + 0.1f * test::gaussian(rng);
  }
  EXPECT_LT(errorOf(filtered(wall, kPasses), light, inside), 0.025);
}

// A pixel whose short rays meet something by chance must not explain its own noise.
TEST(Levels, lonePixelsOfOpennessLeaveNoSpecks) {
  const auto light = [](int, int) { return 10.0f; };
  const auto lone = [](int x, int y) { return (x + 57 * y) % 211 == 0; };
  const auto onLone = [&](int x, int y) { return inside(x, y) && lone(x, y); };
  FilterInput wall = wallWith(light, 0.8f);
  const double before = errorOf(filtered(wall, kPasses), light, onLone);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) wall.at(x, y).open = lone(x, y) ? 0.875f : 1;
  }
  EXPECT_LT(errorOf(filtered(wall, kPasses), light, onLone), 1.15 * before);
}

// Weights that are alike everywhere change nothing but by how many samples tell of the noise close by.
TEST(Levels, wallsOfManySamplesComeOutAsClean) {
  const auto light = [](int, int) { return 10.0f; };
  FilterInput wall = wallWith(light, 0.4f);
  const double few = errorOf(filtered(wall, kPasses), light, inside);
  for (FilterPixel& p : wall.pixels) p.weight = 20;
  const Image after = filtered(wall, kPasses);
  EXPECT_LT(errorOf(after, light, inside), 1.1 * few);
  EXPECT_NEAR(momentsOf(after, 0, kWidth).mean, 5, 0.03);
}

// A narrow shadow that many samples know well, in light that few know.
TEST(Levels, shadowsStayThatHaveLessNoiseThanTheLightAroundThem) {
  const auto isShadow = [](int x) { return x >= 94 && x < 97; };
  const auto light = [&](int x, int) { return isShadow(x) ? 2.0f : 10.0f; };
  FilterInput in = wallWith(light, 0.9f);
  FilterInput sure = wallWith(light, 0.1f);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (isShadow(x)) in.at(x, y) = sure.at(x, y);
      in.at(x, y).weight = isShadow(x) ? 20 : 4;
    }
  }
  const Image after = filtered(in, kPasses);
  EXPECT_LT(errorOf(after, light, [&](int x, int y) { return inside(x, y) && isShadow(x); }), 0.8);
  EXPECT_LT(errorOf(after, light, [&](int x, int y) { return inside(x, y) && std::abs(x - 95) > 16; }), 0.08);
}

TEST(Levels, softShadowsStay) {
  const auto light = [](int x, int y) {
    return 10 + 4 * std::sin(0.12f * static_cast<float>(x)) + 0.02f * static_cast<float>(y);
  };
  EXPECT_LT(errorOf(filtered(wallWith(light, 0.4f), kPasses), light, inside), 0.05);
  EXPECT_LT(errorOf(filtered(wallWith(light, 0.05f), kPasses), light, inside), 0.015);
}

TEST(Levels, edgesOfLightStay) {
  const auto light = [](int x, int) { return x < kWidth / 2 ? 10.0f : 2.0f; };
  const Image after = filtered(wallWith(light, 0.1f), kPasses);
  EXPECT_LT(errorOf(after, light, [](int x, int y) { return inside(x, y) && std::abs(x - kWidth / 2) > 6; }), 0.04);
  EXPECT_LT(errorOf(after, light,
                    [](int x, int y) {
                      return inside(x, y) && std::abs(x - kWidth / 2) > 1 && std::abs(x - kWidth / 2) <= 6;
                    }),
            0.1);
}

// Pixels far brighter than their variance tells.
TEST(Levels, outliersAreSpread) {
  const auto light = [](int, int) { return 10.0f; };
  FilterInput in = wallWith(light, 0.2f);
  for (int y = 10; y < kHeight; y += 20) {
    for (int x = 10; x < kWidth; x += 20) in.at(x, y).diffuse += Vec3(10);
  }
  const Image before = composed(in), after = filtered(in, kPasses);
  for (int y = 30; y < kHeight - 20; y += 20) {
    for (int x = 30; x < kWidth - 20; x += 20) EXPECT_LT(luminance(after.at(x, y)), 5.75f) << x << ' ' << y;
  }
  EXPECT_NEAR(momentsOf(after, 0, kWidth).mean, momentsOf(before, 0, kWidth).mean, 0.01);
}

TEST(Levels, aContactStaysBesideAWall) {
  // A thing a metre before the wall: its pixels are another surface.
  const auto light = [](int x, int) { return x < 60 ? 40.0f : 10.0f; };
  FilterInput in = wallWith(light, 0.3f);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < 60; ++x) in.at(x, y).position.z = 1;
  }
  const Image after = filtered(in, kPasses);
  EXPECT_LT(errorOf(after, light, [](int x, int y) { return inside(x, y) && std::abs(x - 60) < 8; }), 0.06);
}

TEST(Levels, theNoiseLeftIsTold) {
  const auto light = [](int x, int) { return x < kWidth / 2 ? 10.0f : 2.0f; };
  const FilterInput in = wallWith(light, 0.3f);
  const FilteredLuminance left = filteredLuminance(in, kPasses, [&](size_t i) { return in.pixels[i]; });
  double told = 0, found = 0;
  constexpr int kSeeds = 6;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Image a = filtered(wallWith(light, 0.3f, 2 * seed), kPasses),
                b = filtered(wallWith(light, 0.3f, 2 * seed + 1), kPasses);
    for (size_t i = 0; i < a.pixels.size(); ++i) {
      const double off = static_cast<double>(luminance(a.pixels[i]) - luminance(b.pixels[i]));
      found += off * off / 2 / kSeeds;
    }
  }
  for (const float v : left.variance) told += static_cast<double>(v);
  EXPECT_GT(told, found / 1.5);
  EXPECT_LT(told, found * 1.5);
}

TEST(Levels, theSameBitsWithAnyNumberOfThreads) {
  const FilterInput in = wallWith([](int x, int y) { return 5 + 0.01f * static_cast<float>(x * y % 97); }, 0.3f);
  Image one;
  withThreads(1, [&] { one = filtered(in, kPasses); });
  EXPECT_EQ(one.pixels, filtered(in, kPasses).pixels);
}

// Whatever the passes, and however the picture is cut into bands.
TEST(Levels, everyNumberOfPassesCleansWithinThePicture) {
  double before = 1;
  for (int passes = 1; passes <= 7; ++passes) {
    FilterInput tall = noisyWall(24, 600, 0, 0);
    for (size_t i = 0; i < tall.pixels.size(); ++i) {
      FilterPixel& p = tall.pixels[i];
      Rng rng(i, 2, 0);
      p.diffuse = p.albedo * (10 * std::max(0.0f, 1 + 0.3f * test::gaussian(rng))), p.diffuseVariance = 9,
      p.rare = Vec3(1e-6f);
    }
    const Image after = filtered(tall, passes);
    double square = 0;
    for (const Vec3& p : after.pixels)
      square += std::pow(static_cast<double>(luminance(p)) / 5 - 1, 2) / static_cast<double>(after.pixels.size());
    EXPECT_LT(square, before) << passes;
    before = 1.1 * square;
    const FilteredLuminance left = filteredLuminance(tall, passes, [&](size_t k) { return tall.pixels[k]; });
    double told = 0;
    for (const float v : left.variance) told += static_cast<double>(v) / static_cast<double>(left.variance.size());
    EXPECT_LT(told, 2.25) << passes;  // of single pixels
    EXPECT_GT(told, 0) << passes;
  }
  EXPECT_LT(before, 0.002);
}

// One pixel in sixteen has samples, rare light among them: the others take both from their surface.
TEST(Levels, unsampledPixelsGetRareLightToo) {
  FilterInput in = wallWith([](int, int) { return 10.0f; }, 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      FilterPixel& p = in.at(x, y);
      if (x % 4 == 1 && y % 4 == 2) {
        p.rare = Vec3(2);
      } else {
        p.diffuse = p.rare = {}, p.diffuseVariance = p.diffuseShare = 0;
      }
    }
  }
  const Image after = filtered(in, kPasses);
  for (int y = 16; y < kHeight - 16; ++y) {
    for (int x = 16; x < kWidth - 16; ++x) EXPECT_NEAR(luminance(after.at(x, y)), 7, 0.1f) << x << ' ' << y;
  }
}

// A bulb of one pixel before a wall: no pixel beside it shows its surface, far ones lie where its plane might be. It
// leaves no copies of itself 16 pixels away.
TEST(Levels, aLonelyBrightPixelStaysWhereItIs) {
  const auto light = [](int, int) { return 2.0f; };
  FilterInput in = wallWith(light, 0.1f);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      in.at(x, y).position = Vec3{0.01f * static_cast<float>(x), -0.01f * static_cast<float>(y), 0},
               in.at(x, y).normal = {0, 0, 1};
  }
  FilterPixel& bulb = in.at(kWidth / 2, kHeight / 2);
  bulb.position.z = 0.2f;
  const Image without = filtered(in, kPasses);
  bulb.diffuse = bulb.albedo * 2000.0f, bulb.rare = bulb.albedo * 2000.0f;
  const Image after = filtered(in, kPasses);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (x == kWidth / 2 && y == kHeight / 2) continue;
      ASSERT_NEAR(luminance(after.at(x, y)), luminance(without.at(x, y)), 0.02f) << x << ' ' << y;
    }
  }
  EXPECT_GT(luminance(after.at(kWidth / 2, kHeight / 2)), 1500);
}

// A panorama turned: draws of noise go with their columns, so nothing is seen of the seam.
TEST(Levels, aPanoramaHasNoSeam) {
  FilterInput in = wallWith([](int, int) { return 10.0f; }, 0.3f);
  for (FilterPixel& p : in.pixels) p.position = {};
  in.wraps = true;
  const Image after = filtered(in, kPasses);
  double across = 0, elsewhere = 0;
  for (int y = 0; y < kHeight; ++y) {
    across += std::pow(static_cast<double>(luminance(after.at(0, y)) - luminance(after.at(kWidth - 1, y))), 2);
    elsewhere +=
        std::pow(static_cast<double>(luminance(after.at(kWidth / 2, y)) - luminance(after.at(kWidth / 2 - 1, y))), 2);
  }
  EXPECT_LT(across, 4 * elsewhere + 1e-3);
}

}  // namespace
}  // namespace roomlight
