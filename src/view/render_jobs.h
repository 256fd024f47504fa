// Final pictures and panoramas, made one after the other in the background while the home is looked at; each is kept
 // until it was fetched.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "engine/render.h"
#include "view/executor.h"
#include "view/home.h"
#include "view/message.h"
#include "view/shown.h"

namespace roomlight::view {

struct RenderWork {
  std::string job;     // its name
  std::string window;  // who asked
  RenderSettings settings;
  Camera camera;
  HomeState state;
  ViewDisplay display;
  std::string format;    // "png", "jpg", "exr"
  std::string fileName;  // under which the browser saves it
};

struct FinishedFile {
  std::filesystem::path path;
  std::string name;
};

struct JobNews {
  std::string job, window, stage;
  double fraction = 0;
  double secondsLeft = -1, estimatedError = -1;  // below 0: not known
  std::string state = "running";                 // "done", "cancelled", "failed"
  std::string fileId, fileName, message;         // the first two where there is a picture
  uintmax_t bytes = 0;
};

class RenderJobs {
 public:
  // `tell` is called from the jobs' thread, which begins with the first job, and by cancel().
  RenderJobs(const ViewHome& home, std::function<void(const JobNews&)> tell, Executor& executor);
  ~RenderJobs();

  // Errors: too many wait already; there is no thread. Either may be over in a moment.
  Status add(RenderWork work);
  // False: there is no such job. What there is of its picture is kept.
  bool cancel(const std::string& job);
  // Of memory, as Linux tells; elsewhere infinite.
  static double bytesToSpare();
  // Whether a picture is being made or waits to be.
  bool busy() const;
  // From any thread: a finished picture, until drop() removes it or many newer ones have come.
  std::optional<FinishedFile> find(const std::string& id);
  void drop(const std::string& id);

 private:
  using Finished = std::deque<std::pair<std::string, FinishedFile>>;
  struct Asked {
    RenderWork work;
    Job job;
  };
  void keep(const std::string& id, FinishedFile file);
  void remove(Finished::iterator file);
  void run(std::list<Asked>::iterator asked, const std::atomic<bool>& cancelled);
  Status make(const RenderWork& work, const RenderProgress& progress, JobNews& news);
  Result<FinishedFile> write(const RenderWork& work, const Rendered& rendered) const;

  const ViewHome& home_;
  const std::function<void(const JobNews&)> tell_;
  Executor& executor_;
  std::filesystem::path folder_;  // of the owner's alone
  mutable std::mutex mutex_;  // of what follows
  std::list<Asked> asked_;    // the one that is made first
  Finished finished_;         // with their ids, the oldest first
};

}  // namespace roomlight::view
