// A frame of a camera that moves on: pixels that see what the frame before saw keep its light, and of them a few in
 // turn find more.
#pragma once

#include "gather/frame_history.h"
#include "gather/picture.h"
#include "trace/traced_scene.h"

namespace roomlight {

// Linear, cd/m². One camera ray a pixel, whatever the settings say of samples; the history is of frames of this scene
// and shader's technique.
Image gatherFrame(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
                  const PictureSettings& settings, FrameHistory& history, const Progress& progress);

// A frame, where there is a history and one sample a pixel is asked for; else a picture.
Image gatherView(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
                 const PictureSettings& settings, FrameHistory* history, const Progress& progress);

}  // namespace roomlight
