#include "view/render_jobs.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <limits>
#include <random>

#include "base/image_io.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "look/display.h"

namespace roomlight::view {
namespace {

constexpr size_t kMostWaiting = 8, kMostFinished = 16;
constexpr double kTellEveryS = 0.25;

template <class Files>
auto fileOf(Files& files, const std::string& id) {
  return std::find_if(files.begin(), files.end(), [&](const auto& f) { return f.first == id; });
}

std::string newId() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

// Tells now and then how far a job is.
class Teller {
 public:
  Teller(const RenderWork& work, const std::function<void(const JobNews&)>& tell) : tell_(tell) {
    news_.job = work.job, news_.window = work.window;
  }
  void report(const std::string& stage, float fraction) {
    if (stage != news_.stage) stageWatch_ = Stopwatch();
    const bool isNew = stage != news_.stage;
    news_.stage = stage, news_.fraction = static_cast<double>(fraction);
    const double seconds = stageWatch_.seconds();
    news_.secondsLeft = fraction > 0.02f && seconds > 1 ? seconds * (1 / static_cast<double>(fraction) - 1) : -1;
    if (!isNew && watch_.seconds() < kTellEveryS) return;
    watch_ = Stopwatch();
    tell_(news_);
  }
  void estimate(double relativeError) { news_.estimatedError = relativeError; }
  JobNews& news() { return news_; }

 private:
  const std::function<void(const JobNews&)>& tell_;
  JobNews news_;
  Stopwatch watch_, stageWatch_;
};

}  // namespace

RenderJobs::RenderJobs(const ViewHome& home, std::function<void(const JobNews&)> tell, StartThread start)
    : home_(home), tell_(std::move(tell)), start_(std::move(start)) {
  std::error_code code;
  std::string pattern = (std::filesystem::temp_directory_path(code) / "roomlight-renders-XXXXXX").string();
  if (!code && mkdtemp(pattern.data())) folder_ = pattern;
}

RenderJobs::~RenderJobs() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true, cancelled_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

Status RenderJobs::add(RenderWork work) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMostWaiting) return Error{"too many pictures are waiting; cancel one"};
    if (!thread_.joinable()) {
      Result<std::thread> started = tryToStart(start_, [this] { run(); });
      if (!started) return Error{started.error()};
      thread_ = std::move(started).value();
    }
    waiting_.push_back(std::move(work));
  }
  wake_.notify_all();
  return Ok{};
}

bool RenderJobs::cancel(const std::string& job) {
  JobNews news;
  {
    const std::lock_guard lock(mutex_);
    if (running_ == job) {
      cancelled_ = true;
      return true;
    }
    const auto waits =
        std::find_if(waiting_.begin(), waiting_.end(), [&](const RenderWork& w) { return w.job == job; });
    if (waits == waiting_.end()) return false;
    news.job = job, news.window = waits->window, news.state = "cancelled";
    waiting_.erase(waits);
  }
  tell_(news);
  return true;
}

double RenderJobs::bytesToSpare() {
  std::ifstream in("/proc/meminfo");
  std::string key;
  for (double kib = 0; in >> key >> kib; in.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    if (key == "MemAvailable:") return kib * 1024;
  }
  return std::numeric_limits<double>::infinity();
}

bool RenderJobs::busy() const {
  const std::lock_guard lock(mutex_);
  return !running_.empty() || !waiting_.empty();
}

std::optional<FinishedFile> RenderJobs::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto file = fileOf(finished_, id);
  if (file == finished_.end()) return {};
  return file->second;
}

void RenderJobs::drop(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto file = fileOf(finished_, id);
  if (file != finished_.end()) remove(file);
}

void RenderJobs::keep(const std::string& id, FinishedFile file) {
  const std::lock_guard lock(mutex_);
  if (finished_.size() >= kMostFinished) remove(finished_.begin());  // nobody came for it
  finished_.emplace_back(id, std::move(file));
}

// From disk too; with the lock held.
void RenderJobs::remove(Finished::iterator file) {
  std::error_code ignored;
  std::filesystem::remove(file->second.path, ignored);
  finished_.erase(file);
}

void RenderJobs::run() {
  while (true) {
    RenderWork next;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || !waiting_.empty(); });
      if (stop_) return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
      running_ = next.job, cancelled_ = false;
    }
    const JobNews last = work(next);
    {
      const std::lock_guard lock(mutex_);
      running_.clear();
    }
    tell_(last);  // who hears of the end can no longer cancel it
  }
}

JobNews RenderJobs::work(const RenderWork& work) {
  Teller teller(work, tell_);
  RenderProgress progress;
  progress.report = [&](const std::string& stage, float fraction) { teller.report(stage, fraction); };
  progress.estimate = [&](double relativeError, double) { teller.estimate(relativeError); };
  progress.cancelled = &cancelled_;
  JobNews& news = teller.news();
  Status made = Ok{};
  try {
    inBackground(work.settings.threads, [&] { made = make(work, progress, news); });
  } catch (const std::bad_alloc&) {
    made = Error{"not enough memory for this picture"};
  } catch (const std::exception& e) {
    made = Error{fmt::format("the picture could not be made: {}", e.what())};
  }
  if (!made) news.state = "failed", news.message = made.error();
  return news;
}

Status RenderJobs::make(const RenderWork& work, const RenderProgress& progress, JobNews& news) {
  Result<Scene> scene = sceneIn(home_, work.state);
  if (!scene) return Error{scene.error()};
  const Result<Rendered> rendered = render(scene.value(), work.camera, work.settings, progress);
  if (!rendered) return Error{rendered.error()};
  news.state = rendered.value().complete ? "done" : "cancelled";
  news.secondsLeft = 0;
  if (rendered.value().image.width == 0) return Ok{};
  Result<FinishedFile> file = write(work, rendered.value());
  if (!file) return Error{file.error()};
  std::error_code ignored;
  news.fileId = newId(), news.fileName = file.value().name,
  news.bytes = std::filesystem::file_size(file.value().path, ignored);
  keep(news.fileId, std::move(file).value());
  return Ok{};
}

Result<FinishedFile> RenderJobs::write(const RenderWork& work, const Rendered& rendered) const {
  if (folder_.empty()) return Error{"no folder for temporary files; set TMPDIR to one that can be written"};
  FinishedFile out;
  out.name = work.fileName;
  out.path = folder_ / (newId() + "." + work.format);
  const Metadata metadata = {{"roomlight.settings", settingsToJson(work.settings)}};
  Status status = Ok{};
  if (work.format == "exr") {
    status = writeExr(out.path, rendered.image, metadata);
  } else {
    const Display& display = work.display.display;
    const float ev100 = ev100Of(display, rendered.image) - work.display.compensationEv;
    const Image shown = displayed(rendered.image, display, whiteOf(display, rendered.lightColour), ev100);
    status = work.format == "jpg" ? writeJpeg(out.path, shown, SIZE_MAX) : writePng(out.path, shown, metadata);
  }
  if (!status) return Error{status.error()};
  return out;
}

}  // namespace roomlight::view
