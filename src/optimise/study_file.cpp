#include "optimise/study_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/utf8.h"
#include "scene/outline.h"

namespace roomlight::optimise {
namespace {

// Of a year, in homes (docs/methods/optimise.md says where these are from).
constexpr double kDarkHours = 1680, kDayHours = 1820;
constexpr size_t kMostObjectives = 4;
constexpr double kBehindWallM = 0.3;

struct Reading {
  const std::vector<Room>& rooms;
  StudyFile& out;
};

nlohmann::json jsonOf(const TomlNode& node) {
  switch (node.kind) {
    case TomlNode::Kind::Table: {
      nlohmann::json j = nlohmann::json::object();
      for (const TomlNode& c : node.children) j[c.key] = jsonOf(c);
      return j;
    }
    case TomlNode::Kind::Array: {
      nlohmann::json j = nlohmann::json::array();
      for (const TomlNode& c : node.children) j.push_back(jsonOf(c));
      return j;
    }
    case TomlNode::Kind::Text: return node.text;
    case TomlNode::Kind::Number: return node.number;
    case TomlNode::Kind::Flag: return node.flag;
    case TomlNode::Kind::Other: break;
  }
  return nullptr;
}

Vec2 corner(const TomlPlace& j) {
  if (!j.isArray() || j.size() != 2) return j.fail("must be [x, z] in metres"), Vec2();
  return {static_cast<float>(j.at(0).number(-1e6, 1e6)), static_cast<float>(j.at(1).number(-1e6, 1e6))};
}

// `room`: one of the home's, or with `floor` a new one.
Room readRoom(const TomlPlace& j, const std::vector<Room>& rooms) {
  Room room;
  room.name = j["room"].text();
  if (j.has("floor")) {
    const TomlPlace floor = j["floor"];
    for (size_t i = 0, n = floor.size(); i < n; ++i) room.floor.push_back(corner(floor.at(i)));
    if (room.floor.size() < 3 || crossesItself(room.floor) || std::abs(signedAreaM2(room.floor)) < 1e-3)
      return floor.fail("must be an outline of three corners or more that does not cross itself"), room;
    if (signedAreaM2(room.floor) < 0) std::reverse(room.floor.begin(), room.floor.end());
    room.elevationM = static_cast<float>(j.number("elevation", -1e4, 1e4, 0));
    room.heightM = static_cast<float>(j.number("ceiling", 1, 100, 2.5));
    return room;
  }
  const auto found = std::find_if(rooms.begin(), rooms.end(), [&](const Room& r) { return r.name == room.name; });
  if (found != rooms.end()) return *found;
  std::string names;
  for (const Room& r : rooms) names += (names.empty() ? "'" : ", '") + r.name + "'";
  j["room"].fail(
      rooms.empty()
          ? fmt::format("the home knows no rooms; give '{}' a 'floor' of corners [x, z]", printable(room.name))
          : fmt::format("there is no room '{}'; there are {}; another needs a 'floor' of corners [x, z]",
                        printable(room.name), names));
  return room;
}

std::vector<size_t> readConditions(const TomlPlace& j, const StudyFile& out) {
  std::vector<size_t> list;
  if (!j.has("conditions")) {
    for (size_t i = 0; i < out.conditions.size(); ++i) list.push_back(i);
    return list;
  }
  const TomlPlace names = j["conditions"];
  for (const std::string& name : names.texts()) {
    const auto c =
        std::find_if(out.conditions.begin(), out.conditions.end(), [&](const Condition& x) { return x.name == name; });
    if (c == out.conditions.end()) return names.fail(fmt::format("there is no condition '{}'", printable(name))), list;
    list.push_back(static_cast<size_t>(c - out.conditions.begin()));
  }
  if (list.empty()) names.fail("must not be empty");
  return list;
}

template <class List>
void checkName(const TomlPlace& j, const List& list, const std::string& name) {
  for (const auto& other : list) {
    if (other.name == name) return j.fail(fmt::format("the name '{}' is there twice", printable(name)));
  }
}

// As an array of tables; none where it is not there.
template <class Read>
void each(const TomlPlace& root, const char* key, Read&& read) {
  if (!root.has(key)) return;
  const TomlPlace list = root[key];
  for (size_t i = 0, n = list.size(); i < n; ++i) read(list.at(i));
}

std::filesystem::path beside(const StudyFile& out, const std::string& name) {
  return std::filesystem::absolute(out.file.parent_path() / name).lexically_normal();
}

void readCondition(const TomlPlace& j, StudyFile& out) {
  if (!j.isTable({"name", "daylight", "weight", "hours", "comment"})) return;
  Condition c;
  c.name = j["name"].text(), c.line = j.line();
  checkName(j, out.conditions, c.name);
  const TomlPlace daylight = j["daylight"];
  if (daylight.isText()) {
    daylight.oneOf({"none"});
  } else {
    c.daylight = jsonOf(daylight.node());
    // Lighting files that are made of it lie elsewhere.
    if (c.daylight.is_object() && c.daylight.contains("weather") && c.daylight["weather"].is_string())
      c.daylight["weather"] = beside(out, c.daylight["weather"].get<std::string>()).string();
  }
  c.weight = j.number("weight", 0, 1e6, 1);
  c.hoursPerYear = j.number("hours", 0, 8784, -1);
  out.conditions.push_back(c);
}

// Conditions without hours share those of the dark, or those of the day, by their weights.
void shareHours(StudyFile& out) {
  for (const bool night : {true, false}) {
    double open = 0, left = night ? kDarkHours : kDayHours;
    for (const Condition& c : out.conditions) {
      if (c.daylight.is_null() != night) continue;
      if (c.hoursPerYear < 0) open += c.weight;
      if (c.hoursPerYear > 0) left -= c.hoursPerYear;
    }
    for (Condition& c : out.conditions) {
      if (c.daylight.is_null() == night && c.hoursPerYear < 0)
        c.hoursPerYear = open > 0 ? std::max(0.0, left) * c.weight / open : 0;
    }
  }
}

void readZone(const TomlPlace& j, const Reading& r) {
  if (!j.isTable({"name", "room", "floor", "elevation", "ceiling", "rectangle", "height", "spacing", "border", "mean",
                  "uniformity", "use", "weight", "conditions", "comment"}))
    return;
  Zone z;
  z.line = j.line();
  z.rectangle = j.has("rectangle");
  if (z.rectangle) {
    const TomlPlace rectangle = j["rectangle"];
    if (!rectangle.isTable({"corner", "u", "v"})) return;
    z.corner = rectangle["corner"].vector(), z.alongU = rectangle["u"].vector(), z.alongV = rectangle["v"].vector();
    if (length(cross(z.alongU, z.alongV)) < 1e-4f) rectangle.fail("u and v must span a surface");
    for (const char* key : {"room", "floor", "height", "border"}) {
      if (j.has(key)) j[key].fail("means nothing beside 'rectangle'");
    }
    z.name = j["name"].text();
  } else {
    z.room = readRoom(j, r.rooms);
    z.name = j.text("name", z.room.name);
  }
  checkName(j, r.out.zones, z.name);
  if (j.has("use")) {
    const RoomUse* use = findRoomUse(j["use"].text());
    if (!use) {
      j["use"].fail("there is no such use; write living, bedroom, dining, kitchen, bathroom or office");
    } else {
      z.meanLux = use->targets.lux ? use->targets.lux->value : 0,
      z.u0 = use->targets.uniformity ? use->targets.uniformity->value : 0;
      z.workPlaneM = use->workPlaneM;
    }
  }
  z.workPlaneM = j.number("height", 0, 10, z.workPlaneM);
  z.spacingM = j.number("spacing", 0.05, 10, 0), z.borderM = j.number("border", 0, 5, z.borderM);
  if (j.has("mean")) z.meanLux = j["mean"].quantity(Unit::Lux, 0.1, 1e5);
  z.u0 = j.number("uniformity", 0, 1, z.u0);
  z.weight = j.number("weight", 0, 1e6, 1);
  z.conditions = readConditions(j, r.out);
  r.out.zones.push_back(z);
}

void readEye(const TomlPlace& j, StudyFile& out) {
  if (!j.isTable({"name", "position", "lookAt", "direction", "ugr", "conditions", "comment"})) return;
  Eye e;
  e.name = j["name"].text();
  checkName(j, out.eyes, e.name);
  e.position = j["position"].vector();
  if (j.has("lookAt") == j.has("direction")) return j.fail("needs one of 'lookAt' and 'direction'");
  const Vec3 d = j.has("lookAt") ? j["lookAt"].vector() - e.position : j["direction"].vector();
  if (length(d) < 1e-5f) return j.fail("looks nowhere: its direction is zero");
  e.direction = normalize(d);
  e.ugr = j.number("ugr", 5, 40, e.ugr);
  e.conditions = readConditions(j, out);
  out.eyes.push_back(e);
}

void readRatio(const TomlPlace& j, StudyFile& out) {
  if (!j.isTable({"name", "eye", "task", "surround", "most", "conditions", "comment"})) return;
  Ratio q;
  q.name = j["name"].text();
  checkName(j, out.ratios, q.name);
  q.eye = j["eye"].vector(), q.task = j["task"].vector(), q.surround = j["surround"].vector();
  if (length(q.task - q.eye) < 1e-3f || length(q.surround - q.eye) < 1e-3f)
    j.fail("'task' and 'surround' must lie apart from 'eye'");
  q.most = j.number("most", 1, 1e4, q.most);
  q.conditions = readConditions(j, out);
  out.ratios.push_back(q);
}

void readAims(const TomlPlace& j, PlaceRule& p) {
  if (!j.has("aims")) {
    p.aimWords = {p.on == Mounting::Ceiling ? "down" : p.on == Mounting::Wall ? "out" : "up"};
    return;
  }
  const TomlPlace aims = j["aims"];
  for (size_t i = 0, n = aims.size(); i < n; ++i) {
    if (aims.at(i).isText()) {
      p.aimWords.push_back(aims.at(i).oneOf({"down", "up", "out"}));
      if (p.aimWords.back() == "out" && p.on != Mounting::Wall) aims.at(i).fail("'out' is for walls");
    } else {
      p.aimPoints.push_back(aims.at(i).vector());
    }
  }
  if (aims.size() == 0) aims.fail("must not be empty");
}

// Places one by one, inside the room; those for walls may be given a little behind the wall.
void readAt(const TomlPlace& j, PlaceRule& p) {
  if (!j.has("at")) return;
  const TomlPlace at = j["at"];
  for (size_t i = 0, n = at.size(); i < n; ++i) {
    const Vec3 place = at.at(i).vector();
    const Vec2 onFloor{place.x, place.z};
    const bool wall = p.on == Mounting::Wall;
    const bool inside = !p.room.floor.empty() && (contains(p.room.floor, onFloor) ||
                                                  (wall && distanceToEdgeM(p.room.floor, onFloor) < kBehindWallM));
    const float above = place.y - p.room.elevationM;
    if (!inside) at.at(i).fail(fmt::format("lies outside of '{}'", printable(p.room.name)));
    if (wall && (above < 0 || above > p.room.heightM))
      at.at(i).fail(fmt::format("its height must be between floor and ceiling of '{}', {:g} to {:g}",
                                printable(p.room.name), p.room.elevationM, p.room.elevationM + p.room.heightM));
    p.at.push_back(place);
  }
  if (p.at.empty()) at.fail("must not be empty");
}

void readPlace(const TomlPlace& j, const Reading& r) {
  if (!j.isTable({"name", "on", "room", "floor", "elevation", "ceiling", "luminaires", "aims", "spacing", "fromWalls",
                  "height", "apart", "most", "at", "comment"}))
    return;
  PlaceRule p;
  p.line = j.line();
  p.on = mountingNamed(j["on"].oneOf({"ceiling", "wall", "table", "floor"})).value_or(Mounting::Ceiling);
  p.room = readRoom(j, r.rooms);
  p.name = j.text("name", fmt::format("{}, {}", p.room.name, nameOf(p.on)));
  checkName(j, r.out.places, p.name);
  const TomlPlace names = j["luminaires"];
  for (const std::string& name : names.texts()) {
    const Luminaire* l = r.out.catalogue.find(name);
    if (!l)
      return names.fail(
          fmt::format("there is no '{}' in the catalogue; there are {}", printable(name), r.out.catalogue.names()));
    if (std::find(l->mountings.begin(), l->mountings.end(), p.on) == l->mountings.end())
      return names.fail(fmt::format("'{}' is not for mounting on a {}", l->name, nameOf(p.on)));
    p.luminaires.push_back(static_cast<size_t>(l - r.out.catalogue.luminaires.data()));
  }
  if (p.luminaires.empty()) names.fail("must name at least one");
  readAims(j, p);
  p.spacingM = j.number("spacing", 0.1, 20, p.spacingM), p.fromWallsM = j.number("fromWalls", 0, 10, p.fromWallsM);
  if (j.has("height") && p.on != Mounting::Wall) j["height"].fail("is for walls");
  p.heightM = j.number("height", 0.1, 20, p.heightM), p.apartM = j.number("apart", 0, 20, p.apartM);
  p.most = j.whole("most", 1, 1000, p.most);
  readAt(j, p);
  r.out.places.push_back(p);
}

std::vector<std::string> objectiveNames() {
  std::vector<std::string> names;
  for (const ObjectiveInfo& o : objectiveTable()) names.emplace_back(o.name);
  return names;
}

void readObjectives(const TomlPlace& root, StudyFile& out) {
  if (!root.has("objectives")) {
    out.objectives = {Objective::TargetMiss, Objective::Energy, Objective::Cost};
    return;
  }
  const TomlPlace list = root["objectives"];
  for (size_t i = 0, n = list.size(); i < n; ++i) {
    const std::string word = list.at(i).oneOf(objectiveNames());
    for (const ObjectiveInfo& o : objectiveTable()) {
      if (word != o.name) continue;
      if (std::find(out.objectives.begin(), out.objectives.end(), o.objective) != out.objectives.end())
        list.at(i).fail("is there twice");
      out.objectives.push_back(o.objective);
    }
  }
  if (out.objectives.size() < 2 || out.objectives.size() > kMostObjectives) list.fail("must be two to four");
  if (out.eyes.empty() &&
      std::find(out.objectives.begin(), out.objectives.end(), Objective::Glare) != out.objectives.end())
    list.fail(fmt::format("'{}' needs an [[eye]] to judge from", infoOf(Objective::Glare).name));
}

void readLimits(const TomlPlace& root, StudyFile& out) {
  if (root.has("limits")) {
    const TomlPlace j = root["limits"];
    if (!j.isTable({"watts", "cost", "fittings"})) return;
    out.mostWatts = j.number("watts", 0.1, 1e6, 0), out.mostCost = j.number("cost", 0, 1e9, 0),
    out.mostFittings = j.whole("fittings", 1, 10000, 0);
  }
  if (root.has("dimming")) {
    const std::string word = root["dimming"].oneOf({"none", "common", "by condition"});
    out.dimming = word == "none" ? Dimming::None : word == "common" ? Dimming::Common : Dimming::ByCondition;
  }
  if (root.has("search")) {
    const TomlPlace j = root["search"];
    if (!j.isTable({"evaluations", "population", "seed", "certify"})) return;
    out.evaluations = static_cast<size_t>(j.whole("evaluations", 100, 1000000000, 40000));
    out.population = static_cast<size_t>(j.whole("population", 8, 10000, 100));
    if (out.population % 4) j["population"].fail("must be a multiple of 4");
    out.seed = static_cast<uint64_t>(j.number("seed", 0, 9e15, 1));
    out.certified = j.whole("certify", 0, 1000, out.certified);
  }
}

void readAll(const TomlPlace& root, const Reading& r) {
  StudyFile& out = r.out;
  if (!root.isTable({"version", "title", "comment", "catalogue", "lighting", "ownLamps", "condition", "zone", "eye",
                     "ratio", "place", "limits", "dimming", "objectives", "search", "maintenance", "area", "cameras"}))
    return;
  if (root.has("version")) root["version"].number(1, 1);
  out.title = root.text("title", out.file.stem().string());
  out.catalogueFile = beside(out, root["catalogue"].text());
  Result<Catalogue> catalogue = readCatalogue(out.catalogueFile);
  if (!catalogue) {
    // What is wrong in the catalogue's lines is said with those.
    std::error_code ignored;
    std::filesystem::exists(out.catalogueFile, ignored) ? root["catalogue"].fail("see " + catalogue.error())
                                                        : root["catalogue"].fail(catalogue.error());
    return;
  }
  out.catalogue = std::move(catalogue.value());
  if (root.has("lighting")) {
    out.lightingFile = beside(out, root["lighting"].text());
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(out.lightingFile, ignored))
      root["lighting"].fail(fmt::format("{}: no such file", out.lightingFile.string()));
  }
  out.ownLamps = root.flag("ownLamps", false);
  each(root, "condition", [&](const TomlPlace& j) { readCondition(j, out); });
  if (out.conditions.empty()) out.conditions.push_back({"night", nullptr, 1, -1, 0});
  if (std::none_of(out.conditions.begin(), out.conditions.end(), [](const Condition& c) { return c.weight > 0; }))
    root["condition"].at(0).fail("all have weight 0: nothing would be judged");
  shareHours(out);
  each(root, "zone", [&](const TomlPlace& j) { readZone(j, r); });
  if (out.zones.empty())
    root.fail("has no [[zone]] to be lit");
  else if (std::none_of(out.zones.begin(), out.zones.end(), [](const Zone& z) { return z.weight > 0; }))
    root["zone"].at(0).fail("all have weight 0: nothing would be lit");
  each(root, "eye", [&](const TomlPlace& j) { readEye(j, out); });
  each(root, "ratio", [&](const TomlPlace& j) { readRatio(j, out); });
  each(root, "place", [&](const TomlPlace& j) { readPlace(j, r); });
  if (out.places.empty()) root.fail("has no [[place]] for lamps");
  readObjectives(root, out);
  readLimits(root, out);
  if (root.has("cameras")) out.cameras = root["cameras"].texts();
  out.maintenance = root.number("maintenance", 0.1, 1, 1);
  out.areaM2 = root.number("area", 0.1, 1e7, 0);
}

}  // namespace

const std::vector<ObjectiveInfo>& objectiveTable() {
  static const std::vector<ObjectiveInfo> table = {{Objective::TargetMiss, "targetMiss", "targets missed by", "%"},
                                                   {Objective::Uniformity, "uniformity", "unevenness 1 − U0", ""},
                                                   {Objective::Glare, "glare", "glare above the limit", "UGR"},
                                                   {Objective::Energy, "energy", "energy", "kWh/a"},
                                                   {Objective::Cost, "cost", "cost", ""},
                                                   {Objective::Fittings, "fittings", "fittings", ""}};
  return table;
}

const ObjectiveInfo& infoOf(Objective objective) {
  return *std::find_if(objectiveTable().begin(), objectiveTable().end(),
                       [&](const ObjectiveInfo& o) { return o.objective == objective; });
}

Result<StudyFile> readStudy(const std::filesystem::path& file, const std::vector<Room>& rooms) {
  const Result<TomlNode> tree = readToml(file);
  if (!tree) return Error{tree.error()};
  TomlError error{file.string(), {}};
  StudyFile out;
  out.file = file;
  readAll(TomlPlace(tree.value(), "", error), {rooms, out});
  if (!error.first.empty()) return Error{error.first};
  return out;
}

}  // namespace roomlight::optimise
