// Final pictures, and the lighting as a file.
#include <fmt/format.h>

#include <cmath>

#include "engine/quality.h"
#include "import/printable.h"
#include "view/save_lighting.h"
#include "view/session.h"

namespace roomlight::view {
namespace {

constexpr int kUsualWidth = 1920, kPanoramaWidth = 4096;

Json positive(double value) { return value < 0 ? Json(nullptr) : Json(value); }

Json jobJson(const JobNews& n) {
  Json file = nullptr;
  if (!n.fileId.empty()) file = {{"path", "/files/" + n.fileId}, {"name", n.fileName}, {"bytes", n.bytes}};
  return {{"type", "job"}, {"job", n.job}, {"stage", n.stage}, {"fraction", n.fraction}, {"secondsLeft", positive(n.secondsLeft)}, {"estimatedError", positive(n.estimatedError)}, {"state", n.state}, {"file", file}, {"message", n.message.empty() ? Json(nullptr) : Json(n.message)}};
}

// What any file system and header takes.
std::string safeName(std::string name) {
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return name.empty() ? "home" : name.substr(0, 60);
}

Camera panoramaAt(const ViewCamera& view) {
  Camera camera = cameraOf(view);
  const Vec3 level{view.direction.x, 0, view.direction.z};
  camera.worldFromCamera = looking(view.position, length(level) > 1e-3f ? level : Vec3{0, 0, -1});
  camera.projection = Projection::Panorama;
  return camera;
}

}  // namespace

void Session::on(Window& window, const Event&, const RenderWish& m) {
  RenderWork work;
  work.settings = settings_;
  if (!m.quality.empty()) {
    if (const Status s = applyQuality(m.quality, work.settings); !s) return tell(window, errorText({m.id, "unknownThing", "quality", s.error()}));
  }
  work.settings.technique = m.technique.empty() ? window.technique : m.technique;
  if (!isTechnique(work.settings.technique)) return tell(window, errorText({m.id, "unknownThing", "technique", fmt::format("no technique '{}'", printable(m.technique))}));
  const double aspect = m.panorama ? 2 : window.viewport.width > 0 ? static_cast<double>(window.viewport.width) / window.viewport.height
                                                                   : 16.0 / 9;
  work.settings.width = m.width > 0 ? m.width : m.panorama ? kPanoramaWidth
                                                           : kUsualWidth;
  work.settings.height = m.height > 0 ? m.height : std::max(16, static_cast<int>(std::lround(work.settings.width / aspect)));
  work.settings.timeLimitS = m.seconds;
  work.camera = m.panorama ? panoramaAt(window.camera) : cameraOf(window.camera);
  work.state = state_, work.display = window.display;
  work.format = m.format, work.window = window.name, work.job = fmt::format("job:{}", nextJob_++);
  work.fileName = fmt::format("{}-{}.{}", safeName(home_.name), m.panorama ? "panorama" : "picture", m.format);
  const std::string job = work.job;
  if (!jobs_.add(std::move(work))) return tell(window, errorText({m.id, "notPossible", "", "too many pictures are waiting; cancel one"}));
  tell(window, textOf({{"type", "ok"}, {"id", m.id}, {"job", job}}));
}

void Session::on(Window& window, const Event&, const CancelJob& m) {
  if (!jobs_.cancel(m.job)) return tell(window, errorText({m.id, "unknownThing", "job", fmt::format("no job '{}' is under way", printable(m.job))}));
  tell(window, okText(m.id));
}

void Session::on(Window& window, const Event&, const SaveLighting& m) {
  tell(window, textOf({{"type", "saved"}, {"id", m.id}, {"name", safeName(home_.name) + "-lighting.json"}, {"text", lightingFile(home_, state_)}}));
}

void Session::tellJobs(const std::vector<JobNews>& news) {
  for (const JobNews& n : news) {
    const auto window = std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) { return w.name == n.window; });
    if (window != windows_.end()) tell(*window, textOf(jobJson(n)));
  }
}

}  // namespace roomlight::view
