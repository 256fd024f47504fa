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
constexpr milliseconds kAfterFailure{2000};
constexpr milliseconds kTellEvery{100};

TimePoint now() { return std::chrono::steady_clock::now(); }

}  // namespace

Session::Session(ViewHome home, const RenderSettings& settings, Outbox outbox, const StartThread& start)
    : home_(std::move(home)),
      settings_(settings),
      frames_(frameSettings(settings)),
      outbox_(std::move(outbox)),
      executor_(start),
      conversation_(
          home_, settings_, [this](Connection c, std::string text) { outbox_.text(c, std::move(text)); },
          finalPictures()),
      builder_(executor_),
      follower_(executor_),
      refiner_([this] { push(Refined{}); }, executor_),
      jobs_(
          home_, [this](const JobNews& news) { push(news); }, executor_) {
  Status begun = executor_.post(Role::SendFrames, [](const std::atomic<bool>&) {});  // its thread is there from now on
  if (begun) begun = executor_.post(Role::Decide, [this](const std::atomic<bool>&) { runWithThreads(); });
  if (!begun) throw ResourceError(begun.error());
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true, newer_ = true;
  }
  wake_.notify_all();
  executor_.end();
}

Conversation::Jobs Session::finalPictures() {
  return {[this](RenderWork work) { return jobs_.add(std::move(work)); },
          [this](const std::string& job) { return jobs_.cancel(job); },
          [this](const std::string& id) { return jobs_.find(id).has_value(); }, RenderJobs::bytesToSpare};
}

void Session::open(Connection connection, const std::string& window) { push(Opened{connection, window}); }
void Session::close(Connection connection) { push(Closed{connection}); }

void Session::receive(Connection connection, const std::string& text) {
  Message message = readMessage(text);
  if (const auto* ping = std::get_if<Ping>(&message))
    return outbox_.text(connection, textOf({{"type", "pong"}, {"id", ping->id}}));
  push(Said{connection, std::move(message)});
}

void Session::push(What what) {
  {
    const std::lock_guard lock(mutex_);
    Event event{now(), std::move(what)};
    if (asksForPictures(event.what)) newer_ = true;
    if (Event* before = outdatedBy(event.what)) {
      *before = std::move(event);
    } else {
      events_.push_back(std::move(event));
    }
  }
  wake_.notify_all();
}

// Not what frames tell that go out and arrive, nor what comes of work in the background.
bool Session::asksForPictures(const What& what) {
  const auto* said = std::get_if<Said>(&what);
  return said ? !std::holds_alternative<Ack>(said->message)
              : std::holds_alternative<Opened>(what) || std::holds_alternative<Closed>(what);
}

// Of places and sizes of a window only the newest counts. The one before it, if the window said nothing between that
// could depend on it; with the lock held.
Session::Event* Session::outdatedBy(const What& what) {
  const auto* said = std::get_if<Said>(&what);
  if (!said || !(std::holds_alternative<ViewCamera>(said->message) || std::holds_alternative<Viewport>(said->message)))
    return nullptr;
  for (auto e = events_.rbegin(); e != events_.rend(); ++e) {
    if (!asksForPictures(e->what)) continue;
    const auto* before = std::get_if<Said>(&e->what);
    const auto* opened = std::get_if<Opened>(&e->what);
    const auto* closed = std::get_if<Closed>(&e->what);
    const Connection of = before ? before->connection : opened ? opened->connection : closed->connection;
    if (of != said->connection) continue;
    return before && before->message.index() == said->message.index() ? &*e : nullptr;
  }
  return nullptr;
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
    TimePoint until;
    try {
      handleEvents();
      const Plan plan = planNext(situation(), now());
      if (carryOutAll(plan.actions)) continue;
      until = plan.wakeAt;
    } catch (const std::exception& e) {
      tellFailure(fmt::format("something went wrong: {}", e.what()));
      until = now() + kAfterFailure;
    }
    wait(until);
  }
}

void Session::wait(TimePoint until) {
  std::unique_lock lock(mutex_);
  const auto isWoken = [&] { return stop_ || !events_.empty(); };
  if (until == TimePoint::max()) {
    wake_.wait(lock, isWoken);
  } else {
    wake_.wait_until(lock, until, isWoken);
  }
}

bool Session::carryOutAll(const std::vector<Action>& actions) {
  bool changed = false;
  for (const Action& action : actions) changed |= std::visit([&](const auto& a) { return carryOut(a); }, action);
  return changed;
}

void Session::handleEvents() {
  std::vector<Event> events;
  {
    const std::lock_guard lock(mutex_);
    events.swap(events_);
    newer_ = stop_.load();
  }
  for (const Event& event : events) {
    try {
      std::visit([&](const auto& what) { handle(event, what); }, event.what);
    } catch (const std::exception& e) {  // the others still count
      tellFailure(fmt::format("something went wrong: {}", e.what()));
    }
  }
}

// The session goes on: memory, say, may be there again in a moment. A terminal that is gone, or no memory for the
// words, is nothing to end for.
void Session::tellFailure(const std::string& what) {
  try {
    conversation_.tellAll(errorText({{}, "failed", "", what}));
    if (outbox_.failed) outbox_.failed(what);
  } catch (const std::exception&) {}
}

// Whether a thread was started; of tries that fail one after the other only the first is told. The next has to wait a
// little, while what there is is shown.
bool Session::started(const char* what, const Status& begun) {
  if (begun) {
    toldNoThread_ = false;
    return true;
  }
  startAgainAt_ = now() + kAfterFailure;
  if (!std::exchange(toldNoThread_, true)) tellFailure(fmt::format("{}: {}", what, begun.error()));
  return false;
}

// From the builder's thread. Of what the loop did not come to tell only the newest is told.
void Session::tellProgress(const std::string& stage, float fraction) {
  BuildProgress progress{stage, std::min(fraction, 0.99f)};  // the stage may be done, but not the whole
  {
    const std::lock_guard lock(mutex_);
    const TimePoint at = now();
    if (at - progressAt_ < kTellEvery) return;
    progressAt_ = at;
    const auto untold = std::find_if(events_.begin(), events_.end(),
                                     [](const Event& e) { return std::holds_alternative<BuildProgress>(e.what); });
    if (untold != events_.end()) {
      untold->what = std::move(progress);
    } else {
      events_.push_back({at, std::move(progress)});
    }
  }
  wake_.notify_all();
}

void Session::handle(const Event&, const BuildProgress& e) {
  conversation_.tellAll(textOf({{"type", "progress"}, {"stage", e.stage}, {"fraction", e.fraction}}));
}

bool Session::carryOut(const ForgetWindow& a) {
  conversation_.forget(a.window);
  return true;
}

}  // namespace roomlight::view
