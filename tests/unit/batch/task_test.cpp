#include "unit/batch/small_batch.h"

namespace roomlight::batch {
namespace {

using testing::SmallBatch;
using testing::writing;

const Task kTask{"0123456789abcdef",
                 "pictures",
                 "street house",
                 {{"home", "house"}, {"seed", "3"}},
                 {"render", "../house.sh3d", "-o", "{output}"},
                 "picture.png",
                 {{"../house.sh3d", "aa"}},
                 2.5};

TEST(BatchTask, ComesBackFromItsLine) {
  const Result<Task> back = taskOf(lineOf(kTask));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back.value(), kTask);
  EXPECT_EQ(lineOf(kTask).find('\n'), std::string::npos);
}

TEST(BatchTask, LinesThatAreNoTasksAreErrors) {
  for (const char* line : {"", "{", "[]", "{\"id\": 3}", "{\"id\": \"a\", \"kind\": 1}"})
    EXPECT_FALSE(taskOf(line)) << line;
}

TEST(BatchTask, TheIdIsOfAllThatTheResultDependsOn) {
  const uint64_t id = idOf(kTask, "1");
  EXPECT_EQ(idOf(kTask, "1"), id);
  EXPECT_NE(idOf(kTask, "2"), id);
  Task other = kTask;
  other.arguments.back() = "{folder}";
  EXPECT_NE(idOf(other, "1"), id);
  other = kTask, other.inputs.front().hash = "ab";
  EXPECT_NE(idOf(other, "1"), id);
  other = kTask, other.arguments = {"render", "../house.sh3d-o", "", "{output}"};
  EXPECT_NE(idOf(other, "1"), id);
  other = kTask, other.labels.clear(), other.seconds = 1, other.group = "";  // for people alone
  EXPECT_EQ(idOf(other, "1"), id);
}

TEST_F(SmallBatch, TasksAreReadOneByOne) {
  const TaskList all = plan({writing(1), writing(2), writing(3)});
  ASSERT_EQ(all.size(), 3u);
  for (const size_t i : {2, 0, 1}) {
    const Result<Task> task = all.task(i);
    ASSERT_TRUE(task) << task.error();
    EXPECT_EQ(task.value().arguments, writing(static_cast<int>(i) + 1));
  }
}

TEST_F(SmallBatch, AListThatDoesNotGoWithItsPlanIsAnError) {
  plan({writing(1), writing(2)});
  const std::string tasks = testing::readFile(folder_.tasks());
  testing::writeFile(folder_.tasks(), tasks + tasks);
  EXPECT_NE(TaskList::open(folder_).error().find("plan again"), std::string::npos);
  testing::writeFile(folder_.tasks(), tasks);
  EXPECT_TRUE(TaskList::open(folder_));
  testing::writeFile(folder_.plan(), "{}");
  EXPECT_NE(TaskList::open(folder_).error().find("is damaged"), std::string::npos);
  std::filesystem::remove(folder_.plan());
  EXPECT_NE(TaskList::open(folder_).error().find("make a plan first"), std::string::npos);
}

}  // namespace
}  // namespace roomlight::batch
