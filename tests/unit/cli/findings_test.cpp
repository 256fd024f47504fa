// What the program says about a scene's files: in few lines, with --verbose in full.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::runProgram;
using testing::TemporaryFolder;

size_t linesWith(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

// An .obj of one triangle that can be seen, `flat` without area, and as many lists of materials that are not there as
// `missing` says.
std::string writeFaulty(const TemporaryFolder& folder, int flat, int missing) {
  std::string obj;
  for (int i = 0; i < missing; ++i) obj += fmt::format("mtllib none{}.mtl\n", i);
  obj += "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\n";
  for (int i = 0; i < flat; ++i) obj += "f 1 2 4\n";
  testing::writeFile(folder / "a.obj", obj);
  return folder / "a.obj";
}

ProgramRun render(const TemporaryFolder& folder, const std::string& scene, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"render", scene, "--quality", "draft", "--size", "32x18", "-o", folder / "a.png"};
  words.insert(words.end(), more.begin(), more.end());
  return runProgram(words);
}

TEST(Findings, SmallFaultsAreSummedUp) {
  const TemporaryFolder folder;
  const std::string scene = writeFaulty(folder, 12, 0);
  const ProgramRun run = render(folder, scene);
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.err.find("12 small faults in models mended; --verbose lists them\n"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("without area"), std::string::npos) << run.err;
  const ProgramRun all = render(folder, scene, {"--verbose"});
  EXPECT_NE(all.err.find("12 small faults in models mended:\n  triangles without area are left out (12 times)\n"),
            std::string::npos)
      << all.err;
  EXPECT_EQ(render(folder, scene, {"--quiet"}).err, "");
}

TEST(Findings, LongListsOfWarningsAreCut) {
  const TemporaryFolder folder;
  const std::string scene = writeFaulty(folder, 0, 20);
  const ProgramRun run = render(folder, scene);
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.err.find("'none7.mtl' is missing"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("none8.mtl"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(" more; --verbose lists them\n"), std::string::npos) << run.err;
  const ProgramRun all = render(folder, scene, {"--verbose"});
  EXPECT_EQ(linesWith(all.err, "is missing"), 20u);
  EXPECT_EQ(all.err.find("--verbose"), std::string::npos) << all.err;
}

}  // namespace
}  // namespace roomlight
