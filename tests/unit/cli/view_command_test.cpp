// roomlight view: the link that is printed, to whom it leads, and what happens where nobody can read it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "unit/cli/program.h"

namespace roomlight::testing {
namespace {

class ViewCommand : public ::testing::Test {
 protected:
  ViewCommand() {
    writeFile(folder_ / "index.html", "<!doctype html>");
    words_ = {"view", writeRoom(folder_).string(), "--viewer", folder_.path().string(), "--no-open"};
  }
  std::vector<std::string> with(const std::vector<std::string>& more) const {
    std::vector<std::string> words = words_;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  // It ended by itself, with one line that says so.
  static void expectNobodyReads(const ProgramRun& run) {
    EXPECT_EQ(run.exitStatus, 1) << run.err;
    EXPECT_EQ(run.err.rfind("roomlight: nobody can read the page's link", 0), 0u) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }

  TemporaryFolder folder_;
  std::vector<std::string> words_;
};

TEST_F(ViewCommand, endsWhereItsOutputIsClosed) { expectNobodyReads(runProgramInto(kClosed, with({"--quiet"}))); }

TEST_F(ViewCommand, endsWhereTheReaderOfItsOutputIsGone) {
  int ends[2];
  ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
  close(ends[0]);
  expectNobodyReads(runProgramInto(ends[1], with({"--quiet"})));
  close(ends[1]);
}

TEST_F(ViewCommand, endsWhereItsOutputTakesNothing) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  if (full < 0) GTEST_SKIP() << "this system has no /dev/full";
  expectNobodyReads(runProgramInto(full, with({"--quiet"})));
  close(full);
}

// The warning comes just before the links.
TEST_F(ViewCommand, aMachinesOwnAddressesHaveALinkEach) {
  const ProgramRun run = runProgram(with({"--address", "0.0.0.0"}), "nothing is encrypted");
  EXPECT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_EQ(run.out.rfind("http://", 0), 0u) << run.out;
  EXPECT_EQ(run.out.find("0.0.0.0"), std::string::npos) << run.out;
  const auto count = [&](const std::string& text) {
    size_t found = 0;
    for (size_t at = run.out.find(text); at != std::string::npos; at = run.out.find(text, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("http://"), count("\n"));
  EXPECT_EQ(count("/#"), count("\n"));
  if (count("\n") > 1) {
    EXPECT_EQ(count("127.0.0.1"), 0u) << run.out;
  }
}

TEST_F(ViewCommand, windowsAreCounted) {
  for (const char* count : {"0", "65", "many"}) {
    const ProgramRun run = runProgram(with({"--windows", count}));
    EXPECT_EQ(run.exitStatus, 2);
    EXPECT_NE(run.err.find("--windows"), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace roomlight::testing
