#include "view/conversation.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "base/utf8.h"
#include "engine/technique.h"

namespace roomlight::view {
namespace {

constexpr size_t kMostAtOnce = 6;  // techniques and plans: each is a whole lit home in memory
// Around the home. The light of everything is found in one box: a thing that is carried out of sight would make that
// absurdly large.
constexpr float kFarthestOutM = 100;

Bounds3 reachOf(const ViewHome& home) {
  Bounds3 reach = home.scene.bounds();
  for (const EditableLamp& l : home.editable.lamps) reach.add(l.position);
  reach.lo -= Vec3(kFarthestOutM), reach.hi += Vec3(kFarthestOutM);
  return reach;
}

std::string newName() {
  static std::random_device random;
  return fmt::format("{:08x}", random());
}

std::string tooMany() { return fmt::format("windows show {} techniques and plans already; end a split", kMostAtOnce); }

ViewError noTechnique(uint32_t id, const std::string& field, const std::string& name) {
  return {id, "unknownThing", field, fmt::format("no technique '{}'", printable(name))};
}

}  // namespace

Conversation::Conversation(const ViewHome& home, const RenderSettings& settings, Tell tell, Jobs jobs)
    : home_(home),
      reach_(reachOf(home)),
      settings_(settings),
      tell_(std::move(tell)),
      jobs_(std::move(jobs)),
      homeJson_(homeJson(home)),
      state_(home.atStart()),
      arrangement_(home.editable, home.scene, state_) {
  plans_["start"] = state_;
}

void Conversation::tell(const Window& window, std::string text) const {
  if (window.connection) tell_(*window.connection, std::move(text));
}

void Conversation::tellAll(const std::string& text) const {
  for (const Window& w : windows_) tell(w, text);
}

Window* Conversation::windowOf(Connection connection) {
  const auto w =
      std::find_if(windows_.begin(), windows_.end(), [&](const Window& x) { return x.connection == connection; });
  return w == windows_.end() ? nullptr : &*w;
}

Window* Conversation::windowNamed(const std::string& name) {
  const auto w =
      std::find_if(windows_.begin(), windows_.end(), [&](const Window& x) { return !name.empty() && x.name == name; });
  return w == windows_.end() ? nullptr : &*w;
}

void Conversation::serveLast(const Window& window) {
  const auto w = std::find_if(windows_.begin(), windows_.end(), [&](const Window& x) { return &x == &window; });
  if (w != windows_.end()) windows_.splice(windows_.end(), windows_, w);
}

void Conversation::forget(const std::string& window) {
  windows_.remove_if([&](const Window& w) { return w.name == window; });
}

// A window that somebody looks through is not taken from them: a page that was duplicated knows its name too.
void Conversation::opened(Connection connection, const std::string& wanted, TimePoint at) {
  Window* known = windowNamed(wanted);
  if (!known || known->connection) {
    known = &windows_.emplace_back();
    known->name = newName();
    known->technique = settings_.technique;
    known->camera = viewOf(defaultCamera(home_.scene));
    chooseSides(*known);
  }
  Window& window = *known;
  window.connection = connection;
  if (lightsNeeded() > kMostAtOnce) {  // others have taken its place meanwhile
    window.technique = settings_.technique, window.split.reset();
    chooseSides(window);
  }
  window.underWay.clear();
  window.newInput(at);
  Json welcome = homeJson_;
  addWindow(window, welcome);
  welcome.update(wholeState());
  welcome["type"] = "welcome";
  tell(window, textOf(welcome));
  tellJobsAgain(window);
}

// Kept for a while, but for what takes tens of megabytes and is made again in a moment.
void Conversation::closed(Connection connection, TimePoint at) {
  Window* window = windowOf(connection);
  if (!window) return;
  window->connection.reset();
  window->leftAt = at;
  window->underWay.clear();
  window->pick.reset(), window->meter.reset();
  for (Side& s : window->sides) s.restart();
}

void Conversation::said(Connection connection, const Message& message, TimePoint at) {
  Window* window = windowOf(connection);
  if (!window) return;
  std::visit([&](const auto& m) { on(*window, at, m); }, message);
}

void Conversation::chooseSides(Window& window) const {
  std::vector<Side> sides;
  if (window.split) {
    for (const SplitSide& s : {window.split->left, window.split->right})
      sides.emplace_back().key = {s.technique.empty() ? window.technique : s.technique, s.plan};
  } else {
    sides.emplace_back().key = {window.technique, ""};
  }
  window.sides = std::move(sides);
}

size_t Conversation::lightsNeeded() const {
  std::set<std::pair<std::string, std::string>> keys;
  for (const Window& w : windows_) {
    for (const Side& s : w.sides) {
      if (w.connection) keys.emplace(s.key.technique, s.key.plan);
    }
  }
  return keys.size();
}

void Conversation::on(Window& window, TimePoint at, const Viewport& m) {
  window.viewport = m;
  window.newInput(at);
}

void Conversation::on(Window& window, TimePoint at, const ViewCamera& m) {
  window.camera = m;
  window.newInput(at);
}

void Conversation::on(Window& window, TimePoint at, const DisplayChange& m) {
  const bool white = window.display.white();
  apply(m, window.display);
  window.inputAt = at, window.inputShown = false;
  for (Side& s : window.sides) s.again = true;
  if (window.display.white() == white) return;
  for (Side& s : window.sides) s.restart();
  window.newInput(at);
}

// Another technique or split, unless windows would show too many at once.
template <class Choice>
void Conversation::choose(Window& window, TimePoint at, const Request& request, Choice& choice, const Choice& wanted) {
  const Choice before = std::exchange(choice, wanted);
  chooseSides(window);
  if (lightsNeeded() > kMostAtOnce) {
    choice = before;
    chooseSides(window);
    return tell(window, errorText({request.id, "notPossible", request.field, tooMany()}));
  }
  ++wishes_;
  window.newInput(at);
  tell(window, okText(request.id));
}

void Conversation::on(Window& window, TimePoint at, const ChooseTechnique& m) {
  if (!findTechnique(m.technique)) return tell(window, errorText(noTechnique(m.id, "technique", m.technique)));
  choose(window, at, {m.id, "technique"}, window.technique, m.technique);
}

std::optional<ViewError> Conversation::unknownIn(const ChooseSplit& m) const {
  if (!m.split) return {};
  const std::pair<const char*, const SplitSide*> sides[] = {{"left", &m.split->left}, {"right", &m.split->right}};
  for (const auto& [name, side] : sides) {
    const std::string field = fmt::format("split.{}", name);
    if (!side->technique.empty() && !findTechnique(side->technique))
      return noTechnique(m.id, field + ".technique", side->technique);
    if (!side->plan.empty() && !plans_.contains(side->plan))
      return ViewError{m.id, "unknownThing", field + ".plan", fmt::format("no plan '{}'", printable(side->plan))};
  }
  return {};
}

void Conversation::on(Window& window, TimePoint at, const ChooseSplit& m) {
  if (const auto error = unknownIn(m)) return tell(window, errorText(*error));
  choose(window, at, {m.id, "split"}, window.split, m.split);
}

// Of a kind one waits: the one before it was meant for a view or a place that is of no interest any more.
void Conversation::on(Window& window, TimePoint at, const Point& m) {
  std::optional<Point>& waiting = m.meter ? window.meter : window.pick;
  if (waiting) tell(window, pointText(*waiting, nullptr));
  waiting = m;
  if (m.meter) window.meterAt = at, window.meterRevision = revision_;
}

void Conversation::on(Window& window, TimePoint at, const Ack& m) {
  auto& sent = window.underWay;
  const auto frame = std::find_if(sent.begin(), sent.end(), [&](const SentFrame& f) { return f.number == m.frame; });
  // Before it goes out nobody can have seen it: who says so only wants more frames than the line takes.
  if (frame == sent.end() || frame->bytes == 0)
    return tell(window, errorText({{}, "badField", "frame", fmt::format("no frame {} is under way", m.frame)}));
  window.line.sent(frame->bytes, std::chrono::duration<double, std::milli>(at - frame->at).count());
  sent.erase(sent.begin(), std::next(frame));
}

// How long frames are on their way counts from here.
void Conversation::packed(Connection connection, uint32_t number, size_t bytes, TimePoint at) {
  Window* window = windowOf(connection);
  if (!window) return;
  const auto frame = std::find_if(window->underWay.begin(), window->underWay.end(),
                                  [&](const SentFrame& f) { return f.number == number; });
  if (frame == window->underWay.end()) return;
  frame->bytes = bytes, frame->at = at;
  if (bytes == 0) window->underWay.erase(frame);
}

void Conversation::on(Window& window, TimePoint, const ViewError& m) { tell(window, errorText(m)); }
void Conversation::on(Window&, TimePoint, const Ping&) {}  // answered when it came

}  // namespace roomlight::view
