#include "view/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/settings.h"
#include "engine/technique.h"
#include "measure/false_colour.h"
#include "photometry/sun.h"
#include "scene/shown_names.h"

namespace roomlight::view {
namespace {

constexpr int kLegendColours = 17;

double rounded(float v) { return std::round(static_cast<double>(v) * 1e5) / 1e5; }

Json namedJson(const std::vector<std::pair<std::string, std::string>>& list) {
  Json out = Json::array();
  for (const auto& [name, about] : list) out.push_back({{"name", name}, {"about", about}});
  return out;
}

Json cameraJson(const ViewCamera& c) {
  return {{"position", vectorJson(c.position)},
          {"direction", vectorJson(c.direction)},
          {"up", vectorJson(c.up)},
          {"verticalFov", rounded(c.yFovDeg)},
          {"cutHeight", c.cutHeightM < kInfinity ? Json(rounded(c.cutHeightM)) : Json(nullptr)}};
}

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json displayJson(const ViewDisplay& d) {
  Json white = "none";
  if (d.display.automaticWhite) white = "auto";
  if (d.display.whiteK) white = *d.display.whiteK;
  return {{"exposure", d.display.ev100 ? Json(rounded(*d.display.ev100)) : Json("auto")},
          {"compensation", rounded(d.compensationEv)},
          {"curve", toneCurveName(d.display.tone.curve)},
          {"whiteBalance", white},
          {"falseColor", d.falseColour == FalseColour::Off         ? "off"
                         : d.falseColour == FalseColour::Luminance ? "luminance"
                                                                   : "illuminance"},
          {"low", orNull(d.low)},
          {"high", orNull(d.high)}};
}

Json sideJson(const SplitSide& side) {
  Json out = Json::object();
  if (!side.technique.empty()) out["technique"] = side.technique;
  if (!side.plan.empty()) out["plan"] = side.plan;
  return out;
}

const char* placeFromName(PlaceFrom from) {
  switch (from) {
    case PlaceFrom::Lighting: return "lighting";
    case PlaceFrom::Home: return "home";
    case PlaceFrom::Assumed: break;
  }
  return "assumed";
}

Json roomsJson(const Scene& scene) {
  Json out = Json::array();
  for (const Room& room : scene.rooms) {
    Bounds3 b;
    Json floor = Json::array();
    for (const Vec2 p : room.floor) {
      b.add({p.x, room.elevationM, p.y});
      floor.push_back({rounded(p.x), rounded(p.y)});
    }
    if (b.empty()) continue;
    b.add(b.hi + Vec3{0, room.heightM, 0});
    out.push_back({{"name", room.name}, {"low", vectorJson(b.lo)}, {"high", vectorJson(b.hi)}, {"floor", floor}});
  }
  return out;
}

Json camerasJson(const Scene& scene) {
  Json out = Json::array();
  for (const Camera& c : scene.cameras) {
    if (c.projection != Projection::Perspective) continue;
    Json camera = cameraJson(viewOf(c));
    camera["name"] = c.name;
    out.push_back(camera);
  }
  return out;
}

// What people call the materials of a thing, as they are painted now; two that would be called the same have their
// names beside that.
std::vector<std::string> paintLabels(const EditableObject& object, const Scene& scene, const ObjectState& state) {
  std::vector<std::string> labels;
  for (size_t k = 0; k < object.paints.size(); ++k)
    labels.push_back(shownMaterialName(scene.materials[object.paints[k].material], state.colors[k]));
  labels = withoutCopyNumbers(std::move(labels));
  const std::vector<std::string> plain = labels;
  for (size_t k = 0; k < labels.size(); ++k) {
    const std::string& name = scene.materials[object.paints[k].material].name;
    if (!name.empty() && name != plain[k] && std::count(plain.begin(), plain.end(), plain[k]) > 1)
      labels[k] += fmt::format(" ({})", name);
  }
  return labels;
}

}  // namespace

Json vectorJson(Vec3 v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }
std::string lampId(size_t index) { return fmt::format("lamp:{}", index); }
std::string objectId(size_t index) { return fmt::format("object:{}", index); }

Json lampJson(const EditableHome& home, size_t index, const HomeState& state) {
  const EditableLamp& lamp = home.lamps[index];
  const LampState& s = state.lamps[index];
  const float fileK = s.color ? 0 : lamp.temperatureK.value_or(0), kelvin = s.temperatureK.value_or(fileK);  // 0: none
  return {{"id", lampId(index)},
          {"name", lamp.label},
          {"kind", lamp.kind},
          {"object", lamp.object >= 0 ? Json(objectId(static_cast<size_t>(lamp.object))) : Json(nullptr)},
          {"position", vectorJson(positionOf(home, index, state))},
          {"direction", lamp.aimed ? vectorJson(s.direction) : Json(nullptr)},
          {"fluxLm", lamp.fluxLm > 0 ? Json(std::round(s.fluxLm * 1e3) / 1e3) : Json(nullptr)},
          {"fluxAssumed", lamp.fluxAssumed && s.fluxLm == lamp.fluxLm},
          {"dim", rounded(s.dim)},
          {"on", s.on},
          {"temperatureK", kelvin > 0 ? Json(std::round(kelvin)) : Json(nullptr)},
          {"color", kelvin > 0 ? Json(nullptr) : vectorJson(s.color.value_or(lamp.color))},
          {"movable", lamp.object < 0 && !lamp.sources.empty()}};
}

Json objectJson(const EditableHome& home, const Scene& scene, size_t index, const HomeState& state) {
  const EditableObject& object = home.objects[index];
  const ObjectState& s = state.objects[index];
  const Bounds3 b = boundsOf(object, s);
  const std::vector<std::string> labels = paintLabels(object, scene, s);
  Json colors = Json::array();
  for (size_t k = 0; k < object.paints.size(); ++k) {
    const Material& m = scene.materials[object.paints[k].material];
    colors.push_back({{"material", m.name},
                      {"label", labels[k]},
                      {"color", vectorJson(s.colors[k])},
                      {"textured", m.baseColorTexture.texture >= 0}});
  }
  return {{"id", objectId(index)},      {"name", object.label},
          {"low", vectorJson(b.lo)},    {"high", vectorJson(b.hi)},
          {"movable", object.movable},  {"move", vectorJson(s.move)},
          {"turn", rounded(s.turnDeg)}, {"hidden", s.hidden},
          {"colors", colors},           {"open", object.opens ? Json(rounded(s.open)) : Json(nullptr)}};
}

Json overlapsJson(const std::vector<Overlap>& overlaps) {
  Json out = Json::array();
  for (const Overlap& o : overlaps) out.push_back({{"object", objectId(o.thing)}, {"into", objectId(o.into)}});
  return out;
}

Json sunJson(const ViewHome& home, const HomeState& state) {
  if (!state.sun || !home.sun) return nullptr;
  const SunState& s = *state.sun;
  const SunPosition p = sunPosition({s.year, s.month, s.day, s.hour - home.sun->utcOffsetH}, home.sun->latitudeDeg,
                                    home.sun->longitudeDeg);
  const double deg = 180 / static_cast<double>(kPi);
  return {{"on", s.on},
          {"placeFrom", placeFromName(home.sun->placeFrom)},
          {"date", fmt::format("{:04}-{:02}-{:02}", s.year, s.month, s.day)},
          {"hour", s.hour},
          {"utcOffset", home.sun->utcOffsetH},
          {"latitude", home.sun->latitudeDeg},
          {"longitude", home.sun->longitudeDeg},
          {"sky", home.sun->sky},
          {"altitude", std::round(p.altitudeRad * deg * 100) / 100},
          {"azimuth", std::round(std::fmod(p.bearingRad * deg + 360, 360) * 100) / 100}};
}

Json homeJson(const ViewHome& home) {
  const Bounds3 b = home.scene.bounds();
  Json legend = Json::array();
  for (int i = 0; i < kLegendColours; ++i)
    legend.push_back(hexColour(falseColour(static_cast<double>(i) / (kLegendColours - 1))));
  return {{"type", "welcome"},
          {"protocol", 1},
          {"version", version()},
          {"home", home.name},
          {"bounds", {vectorJson(b.lo), vectorJson(b.hi)}},
          {"rooms", roomsJson(home.scene)},
          {"cameras", camerasJson(home.scene)},
          {"techniques", namedJson(describedTechniques())},
          {"qualities", namedJson(qualities())},
          {"curves", toneCurveNames()},
          {"legend", legend},
          {"limits",
           {{"frameWidth", kMostFrameWidth},
            {"frameHeight", kMostFrameHeight},
            {"renderWidth", 7680},
            {"renderHeight", 4320},
            {"messageBytes", kMostMessageBytes},
            {"messagesPerSecond", 240}}}};
}

void addWindow(const Window& window, Json& welcome) {
  welcome["window"] = window.name;
  welcome["camera"] = cameraJson(window.camera);
  welcome["technique"] = window.technique;
  welcome["display"] = displayJson(window.display);
  welcome["split"] = window.split
                         ? Json({{"left", sideJson(window.split->left)}, {"right", sideJson(window.split->right)}})
                         : Json(nullptr);
}

std::string textOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string errorText(const ViewError& e) {
  return textOf({{"type", "error"},
                 {"id", orNull(e.id)},
                 {"code", e.code},
                 {"field", e.field.empty() ? Json(nullptr) : Json(e.field)},
                 {"message", e.message}});
}

std::string okText(uint32_t id) { return textOf({{"type", "ok"}, {"id", id}}); }

std::string pointText(const Point& asked, Json hit) {
  return textOf({{"type", asked.meter ? "metered" : "picked"}, {"id", asked.id}, {"hit", std::move(hit)}});
}

}  // namespace roomlight::view
