#include "view/session.h"

#include "base/parallel.h"
#include "engine/live_walk.h"

namespace roomlight::view {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kLookAgain{250};  // at lines that may have become free, windows that were lost
constexpr milliseconds kSoon{20}, kTellEvery{100};
constexpr size_t kMostLit = 3;           // kept, so that going back to a technique or plan is quick

}  // namespace

Session::Session(ViewHome home, const RenderSettings& settings, Outbox outbox) : home_(std::move(home)), settings_(settings), frames_(frameSettings(settings)), outbox_(std::move(outbox)), homeJson_(homeJson(home_)), refiner_([this] { tellRefined(); }), jobs_(home_, [this](const JobNews& news) { takeNews(news); }) {
  state_ = home_.atStart();
  plans_["start"] = state_;
  thread_ = std::thread([this] { withThreads(settings_.threads, [this] { run(); }); });
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
  follower_.finish();
}

void Session::open(Connection connection, const std::string& window) { push(connection, Opened{window}); }
void Session::close(Connection connection) { push(connection, Closed{}); }

void Session::receive(Connection connection, const std::string& text) {
  Message message = readMessage(text);
  if (const auto* ping = std::get_if<Ping>(&message)) return outbox_.text(connection, textOf({{"type", "pong"}, {"id", ping->id}}));
  push(connection, std::move(message));
}

void Session::push(Connection connection, std::variant<Opened, Closed, Packed, Message> what) {
  const auto* message = std::get_if<Message>(&what);
  const bool waits = std::holds_alternative<Packed>(what) || (message && std::holds_alternative<Ack>(*message));
  {
    const std::lock_guard lock(mutex_);
    events_.push_back({connection, std::chrono::steady_clock::now(), std::move(what)});
    if (!waits) newer_ = true;
  }
  wake_.notify_all();
}

void Session::run() {
  while (!stop_) {
    handleEvents();
    adoptBuilt();
    beginBuilding();
    forgetLostWindows();
    soon_ = false;
    const bool took = takeLight();
    followLight();
    if (takeRefined() || work() || took) continue;
    beginRefining();
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, soon_ ? kSoon : kLookAgain, [&] { return stop_ || built_ || refinedReady_ || lightReady_ || progress_ || !jobNews_.empty() || !events_.empty(); });
  }
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
  for (const Event& event : events) handle(event);
  return !events.empty();
}

// One frame for one window, those in turn that have waited longest.
bool Session::work() {
  for (auto w = windows_.begin(); w != windows_.end(); ++w) {
    if (!w->connection) continue;
    const bool answered = answerPoints(*w);
    if (!makeFrame(*w) && !answered) continue;
    windows_.splice(windows_.end(), windows_, w);
    return true;
  }
  return false;
}

void Session::adoptBuilt() {
  {
    const std::lock_guard lock(mutex_);
    if (!built_) return;
    built_ = false;
  }
  tellAll(textOf({{"type", "progress"}, {"stage", "done"}, {"fraction", 1}}));
  const LightKey key = builder_.work().key;
  auto result = builder_.take();
  if (!result) return;
  if (!*result) {
    failedBuild_ = key.technique;
    if (outbox_.failed) outbox_.failed(result->error());
    tellAll(errorText({{}, "failed", "", result->error()}));
    return;
  }
  if (refiner_.home() && refiner_.home()->key == key) refiner_.stop(), refining_.reset();
  if (follower_.home() && follower_.home()->key == key) follower_.finish();
  lit_.remove_if([&](const auto& l) { return l->key == key; });
  lit_.push_front(std::move(*result).value());
  dropLights();
  for (Window& w : windows_) {
    for (Side& s : w.sides) {
      if (!(s.key == key)) continue;
      s.picture.restart();
      s.history.reset();
      s.quick.forget();
      s.shownSerial = 0;
    }
  }
}

bool Session::needs(const LightKey& key) const {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) { return w.connection && std::any_of(w.sides.begin(), w.sides.end(), [&](const Side& s) { return s.key == key; }); });
}

// The ones that nobody looks at and were not used for longest, beyond a few.
void Session::dropLights() {
  for (auto l = lit_.end(); l != lit_.begin() && lit_.size() > kMostLit;) {
    --l;
    if (needs((*l)->key)) continue;
    if (refiner_.home() == l->get()) refiner_.stop(), refining_.reset();
    if (follower_.home() == l->get()) follower_.finish();
    l = lit_.erase(l);
  }
}

// Of all that windows look at, the first that has no light, or light of another sun.
void Session::beginBuilding() {
  if (builder_.busy()) return;
  for (const Window& w : windows_) {
    for (size_t k = 0; k < w.sides.size() && w.connection; ++k) {
      const Side& s = w.sides[k];
      const auto lit = std::find_if(lit_.begin(), lit_.end(), [&](const auto& l) { return l->key == s.key; });
      if (s.key.technique == failedBuild_ || (lit != lit_.end() && (*lit)->state.sun == stateOf(s.key).sun)) continue;
      RenderSettings settings = frames_;
      settings.technique = s.key.technique;
      RenderProgress progress;
      progress.report = [this](const std::string& stage, float fraction) { tellProgress(stage, fraction); };
      builder_.begin(home_, {s.key, stateOf(s.key), settings, cameraOf(w.camera)}, std::move(progress), [this] {
        {
          const std::lock_guard lock(mutex_);
          built_ = true;
        }
        wake_.notify_all();
      });
      return;
    }
  }
}

}  // namespace roomlight::view
