// `--light` and `--write-lighting` from outside, on a file that holds nothing but walls.
#include <gtest/gtest.h>

#include "base/image_io.h"
#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::readFile;
using testing::runProgram;
using testing::TemporaryFolder;
using testing::writeFile;

// 5 x 2.6 x 4 m, open towards -z above 0.9 m.
constexpr const char* kRoom = R"(o Room
v 0 0 0
v 5 0 0
v 5 0 4
v 0 0 4
v 0 2.6 0
v 5 2.6 0
v 5 2.6 4
v 0 2.6 4
v 0 0.9 0
v 5 0.9 0
f 1 4 3 2
f 5 6 7 8
f 1 2 10 9
f 3 4 8 7
f 1 5 8 4
f 2 3 7 6
)";

class LightOption : public ::testing::Test {
 protected:
  LightOption() { writeFile(folder_ / "room.obj", kRoom); }
  ProgramRun render(std::vector<std::string> more) const {
    std::vector<std::string> words = {"render",      path("room.obj"), "--size",    "32x18",
                                      "--technique", "path",           "--samples", "4"};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  }
  std::string path(const std::string& name) const { return folder_ / name; }
  TemporaryFolder folder_;
};

TEST_F(LightOption, whatWasAddedIsKeptAsAFileThatMakesTheSamePicture) {
  const ProgramRun first = render({"-o", path("a.exr"), "--write-lighting", path("day.json")});
  ASSERT_EQ(first.exitStatus, 0) << first.err;
  EXPECT_NE(first.err.find("no light in the file: added daylight and a ceiling lamp"), std::string::npos) << first.err;
  const ProgramRun again = render({"-o", path("b.exr"), "--lighting", path("day.json")});
  ASSERT_EQ(again.exitStatus, 0) << again.err;
  EXPECT_EQ(again.err.find("added"), std::string::npos) << again.err;
  const Result<Image> a = readImage(path("a.exr")), b = readImage(path("b.exr"));
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(a.value().pixels == b.value().pixels);
  ASSERT_EQ(runProgram({"info", path("room.obj"), "--write-lighting", path("info.json")}).exitStatus, 0);
  EXPECT_EQ(readFile(folder_ / "info.json"), readFile(folder_ / "day.json"));
}

TEST_F(LightOption, decidesWhatShines) {
  const ProgramRun none = render({"-o", path("none.png"), "--light", "none"});
  EXPECT_EQ(none.exitStatus, 0);
  EXPECT_NE(none.err.find("there is no light"), std::string::npos) << none.err;
  const ProgramRun evening = render({"-o", path("evening.png"), "--light", "evening"});
  EXPECT_NE(evening.err.find("the sky after sunset and a ceiling lamp"), std::string::npos) << evening.err;
  const ProgramRun wrong = render({"-o", path("dawn.png"), "--light", "dawn"});
  EXPECT_EQ(wrong.exitStatus, 2);
  EXPECT_NE(wrong.err.find("auto, day, evening, night, none, file"), std::string::npos) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(path("dawn.png")));
}

TEST_F(LightOption, roomsAreCameras) {
  EXPECT_EQ(render({"-o", path("room.png"), "--camera", "Room 1"}).exitStatus, 0);
  const ProgramRun wrong = render({"-o", path("other.png"), "--camera", "Room 7"});
  EXPECT_EQ(wrong.exitStatus, 2);
  EXPECT_NE(wrong.err.find("Room 1"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace roomlight
