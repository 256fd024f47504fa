// What all headers of the library share: errors as values, progress of long work, places.
//
// Units are metres, and those of light: cd/m² for pictures, lux for meters. Axes are glTF's: x to the right, y up, z
// towards the viewer. Nothing throws; what can go wrong returns a Result. Objects of the library are handles that
// threads may share and copies of which are cheap.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#if defined(_WIN32) && !defined(ROOMLIGHT_STATIC)
#ifdef ROOMLIGHT_BUILDS_LIBRARY
#define ROOMLIGHT_API __declspec(dllexport)
#else
#define ROOMLIGHT_API __declspec(dllimport)
#endif
#elif defined(_WIN32)
#define ROOMLIGHT_API
#else
#define ROOMLIGHT_API __attribute__((visibility("default")))
#endif

// Versions of the interface are inline namespaces; the library's own source has other names in roomlight.
#ifdef ROOMLIGHT_BUILDS_LIBRARY
#define ROOMLIGHT_NAMESPACE roomlight::v1
#else
#define ROOMLIGHT_NAMESPACE roomlight::inline v1
#endif

namespace ROOMLIGHT_NAMESPACE {

enum class ErrorKind {
  BadInput,     // a file, a name or a value: the message says where and what to do
  NoRoom,       // memory, or the machine, does not suffice
  Interrupted,  // by Progress::cancelled
  Failed,       // anything else
};

struct Error {
  ErrorKind kind = ErrorKind::BadInput;
  std::string message = {};  // one line
};

// A value or an error. `value()` must not be asked for where there is none.
template <class T>
class Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Error error) : content_(std::move(error)) {}
  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }
  T& value() & { return *std::get_if<0>(&content_); }
  const T& value() const& { return *std::get_if<0>(&content_); }
  T&& value() && { return std::move(*std::get_if<0>(&content_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const { return *std::get_if<1>(&content_); }

 private:
  std::variant<T, Error> content_;
};

struct Done {};
using Status = Result<Done>;

// How long work tells its caller how far it is, and hears that it shall end.
struct Progress {
  // The stage's name and the fraction of it that is done, 0 to 1. Called by one thread at a time, not always the
  // caller's.
  std::function<void(std::string_view stage, float fraction)> report = {};
  const std::atomic<bool>* cancelled = nullptr;  // may become true at any time
};

struct Vec3 {
  float x = 0, y = 0, z = 0;
};

}  // namespace ROOMLIGHT_NAMESPACE
