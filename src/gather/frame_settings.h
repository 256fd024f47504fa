// How frames of a camera that moves on reuse the light of frames before (frame_history.h).
#pragma once

namespace roomlight {

struct FrameSettings {
  bool reuse = true;        // of light of frames before
  int every = 4;  // of so many pixels with a history one is lit anew in a frame; the next lower power of two counts
  int everyStill = 4;  // the same once camera and scene stand still; with a new camera ray each
  int everyStale = 4;  // the same of those whose history is out of date
  float mostEstimates = 32;  // that a history counts for: it forgets what is older
  float smoothEstimates = 8;  // below, pixels keep light that was filtered once with their neighbours'; 0: none do
  float staleEstimates = 0.02f;  // that it counts for where light has changed
  int everyVeil = 4;  // of pixels of veils and mirrors, whose parts are not told apart; and
  float mostOfVeil = 4;  // estimates that their histories count for while the camera moves
  float mostWhileMoving = 8;  // where something moves, but elsewhere
  double quickMs = 0;  // 0: none of this; else frames of a walk are those of quick_frames.h, in about so many
                       // milliseconds, of techniques with light in slots
  float nearM = 0.5f;  // of what moved: light has changed there
};

}  // namespace roomlight
