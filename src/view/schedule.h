// What a session does next. Decided from facts alone, without threads, clock and network: the session says what stands
// where, and since when, carries out what comes of it, and asks again when something has happened or it is time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "view/light_key.h"

namespace roomlight::view {

using TimePoint = std::chrono::steady_clock::time_point;

struct SideFacts {  // one picture of a window
  LightKey key;
  bool isCurrent = false;    // shows the newest input
  bool lightCame = false;    // since its last frame
  bool isToBeShownAgain = false;  // in another display
  bool isAveraged = false, isSettled = false;  // as good as averages make it; as good as it gets
  bool quickSettled = false;  // another quick frame would be the same
  bool failedToRefine = false;
  uint32_t samples = 0;  // 0: of quick frames
};

struct WindowFacts {
  std::string name;
  bool isConnected = false;
  bool takesFrames = false;  // has a size, and frames under way are few
  bool hasSize = false;
  TimePoint leftAt, inputAt;  // when it was lost, or its newest input came
  uint32_t serial = 0;  // of that input
  bool picks = false, meters = false;  // waits for an answer
  TimePoint metersSince;
  uint32_t metersRevision = 0;  // state of the home in which that was asked
  std::vector<SideFacts> sides;
};

struct HomeFacts {  // a home that is lit
  LightKey key;
  bool isLive = false;      // has frames in a few milliseconds
  bool isAway = false;      // its light follows a change
  bool isRefined = false;   // the refiner looks at it
  bool hasState = false;    // its light is that of the state that is wanted
  bool isSettled = false;   // and owes no bounces
  bool canFollow = true;    // to where the sun is wanted; else it is lit anew
  uint32_t revision = 0;    // the newest state that its light knows of
  uint64_t followedAt = 0;  // counts: the last time that its light followed
};

struct RefiningFacts {  // a picture that is refined
  std::string window;
  size_t side = 0;
  uint32_t serial = 0;             // input that it shows
  uint32_t turn = 0, samples = 0;  // how many it has before another picture's turn may come, and so far
};

struct Situation {
  std::vector<WindowFacts> windows;  // served longest ago first
  std::vector<HomeFacts> homes;      // used last first
  std::optional<LightKey> building;  // a home that is being lit
  std::vector<std::string> failed;   // techniques that could not be lit
  std::optional<RefiningFacts> refining;
  bool refinerWorks = false;  // also on a picture that was given up
  bool rendersFinal = false;  // a final picture, which somebody waits for
  TimePoint mayStartAt;       // of threads, after one could not be started
};

// What to do, in this order.
struct StopRefining {};
struct GiveUpLighting {};
struct LightHome {
  std::string window;
  size_t side;
};
struct ForgetWindow {
  std::string window;
};
struct DropHome {
  LightKey key;
};
struct FollowLight {
  LightKey key;
};
struct AnswerPoints {
  std::string window;
  bool meter;  // else only what was picked
};
enum class FrameKind : uint8_t {
  Again,  // the same picture in another display
  Quick,
  Better
};
struct MakeFrame {
  std::string window;
  size_t side;
  FrameKind kind;
};
struct Refine {
  std::string window;
  size_t side;
};
using Action = std::variant<StopRefining, GiveUpLighting, LightHome, ForgetWindow, DropHome, FollowLight, AnswerPoints,
                            MakeFrame, Refine>;

struct Plan {
  std::vector<Action> actions;
  TimePoint wakeAt = TimePoint::max();  // when there may be more to do, if nothing happens before
};

Plan planNext(const Situation& situation, TimePoint now);

}  // namespace roomlight::view
