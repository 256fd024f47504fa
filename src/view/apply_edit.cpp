#include "view/apply_edit.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/utf8.h"
#include "scene/shown_names.h"

namespace roomlight::view {
namespace {

std::optional<size_t> numberIn(const std::string& target, std::string_view prefix, size_t count) {
  if (!target.starts_with(prefix)) return {};
  size_t value = 0;
  const char* end = target.data() + target.size();
  const auto [at, code] = std::from_chars(target.data() + prefix.size(), end, value);
  if (code != std::errc() || at != end || value >= count) return {};
  return value;
}

ViewError refused(const Edit& edit, const char* code, const char* field, std::string message) {
  return {edit.id, code, field, std::move(message)};
}

struct Field {
  const char* name;
  bool given;
};

std::optional<ViewError> refuseOthers(const Edit& edit, std::initializer_list<const char*> known, const char* what) {
  const EditFields& s = edit.set;
  const Field fields[] = {{"position", s.position.has_value()},
                          {"direction", s.direction.has_value()},
                          {"dim", s.dim.has_value()},
                          {"on", s.on.has_value()},
                          {"temperatureK", s.temperatureK.has_value()},
                          {"fluxLm", s.fluxLm.has_value()},
                          {"color", s.color.has_value()},
                          {"move", s.move.has_value()},
                          {"turn", s.turnDeg.has_value()},
                          {"alone", s.alone.has_value()},
                          {"hidden", s.hidden.has_value()},
                          {"material", s.material.has_value()},
                          {"open", s.open.has_value()},
                          {"date", s.year.has_value()},
                          {"hour", s.hour.has_value()}};
  bool any = false;
  for (const Field& f : fields) {
    if (!f.given) continue;
    any = true;
    const bool isKnown =
        std::any_of(known.begin(), known.end(), [&](const char* k) { return std::string_view(k) == f.name; });
    if (!isKnown) return refused(edit, "badField", f.name, fmt::format("{} has no '{}'", what, f.name));
  }
  if (!any) return refused(edit, "badField", "target", "the edit sets no field");
  return {};
}

std::optional<ViewError> editLamp(const EditableHome& home, size_t k, const Edit& edit, Edited& out) {
  if (auto e = refuseOthers(edit, {"position", "direction", "dim", "on", "temperatureK", "color", "fluxLm"}, "a lamp"))
    return e;
  const EditableLamp& lamp = home.lamps[k];
  LampState& s = out.state.lamps[k];
  const EditFields& set = edit.set;
  const char* verb = "Change";
  if (set.position) {
    if (lamp.object >= 0) return refused(edit, "notPossible", "position", "the lamp is part of a thing; move that");
    if (lamp.sources.empty()) return refused(edit, "notPossible", "position", "the lamp has no place of its own");
    s.position = *set.position, verb = "Move";
  }
  if (set.direction) {
    if (!lamp.aimed) return refused(edit, "notPossible", "direction", "the lamp has no direction");
    s.direction = *set.direction, verb = "Aim";
  }
  if (set.color) {
    const float l = luminance(*set.color);
    if (!(l > 0)) return refused(edit, "badField", "color", "must not be black; dim the lamp instead");
    s.color = *set.color / l, s.temperatureK.reset(), verb = "Colour";
  }
  if (set.temperatureK) s.temperatureK = *set.temperatureK, s.color.reset(), verb = "Colour";
  if (set.fluxLm) {
    if (!(lamp.fluxLm > 0)) return refused(edit, "notPossible", "fluxLm", "what the lamp sends out is not known");
    s.fluxLm = static_cast<double>(*set.fluxLm), verb = "Change";
  }
  if (set.on) s.on = *set.on, verb = *set.on ? "Switch on" : "Switch off";
  if (set.dim) s.dim = *set.dim, verb = "Dim";
  out.label = fmt::format("{} {}", verb, lamp.label);
  return {};
}

std::optional<ViewError> paint(const EditableObject& object, const Scene& scene, const Edit& edit, ObjectState& s) {
  const Vec3 color = *edit.set.color;
  if (maxComponent(color) > 1) return refused(edit, "badField", "color", "of a surface must be from 0 to 1");
  if (object.paints.empty()) return refused(edit, "notPossible", "color", "the thing has no material of its own");
  const auto materialOf = [&](size_t p) -> const Material& { return scene.materials[object.paints[p].material]; };
  const auto paintThose = [&](const auto& are) {
    bool any = false;
    for (size_t p = 0; p < object.paints.size(); ++p) {
      if (are(p)) s.colors[p] = color, any = true;
    }
    return any;
  };
  // By its name, or where none has that by what people call it.
  const bool any =
      paintThose([&](size_t p) { return !edit.set.material || materialOf(p).name == *edit.set.material; }) ||
      paintThose([&](size_t p) { return shownMaterialName(materialOf(p), s.colors[p]) == *edit.set.material; });
  if (!any)
    return refused(edit, "unknownThing", "material", fmt::format("no material '{}'", printable(*edit.set.material)));
  return {};
}

std::optional<ViewError> editObject(const EditableHome& home, const Scene& scene, size_t k, const Edit& edit,
                                    Edited& out) {
  if (auto e = refuseOthers(edit, {"move", "turn", "alone", "hidden", "color", "material", "open"}, "an object"))
    return e;
  const EditableObject& object = home.objects[k];
  ObjectState& s = out.state.objects[k];
  const EditFields& set = edit.set;
  const char* verb = "Change";
  if ((set.move || set.turnDeg) && !object.movable)
    return refused(edit, "notPossible", set.move ? "move" : "turn", "it stands still");
  if (set.open && !object.opens) return refused(edit, "notPossible", "open", "nothing of it opens");
  if (set.move) s.move = *set.move, verb = "Move";
  if (set.turnDeg) s.turnDeg = *set.turnDeg, verb = set.move ? "Move" : "Turn";
  if (set.move || set.turnDeg) out.moved = k;
  if (set.color) {
    if (auto e = paint(object, scene, edit, s)) return e;
    verb = "Colour";
  }
  if (set.open) s.open = *set.open, verb = *set.open > 0 ? "Open" : "Shut";
  if (set.hidden) s.hidden = *set.hidden, verb = *set.hidden ? "Hide" : "Show";
  out.label = fmt::format("{} {}", verb, object.label);
  return {};
}

std::optional<ViewError> editSun(const Edit& edit, Edited& out) {
  if (auto e = refuseOthers(edit, {"date", "hour", "on"}, "the sun")) return e;
  if (!out.state.sun) return refused(edit, "notPossible", "target", "the home has no sun by date");
  SunState& s = *out.state.sun;
  if (edit.set.year) s.year = *edit.set.year, s.month = *edit.set.month, s.day = *edit.set.day;
  if (edit.set.hour) s.hour = *edit.set.hour;
  s.on = edit.set.on.value_or(true);
  out.label = edit.set.on ? fmt::format("Switch daylight {}", s.on ? "on" : "off")
                          : fmt::format("Sun to {:04}-{:02}-{:02} {:02}:{:02}", s.year, s.month, s.day,
                                        static_cast<int>(s.hour), static_cast<int>(std::fmod(s.hour, 1) * 60));
  return {};
}

}  // namespace

std::optional<ViewError> applyEdit(const EditableHome& home, const Scene& scene, const Edit& edit, const HomeState& now,
                                   Edited& out) {
  out.state = now, out.moved.reset();
  if (edit.target == "sun") return editSun(edit, out);
  if (const auto k = numberIn(edit.target, "lamp:", home.lamps.size())) return editLamp(home, *k, edit, out);
  const auto k = numberIn(edit.target, "object:", home.objects.size());
  if (k && !home.objects[*k].lampBody) return editObject(home, scene, *k, edit, out);
  return refused(edit, "unknownThing", "target", fmt::format("no thing '{}'", printable(edit.target)));
}

}  // namespace roomlight::view
