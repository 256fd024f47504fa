#include "filter/filter.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "base/parallel.h"
#include "noisy_wall.h"

namespace roomlight {
namespace {

using test::momentsOf;
using test::noisyWall;

TEST(Filter, takesNoiseAwayAndKeepsTheMean) {
  const FilterInput in = noisyWall(97, 61, 10, 3);
  const test::Moments before = momentsOf(composed(in), 0, 97), after = momentsOf(filtered(in, 5), 0, 97);
  EXPECT_LT(after.variance, before.variance / 50);
  EXPECT_NEAR(after.mean, before.mean, 0.01 * before.mean);
}

TEST(Filter, leavesAPictureWithoutNoise) {
  FilterInput in = noisyWall(40, 30, 10, 0);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x)
      in.at(x, y).diffuse = Vec3(x < 20 ? 5.0f : 1.0f), in.at(x, y).sharp = Vec3(y < 15 ? 3.0f : 0.0f);
  }
  const Image before = composed(in), after = filtered(in, 5);
  for (size_t i = 0; i < before.pixels.size(); ++i)
    EXPECT_NEAR(luminance(after.pixels[i]), luminance(before.pixels[i]), 1e-4f);
}

TEST(Filter, keepsTexturesSharp) {
  FilterInput in = noisyWall(40, 30, 10, 2);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      FilterPixel& p = in.at(x, y);
      const Vec3 albedo = (x + y) % 2 ? Vec3(0.8f) : Vec3(0.1f);
      p.diffuse = p.diffuse / p.albedo * albedo;
      p.albedo = albedo;
    }
  }
  const Image after = filtered(in, 5);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) EXPECT_NEAR(luminance(after.at(x, y) / in.at(x, y).albedo), 10, 1.5f);
  }
}

// Single pixels hold as much as hundreds should: spread over the wall, and not onto another.
TEST(Filter, spreadsRareLightOverItsSurfaceAlone) {
  FilterInput in = noisyWall(128, 64, 10, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 64; x < 128; ++x) in.at(x, y).normal = {-1, 0, 0};
    for (int x = 0; x < 64; ++x) in.at(x, y).rare = (x * 7 + y * 13) % 97 == 0 ? Vec3(97) : Vec3();
  }
  const Image before = composed(in), after = filtered(in, 6);
  const test::Moments lit = momentsOf(after, 0, 64), beside = momentsOf(after, 64, 128);
  EXPECT_NEAR(lit.mean, momentsOf(before, 0, 64).mean, 0.02 * lit.mean);
  EXPECT_LT(lit.variance, 0.01);
  EXPECT_NEAR(beside.mean, 5, 0.05);
}

// Lone pixels that their own noise does not explain, so that no pass takes them for it.
TEST(Filter, boundsLonePixelsByThoseBesideThem) {
  FilterInput in = noisyWall(40, 30, 10, 0);
  for (FilterPixel& p : in.pixels) p.specular = Vec3(1), p.roughness = 0.5f;
  in.at(10, 10).diffuse = Vec3(9), in.at(20, 10).diffuse = Vec3(1), in.at(30, 10).specular = Vec3(4);
  for (int x = 5; x < 35; ++x) in.at(x, 20).diffuse = Vec3(8);  // a line
  in.at(10, 25).specular = Vec3(4), in.at(10, 25).roughness = 0.02f;  // what a mirror shows
  in.at(20, 25).normal = normalize(Vec3{1, 0, 1}), in.at(20, 25).diffuse = Vec3(9);  // another surface
  const Image before = composed(in), after = filtered(in, 5);
  const auto bright = [&](const Image& image, int x, int y) { return luminance(image.at(x, y)); };
  const auto isLone = [&](const Image& image, int x, int y) {
    float least = INFINITY, most = 0;
    for (int j = y - 1; j <= y + 1; ++j) {
      for (int i = x - 1; i <= x + 1; ++i) {
        if (i != x || j != y) least = std::min(least, bright(image, i, j)), most = std::max(most, bright(image, i, j));
      }
    }
    return bright(image, x, y) > most + 1e-3f || bright(image, x, y) < least - 1e-3f;
  };
  for (const int x : {10, 20, 30}) {
    EXPECT_TRUE(isLone(before, x, 10)) << x;
    EXPECT_FALSE(isLone(after, x, 10)) << x;
  }
  EXPECT_GT(bright(after, 20, 20), bright(after, 20, 15) + 1);
  EXPECT_GT(bright(after, 10, 25), bright(after, 15, 25) + 2);
  EXPECT_GT(bright(after, 20, 25), bright(after, 15, 25) + 2);
}

// Means of a bright and a dark surface, one of them too bright, one a thing of its own.
TEST(Filter, boundsEdgesByWhatIsAroundThem) {
  FilterInput in = noisyWall(40, 30, 10, 0);
  for (int y = 0; y < 30; ++y) {
    for (int x = 20; x < 40; ++x) in.at(x, y).position.z = 1, in.at(x, y).diffuse = Vec3(1);
    in.at(20, y).position.z = 0.5f;
  }
  Image image = composed(in);
  const Image before = image;
  image.at(20, 10) = Vec3(7), image.at(20, 20) = Vec3(30), image.at(10, 10) = Vec3(7);
  boundEdges(in, image);
  EXPECT_EQ(image.at(20, 10), before.at(19, 10));
  EXPECT_EQ(image.at(20, 20), Vec3(30));
  EXPECT_EQ(image.at(10, 10), Vec3(7)) << "no edge: the filter's";
  EXPECT_EQ(image.at(20, 5), before.at(20, 5));
}

// Pixels on the border of a picture have fewer neighbours, and are on no edge for that; a panorama has no border there.
TEST(Filter, bordersOfAPictureAreNoEdges) {
  FilterInput in = noisyWall(12, 8, 10, 0);
  Image image = composed(in);
  for (const auto& [x, y] : {std::pair(0, 4), std::pair(6, 0), std::pair(11, 7)}) image.at(x, y) = Vec3(7);
  const Image before = image;
  boundEdges(in, image);
  EXPECT_EQ(image.pixels, before.pixels);
  for (int y = 0; y < 8; ++y) in.at(11, y).position.z = 1;
  in.wraps = true;
  boundEdges(in, image);
  EXPECT_EQ(image.at(6, 0), Vec3(7));
  EXPECT_EQ(image.at(11, 7), Vec3(5)) << "another surface than all beside it";
  FilterInput one = noisyWall(1, 1, 10, 0);
  Image single = composed(one);
  boundEdges(one, single);
  EXPECT_EQ(single.at(0, 0), Vec3(5));
  EXPECT_NEAR(luminance(filtered(one, 5).at(0, 0)), 5, 1e-3f);
}

TEST(Filter, rareLightStopsWhereOtherLightDiffers) {
  FilterInput in = noisyWall(128, 64, 10, 0);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) in.at(x, y).rare = Vec3(1);
    for (int x = 64; x < 128; ++x) in.at(x, y).diffuse = Vec3(0.5f);
  }
  const Image after = filtered(in, 6);
  EXPECT_NEAR(luminance(after.at(58, 32)), 6, 0.1f);
  EXPECT_NEAR(luminance(after.at(70, 32)), 0.5f, 0.01f);
}

TEST(Filter, varianceOfFilteredLuminanceFollowsTheNoise) {
  const auto told = [](float deviation, int passes) {
    const FilterInput wall = noisyWall(97, 61, 10, deviation);
    const std::vector<float> variance =
        filteredLuminance(wall, passes, [&](size_t i) { return wall.pixels[i]; }).variance;
    double mean = 0;
    for (const float v : variance) mean += static_cast<double>(v) / static_cast<double>(variance.size());
    return mean;
  };
  const double found = momentsOf(filtered(noisyWall(97, 61, 10, 3), 3), 0, 97).variance;
  EXPECT_GT(told(3, 3), found / 2);
  EXPECT_LT(told(3, 3), found * 2);
  EXPECT_NEAR(told(3, 3) / told(1.5f, 3), 4, 0.5);
  EXPECT_LT(told(3, 6), told(3, 3) / 3);
}

TEST(Filter, filteredLuminanceIsThatOfThePicture) {
  const FilterInput wall = noisyWall(97, 61, 10, 3);
  const std::vector<float> found = filteredLuminance(wall, 5, [&](size_t i) { return wall.pixels[i]; }).luminance;
  const Image shown = filtered(wall, 5);
  double a = 0, b = 0;
  for (size_t i = 0; i < found.size(); ++i)
    a += static_cast<double>(found[i]), b += static_cast<double>(luminance(shown.pixels[i]));
  EXPECT_NEAR(a, b, 0.01 * b);
}

TEST(Filter, mixesNoLightOfWallsThatMeet) {
  FilterInput in = noisyWall(64, 32, 10, 2), dark = noisyWall(64, 32, 6, 2, 1);
  for (int y = 0; y < 32; ++y) {
    for (int x = 32; x < 64; ++x) {
      in.at(x, y) = dark.at(x, y);
      in.at(x, y).normal = {-1, 0, 0};
    }
  }
  const Image after = filtered(in, 5);
  EXPECT_NEAR(momentsOf(after, 0, 32).mean, 5, 0.15);
  EXPECT_NEAR(momentsOf(after, 32, 64).mean, 3, 0.15);
  EXPECT_LT(momentsOf(after, 32, 64).variance, 0.05);
}

// One pane, in which two walls are seen: what it shows of one stays with that.
TEST(Filter, mixesNoReflectionsOfDifferentThings) {
  FilterInput in = noisyWall(64, 32, 10, 0);
  in.reflected.resize(in.pixels.size());
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      Rng rng(static_cast<uint64_t>(64 * y + x), 0, 7);
      FilterPixel& p = in.at(x, y);
      p.diffuse = {}, p.specular = Vec3(std::max(0.0f, (x < 32 ? 5.0f : 3.0f) + 2 * test::gaussian(rng))),
      p.specularVariance = 4;
      in.reflected[static_cast<size_t>(64 * y + x)] = {Vec3{0, 0, 2},
                                                       Vec3{p.position.x, p.position.y, x < 32 ? 1.0f : 3.0f} * 2, 2};
    }
  }
  const Image after = filtered(in, 5);
  EXPECT_NEAR(momentsOf(after, 28, 32).mean, 5, 0.3);
  EXPECT_NEAR(momentsOf(after, 32, 36).mean, 3, 0.3);
  EXPECT_LT(momentsOf(after, 0, 32).variance, 0.4);
  in.reflected.clear();
  EXPECT_LT(momentsOf(filtered(in, 5), 28, 32).mean, 4.7);
}

// A lamp's shade a metre before the wall, facing the same way, hot and as noisy: nothing of it reaches the wall.
TEST(Filter, mixesNoLightOfWhatHangsBeforeAWall) {
  FilterInput in = noisyWall(64, 64, 10, 2);
  const Image wall = filtered(in, 5);
  for (int y = 28; y < 36; ++y) {
    for (int x = 28; x < 36; ++x) {
      FilterPixel& p = in.at(x, y);
      p.diffuse = Vec3(1e4f), p.diffuseVariance = 1e9f, p.position += p.normal;
    }
  }
  const Image after = filtered(in, 5);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (x >= 28 && x < 36 && y >= 28 && y < 36) continue;
      EXPECT_NEAR(luminance(after.at(x, y)), luminance(wall.at(x, y)), 0.5f) << x << " " << y;
    }
  }
}

TEST(Filter, spreadsAnOutlierInsteadOfLosingIt) {
  FilterInput in = noisyWall(64, 64, 10, 1);
  FilterPixel& p = in.at(30, 31);
  p.diffuse += Vec3(500);
  p.diffuseVariance = 1e6f;
  const Image before = composed(in), after = filtered(in, 5);
  EXPECT_LT(luminance(after.at(30, 31)), 100);
  EXPECT_GT(momentsOf(after, 0, 64).mean, 0.985 * momentsOf(before, 0, 64).mean);
}

TEST(Filter, leavesWhatIsNoSurfaceAndMirrors) {
  FilterInput in = noisyWall(32, 32, 10, 1);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 16; ++x) in.at(x, y) = {}, in.at(x, y).rest = Vec3(static_cast<float>(x * y));
    for (int x = 16; x < 32; ++x) {
      FilterPixel& p = in.at(x, y);
      p.diffuse = {}, p.diffuseVariance = 0;
      p.specular = Vec3(static_cast<float>(x ^ y)), p.specularVariance = 100;
      p.roughness = 0.02f;
    }
  }
  const Image before = composed(in), after = filtered(in, 5);
  for (size_t i = 0; i < before.pixels.size(); ++i) EXPECT_EQ(after.pixels[i], before.pixels[i]);
}

// With reflections, sharp light and edges.
FilterInput variedPicture() {
  FilterInput in = noisyWall(75, 43, 10, 3);
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      FilterPixel& p = in.at(x, y);
      Rng rng(static_cast<uint64_t>(x), static_cast<uint64_t>(y), 7);
      p.sharp = Vec3(x > y ? 2.0f : 0.5f), p.sharpVariance = 0.3f * rng.uniform();
      p.specular = {rng.uniform(), 2 * rng.uniform(), rng.uniform()}, p.specularVariance = 0.3f;
      p.roughness = x < 30 ? 0.04f : 0.3f;
      p.normal = normalize({0.3f * rng.uniform(), 0.2f * rng.uniform(), 1});
      if (x + y > 100) p = {};
    }
  }
  return in;
}

TEST(Filter, givesTheSameOnEveryInstructionSet) {
  const FilterInput in = variedPicture();
  const Image best = filtered(in, 5);
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const Image other = filtered(in, 5);
    for (size_t i = 0; i < best.pixels.size(); ++i)
      EXPECT_NEAR(luminance(other.pixels[i]), luminance(best.pixels[i]), 1e-4f) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

// Of a noisy texture, where light was sampled in one pixel of 16; unsampled pixels hold nothing. A wall that meets it
// at a right angle, with other light and samples of its own, gives it none.
TEST(Filter, givesUnsampledPixelsTheLightOfTheirSurface) {
  FilterInput in = noisyWall(96, 64, 10, 0.5f), beside = noisyWall(96, 64, 40, 0.5f, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      FilterPixel& p = in.at(x, y);
      if (x >= 62) p = beside.at(x, y), p.normal = {-1, 0, 0};
      const Vec3 albedo = (x + y) % 2 ? Vec3(0.8f) : Vec3(0.1f);
      p.diffuse = p.diffuse / p.albedo * albedo, p.albedo = albedo;
      p.specular = Vec3(3);
      if (x % 4 != 1 || y % 4 != 2)
        p.diffuse = p.specular = {}, p.diffuseVariance = p.diffuseShare = p.specularShare = 0;
    }
  }
  const Image after = filtered(in, 5);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x)
      EXPECT_NEAR(luminance((after.at(x, y) - Vec3(3)) / in.at(x, y).albedo), x < 62 ? 10 : 40, 1) << x << ' ' << y;
  }
}

// One sample in eight finds light; pixels that found some with their first four samples get sixteen more, which makes
// it rarer there. A mean of pixels would be 47 % too dark, that of samples is not.
TEST(Filter, weighsPixelsByTheirSamples) {
  FilterInput in = noisyWall(128, 96, 10, 0);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 128; ++x) {
      Rng rng(static_cast<uint64_t>(y) * 65536 + static_cast<uint64_t>(x), 0, 1);
      float found = 0, n = 4;
      const auto take = [&](int count) {
        for (int i = 0; i < count; ++i) found += rng.uniform() < 0.125f ? 1.0f : 0.0f;
      };
      take(4);
      if (found > 0) take(16), n = 20;
      const float mean = found / n;
      FilterPixel& p = in.at(x, y);
      p.diffuse = p.albedo * (80 * mean);
      p.diffuseVariance = 6400 * mean * (1 - mean) / (n - 1);
      p.weight = n;
    }
  }
  EXPECT_NEAR(momentsOf(filtered(in, 5), 0, 128).mean, 5, 0.15);
  for (FilterPixel& p : in.pixels) p.weight = 1;
  EXPECT_LT(momentsOf(filtered(in, 5), 0, 128).mean, 3.5);
}

TEST(Filter, givesTheSameBitsWithAnyNumberOfThreads) {
  const FilterInput in = variedPicture();
  Image one;
  withThreads(1, [&] { one = filtered(in, 5); });
  EXPECT_EQ(one.pixels, filtered(in, 5).pixels);
}

// A panorama's left and right edges are neighbours: turned by any number of pixels it is filtered to the same picture.
TEST(Filter, seesNoSeamWhereAPictureGoesOnAtItsOtherSide) {
  const int w = 48, h = 20, turn = 17;
  FilterInput in = noisyWall(w, h, 10, 3);
  for (FilterPixel& p : in.pixels) p.position = {};  // near each other, whatever the turn
  FilterInput turned = in;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) turned.at((x + turn) % w, y) = in.at(x, y);
  }
  in.wraps = turned.wraps = true;
  const Image a = filtered(in, 3), b = filtered(turned, 3);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) EXPECT_NEAR(luminance(a.at(x, y)), luminance(b.at((x + turn) % w, y)), 1e-4f);
  }
}

}  // namespace
}  // namespace roomlight
