#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "batch/records.h"
#include "unit/batch/small_batch.h"

namespace roomlight::batch {
namespace {

using namespace std::chrono_literals;
using testing::readFile;
using testing::SmallBatch;
using testing::writing;

class BatchRunner : public SmallBatch {
 protected:
  RunResult run(const TaskList& list, const RunWish& wish) {
    const Result<RunResult> result = runTasks(list, wish);
    EXPECT_TRUE(result) << result.error();
    return result ? result.value() : RunResult();
  }
  size_t timesRun() const {
    const std::string log = readFile(folder_.path().parent_path() / "log");
    return static_cast<size_t>(std::count(log.begin(), log.end(), '\n'));
  }
  FailedRecord failure(const TaskList& list, size_t i) const {
    const auto record = failedRecord(folder_, idAt(list, i));
    EXPECT_TRUE(record);
    return record.value_or(FailedRecord());
  }
};

TEST_F(BatchRunner, RunsEachTaskOnce) {
  const TaskList all = plan({writing(1), writing(2), writing(3), writing(4), writing(5)});
  const RunResult first = run(all, wish(all, 2));
  EXPECT_EQ(first.done, 5u);
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(outputOf(all, i), fmt::format("{}\n", i + 1));
  const RunResult second = run(all, wish(all, 2));
  EXPECT_EQ(second.already, 5u);
  EXPECT_EQ(timesRun(), 5u);
  expectTidy();
}

TEST_F(BatchRunner, WhatIsPrintedIsTheOutputWhereNothingElseIs) {
  const TaskList all = plan({{"say", "hello"}});
  EXPECT_EQ(run(all, wish(all)).done, 1u);
  EXPECT_EQ(outputOf(all, 0), "hello\n");
}

TEST_F(BatchRunner, ANewPlanKeepsWhatIsDone) {
  const TaskList first = plan({writing(1), writing(2)});
  run(first, wish(first));
  const TaskList second = plan({writing(2), writing(3)});
  const RunResult result = run(second, wish(second));
  EXPECT_EQ(result.already, 1u);
  EXPECT_EQ(result.done, 1u);
  EXPECT_EQ(timesRun(), 3u);
}

TEST_F(BatchRunner, FailuresAreToldByTheirLineAndTriedThreeTimes) {
  const TaskList all =
      plan({{"fail", "1", "the work went wrong"}, {"fail", "2", "no such file"}, {"nothing", "{output}"}});
  const RunResult result = run(all, wish(all));
  EXPECT_EQ(result.failed, 3u);
  EXPECT_EQ(failure(all, 0).line, "the work went wrong");
  EXPECT_EQ(failure(all, 0).tries, 3);
  EXPECT_EQ(failure(all, 1).line, "no such file");
  EXPECT_EQ(failure(all, 1).tries, 1);  // bad input stays bad
  EXPECT_EQ(failure(all, 2).line, "has written no output");
  EXPECT_EQ(told_.size(), 5u);
  expectTidy();
  const RunResult later = run(all, wish(all));
  EXPECT_EQ(later.failed, 3u);
  EXPECT_EQ(told_.size(), 5u);
}

TEST_F(BatchRunner, AgainTriesWhatFailedForGood) {
  const TaskList all = plan({{"fail", "2", "no such file"}});
  run(all, wish(all));
  RunWish again = wish(all);
  again.again = true;
  EXPECT_EQ(run(all, again).failed, 1u);
  EXPECT_EQ(told_.size(), 2u);
}

TEST_F(BatchRunner, AKilledTaskIsStartedAgain) {
  const TaskList all = plan({{"once", "{output}"}});
  EXPECT_EQ(run(all, wish(all)).done, 1u);
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_NE(told_.front().find("killed by signal 9"), std::string::npos) << told_.front();
  EXPECT_FALSE(failedRecord(folder_, idAt(all, 0)));
}

TEST_F(BatchRunner, OutOfMemoryAndTimeAreToldApart) {
  const TaskList all = plan({{"fail", "3", "not enough memory"}, {"slow", "{output}", "x", "60"}});
  RunWish short_ = wish(all);
  short_.timeoutS = 0.2;
  EXPECT_EQ(run(all, short_).failed, 2u);
  EXPECT_EQ(failure(all, 0).how, "memory");
  EXPECT_EQ(failure(all, 1).how, "time");
  EXPECT_EQ(failure(all, 1).line, "took longer than 0.2 s");
  expectTidy();
}

TEST_F(BatchRunner, AChangedInputIsNoticed) {
  testing::writeFile(files_ / "home", "one");
  InputHashes hashes;
  const std::vector<Input> inputs = {{"../home", hashes.of(files_ / "home")}};
  const TaskList all = plan({writing(1), writing(2)}, inputs);
  RunWish first = wish(all);
  first.tasks = {0};
  EXPECT_EQ(run(all, first).done, 1u);
  testing::writeFile(files_ / "home", "another");
  EXPECT_EQ(run(all, wish(all)).failed, 1u);
  EXPECT_NE(failure(all, 1).line.find("home has changed since the plan was made; plan again"), std::string::npos);
  std::filesystem::remove(files_ / "home");
  RunWish again = wish(all);
  again.again = true;
  EXPECT_EQ(run(all, again).failed, 1u);
  EXPECT_NE(failure(all, 1).line.find("has gone"), std::string::npos);
}

TEST_F(BatchRunner, APlanOfAnotherVersionIsRefused) {
  const TaskList all = plan({writing(1)});
  RunWish other = wish(all);
  other.version = "newer";
  const Result<RunResult> result = runTasks(all, other);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().find("planned by roomlight test, this is newer; plan again"), std::string::npos);
}

TEST_F(BatchRunner, AFullDiskEndsTheRunAndIsNobodysFault) {
  const TaskList all = plan({{"full", "out.png"}, writing(2), writing(3)});
  const Result<RunResult> result = runTasks(all, wish(all));
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().find("disk or quota is full"), std::string::npos);
  EXPECT_FALSE(failedRecord(folder_, idAt(all, 0)));
  EXPECT_EQ(timesRun(), 0u);
  expectTidy();
}

TEST_F(BatchRunner, StoppingGivesBackWhatRuns) {
  const TaskList all = plan({writing(1), {"slow", "{output}", "x", "60"}, writing(2)});
  std::atomic<bool> stop{false};
  std::thread later([&] {
    std::this_thread::sleep_for(300ms);
    stop = true;
  });
  RunWish w = wish(all);
  w.stop = &stop;
  const RunResult result = run(all, w);
  later.join();
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.done, 1u);
  EXPECT_EQ(result.left, 2u);
  EXPECT_FALSE(failedRecord(folder_, idAt(all, 1)));
  expectTidy();
}

// The output was renamed, the note of it not yet written.
TEST_F(BatchRunner, WholeOutputWithoutItsNoteIsTaken) {
  const TaskList all = plan({writing(1)});
  run(all, wish(all));
  std::filesystem::remove(folder_.done(idAt(all, 0)));
  EXPECT_EQ(run(all, wish(all)).already, 1u);
  EXPECT_TRUE(std::filesystem::exists(folder_.done(idAt(all, 0))));
  EXPECT_EQ(timesRun(), 1u);
}

TEST_F(BatchRunner, KilledInTheMiddleAgainAndAgainItEndsRight) {
  std::vector<std::vector<std::string>> tasks;
  for (int i = 0; i < 12; ++i) tasks.push_back({"slow", "{output}", fmt::format("{}", i), "0.03"});
  const TaskList all = plan(tasks);
  for (int round = 0; round < 8; ++round) {
    const pid_t child = fork();
    if (child == 0) {
      RunWish w = wish(all, 2);
      w.tell = nullptr;
      _exit(runTasks(all, w) ? 0 : 1);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + 17 * round));
    const BatchStatus during = statusOf(all);
    EXPECT_EQ(during.done + during.running + during.waiting, 12u);
    EXPECT_EQ(during.failed, 0u);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_EQ(statusOf(all).running, 0u);
  }
  const RunResult result = run(all, wish(all, 2));
  EXPECT_EQ(result.done + result.already, 12u);
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(outputOf(all, i), fmt::format("{}\n", i));
  expectTidy();
}

TEST_F(BatchRunner, TwoAtOnceShareTheTasks) {
  std::vector<std::vector<std::string>> tasks;
  for (int i = 0; i < 20; ++i) tasks.push_back(writing(i));
  const TaskList all = plan(tasks);
  std::vector<pid_t> children;
  for (int i = 0; i < 2; ++i) {
    children.push_back(fork());
    if (children.back() == 0) _exit(runTasks(all, wish(all)) ? 0 : 1);
  }
  for (const pid_t child : children) {
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(statusOf(all).done, 20u);
  EXPECT_EQ(timesRun(), 20u);
  expectTidy();
}

// What fails since another has taken the task over, with what it was writing, is no failure.
TEST_F(BatchRunner, ATaskThatWasTakenOverHasNotFailed) {
  const TaskList all = plan({{"stolen"}});
  RunWish w = wish(all);
  w.wait = false;
  const Result<RunResult> result = runTasks(all, w);
  ASSERT_TRUE(result) << result.error();
  EXPECT_EQ(result.value().failed, 0u);
  EXPECT_EQ(result.value().left, 1u);
  EXPECT_FALSE(failedRecord(folder_, idAt(all, 0)));
  EXPECT_TRUE(told_.empty()) << told_[0];
}

TEST_F(BatchRunner, StatusCountsEachTaskOnce) {
  const TaskList all = plan({writing(1), {"fail", "2", "no such file"}, writing(3)});
  RunWish some = wish(all);
  some.tasks = {0, 1};
  run(all, some);
  const BatchStatus status = statusOf(all);
  EXPECT_EQ(status.done, 1u);
  EXPECT_EQ(status.failed, 1u);
  EXPECT_EQ(status.waiting, 1u);
  const std::string text = statusText(all, status);
  EXPECT_NE(text.find("1 done, 0 running, 1 failed, 1 waiting"), std::string::npos) << text;
  EXPECT_NE(text.find("failed: task 1 (" + idAt(all, 1) + "), 1 try: no such file"), std::string::npos) << text;
  EXPECT_EQ(tasksLeft(all, false), std::vector<size_t>{2});
  EXPECT_EQ(tasksLeft(all, true), (std::vector<size_t>{1, 2}));
}

}  // namespace
}  // namespace roomlight::batch
