// The threads of a session and the jobs that they run. Each role has a thread of its own, so that a job never waits for
// one of another role, however long that takes; and what a job leaves its thread in, such as its niceness
// (inBackground), stays within the role.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "base/result.h"

namespace roomlight::view {

// A thread that does the work; throws std::system_error where there is none to be had.
using StartThread = std::function<std::thread(std::function<void()> work)>;

// The system's.
std::thread systemThread(std::function<void()> work);

// By priority, the most urgent first: none waits for one below it, and they end in this order.
enum class Role : unsigned char { Decide, SendFrames, FollowLight, BuildLight, Refine, RenderFinal };

// A job that was posted, or none. Copies mean the same job.
class Job {
 public:
  // `cancelled` becomes true when it is to end. Must not throw.
  using Work = std::function<void(const std::atomic<bool>& cancelled)>;

  explicit operator bool() const { return task_ != nullptr; }
  bool done() const;  // its work has ended, or never will begin
  bool busy() const { return task_ && !done(); }
  void giveUp() const;  // asks it to end; one that waits still begins, and sees that
  bool withdraw() const;  // true: it waited, and will never begin
  void join();  // waits until it is done and has told so; there is none then

 private:
  friend class Executor;
  struct Task;
  std::shared_ptr<Task> task_;
};

// From any thread.
class Executor {
 public:
  explicit Executor(StartThread start = systemThread) : start_(std::move(start)) {}
  ~Executor() { end(); }

  // Runs jobs of a role one after the other, in their order. `ready` is called from its thread once the job is done;
  // `job`, where not null, becomes it. Error: there is no thread, and nothing was begun; it may be tried again. Threads
  // that send or render stay once they are there, others end with their jobs.
  Status post(Role role, Job::Work work, std::function<void()> ready = {}, Job* job = nullptr);
  // Gives up what a role does, withdraws what waits, and waits for the end of its thread.
  void end(Role role);
  // All of them, the most urgent first: nobody posts any more once Decide has ended.
  void end();

 private:
  struct Worker {
    std::mutex mutex;  // of what follows
    std::condition_variable wake;
    std::deque<Job> jobs;  // the one that runs first
    bool runs = false;  // its thread takes jobs
    bool stays = false;  // also without jobs
    std::thread thread;
  };
  static void run(Worker& worker);
  Worker& of(Role role) { return workers_[static_cast<size_t>(role)]; }

  const StartThread start_;
  std::array<Worker, static_cast<size_t>(Role::RenderFinal) + 1> workers_;
};

}  // namespace roomlight::view
