// What the program answers to words it does not know.
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::runProgram;
using testing::TemporaryFolder;

void expectLine(const std::vector<std::string>& words, const std::string& expected) {
  const ProgramRun run = runProgram(words);
  EXPECT_EQ(run.exitStatus, 2) << expected;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(expected), std::string::npos) << run.err;
  EXPECT_EQ(run.out, "");
}

TEST(Words, AMisspeltCommandIsToldTheNearest) {
  expectLine({"rendr", "a.glb", "-o", "a.png"}, "roomlight: unknown command 'rendr'; did you mean render?");
  expectLine({"mesaure", "a.glb"}, "did you mean measure?");
  expectLine({"optimize", "a.glb"}, "did you mean optimise?");
  expectLine({"xyzzy"}, "unknown command 'xyzzy'; there are render, view,");
}

TEST(Words, AFileWithoutACommandIsToldHowToSeeIt) {
  const TemporaryFolder folder;
  const std::string room = testing::writeRoom(folder);
  expectLine({room}, "roomlight: to see it: roomlight render " + room + " -o picture.png, or roomlight view " + room);
  const std::string path = folder.path().string();
  expectLine({path}, "roomlight: to see it: roomlight render " + path);
  testing::writeFile(folder / "a.ies", "");
  testing::writeFile(folder / "a.exr", "");
  expectLine({folder / "a.ies"}, "to read it: roomlight info " + (folder / "a.ies").string());
  expectLine({folder / "a.exr"}, "to see it: roomlight develop ");
  expectLine({folder / "none.glb"}, "none.glb: no such file");
  expectLine({}, "say what to do");
}

TEST(Words, AMisspeltOptionIsToldTheNearest) {
  expectLine({"render", "a.glb", "--qualty", "draft", "-o", "a.png"},
             "unknown option '--qualty' of render; did you mean --quality?");
  expectLine({"render", "a.glb", "--outptu=a.png"}, "unknown option '--outptu' of render; did you mean --output?");
  expectLine({"measure", "a.glb", "--color-of-my-cat"},
             "unknown option '--color-of-my-cat' of measure; see roomlight measure --help");
}

TEST(Words, OptionsThatThereAreArePassedOn) {
  const ProgramRun run = runProgram({"info", "--help"});
  EXPECT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.out.find("--objects"), std::string::npos);
  EXPECT_EQ(runProgram({"--version"}).exitStatus, 0);
}

}  // namespace
}  // namespace roomlight
