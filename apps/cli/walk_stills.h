// Frames of a walk as pictures of their own: none depends on those before it, so that many machines may share a film.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/result.h"
#include "engine/render.h"
#include "import/walk_file.h"
#include "scene/scene.h"

namespace roomlight::cli {

struct FrameRange {
  int first = 0, last = 0;
};
// "17" or "10-19", frames of a walk of so many.
Result<FrameRange> readFrameRange(const std::string& text, int frameCount);

// Takes the picture of a frame, and the rays it was seen by.
using TakeStill = std::function<Status(int number, const Camera& camera, const Rendered& picture)>;

// What exposure and white of the whole film go by: the first frame, small and as a draft.
Result<Rendered> exposureFrame(Scene& scene, const Walk& walk, RenderSettings settings);

// Renders frames one after the other, each as if there were no other. False: cancelled. The scene is left at rest.
Result<bool> renderStills(Scene& scene, const Walk& walk, const FrameRange& range, const RenderSettings& settings,
                          const RenderProgress& progress, const TakeStill& take);

}  // namespace roomlight::cli
