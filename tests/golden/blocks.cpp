#include "golden/blocks.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace roomlight::test {
namespace {

// Float sums of thousands of samples round by about this much, also where every sample is the same.
constexpr double kRounding = 1e-4;

Block blockOf(const Image& image, const Image* variance, int x0, int y0, int x1, int y1) {
  Block b;
  const double n = static_cast<double>(x1 - x0) * (y1 - y0);
  for (int c = 0; c < 3; ++c) {
    double sum = 0, squares = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        sum += static_cast<double>(image.at(x, y)[c]);
        if (variance) squares += static_cast<double>(variance->at(x, y)[c]);
      }
    }
    b.mean[c] = sum / n;
    b.standardError[c] = std::sqrt(squares) / n;
  }
  return b;
}

}  // namespace

std::vector<Block> blocksOf(const Image& image, const Image* variance) {
  std::vector<Block> blocks;
  for (int y = 0; y < image.height; y += kBlock) {
    for (int x = 0; x < image.width; x += kBlock)
      blocks.push_back(blockOf(image, variance, x, y, x + kBlock, y + kBlock));
  }
  blocks.push_back(blockOf(image, variance, 0, 0, image.width, image.height));
  return blocks;
}

double luminanceOf(const Block& b) { return 0.2126 * b.mean[0] + 0.7152 * b.mean[1] + 0.0722 * b.mean[2]; }

Image pictureOf(const std::vector<Block>& blocks) {
  Image image(kGoldenWidth / kBlock, kGoldenHeight / kBlock);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) image.pixels[i][c] = static_cast<float>(blocks[i].mean[c]);
  }
  return image;
}

PathResult pathOf(const Scene& scene, const Camera& camera, int samples, uint64_t seed) {
  const RayScene rays(scene);
  const Lights lights(scene);
  PathSettings settings;
  settings.width = kGoldenWidth, settings.height = kGoldenHeight;
  settings.samples = samples;
  settings.seed = seed;
  return pathTrace(rays, lights, camera, settings);
}

std::string goldenFile(const std::string& scene) {
  return std::string(ROOMLIGHT_SOURCE_DIR) + "/tests/golden/data/" + scene + ".txt";
}

Status writeGolden(const std::string& scene, const std::vector<Block>& blocks, int samples) {
  std::ofstream out(goldenFile(scene));
  out << fmt::format(
      "# Scene {} by path, {} samples a pixel, {}x{}: made by golden_images {}. For each block of {}x{} pixels, row by "
      "row\n",
      scene, samples, kGoldenWidth, kGoldenHeight, samples, kBlock, kBlock);
  out << "# from the top, and at last for the whole picture: mean R G B in cd/m2, standard error of each.\n";
  for (const Block& b : blocks) {
    out << fmt::format("{:.6g} {:.6g} {:.6g}  {:.3g} {:.3g} {:.3g}\n", b.mean[0], b.mean[1], b.mean[2],
                       b.standardError[0], b.standardError[1], b.standardError[2]);
  }
  if (!out.flush()) return Error{goldenFile(scene) + ": cannot be written"};
  return Ok{};
}

Result<std::vector<Block>> readGolden(const std::string& scene) {
  std::ifstream in(goldenFile(scene));
  std::vector<Block> blocks;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream words(line);
    Block b;
    for (double& v : b.mean) words >> v;
    for (double& v : b.standardError) words >> v;
    if (!words) return Error{goldenFile(scene) + ": a line does not hold six numbers"};
    blocks.push_back(b);
  }
  if (blocks.size() != kGoldenWidth / kBlock * (kGoldenHeight / kBlock) + 1)
    return Error{goldenFile(scene) + ": has the wrong number of lines; run golden_images"};
  return blocks;
}

Deviation largestDeviation(const std::vector<Block>& golden, const std::vector<Block>& fresh) {
  Deviation worst;
  for (size_t i = 0; i < golden.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double error =
          std::hypot(golden[i].standardError[c], fresh[i].standardError[c], kRounding * golden[i].mean[c]);
      const double z = std::abs(fresh[i].mean[c] - golden[i].mean[c]) / std::max(error, 1e-30);
      if (z <= worst.z) continue;
      const size_t row = kGoldenWidth / kBlock;
      const std::string where = i + 1 == golden.size() ? "whole picture" : fmt::format("block {},{}", i % row, i / row);
      worst = {z,
               fmt::format("{}, channel {}: {:.5g} +- {:.2g} instead of {:.5g} +- {:.2g} cd/m2", where, c,
                           fresh[i].mean[c], fresh[i].standardError[c], golden[i].mean[c], golden[i].standardError[c])};
    }
  }
  return worst;
}

double threshold(double falseAlarm, size_t tests) {
  const double each = falseAlarm / static_cast<double>(tests);
  double low = 0, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) > each ? low : high) = middle;
  }
  return high;
}

}  // namespace roomlight::test
