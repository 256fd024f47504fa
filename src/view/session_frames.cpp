// Which picture of which window is made next, and how it is sent.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "base/clock.h"
#include "base/parallel.h"
#include "engine/light_colour.h"
#include "measure/luminance_picture.h"
#include "view/illuminance_picture.h"
#include "view/session.h"

namespace roomlight::view {
namespace {

constexpr double kQuickMs =
    32;  // of 50: the rest is for light that follows, and showing and packing, which take a part of the same cores
constexpr double kEditMs = 65;  // where the scene changes: ten frames a second, and light that follows meanwhile
constexpr double kForRays = 0.7;  // of that, at most: the rest is for light
constexpr double kRestMs =
    80;  // without an input: before that a better picture is not begun, since the next input would end it
constexpr double kForLightMs =
    2500;  // after an input that was shown, at most: light that follows it has the machine for itself
constexpr double kLookAtColourMs = 250;
constexpr int kColourRays = 32;  // along both edges
constexpr size_t kMostHistories = 4;

double millisecondsSince(TimePoint at) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - at).count();
}

}  // namespace

Window* Session::windowOf(Connection connection) {
  const auto w =
      std::find_if(windows_.begin(), windows_.end(), [&](const Window& x) { return x.connection == connection; });
  return w == windows_.end() ? nullptr : &*w;
}

// Null for an empty name.
Window* Session::windowNamed(const std::string& name) {
  const auto w =
      std::find_if(windows_.begin(), windows_.end(), [&](const Window& x) { return !name.empty() && x.name == name; });
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
    for (const SplitSide& s : {window.split->left, window.split->right})
      sides.emplace_back().key = {s.technique.empty() ? window.technique : s.technique, s.plan};
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

void Session::lookFrom(LitHome& home, const Camera& camera) {
  RenderStats stats;
  RenderProgress silent;
  Stages stages(silent, stats);
  try {
    home.lit->lookFrom(camera, stages);
  } catch (const std::exception&) {  // its light is in pieces
    dropLight(home);
    throw;
  }
}

// Of the few that moved last: a history takes some hundred bytes a pixel.
FrameHistory* Session::historyOf(Side& side, Window& window) {
  if (!frames_.frames.reuse) return nullptr;
  if (side.history) return &*side.history;
  size_t count = 0;
  Window* oldest = nullptr;
  for (Window& w : windows_) {
    const auto kept = static_cast<size_t>(
        std::count_if(w.sides.begin(), w.sides.end(), [](const Side& s) { return s.history.has_value(); }));
    count += kept;
    if (kept > 0 && &w != &window && (!oldest || w.lastFrameAt < oldest->lastFrameAt)) oldest = &w;
  }
  if (count >= kMostHistories && oldest) {
    for (Side& s : oldest->sides) s.history.reset();
  }
  side.history.emplace(frames_.frames);
  return &*side.history;
}

// An input of any window ends what better pictures of others have begun, so that these would only take time from it.
bool Session::somebodyMoves() const {
  return std::any_of(windows_.begin(), windows_.end(),
                     [](const Window& w) { return w.connection && millisecondsSince(w.inputAt) < kRestMs; });
}

// What a side of a window needs next.
Session::Next Session::nextOf(const Window& window, const Side& side, const LitHome& home) const {
  if (!canBeShown(home)) return Next::Wait;
  const bool current = side.shownSerial == window.serial && side.picture.begun();
  if (!current || side.lightCame) return Next::Quick;
  if (side.again) return Next::Again;
  if (home.front && !isUpToDate(home)) {
    const bool waits =
        millisecondsSince(window.inputAt) < kForLightMs || side.picture.samples() > 0 || side.quick.settled();
    return waits ? Next::Wait : Next::Quick;
  }
  if (!isUpToDate(home)) return Next::Wait;
  if (side.picture.averaged()) return Next::Nothing;
  if (side.picture.samples() > 0 && jobs_.busy()) return Next::Wait;  // somebody waits for that
  if (millisecondsSince(window.inputAt) >= kRestMs) return somebodyMoves() ? Next::Wait : Next::Better;
  return home.front && side.picture.samples() == 0 && !side.quick.settled() ? Next::Quick : Next::Wait;
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
    const LitHome* home = litFor(s.key);
    const Next next = home ? nextOf(window, s, *home) : Next::Nothing;
    soon_ |= next == Next::Wait;
    if (next == Next::Nothing || next == Next::Wait) continue;
    if (best == window.sides.size() || isBefore(s, window.sides[best])) best = k;
  }
  return best < window.sides.size() && stepSide(window, best);
}

// A frame in a few tens of milliseconds. False: ended.
bool Session::showQuick(Window& window, Side& side, LitHome& home, const Camera& camera) {
  const bool edits = home.front && !isUpToDate(home);
  const double ms = edits ? kEditMs : kQuickMs;
  Pace& pace = edits ? side.editPace : side.pace;
  const std::pair<int, int> whole = frameSize(window.viewport, window.line.scale()),
                            size = pace.sizeFor(home.front ? kForRays * ms : ms, whole);
  const Stopwatch watch;
  Image image;
  double costMs = 0;
  if (home.front) {
    image =
        side.quick.make(home.front->quick(window.display.white()), camera, size.first, size.second, ms, {{}, &stop_});
    costMs = side.quick.count().otherMs / std::max(1, threadCount());  // light takes what time is left
  } else {
    const bool white = window.display.white();
    image = home.lit->pictureOf(
        camera, {size.first, size.second, 1, {}, white, true, white ? nullptr : historyOf(side, window)}, {{}, &stop_});
    costMs = watch.seconds() * 1e3;
  }
  if (stop_ || image.width == 0) return false;
  pace.took(size, costMs);
  side.picture.showQuick(std::move(image), watch.seconds() * 1e3, size != whole);
  return true;
}

// False where nothing was done that is worth doing again at once.
bool Session::stepSide(Window& window, size_t index) {
  Side& side = window.sides[index];
  LitHome& home = *litFor(side.key);
  const Camera camera = cameraOf(window.camera);
  const Next next = nextOf(window, side, home);
  if (next == Next::Again) {
    side.again = false;
    sendFrame(window, index, home);
    return true;
  }
  if (next == Next::Better) {
    if (!home.front) lookFrom(home, camera);  // another window may have had it elsewhere
    // Of the whole size on slow lines too: nobody waits for the next.
    const bool shows = side.picture.step(home, camera, frameSize(window.viewport, 1),
                                         {window.display.white(), refines(window, side)}, newer_);
    if (shows) sendFrame(window, index, home);
    return true;
  }
  if (side.shownSerial != window.serial) {
    if (home.front && side.picture.samples() > 0 && side.picture.begun()) side.quick.adopt(side.picture.image());
    side.picture.restart();
    side.shownSerial = window.serial;
    if (home.front) {
      followFront(home);
    } else {
      lookFrom(home, camera);
    }
  }
  if (home.front || wantedOf(home) == home.state) side.shownRevision = revision_;
  if (std::exchange(side.lightCame, false)) side.picture.restart();
  if (!showQuick(window, side, home, camera)) return false;
  sendFrame(window, index, home);
  return true;
}

void Session::sendFrame(Window& window, size_t index, LitHome& home) {
  Side& side = window.sides[index];
  const GrowingPicture& picture = side.picture;
  const RayScene& rays = home.front ? home.front->rays() : home.lit->rays();
  FrameInfo info;
  info.number = window.nextFrame++;
  info.side = window.sides.size() > 1 ? static_cast<uint8_t>(index + 1) : uint8_t{0};
  const bool sunBehind = !home.canFollow(stateOf(side.key).sun), lightBehind = !isUpToDate(home);
  const auto flag = [](bool on, uint8_t bit) { return on ? bit : uint8_t{0}; };
  info.flags = static_cast<uint8_t>(flag(picture.quick(), kQuick) | flag(picture.settled(), kSettled) |
                                    flag(picture.refined(), kRefined) |
                                    flag(sunBehind || lightBehind || side.shownRevision != revision_, kLightIsBehind));
  info.jpegQuality = static_cast<uint16_t>(window.line.quality());
  info.camera = window.camera.number, info.revision = side.shownRevision, info.samples = picture.samples();
  info.relativeError = picture.relativeError();
  info.pictureMs = static_cast<float>(picture.pictureMs());
  const double sinceLast = millisecondsSince(window.lastFrameAt) / 1e3;
  if (!window.inputShown) info.latencyMs = static_cast<float>(millisecondsSince(window.inputAt));
  window.inputShown = true;
  window.lastFrameAt = std::chrono::steady_clock::now();
  FrameSender::Make make;
  if (window.display.falseColour == FalseColour::Off) {
    if (window.display.display.automaticWhite &&
        (isBlack(side.lightColour) || millisecondsSince(side.lightColourAt) > kLookAtColourMs)) {
      side.lightColour = lightColour(rays, cameraOf(window.camera), picture.image(), kColourRays),
      side.lightColourAt = window.lastFrameAt;
    }
    const Vec3 colour = window.display.display.automaticWhite ? side.lightColour : Vec3();
    make = [light = picture.shared(), colour, display = window.display, sinceLast, eye = window.eye[index],
            info]() mutable {
      const ByteImage shown = showPicture(*light, colour, display, sinceLast, *eye, info);
      return packFrame(info, shown);
    };
  } else {
    info.flags |= kFalseColour;
    const bool lux = window.display.falseColour == FalseColour::Illuminance;
    auto amounts = std::make_shared<const Image>(
        lux ? illuminancePicture(rays, cameraOf(window.camera), picture.image()) : luminanceOnly(picture.image()));
    make = [amounts = std::move(amounts), display = window.display, info]() mutable {
      const ByteImage shown = showAmounts(*amounts, display, info);
      return packFrame(info, shown);
    };
  }
  window.underWay.push_back({info.number, 0, window.lastFrameAt});
  sender_.push(std::move(make),
               [this, connection = *window.connection, number = info.number](Result<std::string> bytes) {
                 push(connection, Packed{number, bytes ? bytes.value().size() : 0});
                 if (bytes) return outbox_.frame(connection, std::move(bytes).value());
                 outbox_.text(connection, errorText({{}, "failed", "", bytes.error()}));
               });
}

// How long frames are on their way counts from here.
void Session::packed(Window& window, const Packed& p, TimePoint at) {
  const auto frame = std::find_if(window.underWay.begin(), window.underWay.end(),
                                  [&](const SentFrame& f) { return f.number == p.number; });
  if (frame == window.underWay.end()) return;
  frame->bytes = p.bytes, frame->at = at;
  if (p.bytes == 0) window.underWay.erase(frame);
}

}  // namespace roomlight::view
