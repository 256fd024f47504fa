// Final pictures made one after the other in the background: their news, their files, cancelling, failures.
#include "view/render_jobs.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "support/rooms.h"
#include "support/threads.h"
#include "unit/view/lit_room.h"

namespace roomlight::view {
namespace {

constexpr int kMostWaiting = 8;

// What is told of jobs. Their thread may be held at the first news of a job.
class News {
 public:
  test::Signals begun, mayGoOn;
  bool holds = false;

  std::function<void(const JobNews&)> listener() {
    return [this](const JobNews& news) { hear(news); };
  }
  // The last of a job.
  JobNews end() {
    ends_.take();
    const std::lock_guard lock(mutex_);
    const JobNews news = ended_.front();
    ended_.erase(ended_.begin());
    return news;
  }

 private:
  void hear(const JobNews& news) {
    bool isFirst = false;
    {
      const std::lock_guard lock(mutex_);
      if (news.state == "running") isFirst = !std::exchange(known_[news.job], true);
      if (news.state != "running") ended_.push_back(news);
    }
    if (news.state != "running") ends_.give();
    if (!isFirst || !holds) return;
    begun.give();
    mayGoOn.take();
  }

  std::mutex mutex_;
  std::map<std::string, bool> known_;
  std::vector<JobNews> ended_;
  test::Signals ends_;
};

RenderWork work(const ViewHome& home, const std::string& job) {
  RenderWork w;
  w.job = job, w.window = "w";
  w.settings.technique = "path", w.settings.samples = 1, w.settings.threads = 1;
  w.settings.width = 16, w.settings.height = 9;
  w.camera = test::cameraAt({1.5f, 1.2f, 2.5f});
  w.state = home.atStart();
  w.format = "png", w.fileName = "room.png";
  return w;
}

// One that ends only if it is cancelled.
RenderWork endless(const ViewHome& home, const std::string& job) {
  RenderWork w = work(home, job);
  w.settings.samples = 0, w.settings.timeLimitS = 86400;
  return w;
}

struct Jobs {
  test::Threads threads;
  ViewHome home{"room", roomWithALamp()};
  News news;
  Executor executor{threads.starter()};
  std::optional<RenderJobs> jobs{std::in_place, home, news.listener(), executor};
};

TEST(RenderJobs, picturesAreKeptUntilTheyAreDropped) {
  Jobs j;
  EXPECT_FALSE(j.jobs->busy());
  ASSERT_TRUE(j.jobs->add(work(j.home, "a")).ok());
  const JobNews done = j.news.end();
  EXPECT_EQ(done.job, "a");
  EXPECT_EQ(done.window, "w");
  EXPECT_EQ(done.state, "done") << done.message;
  EXPECT_EQ(done.fileName, "room.png");
  EXPECT_FALSE(j.jobs->busy());
  const std::optional<FinishedFile> file = j.jobs->find(done.fileId);
  ASSERT_TRUE(file);
  EXPECT_EQ(std::filesystem::file_size(file->path), done.bytes);
  EXPECT_GT(done.bytes, 0u);
  j.jobs->drop(done.fileId);
  EXPECT_FALSE(j.jobs->find(done.fileId));
  EXPECT_FALSE(std::filesystem::exists(file->path));
}

TEST(RenderJobs, oneIsMadeAfterTheOther) {
  Jobs j;
  for (const char* job : {"a", "b", "c"}) ASSERT_TRUE(j.jobs->add(work(j.home, job)).ok());
  for (const char* job : {"a", "b", "c"}) EXPECT_EQ(j.news.end().job, job);
}

TEST(RenderJobs, onlySoManyWaitAndThoseCanBeCancelled) {
  Jobs j;
  j.news.holds = true;
  ASSERT_TRUE(j.jobs->add(work(j.home, "first")).ok());
  j.news.begun.take();
  EXPECT_TRUE(j.jobs->busy());
  for (int i = 0; i < kMostWaiting; ++i) EXPECT_TRUE(j.jobs->add(work(j.home, std::to_string(i))).ok());
  const Status more = j.jobs->add(work(j.home, "more"));
  ASSERT_FALSE(more.ok());
  EXPECT_NE(more.error().find("too many pictures are waiting"), std::string::npos);
  for (int i = 0; i < kMostWaiting; ++i) {
    EXPECT_TRUE(j.jobs->cancel(std::to_string(i)));
    const JobNews cancelled = j.news.end();
    EXPECT_EQ(cancelled.job, std::to_string(i));
    EXPECT_EQ(cancelled.state, "cancelled");
  }
  EXPECT_FALSE(j.jobs->cancel("more"));
  j.news.mayGoOn.give();
  EXPECT_EQ(j.news.end().state, "done");
  EXPECT_FALSE(j.jobs->cancel("first"));
}

TEST(RenderJobs, theOneThatIsMadeCanBeCancelled) {
  Jobs j;
  j.news.holds = true;
  ASSERT_TRUE(j.jobs->add(endless(j.home, "a")).ok());
  j.news.begun.take();
  EXPECT_TRUE(j.jobs->cancel("a"));
  j.news.mayGoOn.give();
  const JobNews cancelled = j.news.end();
  EXPECT_EQ(cancelled.job, "a");
  EXPECT_EQ(cancelled.state, "cancelled");
  j.news.holds = false;
  ASSERT_TRUE(j.jobs->add(work(j.home, "b")).ok());
  EXPECT_EQ(j.news.end().state, "done");
}

TEST(RenderJobs, aFailureIsToldAndTheNextIsMade) {
  Jobs j;
  RenderWork wrong = work(j.home, "a");
  wrong.settings.technique = "magic";
  ASSERT_TRUE(j.jobs->add(wrong).ok());
  const JobNews failed = j.news.end();
  EXPECT_EQ(failed.state, "failed");
  EXPECT_NE(failed.message.find("magic"), std::string::npos);
  EXPECT_EQ(failed.fileId, "");
  ASSERT_TRUE(j.jobs->add(work(j.home, "b")).ok());
  EXPECT_EQ(j.news.end().state, "done");
}

TEST(RenderJobs, canGoWhileAPictureIsMade) {
  Jobs j;
  ASSERT_TRUE(j.jobs->add(work(j.home, "a")).ok());
  const std::optional<FinishedFile> file = j.jobs->find(j.news.end().fileId);
  ASSERT_TRUE(file);
  j.news.holds = true;
  ASSERT_TRUE(j.jobs->add(endless(j.home, "b")).ok());
  j.news.begun.take();
  ASSERT_TRUE(j.jobs->add(work(j.home, "c")).ok());
  j.news.mayGoOn.give();
  j.jobs.reset();
  EXPECT_EQ(j.news.end().job, "b");
  EXPECT_FALSE(std::filesystem::exists(file->path));
}

TEST(RenderJobs, withoutAThreadAPictureIsRefusedAndTheNextIsMade) {
  Jobs j;
  j.threads.none = true;
  const Status refused = j.jobs->add(work(j.home, "a"));
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().find("no thread can be started"), std::string::npos);
  EXPECT_FALSE(j.jobs->busy());
  EXPECT_FALSE(j.jobs->cancel("a"));
  j.threads.none = false;
  ASSERT_TRUE(j.jobs->add(work(j.home, "b")).ok());
  EXPECT_EQ(j.news.end().job, "b");
}

}  // namespace
}  // namespace roomlight::view
