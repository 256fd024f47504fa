// What is said about the home itself: edits, steps back and forth, plans, its lighting as a file.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/utf8.h"
#include "view/apply_edit.h"
#include "view/conversation.h"
#include "view/save_lighting.h"

namespace roomlight::view {
namespace {

constexpr size_t kMostPlans = 20;

bool isWithin(const Bounds3& b, Vec3 p) { return minComponent(min(p - b.lo, b.hi - p)) >= 0; }

std::vector<size_t> firstNumbers(size_t count) {
  std::vector<size_t> out(count);
  std::iota(out.begin(), out.end(), size_t{0});
  return out;
}

}  // namespace

const HomeState& Conversation::stateOf(const std::string& plan) const {
  const auto known = plans_.find(plan);
  if (plan.empty() || known == plans_.end()) return state_;
  const auto [shown, isNew] = shown_.try_emplace(plan, state_);
  if (isNew) shown->second.lamps = known->second.lamps, shown->second.sun = known->second.sun;
  return shown->second;
}

std::optional<ViewError> Conversation::tooFar(const Edit& edit, const HomeState& next) const {
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
std::optional<ViewError> Conversation::noLightAt(const Edit& edit, const HomeState& next) const {
  if (!home_.sun || next.sun == state_.sun || next.sun == home_.sun->atStart) return {};
  const Result<SunLight> light = home_.sun->at(*next.sun);
  return light ? std::nullopt
               : std::optional(ViewError{edit.id, "notPossible", edit.set.hour ? "hour" : "date", light.error()});
}

void Conversation::on(Window& window, TimePoint at, const Edit& m) {
  Edited edited;
  if (const auto error = applyEdit(home_.editable, home_.scene, m, state_, edited))
    return tell(window, errorText(*error));
  // A page that was loaded again counts its gestures from one, so that those of other things have the same names.
  const std::string gesture = m.gesture.empty() ? "" : window.name + '\n' + m.target + '\n' + m.gesture;
  const HomeState* start = history_.startOf(gesture);
  arrangement_.takeAlong(m, start ? *start : state_, edited);
  if (const auto error = tooFar(m, edited.state)) return tell(window, errorText(*error));
  if (const auto error = noLightAt(m, edited.state)) return tell(window, errorText(*error));
  tell(window, okText(m.id));
  if (edited.state == state_) return;
  history_.step(state_, edited.label, gesture);
  setState(std::move(edited.state), window, at);
}

void Conversation::on(Window& window, TimePoint at, const StepHistory& m) {
  if (m.back ? !history_.canUndo() : !history_.canRedo())
    return tell(window,
                errorText({m.id, "notPossible", "", m.back ? "there is nothing to undo" : "there is nothing to redo"}));
  tell(window, okText(m.id));
  setState(m.back ? history_.undo(state_) : history_.redo(state_), window, at);
}

std::optional<ViewError> Conversation::refusalOf(const EditPlan& m) const {
  const bool known = plans_.contains(m.name);
  if (m.what != EditPlan::Do::Keep && !known)
    return ViewError{m.id, "unknownThing", "name", fmt::format("no plan '{}'", printable(m.name))};
  if (m.what != EditPlan::Do::Apply && m.name == "start")
    return ViewError{m.id, "notPossible", "name", "the plan 'start' stays as it is"};
  if (m.what == EditPlan::Do::Keep && !known && plans_.size() >= kMostPlans)
    return ViewError{m.id, "notPossible", "name", fmt::format("there are {} plans already; drop one", kMostPlans)};
  return {};
}

// Windows that show it show what is edited.
void Conversation::dropPlan(const std::string& name, TimePoint at) {
  plans_.erase(name);
  for (Window& w : windows_) {
    if (!w.split || (w.split->left.plan != name && w.split->right.plan != name)) continue;
    for (SplitSide* s : {&w.split->left, &w.split->right}) {
      if (s->plan == name) s->plan.clear();
    }
    chooseSides(w);
    w.newInput(at);
  }
}

void Conversation::on(Window& window, TimePoint at, const EditPlan& m) {
  if (const auto refusal = refusalOf(m)) return tell(window, errorText(*refusal));
  tell(window, okText(m.id));
  if (m.what == EditPlan::Do::Apply) {
    HomeState next = stateOf(m.name);
    if (next == state_) return;
    history_.step(state_, fmt::format("Plan {}", m.name), "");
    return setState(std::move(next), window, at);
  }
  shown_.clear();
  if (m.what == EditPlan::Do::Keep) {
    plans_[m.name] = state_;
    for (Window& w : windows_) {
      if (w.split) w.newInput(at);  // it may show what the plan was
    }
  } else {
    dropPlan(m.name, at);
  }
  for (Window& w : windows_) {  // another list of plans asks for no other frame
    for (Side& side : w.sides) side.shownRevision += side.shownRevision == revision_ ? 1 : 0;
  }
  ++revision_;
  Json json = stateJson({}, {}, false);
  json["by"] = window.name;
  tellAll(textOf(json));
}

void Conversation::setState(HomeState next, const Window& by, TimePoint at) {
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
  arrangement_.follow(state_, next);
  state_ = std::move(next);
  shown_.clear();
  ++revision_, ++wishes_;
  Json json = stateJson(lamps, objects, sun);
  json["by"] = by.name;
  tellAll(textOf(json));
  for (Window& w : windows_) w.newInput(at);
}

Json Conversation::wholeState() const {
  return stateJson(firstNumbers(home_.editable.lamps.size()), firstNumbers(home_.editable.objects.size()), true);
}

Json Conversation::stateJson(const std::vector<size_t>& lamps, const std::vector<size_t>& objects, bool sun) const {
  Json json{{"type", "state"}, {"revision", revision_}};
  Json lampList = Json::array(), objectList = Json::array(), planList = Json::array();
  for (const size_t i : lamps) lampList.push_back(lampJson(home_.editable, i, state_));
  for (const size_t i : objects) {
    if (!home_.editable.objects[i].lampBody) objectList.push_back(objectJson(home_.editable, home_.scene, i, state_));
  }
  for (const auto& [name, state] : plans_) planList.push_back(name);
  json["lamps"] = lampList, json["objects"] = objectList, json["plans"] = planList;
  json["overlaps"] = overlapsJson(arrangement_.overlaps());
  if (sun) json["sun"] = sunJson(home_, state_);
  json["undo"] = history_.canUndo() ? Json(history_.undoLabel()) : Json(nullptr);
  json["redo"] = history_.canRedo() ? Json(history_.redoLabel()) : Json(nullptr);
  return json;
}

void Conversation::on(Window& window, TimePoint, const SaveLighting& m) {
  tell(window, textOf({{"type", "saved"},
                       {"id", m.id},
                       {"name", fileNameOf(home_) + "-lighting.json"},
                       {"text", lightingFile(home_, state_)}}));
}

}  // namespace roomlight::view
