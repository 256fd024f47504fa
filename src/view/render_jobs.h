// Final pictures and panoramas, made one after the other in the background while the home is looked at; each is fetched once.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "engine/render.h"
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
  // `tell` is called from the jobs' thread.
  RenderJobs(const ViewHome& home, std::function<void(const JobNews&)> tell);
  ~RenderJobs();

  // False: too many wait already.
  bool add(RenderWork work);
  // False: there is no such job. What there is of its picture is kept.
  bool cancel(const std::string& job);
  // From any thread; once.
  std::optional<FinishedFile> take(const std::string& id);

 private:
  void run();
  JobNews work(const RenderWork& work);  // its last news
  Result<FinishedFile> write(const RenderWork& work, const Rendered& rendered) const;

  const ViewHome& home_;
  const std::function<void(const JobNews&)> tell_;
  std::filesystem::path folder_;  // of the owner's alone
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<RenderWork> waiting_;
  std::string running_;
  std::map<std::string, FinishedFile> finished_;
  std::atomic<bool> cancelled_{false};
  bool stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace roomlight::view
