#include "view/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "base/parallel.h"
#include "engine/live_walk.h"

namespace roomlight::view {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kLookAgain{250};  // at lines that may have become free, windows that were lost
constexpr milliseconds kSoon{20}, kTellEvery{100};
constexpr milliseconds kAfterFailure{2000};
// Around the home. The light of everything is found in one box: a thing that is carried out of sight would make that
// absurdly large.
constexpr float kFarthestOutM = 100;

Bounds3 reachOf(const ViewHome& home) {
  Bounds3 reach = home.scene.bounds();
  for (const EditableLamp& l : home.editable.lamps) reach.add(l.position);
  reach.lo -= Vec3(kFarthestOutM), reach.hi += Vec3(kFarthestOutM);
  return reach;
}

}  // namespace

Session::Session(ViewHome home, const RenderSettings& settings, Outbox outbox, const StartThread& start)
    : home_(std::move(home)),
      reach_(reachOf(home_)),
      settings_(settings),
      frames_(frameSettings(settings)),
      outbox_(std::move(outbox)),
      builder_(start),
      homeJson_(homeJson(home_)),
      follower_(start),
      refiner_([this] { tellRefined(); }, start),
      jobs_(
          home_, [this](const JobNews& news) { takeNews(news); }, start),
      sender_(start) {
  state_ = home_.atStart();
  plans_["start"] = state_;
  thread_ = start([this] { runWithThreads(); });
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true, newer_ = true;
  }
  wake_.notify_all();
  thread_.join();
  builder_.cancel();
  refiner_.stop();
  follower_.cancel();
}

void Session::open(Connection connection, const std::string& window) { push(connection, Opened{window}); }
void Session::close(Connection connection) { push(connection, Closed{}); }

void Session::receive(Connection connection, const std::string& text) {
  Message message = readMessage(text);
  if (const auto* ping = std::get_if<Ping>(&message))
    return outbox_.text(connection, textOf({{"type", "pong"}, {"id", ping->id}}));
  push(connection, std::move(message));
}

void Session::push(Connection connection, What what) {
  {
    const std::lock_guard lock(mutex_);
    Event event{connection, std::chrono::steady_clock::now(), std::move(what)};
    if (!isOfFrames(event.what)) newer_ = true;
    if (Event* before = outdatedBy(event)) {
      *before = std::move(event);
    } else {
      events_.push_back(std::move(event));
    }
  }
  wake_.notify_all();
}

// Frames that go out and arrive: nothing that another picture is needed for.
bool Session::isOfFrames(const What& what) {
  const auto* message = std::get_if<Message>(&what);
  return std::holds_alternative<Packed>(what) || (message && std::holds_alternative<Ack>(*message));
}

// Of places and sizes of a window only the newest counts. The one before it, if nothing that could depend on it came
// between; with the lock held.
Session::Event* Session::outdatedBy(const Event& event) {
  const auto* message = std::get_if<Message>(&event.what);
  if (!message || !(std::holds_alternative<ViewCamera>(*message) || std::holds_alternative<Viewport>(*message)))
    return nullptr;
  const auto before = std::find_if(events_.rbegin(), events_.rend(), [&](const Event& e) {
    return e.connection == event.connection && !isOfFrames(e.what);
  });
  const auto* said = before == events_.rend() ? nullptr : std::get_if<Message>(&before->what);
  return said && said->index() == message->index() ? &*before : nullptr;
}

// Threads of parallel loops may be missing for a moment, too.
void Session::runWithThreads() {
  while (!stop_) {
    try {
      withThreads(settings_.threads, [this] { run(); });
    } catch (const std::exception& e) {
      tellFailure(fmt::format("something went wrong: {}", e.what()));
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, kAfterFailure, [&] { return stop_.load(); });
    }
  }
}

void Session::run() {
  while (!stop_) {
    milliseconds pause = kAfterFailure;
    try {
      if (workOn()) continue;
      pause = soon_ ? kSoon : kLookAgain;
    } catch (const std::exception& e) {
      tellFailure(fmt::format("something went wrong: {}", e.what()));
    }
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, pause, [&] {
      return stop_ || built_ || refinedReady_ || lightReady_ || progress_ || !jobNews_.empty() || !events_.empty();
    });
  }
}

// What there is to do now. False: nothing.
bool Session::workOn() {
  handleEvents();
  adoptBuilt();
  beginBuilding();
  forgetLostWindows();
  dropLights();
  soon_ = false;
  const bool took = takeLight();
  followLight();
  if (takeRefined() || work() || took) return true;
  beginRefining();
  return false;
}

// The session goes on: memory, say, may be there again in a moment. A terminal that is gone, or no memory for the
// words, is nothing to end for.
void Session::tellFailure(const std::string& what) {
  try {
    tellAll(errorText({{}, "failed", "", what}));
    if (outbox_.failed) outbox_.failed(what);
  } catch (const std::exception&) {}
}

// Of threads that could not be started, the next try has to wait a little, while what there is is shown.
bool Session::mayStart() const { return std::chrono::steady_clock::now() >= startAgainAt_; }

// Whether a thread was started; of tries that fail one after the other only the first is told.
bool Session::started(const char* what, const Status& begun) {
  if (begun) {
    toldNoThread_ = false;
    return true;
  }
  startAgainAt_ = std::chrono::steady_clock::now() + kAfterFailure;
  if (!std::exchange(toldNoThread_, true)) tellFailure(fmt::format("{}: {}", what, begun.error()));
  return false;
}

void Session::takeNews(const JobNews& news) {
  {
    const std::lock_guard lock(mutex_);
    jobNews_.push_back(news);
  }
  wake_.notify_all();
}

// From the builder's thread: windows are the loop's.
void Session::tellProgress(const std::string& stage, float fraction) {
  {
    const std::lock_guard lock(mutex_);
    const TimePoint now = std::chrono::steady_clock::now();
    if (now - progressAt_ < kTellEvery) return;
    progressAt_ = now;
    progress_ = {stage, std::min(fraction, 0.99f)};  // the stage may be done, but not the whole
  }
  wake_.notify_all();
}

bool Session::handleEvents() {
  std::vector<Event> events;
  std::optional<std::pair<std::string, float>> progress;
  std::vector<JobNews> news;
  {
    const std::lock_guard lock(mutex_);
    events.swap(events_);
    progress.swap(progress_), news.swap(jobNews_);
    newer_ = stop_.load();
  }
  tellJobs(news);
  if (progress) tellAll(textOf({{"type", "progress"}, {"stage", progress->first}, {"fraction", progress->second}}));
  for (const Event& event : events) {
    try {
      handle(event);
    } catch (const std::exception& e) {  // the others still count
      tellFailure(fmt::format("something went wrong: {}", e.what()));
    }
  }
  return !events.empty();
}

// One frame for one window, those in turn that have waited longest.
bool Session::work() {
  for (auto w = windows_.begin(); w != windows_.end(); ++w) {
    if (!w->connection) continue;
    bool done = false;
    try {
      done = answerPoints(*w);
      done |= makeFrame(*w);
    } catch (const std::exception&) {  // others come before it is tried again
      windows_.splice(windows_.end(), windows_, w);
      throw;
    }
    if (!done) continue;
    windows_.splice(windows_.end(), windows_, w);
    return true;
  }
  return false;
}

}  // namespace roomlight::view
