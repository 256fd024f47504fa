#include "base/image_io.h"
#include "batch/merge.h"
#include "unit/batch/small_batch.h"

namespace roomlight::batch {
namespace {

using testing::readFile;
using testing::SmallBatch;
using testing::writing;

class BatchMerge : public SmallBatch {};

TEST_F(BatchMerge, MeanOfSeedsHasItsStandardError) {
  std::vector<std::filesystem::path> files;
  for (const float light : {1.0f, 2.0f, 6.0f}) {
    Image image(2, 1);
    image.pixels = {{light, light, light}, {3, 3, 3}};
    files.push_back(files_ / fmt::format("{}.exr", light));
    ASSERT_TRUE(writeExr(files.back(), image, {{"roomlight.seed", "1"}, {"roomlight.scene", "home"}}));
  }
  const Result<SeedMean> mean = meanOfSeeds("a", files, files_ / "mean.exr", files_ / "error.exr");
  ASSERT_TRUE(mean) << mean.error();
  const Result<Image> means = readImage(files_ / "mean.exr"), errors = readImage(files_ / "error.exr");
  ASSERT_TRUE(means && errors);
  EXPECT_FLOAT_EQ(means.value().at(0, 0).x, 3);
  EXPECT_FLOAT_EQ(means.value().at(1, 0).x, 3);
  // Of 1, 2, 6: variance 7, of the mean 7/3.
  EXPECT_NEAR(errors.value().at(0, 0).x, std::sqrt(7.0 / 3), 1e-4);
  EXPECT_FLOAT_EQ(errors.value().at(1, 0).x, 0);
  EXPECT_NEAR(mean.value().standardError, std::sqrt(7.0 / 6) / 3, 1e-5);
  const Result<Metadata> about = readMetadata(files_ / "mean.exr");
  ASSERT_TRUE(about);
  EXPECT_EQ(about.value().at("roomlight.seeds"), "3");
  EXPECT_EQ(about.value().at("roomlight.scene"), "home");
}

TEST_F(BatchMerge, OneSeedOrTwoSizesAreNoMean) {
  ASSERT_TRUE(writeExr(files_ / "a.exr", Image(2, 1), {}));
  ASSERT_TRUE(writeExr(files_ / "b.exr", Image(1, 2), {}));
  EXPECT_FALSE(meanOfSeeds("a", {files_ / "a.exr"}, files_ / "m.exr", files_ / "e.exr"));
  EXPECT_FALSE(meanOfSeeds("a", {files_ / "a.exr", files_ / "b.exr"}, files_ / "m.exr", files_ / "e.exr"));
}

TEST_F(BatchMerge, SheetsShowPicturesSideBySide) {
  Image image(480, 320);
  for (Vec3& p : image.pixels) p = {1, 0, 0};
  ASSERT_TRUE(writePng(files_ / "a.png", image, {}));
  ASSERT_TRUE(writeExr(files_ / "b.exr", image, {}));
  SheetMaker maker(files_.path(), "all", "sheet");
  ASSERT_TRUE(maker.add(files_ / "a.png"));
  ASSERT_TRUE(maker.add(files_ / "b.exr"));
  ASSERT_TRUE(maker.finish());
  ASSERT_EQ(maker.sheets().size(), 1u);
  EXPECT_EQ(maker.sheets()[0].pictures, 2u);
  const Result<Image> sheet = readImage(files_ / "sheet_1.jpg");
  ASSERT_TRUE(sheet) << sheet.error();
  EXPECT_EQ(sheet.value().width, 2 * 246 + 6);
  EXPECT_GT(sheet.value().at(100, 80).x, 0.8f);
}

TEST_F(BatchMerge, FiguresHaveALineForEachTask) {
  const TaskList all = plan({writing(1), {"fail", "2", "no <such> file"}, writing(3)});
  RunWish some = wish(all);
  some.tasks = {0, 1};
  ASSERT_TRUE(runTasks(all, some));
  const Result<Merged> merged = mergeBatch(all, program());
  ASSERT_TRUE(merged) << merged.error();
  EXPECT_EQ(merged.value().done, 1u);
  EXPECT_EQ(merged.value().failed, 1u);
  const std::string csv = readFile(folder_.merged() / "figures.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_NE(csv.find(",done,"), std::string::npos);
  EXPECT_NE(csv.find(",waiting,"), std::string::npos);
  const std::string html = readFile(folder_.merged() / "index.html");
  EXPECT_NE(html.find("1 of 3 done, 1 failed"), std::string::npos);
  EXPECT_NE(html.find("no &lt;such&gt; file"), std::string::npos);
}

}  // namespace
}  // namespace roomlight::batch
