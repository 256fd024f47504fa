// The threads of a session and their jobs: what overlaps, what waits, how jobs end, and where there are no threads.
#include "view/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <vector>

#include "support/threads.h"

namespace roomlight::view {
namespace {

constexpr Role kRoles[] = {Role::Decide,     Role::SendFrames, Role::FollowLight,
                           Role::BuildLight, Role::Refine,     Role::RenderFinal};

// Posts jobs that begin and then wait until they may go on, and records which were run, in their order.
class Jobs {
  std::mutex mutex_;
  std::vector<int> order_;

 public:
  test::Threads threads;
  test::Signals begun, mayGoOn, ready;

  Job::Work held() {
    return [this](const std::atomic<bool>&) {
      begun.give();
      mayGoOn.take();
    };
  }
  // Ends when it is told to.
  Job::Work endless() {
    return [this](const std::atomic<bool>& cancelled) {
      begun.give();
      while (!cancelled) std::this_thread::yield();
    };
  }
  Job::Work recorded(int number) {
    return [this, number](const std::atomic<bool>& cancelled) {
      const std::lock_guard lock(mutex_);
      if (!cancelled) order_.push_back(number);
    };
  }
  Job post(Role role, Job::Work work) {
    Job job;
    const Status posted = executor.post(
        role, std::move(work), [this] { ready.give(); }, &job);
    EXPECT_TRUE(posted.ok()) << posted.error();
    return job;
  }
  std::vector<int> order() {
    const std::lock_guard lock(mutex_);
    return order_;
  }

  Executor executor{threads.starter()};  // the last: its end waits for jobs, which need what is above
};

TEST(Executor, runsAJobAndTellsOfItsEnd) {
  Jobs jobs;
  Job job = jobs.post(Role::Refine, jobs.held());
  EXPECT_TRUE(job);
  jobs.begun.take();
  EXPECT_TRUE(job.busy());
  EXPECT_FALSE(job.done());
  jobs.mayGoOn.give();
  jobs.ready.take();
  EXPECT_TRUE(job.done());
  EXPECT_FALSE(job.busy());
  job.join();
  EXPECT_FALSE(job);
}

TEST(Executor, aJobOfNoneIsNothingToWaitFor) {
  Job none;
  EXPECT_FALSE(none.busy() || none.done() || none.withdraw());
  none.giveUp();
  none.join();
}

// Each is done while jobs of all other roles are under way: neither frames nor light wait for a render.
TEST(Executor, noRoleWaitsForAnother) {
  for (const Role role : kRoles) {
    Jobs jobs;
    for (const Role other : kRoles) {
      if (other != role) jobs.post(other, jobs.held()), jobs.begun.take();
    }
    jobs.post(role, jobs.recorded(1)).join();
    EXPECT_EQ(jobs.order(), std::vector<int>{1});
    jobs.mayGoOn.give(static_cast<int>(std::size(kRoles)));
  }
}

TEST(Executor, jobsOfARoleRunInTheirOrderOneAfterTheOther) {
  Jobs jobs;
  jobs.post(Role::SendFrames, jobs.held());
  jobs.begun.take();
  Job last;
  for (const int number : {1, 2, 3}) last = jobs.post(Role::SendFrames, jobs.recorded(number));
  EXPECT_TRUE(last.busy());
  EXPECT_EQ(jobs.order(), std::vector<int>{});
  jobs.mayGoOn.give();
  last.join();
  EXPECT_EQ(jobs.order(), (std::vector<int>{1, 2, 3}));
}

// The most urgent first: each goes on until it is told to end.
TEST(Executor, endsRolesByPriority) {
  Jobs jobs;
  std::mutex mutex;
  std::vector<Role> ended;
  for (const Role role : {Role::RenderFinal, Role::BuildLight, Role::SendFrames, Role::Refine, Role::FollowLight}) {
    jobs.post(role, [&, role](const std::atomic<bool>& cancelled) {
      jobs.begun.give();
      while (!cancelled) std::this_thread::yield();
      const std::lock_guard lock(mutex);
      ended.push_back(role);
    });
    jobs.begun.take();
  }
  jobs.executor.end();
  EXPECT_EQ(ended, (std::vector<Role>{Role::SendFrames, Role::FollowLight, Role::BuildLight, Role::Refine,
                                      Role::RenderFinal}));
}

TEST(Executor, whatHasBegunIsGivenUp) {
  Jobs jobs;
  Job job = jobs.post(Role::BuildLight, jobs.endless());
  jobs.begun.take();
  EXPECT_FALSE(job.withdraw());
  EXPECT_TRUE(job.busy());
  job.giveUp();
  job.join();
  EXPECT_TRUE(jobs.ready.tryToTake());
}

TEST(Executor, whatWaitsIsWithdrawnAndNothingOfItIsKept) {
  Jobs jobs;
  Job first = jobs.post(Role::RenderFinal, jobs.held());
  jobs.begun.take();
  auto kept = std::make_shared<int>(1);
  Job job = jobs.post(Role::RenderFinal, [kept, work = jobs.recorded(1)](const std::atomic<bool>& c) { work(c); });
  Job next = jobs.post(Role::RenderFinal, jobs.recorded(2));
  EXPECT_TRUE(job.withdraw());
  EXPECT_EQ(kept.use_count(), 1);
  EXPECT_TRUE(job.done());
  EXPECT_FALSE(job.withdraw());
  job.join();  // at once, while the first is under way
  EXPECT_TRUE(first.busy());
  jobs.mayGoOn.give();
  next.join();
  EXPECT_EQ(jobs.order(), std::vector<int>{2});
}

// Whoever waits for its end hears of it.
TEST(Executor, whatIsGivenUpBeforeItBeginsBeginsAndEnds) {
  Jobs jobs;
  jobs.post(Role::BuildLight, jobs.held());
  jobs.begun.take();
  Job job = jobs.post(Role::BuildLight, jobs.recorded(1));
  job.giveUp();
  EXPECT_TRUE(job.busy());
  jobs.mayGoOn.give();
  job.join();
  EXPECT_EQ(jobs.order(), std::vector<int>{});
  jobs.ready.take();
  jobs.ready.take();
}

TEST(Executor, whatAJobHoldsIsGoneOnceItWasWaitedFor) {
  Jobs jobs;
  for (const Role role : kRoles) {
    auto kept = std::make_shared<int>(1);
    Job job;
    ASSERT_TRUE(jobs.executor.post(
        role, [kept](const std::atomic<bool>&) {}, [kept] {}, &job));
    job.join();
    EXPECT_EQ(kept.use_count(), 1);
  }
}

TEST(Executor, endsWithJobsThatWait) {
  Jobs jobs;
  Job under, waiting;
  {
    Executor executor;
    ASSERT_TRUE(executor.post(Role::RenderFinal, jobs.endless(), {}, &under));
    ASSERT_TRUE(executor.post(Role::RenderFinal, jobs.recorded(1), {}, &waiting));
    jobs.begun.take();
  }
  EXPECT_TRUE(under.done());
  EXPECT_TRUE(waiting.done());
  waiting.join();
  EXPECT_EQ(jobs.order(), std::vector<int>{});
}

TEST(Executor, aRoleThatWasEndedCanBeginAgain) {
  Jobs jobs;
  for (const Role role : {Role::Refine, Role::RenderFinal}) {
    jobs.post(role, jobs.endless());
    jobs.begun.take();
    jobs.executor.end(role);
    jobs.post(role, jobs.recorded(1)).join();
  }
  EXPECT_EQ(jobs.order(), (std::vector<int>{1, 1}));
}

TEST(Executor, withoutAThreadNothingIsBegunAndItMayBeTriedAgain) {
  Jobs jobs;
  for (const Role role : kRoles) {
    jobs.threads.none = true;
    Job job;
    const Status refused = jobs.executor.post(
        role, jobs.recorded(1), [] { ADD_FAILURE() << "it was not begun"; }, &job);
    ASSERT_FALSE(refused.ok());
    EXPECT_FALSE(job);
    EXPECT_EQ(refused.error().find("no thread can be started: "), 0u);
    EXPECT_EQ(refused.error().find('\n'), std::string::npos);
    jobs.threads.none = false;
    jobs.post(role, jobs.recorded(2)).join();
  }
  EXPECT_EQ(jobs.order(), std::vector<int>(std::size(kRoles), 2));
}

// A thread is started when there is something to do.
TEST(Executor, threadsThatSendAndRenderStayOthersEndWithTheirJobs) {
  for (const Role role : kRoles) {
    const bool stays = role == Role::SendFrames || role == Role::RenderFinal;
    Jobs jobs;
    jobs.post(role, jobs.recorded(1)).join();
    jobs.threads.none = true;
    EXPECT_EQ(jobs.executor.post(role, jobs.recorded(2)).ok(), stays);
  }
}

TEST(Executor, oneThreadDoesForJobsThatWait) {
  Jobs jobs;
  jobs.post(Role::FollowLight, jobs.held());
  jobs.begun.take();
  jobs.threads.none = true;
  Job next = jobs.post(Role::FollowLight, jobs.recorded(1));
  jobs.mayGoOn.give();
  next.join();
  EXPECT_EQ(jobs.order(), std::vector<int>{1});
}

}  // namespace
}  // namespace roomlight::view
