// Between what the library shows (roomlight::v1) and what it works with (roomlight).
#pragma once

#include <cxxabi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "engine/render.h"
#include "home/open_home.h"
#include "base/parallel.h"
#include "roomlight/layers.h"
#include "roomlight/render.h"
#include "still/layered_home.h"

namespace roomlight::v1 {

// Messages name options as the command line has them; callers know them without dashes.
std::string withoutDashes(std::string message);

inline Error badInput(const std::string& message) { return {ErrorKind::BadInput, withoutDashes(message)}; }
inline Error interrupted() { return {ErrorKind::Interrupted, "interrupted"}; }

// Whether something may be there: what is farther rays cannot reach with any precision.
inline bool isPlace(roomlight::Vec3 v) {
  constexpr float kFarthestM = 1e6f;
  return isFinite(v) && std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kFarthestM;
}

inline roomlight::Vec3 toInternal(Vec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 toPublic(roomlight::Vec3 v) { return {v.x, v.y, v.z}; }

inline RenderProgress toInternal(const Progress& progress) {
  RenderProgress out;
  if (progress.report) out.report = [report = progress.report](const std::string& s, float f) { report(s, f); };
  out.cancelled = progress.cancelled;
  return out;
}

// What `work` returns; what it throws as an error.
template <class Work>
auto guarded(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::NoRoom, "memory does not suffice"};
  } catch (const ResourceError& e) {
    return Error{ErrorKind::NoRoom, e.what()};
  } catch (const std::exception& e) {
    return Error{ErrorKind::Failed, e.what()};
  } catch (const abi::__forced_unwind&) {
    throw;  // a thread that is ended
  } catch (...) {
    return Error{ErrorKind::Failed, "an exception of a progress function"};
  }
}

constexpr int kMostThreads = 1024;
// The same on so many threads; 0: all.
template <class Work>
auto guardedOn(int threads, const Work& work) -> decltype(work()) {
  if (threads < 0 || threads > kMostThreads)
    return badInput("threads: must be from 0 to " + std::to_string(kMostThreads));
  return guarded([&] {
    std::optional<decltype(work())> result;
    withThreads(threads, [&] { result.emplace(work()); });
    return std::move(*result);
  });
}

// Waits for others to be done with what is used by one at a time; owns nothing where that was cancelled.
inline std::unique_lock<std::timed_mutex> turnAt(std::timed_mutex& one, const Progress& progress) {
  constexpr std::chrono::milliseconds kBetweenLooks{50};
  std::unique_lock lock(one, std::defer_lock);
  while (!lock.try_lock_for(kBetweenLooks)) {
    if (progress.cancelled && *progress.cancelled) break;
  }
  return lock;
}

struct Home::State {
  home::OpenedHome opened;
  std::string file, lighting;  // names, for reports
};

struct Image::State {
  const roomlight::Image* image;
  std::shared_ptr<const void> owner;  // of the image
};
Image toPublic(roomlight::Image image);
Image imageIn(std::shared_ptr<const void> owner, const roomlight::Image& image);

struct Picture::State {
  Image image;  // that of `rendered`
  std::shared_ptr<const Rendered> rendered;
  Camera camera;
  std::string view;
  RenderSettings settings;
  Home home;
};

Picture pictureOf(Rendered rendered, const Camera& camera, const std::string& view, const RenderSettings& settings,
                  const Home& home);

struct Layers::State {
  MixHome home;
  std::vector<LayerInfo> list;
};
Result<Layers> toPublic(roomlight::Result<MixHome> opened);

Result<Display> toInternal(const DisplayOptions& options);
Result<RenderSettings> toInternal(const Settings& settings);

}  // namespace roomlight::v1
