// What a browser says, read strictly (docs/reference/view-protocol.md): an unknown key, a wrong type or a value out of
// range is an error that names the key.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/tone.h"
#include "base/vec.h"

namespace roomlight::view {

constexpr size_t kMostMessageBytes = 64 << 10;

struct ViewError {
  std::optional<uint32_t> id;  // of the request, where it could be read
  std::string code;  // "badMessage", "badField", "unknownThing", "notPossible", "failed"
  std::string field;  // the key that is wrong; empty: none
  std::string message;
};

struct Viewport {
  int width = 0, height = 0;  // CSS pixels
  float pixelRatio = 1;
};

struct ViewCamera {
  uint32_t number = 0;
  Vec3 position, direction{0, 0, -1}, up{0, 1, 0};  // directions are unit
  float yFovDeg = 55;
  float cutHeightM = kInfinity;  // what is higher in the home is not seen
};

enum class FalseColour : uint8_t { Off, Illuminance, Luminance };

// What of the display a message changes.
struct DisplayChange {
  std::optional<std::optional<float>> ev100;  // none inside: automatic
  std::optional<float> compensationEv;
  std::optional<ToneCurve> curve;
  std::optional<bool> automaticWhite;
  std::optional<std::optional<double>> whiteK;
  std::optional<FalseColour> falseColour;
  std::optional<std::optional<double>> low, high;  // none inside: by the picture
};

struct ChooseTechnique {
  uint32_t id;
  std::string technique;
};

struct SplitSide {
  std::string technique, plan;  // empty: the window's technique, the plan that is edited
};
struct Split {
  SplitSide left, right;
};
struct ChooseSplit {
  uint32_t id;
  std::optional<Split> split;
};

// Fields that an edit sets; which of them a thing has is not known here.
struct EditFields {
  std::optional<Vec3> position, direction, color, move;
  std::optional<float> dim, temperatureK, fluxLm, turnDeg, open;
  std::optional<bool> on, hidden;
  std::optional<bool> alone;  // of a move or a turn: what stands on the thing stays
  std::optional<std::string> material;
  std::optional<int> year, month, day;  // together
  std::optional<double> hour;
};
struct Edit {
  uint32_t id;
  std::string target, gesture;
  EditFields set;
};

struct StepHistory {
  uint32_t id;
  bool back;  // undo, else redo
};

struct EditPlan {
  enum class Do : uint8_t { Keep, Apply, Drop };
  uint32_t id;
  Do what;
  std::string name;
};

struct Point {  // asks what is there, or what a meter shows there
  uint32_t id;
  float x, y;  // 0..1 of the viewport, from its top left corner
  bool meter;
};

struct RenderWish {
  uint32_t id;
  bool panorama = false;
  int width = 0, height = 0;  // 0: chosen
  std::string technique, quality, format = "png";  // empty: the window's, good
  double seconds = 0;  // 0: until the quality is reached
};

struct CancelJob {
  uint32_t id;
  std::string job;
};
struct SaveLighting {
  uint32_t id;
};
struct Ack {
  uint32_t frame;
};
struct Ping {
  uint32_t id;
};

using Message = std::variant<ViewError, Viewport, ViewCamera, DisplayChange, ChooseTechnique, ChooseSplit, Edit,
                             StepHistory, EditPlan, Point, RenderWish, CancelJob, SaveLighting, Ack, Ping>;

// Names of techniques, qualities, plans and things are left to who knows them.
Message readMessage(std::string_view text);

}  // namespace roomlight::view
