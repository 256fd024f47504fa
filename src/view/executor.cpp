#include "view/executor.h"

#include <fmt/format.h>

#include <system_error>

namespace roomlight::view {
namespace {

enum class State : int { Waits, Runs, Done, Over };

}  // namespace

std::thread systemThread(std::function<void()> work) { return std::thread(std::move(work)); }

struct Job::Task {
  Work work;
  std::function<void()> ready;
  std::atomic<bool> cancelled{false};
  std::atomic<State> state{State::Waits};

  // Whether the caller is the one to run or to withdraw it.
  bool claim() {
    State waits = State::Waits;
    return state.compare_exchange_strong(waits, State::Runs);
  }
  void run() {
    if (!claim()) return;
    work(cancelled);
    state = State::Done;
    if (ready) ready();
    work = nullptr, ready = nullptr;
  }
  void end() {
    state = State::Over;
    state.notify_all();
  }
};

bool Job::done() const { return task_ && task_->state >= State::Done; }

void Job::giveUp() const {
  if (task_) task_->cancelled = true;
}

bool Job::withdraw() const {
  if (!task_ || !task_->claim()) return false;
  task_->work = nullptr, task_->ready = nullptr;
  task_->end();
  return true;
}

void Job::join() {
  if (!task_) return;
  for (State s = task_->state; s != State::Over; s = task_->state) task_->state.wait(s);
  task_ = nullptr;
}

Status Executor::post(Role role, Job::Work work, std::function<void()> ready, Job* job) {
  Job posted;
  posted.task_ = std::make_shared<Job::Task>();
  posted.task_->work = std::move(work), posted.task_->ready = std::move(ready);
  Worker& worker = of(role);
  const std::lock_guard lock(worker.mutex);
  if (!worker.runs) {
    if (worker.thread.joinable()) worker.thread.join();  // its last job is over, and it needs no lock
    try {
      worker.thread = start_([&worker] { run(worker); });
    } catch (const std::system_error& e) {
      return Error{fmt::format("no thread can be started: {}; end other programs, or allow more processes (ulimit -u)",
                               e.code().message())};
    }
    worker.runs = true, worker.stays = role == Role::SendFrames || role == Role::RenderFinal;
  }
  worker.jobs.push_back(posted);
  worker.wake.notify_all();
  if (job) *job = std::move(posted);
  return Ok{};
}

void Executor::run(Worker& worker) {
  std::unique_lock lock(worker.mutex);
  while (worker.runs) {
    worker.wake.wait(lock, [&] { return !worker.jobs.empty() || !worker.stays; });
    Job job;
    if (!worker.jobs.empty()) {
      job = worker.jobs.front();
      lock.unlock();
      job.task_->run();
      lock.lock();
      worker.jobs.pop_front();
    }
    worker.runs = worker.stays || !worker.jobs.empty();
    if (job) job.task_->end();  // only now: who waited for it may post the next
  }
}

void Executor::end(Role role) {
  Worker& worker = of(role);
  std::thread thread;
  {
    const std::lock_guard lock(worker.mutex);
    for (const Job& job : worker.jobs) {
      if (!job.withdraw()) job.giveUp();
    }
    worker.stays = false;
    thread = std::move(worker.thread);
  }
  worker.wake.notify_all();
  if (thread.joinable()) thread.join();
}

void Executor::end() {
  for (size_t role = 0; role < workers_.size(); ++role) end(static_cast<Role>(role));
}

}  // namespace roomlight::view
