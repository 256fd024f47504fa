// How a frame of a window is made and sent.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "base/parallel.h"
#include "base/progress.h"
#include "engine/sights.h"
#include "measure/false_colour.h"
#include "view/illuminance_picture.h"
#include "view/session.h"

namespace roomlight::view {
namespace {

// Of 50: the rest is for light that follows, and showing and packing, which take a part of the same cores.
constexpr double kQuickMs = 32;
constexpr double kEditMs = 65;  // where the scene changes: ten frames a second, and light that follows meanwhile
constexpr double kForRays = 0.7;  // of that, at most: the rest is for light
constexpr double kLookAtColourMs = 250;
constexpr int kColourRays = 32;  // along both edges
constexpr size_t kMostHistories = 4;

double millisecondsSince(TimePoint at) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - at).count();
}

// One that fails does not end the others.
Result<std::string> made(const std::function<Result<std::string>()>& make) {
  try {
    Result<std::string> bytes = std::string();
    withThreads(1, [&] { bytes = make(); });
    return bytes;
  } catch (const std::exception& e) {
    return Error{fmt::format("a frame could not be made: {}", e.what())};
  }
}

}  // namespace

void Session::lookFrom(LitHome& home, const Camera& camera) {
  RenderStats stats;
  RenderProgress silent;
  Stages stages(silent, stats);
  try {
    home.solution->lit->lookFrom(camera, stages);
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
  for (Window& w : conversation_.windows()) {
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

// A frame in a few tens of milliseconds. False: ended.
bool Session::showQuick(Window& window, Side& side, LitHome& home, const Camera& camera) {
  const bool edits = home.live && !isUpToDate(home);
  const double ms = edits ? kEditMs : kQuickMs;
  Pace& pace = edits ? side.editPace : side.pace;
  const std::pair<int, int> whole = frameSize(window.viewport, window.line.scale()),
                            size = pace.sizeFor(home.live ? kForRays * ms : ms, whole);
  const Stopwatch watch;
  Image image;
  double costMs = 0;
  if (home.live) {
    image =
        side.quick.make(home.live->quick(window.display.white()), camera, size.first, size.second, ms, {{}, &stop_});
    // Light takes what time is left; where that is less than the least of it needs, pictures get smaller.
    const QuickFrames::Count& took = side.quick.count();
    const double threads = std::max(1, threadCount()), leftMs = (1 - kForRays) * ms * threads;
    costMs = (took.otherMs + (took.leastLight ? std::max(0.0, took.litMs - leftMs) : 0)) / threads;
  } else {
    const bool white = window.display.white();
    image = home.solution->lit->pictureOf(
        camera, {size.first, size.second, 1, {}, white, true, white ? nullptr : historyOf(side, window)}, {{}, &stop_});
    costMs = watch.seconds() * 1e3;
  }
  if (stop_ || image.width == 0) return false;
  pace.took(size, costMs);
  side.picture.showQuick(std::move(image), watch.seconds() * 1e3, size != whole);
  return true;
}

bool Session::carryOut(const MakeFrame& a) {
  Window* window = conversation_.windowNamed(a.window);
  if (!window || !window->connection || a.side >= window->sides.size()) return false;
  try {
    if (!makeFrame(*window, a.side, a.kind)) return false;
  } catch (const std::exception&) {  // others come before it is tried again
    conversation_.serveLast(*window);
    throw;
  }
  conversation_.serveLast(*window);
  return true;
}

// False where nothing was done that is worth doing again at once.
bool Session::makeFrame(Window& window, size_t index, FrameKind kind) {
  Side& side = window.sides[index];
  LitHome* lit = litFor(side.key);
  if (!lit || (!lit->live && !lit->solution)) return false;
  LitHome& home = *lit;
  const Camera camera = cameraOf(window.camera);
  if (kind == FrameKind::Again) {
    side.again = false;
    sendFrame(window, index, home);
    return true;
  }
  if (kind == FrameKind::Better) {
    if (!home.solution) return false;
    if (!home.live) lookFrom(home, camera);  // another window may have had it elsewhere
    // Of the whole size on slow lines too: nobody waits for the next.
    const bool shows = side.picture.step(*home.solution->lit, camera, frameSize(window.viewport, 1),
                                         {window.display.white(), refines(window, side)}, newer_);
    if (shows) sendFrame(window, index, home);
    return true;
  }
  if (side.shownSerial != window.serial) {
    if (home.live && side.picture.samples() > 0 && side.picture.begun()) side.quick.adopt(side.picture.image());
    side.picture.restart();
    side.shownSerial = window.serial;
    if (home.live) {
      followLive(home);
    } else {
      lookFrom(home, camera);
    }
  }
  if (home.live || isWanted(home.solution->state, home)) side.shownRevision = conversation_.revision();
  if (std::exchange(side.lightCame, false)) side.picture.restart();
  if (!showQuick(window, side, home, camera)) return false;
  sendFrame(window, index, home);
  return true;
}

void Session::sendFrame(Window& window, size_t index, LitHome& home) {
  FrameInfo info = frameInfo(window, index, home);
  MakeBytes make = inDisplay(window, index, home.rays(), info);
  window.underWay.push_back({info.number, 0, window.lastFrameAt});
  auto send = [this, make = std::move(make), connection = *window.connection,
               number = info.number](const std::atomic<bool>&) {
    Result<std::string> bytes = made(make);
    push(Packed{connection, number, bytes ? bytes.value().size() : 0});
    if (bytes) return outbox_.frame(connection, std::move(bytes).value());
    outbox_.text(connection, errorText({{}, "failed", "", bytes.error()}));
  };
  executor_.post(Role::SendFrames, std::move(send));
}

FrameInfo Session::frameInfo(Window& window, size_t index, const LitHome& home) const {
  const Side& side = window.sides[index];
  const GrowingPicture& picture = side.picture;
  FrameInfo info;
  info.number = window.nextFrame++;
  info.side = window.sides.size() > 1 ? static_cast<uint8_t>(index + 1) : uint8_t{0};
  const bool isBehind = !isUpToDate(home) || !home.canFollow(conversation_.stateOf(side.key.plan).sun) ||
                        side.shownRevision != conversation_.revision();
  const auto flag = [](bool on, uint8_t bit) { return on ? bit : uint8_t{0}; };
  info.flags = static_cast<uint8_t>(flag(picture.quick(), kQuick) | flag(picture.settled(), kSettled) |
                                    flag(picture.refined(), kRefined) | flag(isBehind, kLightIsBehind));
  info.jpegQuality = static_cast<uint16_t>(window.line.quality());
  info.camera = window.camera.number, info.revision = side.shownRevision, info.samples = picture.samples();
  info.samplesInAll = picture.samplesInAll();
  info.relativeError = picture.relativeError();
  info.pictureMs = static_cast<float>(picture.pictureMs());
  if (!window.inputShown) info.latencyMs = static_cast<float>(millisecondsSince(window.inputAt));
  window.inputShown = true;
  return info;
}

// What the sender does with the picture as it is now; counts as the window's last frame.
Session::MakeBytes Session::inDisplay(Window& window, size_t index, const RayScene& rays, FrameInfo info) {
  Side& side = window.sides[index];
  const GrowingPicture& picture = side.picture;
  const double sinceLast = millisecondsSince(window.lastFrameAt) / 1e3;
  window.lastFrameAt = std::chrono::steady_clock::now();
  const ViewDisplay& display = window.display;
  if (display.falseColour != FalseColour::Off) {
    info.flags |= kFalseColour;
    const bool lux = display.falseColour == FalseColour::Illuminance;
    auto amounts = std::make_shared<const Image>(
        lux ? illuminancePicture(rays, cameraOf(window.camera), picture.image()) : luminanceOnly(picture.image()));
    return [amounts = std::move(amounts), display, info]() mutable {
      const ByteImage shown = showAmounts(*amounts, display, info);
      return packFrame(info, shown);
    };
  }
  if (display.display.automaticWhite &&
      (isBlack(side.lightColour) || millisecondsSince(side.lightColourAt) > kLookAtColourMs)) {
    side.lightColour = lightColour(rays, cameraOf(window.camera), picture.image(), kColourRays),
    side.lightColourAt = window.lastFrameAt;
  }
  const Vec3 colour = display.display.automaticWhite ? side.lightColour : Vec3();
  return [light = picture.shared(), colour, display, sinceLast, eye = window.eye[index], info]() mutable {
    const ByteImage shown = showPicture(*light, colour, display, sinceLast, *eye, info);
    return packFrame(info, shown);
  };
}

}  // namespace roomlight::view
