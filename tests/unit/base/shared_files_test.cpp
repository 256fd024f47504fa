// Results that processes keep for one another: what is read back, what is removed, and what stays.
#include "base/shared_files.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "base/hash.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::readFile;
using testing::TemporaryFolder;
using testing::writeFile;

constexpr uint64_t kPlenty = 1'000'000;

std::string nameOf(int i) { return hashOf(std::to_string(i)) + "-" + hashOf("settings"); }

std::string found(const SharedFiles& files, const std::string& name) {
  const auto bytes = files.find(name);
  return !bytes ? "error: " + bytes.error() : bytes.value() ? *bytes.value() : "none";
}

void makeOlder(const std::filesystem::path& file, std::chrono::hours by) {
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) - by);
}

TEST(SharedFiles, WhatWasKeptIsFoundByItsNameAlone) {
  const TemporaryFolder folder;
  const SharedFiles files(folder / "a/b", ".light", kPlenty);
  EXPECT_EQ(found(files, nameOf(1)), "none");
  EXPECT_FALSE(std::filesystem::exists(folder / "a")) << "looking makes no folder";
  ASSERT_TRUE(files.keep(nameOf(1), "one").ok());
  ASSERT_TRUE(files.keep(nameOf(2), std::string("t\0o", 3)).ok());
  EXPECT_EQ(found(files, nameOf(1)), "one");
  EXPECT_EQ(found(files, nameOf(2)), std::string("t\0o", 3));
  EXPECT_EQ(found(files, nameOf(3)), "none");
  EXPECT_EQ(found(SharedFiles(folder / "a/b", ".other", kPlenty), nameOf(1)), "none");
  ASSERT_TRUE(files.keep(nameOf(1), "uno").ok());
  EXPECT_EQ(found(files, nameOf(1)), "uno");
}

TEST(SharedFiles, EveryChangeOfAFileIsNoticedAndItGoes) {
  const TemporaryFolder folder;
  const SharedFiles files(folder.path(), ".light", kPlenty);
  const std::string name = nameOf(1), file = folder / (name + ".light");
  ASSERT_TRUE(files.keep(name, "light of a home").ok());
  const std::string right = readFile(file);
  std::vector<std::string> wrong = {"", "x", right + "x", right.substr(0, right.size() - 1), right.substr(1)};
  for (size_t i = 0; i < right.size(); ++i) wrong.push_back(right), wrong.back()[i] ^= 1;
  for (const std::string& bytes : wrong) {
    writeFile(file, bytes);
    EXPECT_NE(found(files, name).find(name + ".light: "), std::string::npos) << bytes;
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(found(files, name), "none");
  }
  // Of another name, though whole.
  writeFile(folder / (nameOf(2) + ".light"), right);
  EXPECT_NE(found(files, nameOf(2)).find("holds something else"), std::string::npos);
}

TEST(SharedFiles, WhatWasUsedLongestAgoGoesAndNothingOfOthers) {
  const TemporaryFolder folder;
  const SharedFiles files(folder.path(), ".light", 3500);
  const std::string others[] = {"notes.light", nameOf(9) + ".txt", "readme", "0123.light", "cafe.txt"};
  for (const std::string& other : others) {
    writeFile(folder / other, std::string(5000, 'x'));
    makeOlder(folder / other, std::chrono::hours(100));
  }
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(files.keep(nameOf(i), std::string(1000, 'x')).ok());
    makeOlder(folder / (nameOf(i) + ".light"), std::chrono::hours(10 - i));
  }
  EXPECT_NE(found(files, nameOf(0)), "none");  // the oldest was just used
  ASSERT_TRUE(files.keep(nameOf(3), std::string(1000, 'x')).ok());
  EXPECT_TRUE(files.has(nameOf(0)));
  EXPECT_FALSE(files.has(nameOf(1)));
  EXPECT_TRUE(files.has(nameOf(2)) && files.has(nameOf(3)));
  for (const std::string& other : others) EXPECT_TRUE(std::filesystem::exists(folder / other)) << other;
  const Status large = files.keep(nameOf(4), std::string(4000, 'x'));
  ASSERT_FALSE(large.ok());
  EXPECT_NE(large.error().find("more than the folder may hold"), std::string::npos) << large.error();
  EXPECT_TRUE(files.has(nameOf(3))) << "what does not fit drives nothing out";
}

TEST(SharedFiles, LeftoversOfProgramsThatWereKilledGoAfterAnHour) {
  const TemporaryFolder folder;
  const SharedFiles files(folder.path(), ".light", kPlenty);
  const std::string part = nameOf(1) + ".light.part-0123abcd", young = nameOf(2) + ".light.part-0123abcd",
                    claim = nameOf(3) + ".claim";
  writeFile(folder / part, "half"), writeFile(folder / young, "half");
  std::filesystem::create_directory(folder / claim);
  writeFile(folder / (claim + "/.lock"), "");
  makeOlder(folder / part, std::chrono::hours(2)), makeOlder(folder / claim, std::chrono::hours(2));
  ASSERT_TRUE(files.keep(nameOf(4), "light").ok());
  EXPECT_FALSE(std::filesystem::exists(folder / part));
  EXPECT_FALSE(std::filesystem::exists(folder / claim));
  EXPECT_TRUE(std::filesystem::exists(folder / young));
}

TEST(SharedFiles, WhereNothingCanBeWrittenThatIsOneLine) {
  const TemporaryFolder folder;
  writeFile(folder / "file", "1");
  const SharedFiles files(folder / "file", ".light", kPlenty);
  EXPECT_EQ(found(files, nameOf(1)), "none");
  EXPECT_FALSE(files.turn(nameOf(1), 10, {}));
  const Status kept = files.keep(nameOf(1), "light");
  ASSERT_FALSE(kept.ok());
  EXPECT_NE(kept.error().find("cannot be written"), std::string::npos) << kept.error();
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(SharedFiles, ASecondWaitsForTheFirstAndThenReads) {
  const TemporaryFolder folder;
  const SharedFiles files(folder.path(), ".light", kPlenty);
  HeldFolder first = files.turn(nameOf(1), 10, {});
  ASSERT_TRUE(first);
  EXPECT_FALSE(files.turn(nameOf(1), 0.1, {})) << "time is over";
  EXPECT_TRUE(files.turn(nameOf(2), 10, {})) << "another name is free";
  std::thread finder([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    EXPECT_TRUE(files.keep(nameOf(1), "light").ok());
  });
  EXPECT_FALSE(files.turn(nameOf(1), 60, {}));
  EXPECT_EQ(found(files, nameOf(1)), "light");
  finder.join();
  first.reset();
  EXPECT_EQ(folder.fileCount(), 1u) << "claims are gone";
}

TEST(SharedFiles, WhoIsKilledHoldsNothing) {
  const TemporaryFolder folder;
  const SharedFiles files(folder.path(), ".light", kPlenty);
  const pid_t child = fork();
  if (child == 0) {
    const HeldFolder held = files.turn(nameOf(1), 1, {});
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(files.turn(nameOf(1), 0, {}));
}

}  // namespace
}  // namespace roomlight
