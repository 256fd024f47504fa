// What is said about final pictures.
#include <fmt/format.h>

#include <cmath>

#include "base/utf8.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "view/conversation.h"

namespace roomlight::view {
namespace {

constexpr int kUsualWidth = 1920, kPanoramaWidth = 4096;
constexpr double kBytesAPixel = 450;   // of a render: pictures, what the filter needs, paths' sums
constexpr double kMostOfMemory =
    0.6;  // of what is free: the kernel ends programs without a word where there is none left

Json positive(double value) { return value < 0 ? Json(nullptr) : Json(value); }

Json jobJson(const JobNews& n) {
  Json file = nullptr;
  if (!n.fileId.empty()) file = {{"path", "/files/" + n.fileId}, {"name", n.fileName}, {"bytes", n.bytes}};
  return {{"type", "job"},
          {"job", n.job},
          {"stage", n.stage},
          {"fraction", n.fraction},
          {"secondsLeft", positive(n.secondsLeft)},
          {"estimatedError", positive(n.estimatedError)},
          {"state", n.state},
          {"file", file},
          {"message", n.message.empty() ? Json(nullptr) : Json(n.message)}};
}

Camera panoramaAt(const ViewCamera& view) {
  Camera camera = cameraOf(view);
  const Vec3 level{view.direction.x, 0, view.direction.z};
  camera.worldFromCamera = looking(view.position, length(level) > 1e-3f ? level : Vec3{0, 0, -1});
  camera.projection = Projection::Panorama;
  return camera;
}

}  // namespace

void Conversation::on(Window& window, TimePoint, const RenderWish& m) {
  RenderWork work;
  work.settings = settings_;
  if (!m.quality.empty()) {
    if (const Status s = applyQuality(m.quality, work.settings); !s)
      return tell(window, errorText({m.id, "unknownThing", "quality", s.error()}));
  }
  work.settings.technique = m.technique.empty() ? window.technique : m.technique;
  if (!findTechnique(work.settings.technique))
    return tell(window, errorText({m.id, "unknownThing", "technique",
                                   fmt::format("no technique '{}'", printable(m.technique))}));
  const double aspect = m.panorama ? 2
                        : window.viewport.width > 0
                            ? static_cast<double>(window.viewport.width) / window.viewport.height
                            : 16.0 / 9;
  work.settings.width = m.width > 0 ? m.width : m.panorama ? kPanoramaWidth : kUsualWidth;
  work.settings.height =
      m.height > 0 ? m.height : std::max(16, static_cast<int>(std::lround(work.settings.width / aspect)));
  const double bytes = kBytesAPixel * work.settings.width * work.settings.height;
  if (bytes > kMostOfMemory * jobs_.bytesToSpare())
    return tell(
        window,
        errorText(
            {m.id, "notPossible", "width",
             fmt::format(
                 "a picture of {} x {} takes about {:.1f} GB of memory, more than there is to spare; make it smaller",
                 work.settings.width, work.settings.height, bytes / 1e9)}));
  work.settings.timeLimitS = m.seconds;
  work.camera = m.panorama ? panoramaAt(window.camera) : cameraOf(window.camera);
  work.state = state_, work.display = window.display;
  work.format = m.format, work.window = window.name, work.job = fmt::format("job:{}", nextJob_++);
  work.fileName = fmt::format("{}-{}.{}", fileNameOf(home_), m.panorama ? "panorama" : "picture", m.format);
  const std::string job = work.job;
  if (const Status added = jobs_.add(std::move(work)); !added)
    return tell(window, errorText({m.id, "notPossible", "", added.error()}));
  tell(window, textOf({{"type", "ok"}, {"id", m.id}, {"job", job}}));
}

void Conversation::on(Window& window, TimePoint, const CancelJob& m) {
  if (!jobs_.cancel(m.job))
    return tell(window,
                errorText({m.id, "unknownThing", "job", fmt::format("no job '{}' is under way", printable(m.job))}));
  tell(window, okText(m.id));
}

void Conversation::heard(const JobNews& news) {
  Window* window = windowNamed(news.window);
  if (!window) return;
  window->jobs[news.job] = news;
  tell(*window, textOf(jobJson(news)));
  forgetJobs(*window, window->connection.has_value());
}

// To a window that comes back.
void Conversation::tellJobsAgain(Window& window) {
  forgetJobs(window, false);
  for (const auto& [job, news] : window.jobs) tell(window, textOf(jobJson(news)));
  forgetJobs(window, true);
}

// Pictures that were fetched or removed since and, where the window was told, jobs that have ended without one.
void Conversation::forgetJobs(Window& window, bool told) {
  std::erase_if(window.jobs, [&](const auto& entry) {
    const JobNews& n = entry.second;
    return n.fileId.empty() ? told && n.state != "running" : !jobs_.isKept(n.fileId);
  });
}

}  // namespace roomlight::view
