#include "batch/slurm.h"
#include "unit/batch/small_batch.h"

namespace roomlight::batch {
namespace {

using testing::readFile;
using testing::SmallBatch;
using testing::writing;

class BatchSlurm : public SmallBatch {
 protected:
  TaskList hundred() {
    std::vector<std::vector<std::string>> tasks;
    for (int i = 0; i < 100; ++i) tasks.push_back(writing(i));
    return plan(tasks);  // of a second each, as estimated
  }
};

TEST_F(BatchSlurm, ChunksTakeAsLongAsWished) {
  const TaskList all = hundred();
  SlurmWish wish;
  wish.program = "/opt/room light/roomlight", wish.chunkMinutes = 0.5, wish.partition = "day", wish.arrayLimit = 2;
  const SlurmPlan plan = slurmPlan(all, tasksLeft(all, true), wish);
  EXPECT_EQ(plan.chunk, 30u);
  EXPECT_EQ(plan.chunks, 4u);
  ASSERT_EQ(plan.arrays.size(), 1u);
  const std::string& script = plan.contents[0];
  EXPECT_NE(script.find("#SBATCH --array=0-3%2\n"), std::string::npos) << script;
  EXPECT_NE(script.find("#SBATCH --partition=day\n"), std::string::npos);
  EXPECT_NE(script.find("#SBATCH --requeue\n"), std::string::npos);
  EXPECT_NE(script.find("exec '/opt/room light/roomlight' batch run "), std::string::npos);
  EXPECT_NE(script.find(" --again "), std::string::npos);  // what has failed is submitted, too
  EXPECT_FALSE(std::filesystem::exists(folder_.slurm()));  // nothing is written yet
}

TEST_F(BatchSlurm, ManyChunksAreSeveralArrays) {
  const TaskList all = hundred();
  SlurmWish wish;
  wish.chunkMinutes = 0, wish.mostInArray = 30;
  const SlurmPlan plan = slurmPlan(all, tasksLeft(all, true), wish);
  EXPECT_EQ(plan.chunk, 1u);
  ASSERT_EQ(plan.arrays.size(), 4u);
  EXPECT_NE(plan.contents[3].find("--array=0-9\n"), std::string::npos);
  EXPECT_NE(plan.contents[3].find("--index $((90 + SLURM_ARRAY_TASK_ID))"), std::string::npos);
}

TEST_F(BatchSlurm, OnlyWhatIsNotDoneIsSubmitted) {
  const TaskList all = hundred();
  RunWish some = wish(all);
  some.tasks = {0, 1, 5};
  ASSERT_TRUE(runTasks(all, some));
  const std::vector<size_t> left = tasksLeft(all, true);
  EXPECT_EQ(left.size(), 97u);
  const SlurmPlan plan = slurmPlan(all, left, {});
  ASSERT_TRUE(writeSlurm(plan, left));
  EXPECT_EQ(readTaskNumbers(plan.list, 0, 4).value(), (std::vector<size_t>{2, 3, 4, 6}));
  EXPECT_EQ(readTaskNumbers(plan.list, 96, 10).value(), std::vector<size_t>{99});
  EXPECT_TRUE(readTaskNumbers(plan.list, 97, 10).value().empty());
  // Jobs that wait go on reading their own list.
  EXPECT_NE(slurmPlan(all, left, {}).list, plan.list);
}

}  // namespace
}  // namespace roomlight::batch
