#include "view/render_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <random>

#include "base/image_io.h"
#include "base/parallel.h"
#include "base/platform/files.h"
#include "base/platform/system_facts.h"
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

RenderJobs::RenderJobs(const ViewHome& home, std::function<void(const JobNews&)> tell, Executor& executor)
    : home_(home), tell_(std::move(tell)), executor_(executor), folder_(makeTemporaryFolder("roomlight-renders")) {}

RenderJobs::~RenderJobs() {
  executor_.end(Role::RenderFinal);
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

Status RenderJobs::add(RenderWork work) {
  const std::lock_guard lock(mutex_);
  if (asked_.size() > kMostWaiting) return Error{"too many pictures are waiting; cancel one"};  // one more is made
  std::list<Asked> next;
  const auto asked = next.insert(next.end(), {std::move(work), {}});
  Status posted = executor_.post(
      Role::RenderFinal, [this, asked](const std::atomic<bool>& c) { run(asked, c); }, {}, &asked->job);
  if (posted) asked_.splice(asked_.end(), next);
  return posted;
}

bool RenderJobs::cancel(const std::string& job) {
  JobNews news;
  {
    const std::lock_guard lock(mutex_);
    const auto asked = std::find_if(asked_.begin(), asked_.end(), [&](const Asked& a) { return a.work.job == job; });
    if (asked == asked_.end()) return false;
    if (!asked->job.withdraw()) {
      asked->job.giveUp();
      return true;
    }
    news.job = job, news.window = asked->work.window, news.state = "cancelled";
    asked_.erase(asked);
  }
  tell_(news);
  return true;
}

double RenderJobs::bytesToSpare() {
  return memoryBytes("MemAvailable").value_or(std::numeric_limits<double>::infinity());
}

bool RenderJobs::busy() const {
  const std::lock_guard lock(mutex_);
  return !asked_.empty();
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

void RenderJobs::run(std::list<Asked>::iterator asked, const std::atomic<bool>& cancelled) {
  const RenderWork& work = asked->work;
  Teller teller(work, tell_);
  RenderProgress progress;
  progress.report = [&](const std::string& stage, float fraction) { teller.report(stage, fraction); };
  progress.estimate = [&](double relativeError, double) { teller.estimate(relativeError); };
  progress.cancelled = &cancelled;
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
  {
    const std::lock_guard lock(mutex_);
    asked_.erase(asked);
  }
  tell_(news);  // who hears of the end can no longer cancel it
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
