// `roomlight develop` from outside.
#include <gtest/gtest.h>

#include "base/image_io.h"
#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::runProgram;
using testing::TemporaryFolder;

std::string flat(const TemporaryFolder& folder, const std::string& name, int width, int height, float luminance) {
  Image image(width, height);
  for (Vec3& p : image.pixels) p = Vec3(luminance);
  EXPECT_TRUE(writeExr(folder / name, image, {}));
  return folder / name;
}

TEST(DevelopCommand, showsPicturesSideBySideWithTheExposureOfTheLast) {
  const TemporaryFolder folder;
  const std::string dark = flat(folder, "dark.exr", 8, 6, 10), bright = flat(folder, "bright.exr", 4, 6, 40);
  const ProgramRun run = runProgram({"develop", dark, bright, "-o", folder / "strip.png", "--tone", "clip"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const Image strip = readImage(folder / "strip.png").value();
  ASSERT_EQ(strip.width, 12);
  EXPECT_NEAR(strip.at(9, 3).x, 0.18, 0.01);
  EXPECT_NEAR(strip.at(2, 3).x, 0.18 / 4, 0.01);
}

TEST(DevelopCommand, aJpegIsAsSmallAsAsked) {
  const TemporaryFolder folder;
  Image noise(200, 200);
  uint32_t state = 1;
  for (Vec3& p : noise.pixels) p = Vec3(static_cast<float>((state = state * 1664525u + 1013904223u) >> 20));
  ASSERT_TRUE(writeExr(folder / "noise.exr", noise, {}));
  ASSERT_EQ(
      runProgram({"develop", folder / "noise.exr", "-o", folder / "noise.jpg", "--most-kilobytes", "25"}).exitStatus,
      0);
  const auto size = std::filesystem::file_size(folder / "noise.jpg");
  EXPECT_GT(size, 1000u);
  EXPECT_LE(size, 25000u);
}

TEST(DevelopCommand, finishedPicturesAreRefused) {
  const TemporaryFolder folder;
  Image grey(8, 6);
  ASSERT_TRUE(writePng(folder / "a.png", grey, {}));
  ASSERT_TRUE(writeJpeg(folder / "a.jpg", grey, SIZE_MAX));
  for (const char* name : {"a.png", "a.jpg"}) {
    const ProgramRun run = runProgram({"develop", folder / name, "-o", folder / "o.png"});
    EXPECT_EQ(run.exitStatus, 2);
    EXPECT_NE(run.err.find("is exposed and tone-mapped already; develop takes linear pictures"), std::string::npos)
        << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "o.png"));
  }
}

TEST(DevelopCommand, badInputIsExitStatusTwo) {
  const TemporaryFolder folder;
  const std::string a = flat(folder, "a.exr", 8, 6, 1), b = flat(folder, "b.exr", 8, 5, 1), out = folder / "o.png";
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"develop", a, b, "-o", out},
                                             {"develop", folder / "none.exr", "-o", out},
                                             {"develop", a, "-o", folder / "o.gif"},
                                             {"develop", a, "-o", out, "--tone", "sepia"}}) {
    EXPECT_EQ(runProgram(arguments).exitStatus, 2);
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

}  // namespace
}  // namespace roomlight
