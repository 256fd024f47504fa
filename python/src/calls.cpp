#include "calls.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

namespace roomlight::python {

namespace {

constexpr std::chrono::milliseconds kBetweenSignals{100};

const char* nameOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::BadInput: return "bad input";
    case ErrorKind::NoRoom: return "no room";
    case ErrorKind::Interrupted: return "interrupted";
    case ErrorKind::Failed: break;
  }
  return "failed";
}

}  // namespace

// Long work that one thread does and another waits for.
class Call {
 public:
  explicit Call(const py::object& report) : report_(report) {}

  void work(const std::function<void(const Progress&)>& work);
  bool waitFor(std::chrono::milliseconds time);
  void cancel() { cancelled_ = true; }
  // Keeps the first exception, and cancels.
  void fail(std::exception_ptr exception);
  std::exception_ptr failure() const { return failure_; }

 private:
  void report(std::string_view stage, float fraction);

  const py::object& report_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool isOver_ = false;
  std::exception_ptr failure_;
};

void Call::fail(std::exception_ptr exception) {
  const std::scoped_lock lock(mutex_);
  if (!failure_) failure_ = std::move(exception);
  cancelled_ = true;
}

void Call::report(std::string_view stage, float fraction) {
  if (cancelled_) return;
  const py::gil_scoped_acquire acquire;
  try {
    const py::object answer = report_(py::str(stage.data(), stage.size()), fraction);
    if (!answer.is_none() && !answer.cast<bool>()) cancelled_ = true;
  } catch (...) {
    fail(std::current_exception());
  }
}

void Call::work(const std::function<void(const Progress&)>& work) {
  try {
    Progress progress;
    if (!report_.is_none()) progress.report = [this](std::string_view s, float f) { report(s, f); };
    progress.cancelled = &cancelled_;
    work(progress);
  } catch (...) {
    fail(std::current_exception());
  }
  const std::scoped_lock lock(mutex_);
  isOver_ = true;
  ended_.notify_all();
}

bool Call::waitFor(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, time, [this] { return isOver_; });
}

namespace {

// What is under way, to be ended before the interpreter is.
struct Running {
  std::mutex mutex;
  std::condition_variable fewer;
  std::set<Call*> calls;  // of those that can be cancelled
  int count = 0;
  bool isClosed = false;
  pid_t process = getpid();  // a forked one has none of the threads
};

Running& running() {
  static auto* all = new Running;  // outlives threads that still wait when the process ends
  return *all;
}

void waitWithSignals(Call& call) {
  const py::gil_scoped_release release;
  while (!call.waitFor(kBetweenSignals)) {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) call.fail(std::make_exception_ptr(py::error_already_set()));
  }
}

// Text that may be a file's name in any encoding.
py::str textOf(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "backslashreplace"));
}

}  // namespace

Entered::Entered(Call* call) : call_(call) {
  const std::scoped_lock lock(running().mutex);
  ++running().count;
  if (!call_) return;
  if (running().isClosed) call_->cancel();
  running().calls.insert(call_);
}

Entered::~Entered() {
  const std::scoped_lock lock(running().mutex);
  --running().count;
  running().calls.erase(call_);
  running().fewer.notify_all();
}

void raise(const Error& error) {
  const py::object exception =
      py::module_::import("roomlight._errors").attr("exception_of")(nameOf(error.kind), textOf(error.message));
  PyErr_SetObject(py::type::of(exception).ptr(), exception.ptr());
  throw py::error_already_set();
}

void runLong(const py::object& report, const std::function<void(const Progress&)>& work) {
  Call call(report);
  {
    const Entered entered(&call);
    std::thread worker([&] { call.work(work); });
    waitWithSignals(call);
    worker.join();
  }
  // Moved out: the exception is Python's, and dies with the lock held.
  if (const std::exception_ptr failure = call.failure()) std::rethrow_exception(failure);
}

void endLongWork() {
  if (getpid() != running().process) return;
  const py::gil_scoped_release release;
  std::unique_lock lock(running().mutex);
  running().isClosed = true;
  for (Call* call : running().calls) call->cancel();
  running().fewer.wait(lock, [] { return running().count == 0; });
}

}  // namespace roomlight::python
