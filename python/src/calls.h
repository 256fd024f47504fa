// Calls of the library from Python: errors as exceptions, and long work on a thread of its own, so that Python's other
// threads go on and Ctrl-C ends it.
#pragma once

#include <pybind11/pybind11.h>

#include <roomlight/roomlight.h>

#include <functional>
#include <optional>
#include <utility>

namespace roomlight::python {

namespace py = pybind11;

// Raises the exception of roomlight._errors for an error.
[[noreturn]] void raise(const Error& error);

template <class T>
T taken(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(result).value();
}
inline void check(const Status& status) {
  if (!status) raise(status.error());
}

class Call;

// While it lives the interpreter does not end (endLongWork). Made and destroyed with the interpreter's lock.
class Entered {
 public:
  explicit Entered(Call* call = nullptr);  // which is cancelled then
  ~Entered();
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

 private:
  Call* call_;
};

// Runs `work` on the calling thread, without the interpreter's lock. For what takes up to some seconds and cannot be
// cancelled.
template <class Work>
auto unlocked(const Work& work) {
  const Entered entered;
  const py::gil_scoped_release release;
  return work();
}

// Runs `work` on a thread of its own and waits for it without the interpreter's lock. `report`: None, or called as
// report(stage, fraction) with the lock; where it returns False, the work is cancelled. It is cancelled too, and the
// exception goes on from here, where `report` raises or a signal does (KeyboardInterrupt).
void runLong(const py::object& report, const std::function<void(const Progress&)>& work);

// The value of long work, `Result<T> work(progress)`.
template <class Work>
auto valueOfLong(const py::object& report, const Work& work) {
  std::optional<decltype(work(Progress{}))> result;
  runLong(report, [&](const Progress& progress) { result.emplace(work(progress)); });
  return taken(*std::move(result));
}

// Cancels all long work and waits until it and what is unlocked has ended; for the end of the interpreter, after which
// none may call Python.
void endLongWork();

}  // namespace roomlight::python
