// A browser's window: where it looks from, how it shows it, and the pictures it is being sent.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gather/frame.h"
#include "gather/quick_frames.h"
#include "view/growing_picture.h"
#include "view/message.h"
#include "view/pacing.h"
#include "view/render_jobs.h"
#include "view/schedule.h"
#include "view/shown.h"
#include "view/view_camera.h"

namespace roomlight::view {

using Connection = uint64_t;

constexpr size_t kMostUnderWay =
    2;  // frames of a window that were not acknowledged; before one of them is, no other is made

struct SentFrame {
  uint32_t number;
  size_t bytes;  // 0: not packed yet
  TimePoint at;
};

// One picture of the window: the whole, or a half of a split.
struct Side {
  LightKey key;
  GrowingPicture picture;
  Pace pace, editPace;  // of frames while only the camera moves, and while things do
  std::optional<FrameHistory> history;  // of its quick frames, where the home has no front;
  QuickFrames quick;                    // and where it has one
  bool lightCame = false;               // since its last frame
  Vec3 lightColour;                     // for the automatic white, of
  TimePoint lightColourAt;
  uint32_t shownSerial = 0;    // input that the picture shows
  uint32_t shownRevision = 0;  // state of the light that it shows
  bool again = false;          // to be shown once more: only the display is another
  // Of its refinement: turns so far, samples of those before the one it has, and the input whose picture could not be
  // refined.
  uint32_t turns = 0, samplesBefore = 0, failedSerial = 0;

  // The next picture is made from nothing, and until then there is none that takes memory.
  void restart() {
    picture.restart(), history.reset(), quick = QuickFrames(), lightCame = again = false, shownSerial = 0;
  }
};

struct Window {
  std::string name;
  std::optional<Connection> connection;  // none: lost, perhaps taken up again
  TimePoint leftAt;
  Viewport viewport;  // of no size: not told yet
  ViewCamera camera;
  ViewDisplay display;
  std::string technique;
  std::optional<Split> split;
  std::vector<Side> sides;
  uint32_t serial = 1;  // counts inputs that need other pictures
  TimePoint inputAt;  // the newest of them
  bool inputShown = true;
  std::deque<SentFrame> underWay;
  uint32_t nextFrame = 1;
  Line line;
  // Of its sides; used by who sends its frames alone.
  std::shared_ptr<Adaptation> eye[2] = {std::make_shared<Adaptation>(), std::make_shared<Adaptation>()};
  TimePoint lastFrameAt;
  std::optional<Point> pick, meter;  // wait to be answered
  TimePoint meterAt;  // since when,
  uint32_t meterRevision = 0;  // of which state
  std::map<std::string, JobNews> jobs;  // the last of each, as far as it may have to be told again

  bool hasSize() const { return viewport.width > 0; }
  bool takesFrames() const { return hasSize() && underWay.size() < kMostUnderWay; }
  // From here on another picture is wanted.
  void newInput(TimePoint at) { ++serial, inputAt = at, inputShown = false; }
};

}  // namespace roomlight::view
