// `roomlight compare` from outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "compare/compare.h"
#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::runProgram;
using testing::TemporaryFolder;

class CompareCommand : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string path(const std::string& name) const { return folder_ / name; }

  static Image ramp(int width, float scale) {
    Image image(width, 16);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Vec3(scale * static_cast<float>(1 + i % 31));
    return image;
  }
  void SetUp() override {
    ASSERT_TRUE(writeExr(path("reference.exr"), ramp(20, 1), {}).ok());
    ASSERT_TRUE(writeExr(path("bright.exr"), ramp(20, 1.1f), {}).ok());
    ASSERT_TRUE(writeExr(path("wide.exr"), ramp(24, 1), {}).ok());
  }
};

TEST_F(CompareCommand, jsonHoldsEveryMeasure) {
  const ProgramRun run =
      runProgram({"compare", path("reference.exr"), path("bright.exr"), "--json", "--difference", path("d.png")});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  const Report report = compare(ramp(20, 1), ramp(20, 1.1f)).value();
  EXPECT_DOUBLE_EQ(json["mse"], report.mse);
  EXPECT_DOUBLE_EQ(json["relMse"], report.relMse);
  EXPECT_DOUBLE_EQ(json["ssim"], report.ssim);
  EXPECT_DOUBLE_EQ(json["flip"], report.flip);
  EXPECT_NEAR(json["meanLuminanceErrorPercent"].get<double>(), 10, 1e-3);
  EXPECT_EQ(readImage(path("d.png")).value().width, 20);
}

TEST_F(CompareCommand, tableAndDifferencePictureBesideThePictureByDefault) {
  const ProgramRun run = runProgram({"compare", path("reference.exr"), path("reference.exr")});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* key : {"mse", "relMse", "ssim", "flip", "meanLuminanceErrorPercent"})
    EXPECT_NE(run.out.find(key), std::string::npos);
  EXPECT_TRUE(readImage(path("reference.exr.difference.png")).ok());
}

TEST_F(CompareCommand, tonemappedPicturesAreComparedAsShown) {
  Image grey(20, 16), lighter(20, 16);
  for (Vec3& p : grey.pixels) p = Vec3(51 / 255.0f);
  for (Vec3& p : lighter.pixels) p = Vec3(102 / 255.0f);
  ASSERT_TRUE(writePng(path("grey.png"), grey, {}).ok());
  ASSERT_TRUE(writePng(path("lighter.png"), lighter, {}).ok());
  ASSERT_TRUE(writeJpeg(path("lighter.jpg"), lighter, SIZE_MAX).ok());
  for (const char* file : {"lighter.png", "lighter.jpg"}) {
    const ProgramRun run =
        runProgram({"compare", path("grey.png"), path(file), "--json", "--difference", path("d.png")});
    ASSERT_EQ(run.exitStatus, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["space"], "display");
    // 0.2 in encoded values, whatever their exposure; JPEG may be off by one of 255.
    EXPECT_NEAR(json["mse"].get<double>(), 0.04, std::string(file).ends_with(".png") ? 1e-6 : 2e-3) << file;
    EXPECT_FALSE(json.contains("relMse"));
    EXPECT_FALSE(json.contains("meanLuminanceErrorPercent"));
  }
  const ProgramRun same = runProgram({"compare", path("grey.png"), path("grey.png")});
  EXPECT_NE(same.out.find("mse                        0.000000"), std::string::npos) << same.out;
  EXPECT_NE(same.out.find("as shown"), std::string::npos) << same.out;
}

TEST_F(CompareCommand, linearAndToneMappedPicturesAreNotCompared) {
  ASSERT_TRUE(writePng(path("shown.png"), ramp(20, 0.01f), {}).ok());
  for (const auto& [a, b] : {std::pair("reference.exr", "shown.png"), std::pair("shown.png", "reference.exr")}) {
    const ProgramRun run = runProgram({"compare", path(a), path(b)});
    EXPECT_EQ(run.exitStatus, 2);
    EXPECT_NE(run.err.find("reference.exr holds linear light and " + path("shown.png") + " a tone-mapped picture"),
              std::string::npos)
        << run.err;
  }
  EXPECT_EQ(runProgram({"compare", path("shown.png"), path("shown.png"), "--second", path("shown.png")}).exitStatus, 2);
}

TEST_F(CompareCommand, sizesThatDifferAreToldBeforeAPictureIsDecoded) {
  // Whole but for what a decoder comes to last.
  const std::string wide = testing::readFile(path("wide.exr"));
  testing::writeFile(path("torn.exr"), wide.substr(0, wide.size() - 20));
  const std::string expected = "sizes differ: the reference has 20 x 16 pixels, the picture 24 x 16";
  const std::vector<std::vector<std::string>> cases = {
      {"compare", path("reference.exr"), path("torn.exr")},
      {"compare", path("reference.exr"), path("bright.exr"), "--second", path("torn.exr")}};
  for (const auto& arguments : cases) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.exitStatus, 2);
    EXPECT_NE(run.err.find(path("reference.exr") + ", " + path("torn.exr") + ": " + expected), std::string::npos)
        << run.err;
  }
  EXPECT_EQ(runProgram({"compare", path("wide.exr"), path("torn.exr")}).err.find("sizes differ"), std::string::npos);
}

TEST_F(CompareCommand, badInputIsOneLineExitStatusTwoAndNothingWritten) {
  testing::writeFile(path("text.exr"), "no picture");
  testing::writeFile(path("torn.jpg"), "\xff\xd8\xff\xe0 no more");
  const size_t before = folder_.fileCount();
  const std::vector<std::vector<std::string>> cases = {
      {"compare", path("reference.exr"), path("wide.exr")},
      {"compare", path("reference.exr"), path("missing.exr")},
      {"compare", "", path("reference.exr")},
      {"compare", path("text.exr"), path("reference.exr")},
      {"compare", path("torn.jpg"), path("torn.jpg")},
      {"compare", path("reference.exr"), path("bright.exr"), "--difference", path("no/d.png")},
      {"compare", path("reference.exr"), path("bright.exr"), "--difference", path("d.exr")},
      {"compare", path("reference.exr"), path("bright.exr"), "--difference", ""},
      {"compare", path("reference.exr"), path("bright.exr"), "--band", path("b.png")},
      {"compare", path("reference.exr"), path("bright.exr"), "--second", path("reference.exr"), "--band",
       path("bright.exr")},
      {"compare", path("reference.exr"), path("bright.exr"), "--second", path("reference.exr"), "--band",
       path("no/b.png")},
      {"compare", path("reference.exr"), path("bright.exr"), "--second", path("reference.exr"), "--band", path("b.png"),
       "--difference", path("b.png")},
      {"compare", path("reference.exr")}};
  for (const auto& arguments : cases) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.exitStatus, 2) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(folder_.fileCount(), before);
  }
}

}  // namespace
}  // namespace roomlight
