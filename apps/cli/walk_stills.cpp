#include "walk_stills.h"

#include <fmt/format.h>

#include "arguments.h"

namespace roomlight::cli {
namespace {

constexpr int kMeterWidth = 192;  // pixels, of the frame that exposure goes by

Result<Rendered> still(Scene& scene, const Walk& walk, int frame, const RenderSettings& settings,
                       const RenderProgress& progress) {
  stage(walk, walk.timeOf(frame), scene);
  Result<Renderer> renderer = Renderer::of(scene, settings, {cameraAt(walk, walk.timeOf(frame))});
  if (!renderer) return Error{renderer.error()};
  return renderer.value().picture(cameraAt(walk, walk.timeOf(frame)), progress);
}

}  // namespace

Result<FrameRange> readFrameRange(const std::string& text, int frameCount) {
  const size_t dash = text.find('-');
  const auto first = parseNumber<int>(std::string_view(text).substr(0, dash));
  const auto last = dash == std::string::npos ? first : parseNumber<int>(std::string_view(text).substr(dash + 1));
  if (!first || !last || *first < 0 || *last < *first)
    return Error{fmt::format("--stills {}: write the number of a frame from 0, or FIRST-LAST", text)};
  if (*last >= frameCount) return Error{fmt::format("--stills {}: the walk has frames 0 to {}", text, frameCount - 1)};
  return FrameRange{*first, *last};
}

Result<Rendered> exposureFrame(Scene& scene, const Walk& walk, RenderSettings settings) {
  const int threads = settings.threads, width = settings.width, height = settings.height;
  if (const Status s = applyQuality("draft", settings); !s) return Error{s.error()};
  settings.samples = 0, settings.timeLimitS = 0, settings.noiseLevel = 0, settings.threads = threads;
  settings.technique = technique::kHybrid;
  settings.width = std::min(width, kMeterWidth);
  settings.height = std::max(1, height * settings.width / width);
  const RenderProgress silent;
  Result<Rendered> out = still(scene, walk, 0, settings, silent);
  atRest(walk, scene);
  return out;
}

Result<bool> renderStills(Scene& scene, const Walk& walk, const FrameRange& range, const RenderSettings& settings,
                          const RenderProgress& progress, const TakeStill& take) {
  bool complete = true;
  for (int frame = range.first; complete && frame <= range.last; ++frame) {
    Result<Rendered> picture = still(scene, walk, frame, settings, progress);
    if (!picture) return Error{picture.error()};
    complete = picture.value().complete && !picture.value().image.pixels.empty();
    if (!complete) break;
    if (const Status s = take(frame, cameraAt(walk, walk.timeOf(frame)), picture.value()); !s) return Error{s.error()};
  }
  atRest(walk, scene);
  return complete;
}

}  // namespace roomlight::cli
