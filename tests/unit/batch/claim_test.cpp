#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "batch/claim.h"
#include "unit/batch/small_batch.h"

namespace roomlight::batch {
namespace {

using testing::SmallBatch;
using testing::writing;

constexpr const char* kId = "0123456789abcdef";

class BatchClaim : public SmallBatch {
 protected:
  BatchClaim() { std::filesystem::create_directories(folder_.claims()); }
  Owner other(const std::string& host) const {
    Owner o = thisOwner();
    o.host = host, o.token = "other";
    return o;
  }
  void age(double seconds) const {
    timespec times[2] = {};
    clock_gettime(CLOCK_REALTIME, &times[0]);
    times[0].tv_sec -= static_cast<time_t>(seconds), times[1] = times[0];
    ASSERT_EQ(utimensat(AT_FDCWD, (folder_.claims() / kId).c_str(), times, 0), 0);
  }
};

TEST_F(BatchClaim, IsOfOneAtATime) {
  Claims mine(folder_), others(folder_, 300, other("there"));
  EXPECT_TRUE(mine.take(kId).value());
  EXPECT_FALSE(others.take(kId).value());
  EXPECT_EQ(others.liveCount(), 1u);
  mine.release(kId);
  EXPECT_TRUE(others.take(kId).value());
}

TEST_F(BatchClaim, GoesWithItsHolder) {
  {
    Claims mine(folder_);
    EXPECT_TRUE(mine.take(kId).value());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.claims()));
}

// The owner's process has ended without letting go.
TEST_F(BatchClaim, OfADeadProcessHereIsTakenOverAtOnceWithWhatItLeft) {
  const pid_t child = fork();
  if (child == 0) {
    Owner self = thisOwner();
    self.token = "child";
    Claims* claims = new Claims(folder_, 300, self);  // is not let go
    _exit(claims->take(kId).value() ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  const auto left = folder_.path() / fmt::format("out/01/{}.child.tmp", kId);
  std::filesystem::create_directories(left);
  Claims mine(folder_);
  ASSERT_EQ(mine.all().size(), 1u);
  EXPECT_TRUE(mine.all().front().isStale);
  EXPECT_TRUE(mine.take(kId).value());
  EXPECT_FALSE(std::filesystem::exists(left));
}

// As under a parent that does not ask for the ends of its children.
TEST_F(BatchClaim, OfAProcessThatIsDeadButStillListedIsTakenOver) {
  const pid_t child = fork();
  if (child == 0) {
    Owner self = thisOwner();
    self.token = "child";
    Claims* claims = new Claims(folder_, 300, self);
    _exit(claims->take(kId).value() ? 0 : 1);
  }
  siginfo_t ended{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  Claims mine(folder_);
  EXPECT_TRUE(mine.take(kId).value());
  waitpid(child, nullptr, 0);
}

TEST_F(BatchClaim, ThatWasTakenOverIsNoLongerHeld) {
  Claims there(folder_, 300, other("there")), mine(folder_);
  ASSERT_TRUE(there.take(kId).value());
  EXPECT_TRUE(there.holds(kId));
  age(310);
  ASSERT_TRUE(mine.take(kId).value());
  EXPECT_FALSE(there.holds(kId));
  EXPECT_TRUE(mine.holds(kId));
}

// Letting go can fail for a moment, as on NFS: what is still its own is no other's.
TEST_F(BatchClaim, OfItsOwnIsTakenAgain) {
  Claims mine(folder_);
  ASSERT_TRUE(mine.take(kId).value());
  const std::string claim = testing::readFile(folder_.claims() / kId);
  mine.release(kId);
  testing::writeFile(folder_.claims() / kId, claim);
  EXPECT_TRUE(mine.take(kId).value());
  EXPECT_FALSE(mine.take(kId).value()) << "a task that is listed twice";
}

TEST_F(BatchClaim, OfAnotherMachineIsTakenOverWithoutASignOfLife) {
  Claims there(folder_, 300, other("there")), mine(folder_);
  ASSERT_TRUE(there.take(kId).value());
  age(290);
  EXPECT_FALSE(mine.take(kId).value());
  age(310);
  EXPECT_TRUE(mine.take(kId).value());
  there.release(kId);  // it is no longer its own
  EXPECT_EQ(mine.liveCount(), 1u);
}

TEST_F(BatchClaim, OfAnEarlierRunOfTheSameSlurmJobIsTakenOverAtOnce) {
  Owner before = other("node1"), after = other("node2");
  before.job = after.job = "12_3", after.restarts = 1, after.token = "after";
  Claims first(folder_, 300, before), second(folder_, 300, after);
  ASSERT_TRUE(first.take(kId).value());
  EXPECT_TRUE(second.take(kId).value());
}

TEST_F(BatchClaim, HalfWrittenIsFreeWhenItIsOld) {
  testing::writeFile(folder_.claims() / kId, "{\"host\"");
  Claims mine(folder_);
  EXPECT_FALSE(mine.take(kId).value());
  age(400);
  EXPECT_TRUE(mine.take(kId).value());
}

}  // namespace
}  // namespace roomlight::batch
