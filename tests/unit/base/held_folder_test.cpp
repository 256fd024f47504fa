#include "base/write_file.h"

#include <gtest/gtest.h>

#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::TemporaryFolder;
using testing::writeFile;

TEST(HeldFolder, IsHeldOnceAtATimeUntilTheLastCopyGoes) {
  const TemporaryFolder folder;
  Result<HeldFolder> first = holdFolder(folder / "out");
  ASSERT_TRUE(first && first.value());
  HeldFolder copy = first.value();
  first.value().reset();
  for (int i = 0; i < 2; ++i) {
    const Result<HeldFolder> second = holdFolder(folder / "out");
    ASSERT_TRUE(second) << second.error();
    EXPECT_FALSE(second.value()) << "trying takes nothing away from who holds it";
  }
  copy.reset();
  const Result<HeldFolder> again = holdFolder(folder / "out");
  ASSERT_TRUE(again);
  EXPECT_TRUE(again.value());
}

TEST(HeldFolder, WhatWasMadeAndIsStillEmptyIsRemoved) {
  const TemporaryFolder folder;
  for (const char* name : {"one/two/three", "one/two/", "one/./two"}) {
    ASSERT_TRUE(holdFolder(folder / name).value()) << name;
    EXPECT_EQ(folder.fileCount(), 0u) << name;
  }
}

TEST(HeldFolder, WhatWasThereOrHoldsSomethingStays) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "before");
  ASSERT_TRUE(holdFolder(folder / "before/made").value());
  EXPECT_TRUE(std::filesystem::is_empty(folder / "before"));
  ASSERT_TRUE(holdFolder(folder / "before").value());
  EXPECT_TRUE(std::filesystem::is_empty(folder / "before"));
  HeldFolder held = holdFolder(folder / "written/here").value();
  writeFile(folder / "written/here/result", "1");
  held.reset();
  EXPECT_EQ(testing::readFile(folder / "written/here/result"), "1");
  EXPECT_FALSE(std::filesystem::exists(folder / "written/here/.lock"));
}

TEST(HeldFolder, ALockLeftByAProgramThatWasKilledDoesNotCount) {
  const TemporaryFolder folder;
  writeFile(folder / ".lock", "");
  EXPECT_TRUE(holdFolder(folder.path()).value());
}

TEST(HeldFolder, SaysWhyItCannotBeMade) {
  const TemporaryFolder folder;
  writeFile(folder / "file", "1");
  const Result<HeldFolder> held = holdFolder(folder / "file/out");
  ASSERT_FALSE(held);
  EXPECT_NE(held.error().find("file/out: cannot be made: "), std::string::npos) << held.error();
  EXPECT_EQ(testing::readFile(folder / "file"), "1");
}

}  // namespace
}  // namespace roomlight
