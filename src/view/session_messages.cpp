// What each message of a browser does.
#include <fmt/format.h>

#include <random>
#include <utility>

#include "engine/technique.h"
#include "import/printable.h"
#include "view/session.h"

namespace roomlight::view {
namespace {

constexpr size_t kMostWindows = 64, kMostPlans = 20;
constexpr std::chrono::minutes kKept{10};
constexpr size_t kMostAtOnce = 6;  // techniques and plans: each is a whole lit home in memory

std::string newName() {
  static std::random_device random;
  return fmt::format("{:08x}", random());
}

bool isWithin(const Bounds3& b, Vec3 p) { return minComponent(min(p - b.lo, b.hi - p)) >= 0; }

std::string tooMany() { return fmt::format("windows show {} techniques and plans already; end a split", kMostAtOnce); }

ViewError noTechnique(uint32_t id, const char* field, const std::string& name) {
  return {id, "unknownThing", field, fmt::format("no technique '{}'", printable(name))};
}

}  // namespace

void Session::handle(const Event& event) {
  if (const auto* opened = std::get_if<Opened>(&event.what)) return openWindow(event, opened->window);
  Window* window = windowOf(event.connection);
  if (!window) return;
  if (std::holds_alternative<Closed>(event.what)) return closeWindow(*window, event.at);
  if (const auto* p = std::get_if<Packed>(&event.what)) return packed(*window, *p, event.at);
  std::visit([&](const auto& m) { on(*window, event, m); }, std::get<Message>(event.what));
}

// A window that somebody looks through is not taken from them: a page that was duplicated knows its name too.
void Session::openWindow(const Event& event, const std::string& wanted) {
  Window* known = windowNamed(wanted);
  if (!known || known->connection) {
    known = &windows_.emplace_back();
    known->name = newName();
    known->technique = settings_.technique;
    known->camera = viewOf(defaultCamera(home_.scene));
    chooseSides(*known);
  }
  Window& window = *known;
  window.connection = event.connection;
  if (lightsNeeded() > kMostAtOnce) {  // others have taken its place meanwhile
    window.technique = settings_.technique, window.split.reset();
    chooseSides(window);
  }
  window.underWay.clear();
  newInput(window, event.at);
  Json welcome = homeJson_;
  addWindow(window, welcome);
  std::vector<size_t> lamps(home_.editable.lamps.size()), objects(home_.editable.objects.size());
  for (size_t i = 0; i < lamps.size(); ++i) lamps[i] = i;
  for (size_t i = 0; i < objects.size(); ++i) objects[i] = i;
  welcome.update(stateJson(lamps, objects, true));
  welcome["type"] = "welcome";
  tell(window, textOf(welcome));
  tellJobsAgain(window);
}

// Kept for a while, but for what takes tens of megabytes and is made again in a moment.
void Session::closeWindow(Window& window, TimePoint at) {
  window.connection.reset();
  window.leftAt = at;
  window.underWay.clear();
  window.pick.reset(), window.meter.reset();
  if (refining_ && refining_->window == window.name) refiner_.giveUp(), refining_.reset();
  for (Side& s : window.sides) s.restart();
}

void Session::forgetLostWindows() {
  const TimePoint now = std::chrono::steady_clock::now();
  windows_.remove_if(
      [&](const Window& w) { return !w.connection && (now - w.leftAt > kKept || windows_.size() > kMostWindows); });
}

void Session::on(Window& window, const Event& event, const Viewport& m) {
  window.viewport = m;
  newInput(window, event.at);
}

void Session::on(Window& window, const Event& event, const ViewCamera& m) {
  window.camera = m;
  newInput(window, event.at);
}

void Session::on(Window& window, const Event& event, const DisplayChange& m) {
  const bool white = window.display.white();
  apply(m, window.display);
  window.inputAt = event.at, window.inputShown = false;
  for (Side& s : window.sides) s.again = true;
  if (window.display.white() == white) return;
  for (Side& s : window.sides) s.restart();
  newInput(window, event.at);
}

void Session::on(Window& window, const Event& event, const ChooseTechnique& m) {
  if (!findTechnique(m.technique)) return tell(window, errorText(noTechnique(m.id, "technique", m.technique)));
  const std::string before = std::exchange(window.technique, m.technique);
  chooseSides(window);
  if (lightsNeeded() > kMostAtOnce) {
    window.technique = before;
    chooseSides(window);
    return tell(window, errorText({m.id, "notPossible", "technique", tooMany()}));
  }
  failedBuilds_.clear();
  newInput(window, event.at);
  tell(window, okText(m.id));
}

void Session::on(Window& window, const Event& event, const ChooseSplit& m) {
  if (m.split) {
    const std::pair<const char*, const SplitSide*> sides[] = {{"left", &m.split->left}, {"right", &m.split->right}};
    for (const auto& [name, side] : sides) {
      const std::string field = fmt::format("split.{}", name);
      if (!side->technique.empty() && !findTechnique(side->technique))
        return tell(window, errorText(noTechnique(m.id, (field + ".technique").c_str(), side->technique)));
      if (!side->plan.empty() && !plans_.contains(side->plan))
        return tell(window, errorText({m.id, "unknownThing", field + ".plan",
                                       fmt::format("no plan '{}'", printable(side->plan))}));
    }
  }
  const std::optional<Split> before = std::exchange(window.split, m.split);
  chooseSides(window);
  if (lightsNeeded() > kMostAtOnce) {
    window.split = before;
    chooseSides(window);
    return tell(window, errorText({m.id, "notPossible", "split", tooMany()}));
  }
  failedBuilds_.clear();
  newInput(window, event.at);
  tell(window, okText(m.id));
}

std::optional<ViewError> Session::tooFar(const Edit& edit, const HomeState& next) const {
  const auto refused = [&](const char* field) {
    return ViewError{edit.id, "badField", field, "is too far from the home"};
  };
  if (edit.set.position && !isWithin(reach_, *edit.set.position)) return refused("position");
  for (size_t i = 0; edit.set.move && i < next.objects.size(); ++i) {
    if (!(next.objects[i] == state_.objects[i]) &&
        !isWithin(reach_, boundsOf(home_.editable.objects[i], next.objects[i]).centre()))
      return refused("move");
  }
  return {};
}

// A weather file may end, or lack an hour.
std::optional<ViewError> Session::noLightAt(const Edit& edit, const HomeState& next) const {
  if (!home_.sun || next.sun == state_.sun || next.sun == home_.sun->atStart) return {};
  const Result<SunLight> light = home_.sun->at(*next.sun);
  return light ? std::nullopt
               : std::optional(ViewError{edit.id, "notPossible", edit.set.hour ? "hour" : "date", light.error()});
}

void Session::on(Window& window, const Event&, const Edit& m) {
  Edited edited;
  if (const auto error = applyEdit(home_.editable, home_.scene, m, state_, edited))
    return tell(window, errorText(*error));
  if (const auto error = tooFar(m, edited.state)) return tell(window, errorText(*error));
  if (const auto error = noLightAt(m, edited.state)) return tell(window, errorText(*error));
  tell(window, okText(m.id));
  if (edited.state == state_) return;
  // A page that was loaded again counts its gestures from one, so that those of other things have the same names.
  history_.step(state_, edited.label, m.gesture.empty() ? "" : window.name + '\n' + m.target + '\n' + m.gesture);
  setState(std::move(edited.state), window);
}

void Session::on(Window& window, const Event&, const StepHistory& m) {
  if (m.back ? !history_.canUndo() : !history_.canRedo())
    return tell(window,
                errorText({m.id, "notPossible", "", m.back ? "there is nothing to undo" : "there is nothing to redo"}));
  tell(window, okText(m.id));
  setState(m.back ? history_.undo(state_) : history_.redo(state_), window);
}

void Session::on(Window& window, const Event& event, const EditPlan& m) {
  const auto known = plans_.find(m.name);
  if (m.what != EditPlan::Do::Keep && known == plans_.end())
    return tell(window, errorText({m.id, "unknownThing", "name", fmt::format("no plan '{}'", printable(m.name))}));
  if (m.what == EditPlan::Do::Apply) {
    HomeState next = state_;
    next.lamps = known->second.lamps, next.sun = known->second.sun;
    tell(window, okText(m.id));
    if (next == state_) return;
    history_.step(state_, fmt::format("Plan {}", m.name), "");
    return setState(std::move(next), window);
  }
  if (m.name == "start")
    return tell(window, errorText({m.id, "notPossible", "name", "the plan 'start' stays as it is"}));
  if (m.what == EditPlan::Do::Keep && known == plans_.end() && plans_.size() >= kMostPlans)
    return tell(window, errorText({m.id, "notPossible", "name",
                                   fmt::format("there are {} plans already; drop one", kMostPlans)}));
  if (m.what == EditPlan::Do::Keep) {
    plans_[m.name] = state_;
    for (Window& w : windows_) {
      if (w.split) newInput(w, event.at);  // it may show what the plan was
    }
  } else {
    plans_.erase(known);
    for (Window& w : windows_) {  // windows that show it show what is edited
      if (!w.split || (w.split->left.plan != m.name && w.split->right.plan != m.name)) continue;
      for (SplitSide* s : {&w.split->left, &w.split->right}) {
        if (s->plan == m.name) s->plan.clear();
      }
      chooseSides(w);
      newInput(w, event.at);
    }
  }
  tell(window, okText(m.id));
  ++revision_;
  Json json = stateJson({}, {}, false);
  json["by"] = window.name;
  tellAll(textOf(json));
}

void Session::on(Window& window, const Event& event, const Ack& m) {
  auto& sent = window.underWay;
  const auto frame = std::find_if(sent.begin(), sent.end(), [&](const SentFrame& f) { return f.number == m.frame; });
  // Before it goes out nobody can have seen it: who says so only wants more frames than the line takes.
  if (frame == sent.end() || frame->bytes == 0)
    return tell(window, errorText({{}, "badField", "frame", fmt::format("no frame {} is under way", m.frame)}));
  window.line.sent(frame->bytes, std::chrono::duration<double, std::milli>(event.at - frame->at).count());
  sent.erase(sent.begin(), std::next(frame));
}

void Session::on(Window& window, const Event&, const ViewError& m) { tell(window, errorText(m)); }
void Session::on(Window&, const Event&, const Ping&) {}  // answered when it came

void Session::setState(HomeState next, const Window& by) {
  std::vector<size_t> lamps, objects;
  for (size_t i = 0; i < next.objects.size(); ++i) {
    if (!(next.objects[i] == state_.objects[i])) objects.push_back(i);
  }
  for (size_t i = 0; i < next.lamps.size(); ++i) {
    const int object = home_.editable.lamps[i].object;
    const bool carried = object >= 0 && std::binary_search(objects.begin(), objects.end(), static_cast<size_t>(object));
    if (carried || !(next.lamps[i] == state_.lamps[i])) lamps.push_back(i);
  }
  const bool sun = !(next.sun == state_.sun);
  state_ = std::move(next);
  ++revision_;
  failedBuilds_.clear();
  Json json = stateJson(lamps, objects, sun);
  json["by"] = by.name;
  tellAll(textOf(json));
  const TimePoint now = std::chrono::steady_clock::now();
  for (Window& w : windows_) newInput(w, now);
}

Json Session::stateJson(const std::vector<size_t>& lamps, const std::vector<size_t>& objects, bool sun) const {
  Json json{{"type", "state"}, {"revision", revision_}};
  Json lampList = Json::array(), objectList = Json::array(), planList = Json::array();
  for (const size_t i : lamps) lampList.push_back(lampJson(home_.editable, i, state_));
  for (const size_t i : objects) {
    if (!home_.editable.objects[i].lampBody) objectList.push_back(objectJson(home_.editable, home_.scene, i, state_));
  }
  for (const auto& [name, state] : plans_) planList.push_back(name);
  json["lamps"] = lampList, json["objects"] = objectList, json["plans"] = planList;
  if (sun) json["sun"] = sunJson(home_, state_);
  json["undo"] = history_.canUndo() ? Json(history_.undoLabel()) : Json(nullptr);
  json["redo"] = history_.canRedo() ? Json(history_.redoLabel()) : Json(nullptr);
  return json;
}

}  // namespace roomlight::view
