// Means over blocks of a picture with their standard errors, as golden pictures are kept, and the test between two of
 // them.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "reference/path_tracer.h"

namespace roomlight::test {

constexpr int kBlock = 8;                           // pixels, edge of a block
constexpr int kGoldenWidth = 96, kGoldenHeight = 64;

struct Block {
  double mean[3] = {}, standardError[3] = {};  // cd/m² per channel
};

// The blocks row by row from the top, at last the whole picture. Without `variance` (of each pixel's mean) errors are
// 0.
std::vector<Block> blocksOf(const Image& image, const Image* variance = nullptr);

double luminanceOf(const Block& block);

// The blocks as a picture, one pixel a block.
Image pictureOf(const std::vector<Block>& blocks);

PathResult pathOf(const Scene& scene, const Camera& camera, int samples, uint64_t seed);

std::string goldenFile(const std::string& scene);
Status writeGolden(const std::string& scene, const std::vector<Block>& blocks, int samples);
Result<std::vector<Block>> readGolden(const std::string& scene);

// The largest |z| over blocks and channels between two estimates, and where.
struct Deviation {
  double z = 0;
  std::string where;
};
Deviation largestDeviation(const std::vector<Block>& golden, const std::vector<Block>& fresh);

// |z| that equal pictures pass with a chance below `falseAlarm` over `tests` two-sided tests (Bonferroni).
double threshold(double falseAlarm, size_t tests);

}  // namespace roomlight::test
