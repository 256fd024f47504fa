// A walk through a home that changes meanwhile, frame by frame, by one technique.
#pragma once

#include <functional>

#include "engine/render.h"
#include "trace/ray_scene.h"
#include "import/walk_file.h"

namespace roomlight {

struct WalkFrame {
  double updateMs = 0, updateCpuMs = 0;    // until the light follows what moved, was dimmed, and where the camera is
  double pictureMs = 0, pictureCpuMs = 0;  // Cpu: of all threads together
};

struct WalkFrames {
  std::vector<WalkFrame> frames;  // fewer than the walk has if cancelled
  std::vector<StageStats> opening;  // what came before the first
  std::vector<StageStats> stages;   // of all frames together: "rays", "voxelise", "illuminate", ..., "gather"
  bool complete = true;
  double framesPerSecond()
      const;     // frames over the time of all of them but the first, if there are more; 0 without any
  double framesPerCpuSecond() const;  // over processor time: as many cores would do it in
};

struct ShownFrame {
  int number;
  const Camera& camera;
  const Image& image;  // linear, cd/m²
  const RayScene& rays;
};
// `take`, where given, is handed every picture in turn; its time does not count, and an error ends the walk.
using TakeFrame = std::function<Status(const ShownFrame&)>;

// Plays a walk of the scene, which must be as readWalkFile() saw it, and is so again afterwards. Pictures are of the
// settings' size and samples. What is done once a scene, such as parting what moves from what does not, is done before
// the first frame.
Result<WalkFrames> measureWalk(Scene& scene, const Walk& walk, const RenderSettings& settings,
                               const RenderProgress& progress = {}, const TakeFrame& take = {});

// Settings of a frame: one sample a pixel, and for `path` its filter, without which one is nothing to look at.
RenderSettings frameSettings(RenderSettings settings);

}  // namespace roomlight
