// Which picture of which window is made next, and how it is sent.
#include "engine/light_colour.h"
#include "measure/luminance_picture.h"
#include "view/illuminance_picture.h"
#include "view/session.h"

namespace roomlight::view {
namespace {

constexpr double kQuickMs = 38;  // of 50: the rest is for light that follows, showing and packing
constexpr double kRestMs = 80;  // without an input: before that a better picture is not begun, since the next input would end it
constexpr size_t kMostUnderWay = 2, kMostHistories = 4;

double millisecondsSince(TimePoint at) { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - at).count(); }

}  // namespace

Window* Session::windowOf(Connection connection) {
  const auto w = std::find_if(windows_.begin(), windows_.end(), [&](const Window& x) { return x.connection == connection; });
  return w == windows_.end() ? nullptr : &*w;
}

void Session::tell(const Window& window, std::string text) const {
  if (window.connection) outbox_.text(*window.connection, std::move(text));
}

void Session::tellAll(const std::string& text) const {
  for (const Window& w : windows_) tell(w, text);
}

void Session::chooseSides(Window& window) {
  std::vector<Side> sides;
  if (window.split) {
    for (const SplitSide& s : {window.split->left, window.split->right}) sides.emplace_back().key = {s.technique.empty() ? window.technique : s.technique, s.plan};
  } else {
    sides.emplace_back().key = {window.technique, ""};
  }
  window.sides = std::move(sides);
}

void Session::newInput(Window& window, TimePoint at) {
  ++window.serial;
  if (refining_ && refining_->window == window.name) refiner_.giveUp(), refining_.reset();
  window.inputAt = at, window.inputShown = false;
}

HomeState Session::stateOf(const LightKey& key) const {
  const auto plan = plans_.find(key.plan);
  if (key.plan.empty() || plan == plans_.end()) return state_;
  HomeState state = state_;
  state.lamps = plan->second.lamps, state.sun = plan->second.sun;
  return state;
}

LitHome* Session::litFor(const LightKey& key) {
  const auto lit = std::find_if(lit_.begin(), lit_.end(), [&](const auto& l) { return l->key == key; });
  if (lit == lit_.end()) return nullptr;
  lit_.splice(lit_.begin(), lit_, lit);
  return lit_.front().get();
}

// All but the sun, which needs light that is found afresh.
void Session::bringUpToDate(LitHome& home, const Camera& camera) {
  HomeState wanted = stateOf(home.key);
  wanted.sun = home.state.sun;
  RenderStats stats;
  RenderProgress silent;
  Stages stages(silent, stats);
  if (!(wanted == home.state)) {
    if (refiner_.home() == &home) refiner_.letGo();
    const SceneChange change = stage(home_.editable, home.state, wanted, home.scene);
    home.state = std::move(wanted);
    home.lit->update(change, stages);
    for (Window& w : windows_) {
      for (Side& s : w.sides) {
        if (s.key == home.key && s.history) s.history->sceneChanged(change, home.scene);
      }
    }
  }
  home.lit->lookFrom(camera, stages);
}

// Bounces that the last change still owes: a frame shows them as far as they have come.
void Session::goOnWithLight(LitHome& home) {
  if (refiner_.home() == &home) refiner_.letGo();
  RenderStats stats;
  RenderProgress silent;
  Stages stages(silent, stats);
  home.lit->update({}, stages);
  for (Window& w : windows_) {
    for (Side& s : w.sides) {
      if (s.key == home.key) s.picture.restart();
    }
  }
}

// Of the few that moved last: a history takes some hundred bytes a pixel.
FrameHistory* Session::historyOf(Side& side, Window& window) {
  if (!frames_.frames.reuse) return nullptr;
  if (side.history) return &*side.history;
  size_t count = 0;
  Window* oldest = nullptr;
  for (Window& w : windows_) {
    const auto kept = static_cast<size_t>(std::count_if(w.sides.begin(), w.sides.end(), [](const Side& s) { return s.history.has_value(); }));
    count += kept;
    if (kept > 0 && &w != &window && (!oldest || w.lastFrameAt < oldest->lastFrameAt)) oldest = &w;
  }
  if (count >= kMostHistories && oldest) {
    for (Side& s : oldest->sides) s.history.reset();
  }
  side.history.emplace(frames_.frames);
  return &*side.history;
}

bool Session::makeFrame(Window& window) {
  if (window.viewport.width == 0 || window.underWay.size() >= kMostUnderWay) return false;
  // The side that is behind, else the one with fewer samples.
  size_t best = window.sides.size();
  const auto isBefore = [&](const Side& a, const Side& b) {
    const bool aOld = a.shownSerial != window.serial, bOld = b.shownSerial != window.serial;
    return aOld != bOld ? aOld : a.picture.samples() < b.picture.samples();
  };
  for (size_t k = 0; k < window.sides.size(); ++k) {
    const Side& s = window.sides[k];
    const bool idle = s.shownSerial == window.serial && s.picture.averaged() && !s.again;
    LitHome* home = idle ? nullptr : litFor(s.key);
    if (!home) continue;
    const bool onlyBetter = s.shownSerial == window.serial && s.picture.begun() && !s.again && home->lit->settled();
    if (onlyBetter && millisecondsSince(window.inputAt) < kRestMs) {
      soon_ = true;
      continue;
    }
    if (best == window.sides.size() || isBefore(s, window.sides[best])) best = k;
  }
  return best < window.sides.size() && stepSide(window, best);
}

// False where nothing was done that is worth doing again at once.
bool Session::stepSide(Window& window, size_t index) {
  Side& side = window.sides[index];
  LitHome& home = *litFor(side.key);
  const Camera camera = cameraOf(window.camera);
  if (side.shownSerial != window.serial) {
    side.picture.restart();
    side.shownSerial = window.serial;
    bringUpToDate(home, camera);
    side.shownRevision = revision_;
  }
  if (side.again && side.picture.begun()) {
    side.again = false;
    sendFrame(window, index, home);
    return true;
  }
  if (side.picture.averaged()) return false;
  if (side.picture.begun() && !home.lit->settled()) goOnWithLight(home);
  const bool shows = side.picture.step(home, camera, frameSize(window.viewport, window.line.scale()), {kQuickMs, side.pace, historyOf(side, window)}, refines(side), newer_, stop_);
  if (shows) sendFrame(window, index, home);
  return true;
}

void Session::sendFrame(Window& window, size_t index, LitHome& home) {
  Side& side = window.sides[index];
  const GrowingPicture& picture = side.picture;
  FrameInfo info;
  info.number = window.nextFrame++;
  info.side = window.sides.size() > 1 ? static_cast<uint8_t>(index + 1) : uint8_t{0};
  const bool sunBehind = !(home.state.sun == stateOf(side.key).sun);
  const auto flag = [](bool on, uint8_t bit) { return on ? bit : uint8_t{0}; };
  info.flags = static_cast<uint8_t>(flag(picture.quick(), kQuick) | flag(picture.settled(), kSettled) | flag(picture.refined(), kRefined) | flag(sunBehind || side.shownRevision != revision_, kLightIsBehind));
  info.jpegQuality = static_cast<uint16_t>(window.line.quality());
  info.camera = window.camera.number, info.revision = side.shownRevision, info.samples = picture.samples();
  info.relativeError = picture.relativeError();
  info.pictureMs = static_cast<float>(picture.pictureMs());
  const double sinceLast = millisecondsSince(window.lastFrameAt) / 1e3;
  ByteImage shown;
  if (window.display.falseColour == FalseColour::Off) {
    const Vec3 white = window.display.display.automaticWhite ? lightColour(home.lit->rays(), cameraOf(window.camera), picture.image()) : Vec3();
    shown = showPicture(picture.image(), white, window.display, sinceLast, window.eye[index], info);
  } else {
    info.flags |= kFalseColour;
    const bool lux = window.display.falseColour == FalseColour::Illuminance;
    shown = showAmounts(lux ? illuminancePicture(home.lit->rays(), cameraOf(window.camera), picture.image()) : luminanceOnly(picture.image()), window.display, info);
  }
  if (!window.inputShown) info.latencyMs = static_cast<float>(millisecondsSince(window.inputAt));
  window.inputShown = true;
  window.lastFrameAt = std::chrono::steady_clock::now();
  Result<std::string> bytes = packFrame(info, shown);
  if (!bytes) return tell(window, errorText({{}, "failed", "", bytes.error()}));
  window.underWay.push_back({info.number, bytes.value().size(), window.lastFrameAt});
  outbox_.frame(*window.connection, std::move(bytes).value());
}

}  // namespace roomlight::view
