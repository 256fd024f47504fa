#include "measure/measurements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/outline.h"

namespace roomlight {

std::string threeDigits(double value) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value);
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  const double unit = std::pow(10.0, before - 3), rounded = std::round(value / unit) * unit;
  // What rounds up to the next power of ten has one digit more before the point.
  const int digits = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-9)) + 1;
  return fmt::format("{:.{}f}", rounded, std::clamp(3 - digits, 0, 6));
}

bool isIn(const Room& room, Vec3 p) {
  return p.y >= room.elevationM && p.y <= room.elevationM + room.heightM && contains(room.floor, {p.x, p.z});
}

std::optional<HomeMeans> homeMeans(const Measurements& m) {
  HomeMeans means;
  for (const GridReading& g : m.grids) {
    const Statistics s = g.lux();
    if (g.kind != SurfaceKind::WorkPlane || g.outdoors || s.points == 0 || g.areaM2 <= 0) continue;
    ++means.rooms, means.areaM2 += g.areaM2;
    means.ofRoomsLux += s.mean, means.ofAreaLux += s.mean * g.areaM2;
  }
  if (means.rooms == 0) return std::nullopt;
  means.ofRoomsLux /= static_cast<double>(means.rooms), means.ofAreaLux /= means.areaM2;
  return means;
}

namespace {

constexpr size_t kMostNames = 3;

std::string namesOf(const std::vector<std::string>& names, const char* more) {
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kMostNames); ++i) text += (i ? ", " : "") + names[i];
  return names.size() > kMostNames ? fmt::format("{} and {} more{}", text, names.size() - kMostNames, more) : text;
}

std::string misplacedAt(const Measurements& m, MeterPlace place, const char* where) {
  std::vector<std::string> grids, meters, whole;
  size_t cells = 0;
  for (const GridReading& g : m.grids) {
    const auto count = static_cast<size_t>(
        std::count_if(g.leftOut.begin(), g.leftOut.end(), [&](const LeftOutCell& c) { return c.place == place; }));
    if (count > 0) cells += count, grids.push_back(fmt::format("{} of '{}'", count, g.name));
    if (g.outdoors && place == MeterPlace::Outdoors) whole.push_back(fmt::format("'{}'", g.name));
  }
  const auto add = [&](const auto& readings) {
    for (const auto& r : readings) {
      if (r.place == place) meters.push_back(fmt::format("'{}'", r.plan.name));
    }
  };
  add(m.points), add(m.spots), add(m.glares);
  std::string text;
  const auto part = [&](const std::string& words) { text += (text.empty() ? "" : "; ") + words; };
  if (cells > 0)
    part(fmt::format("{} {} of grids left out of means and minima ({})", cells, cells == 1 ? "point" : "points",
                     namesOf(grids, grids.size() > kMostNames + 1 ? " grids" : " grid")));
  if (!whole.empty())
    part(fmt::format("{} measured, but left out of the means of the home ({})",
                     whole.size() == 1 ? "one grid" : fmt::format("{} grids", whole.size()), namesOf(whole, "")));
  if (!meters.empty()) {
    part(fmt::format("{} {}{} ({})", meters.size(), meters.size() == 1 ? "meter" : "meters",
                     isMisplaced(place) ? ", read but not judged" : "", namesOf(meters, "")));
  }
  return text.empty() ? text : fmt::format("{}: {}", where, text);
}

}  // namespace

std::vector<std::string> misplaced(const Measurements& m) {
  std::vector<std::string> lines;
  for (const auto& [place, where] :
       {std::pair(MeterPlace::Furniture, "in furniture"), std::pair(MeterPlace::Wall, "in a wall, floor or ceiling"),
        std::pair(MeterPlace::Outdoors, "outdoors")}) {
    const std::string line = misplacedAt(m, place, where);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> notJudged(const Measurements& m) {
  std::vector<std::string> list;
  for (const GridReading& g : m.grids) {
    if (g.kind == SurfaceKind::WorkPlane && g.lux().points == 0 && g.targets.lux)
      list.push_back(fmt::format("{}: illuminance is not judged, since no point is left ({} lie in furniture or walls)",
                                 g.name, g.leftOut.size()));
  }
  for (const GlareReading& g : m.glares) {
    if (isMisplaced(g.place) && g.plan.targets.ugr)
      list.push_back(fmt::format("{}: glare is not judged, since the eye is in {}", g.plan.name,
                                 g.place == MeterPlace::Wall ? "a wall" : "furniture"));
    if (!isMisplaced(g.place) && !g.ugr && g.plan.targets.ugr)
      list.push_back(fmt::format("{}: glare is not judged, since there is no rating", g.plan.name));
  }
  for (const RoomReading& r : m.rooms) {
    const auto ofRoom = [&](const GridReading& g) { return g.room == r.room.name && g.kind == SurfaceKind::WorkPlane; };
    if ((r.targets.lux || r.targets.uniformity) && std::none_of(m.grids.begin(), m.grids.end(), ofRoom))
      list.push_back(fmt::format("{}: illuminance is not judged, since its work plane is not measured", r.room.name));
    const auto eye = [&](const GlareReading& g) { return isIn(r.room, g.plan.position); };
    if (r.targets.ugr && std::none_of(m.glares.begin(), m.glares.end(), eye))
      list.push_back(fmt::format("{}: glare is not judged, since there is no eye in it (glare, or --eye and --view)",
                                 r.room.name));
    if (r.targets.wattsPerM2 && !r.wattsKnown())
      list.push_back(fmt::format("{}: W/m² are not judged, since the watts of {} of {} lamps are not stated",
                                 r.room.name, r.lampsWithoutWatts, r.lamps));
  }
  return list;
}

std::vector<Verdict> verdictsOf(const Measurements& m) {
  std::vector<Verdict> list;
  const auto judge = [&](const std::string& where, const char* what, const char* unit,
                         const std::optional<Target>& wanted, double got, bool atMost) {
    if (wanted) list.push_back({where, what, unit, wanted->source, wanted->value, got, atMost});
  };
  for (const GridReading& g : m.grids) {
    if (g.kind != SurfaceKind::WorkPlane && g.kind != SurfaceKind::Rectangle) continue;
    const Statistics s = g.lux();
    if (s.points == 0) continue;
    judge(g.name, "mean illuminance", "lx", g.targets.lux, s.mean * m.maintenanceFactor, false);
    judge(g.name, "uniformity U0", "", g.targets.uniformity, s.u0(), false);
  }
  for (const PointReading& p : m.points) {
    if (isMisplaced(p.place)) continue;
    judge(p.plan.name, "illuminance", "lx", p.plan.targets.lux, p.lux * m.maintenanceFactor, false);
  }
  for (const GlareReading& g : m.glares) {
    if (g.ugr && !isMisplaced(g.place)) judge(g.plan.name, "glare UGR", "", g.plan.targets.ugr, *g.ugr, true);
  }
  for (const RoomReading& r : m.rooms) {
    for (const GlareReading& g : m.glares) {
      if (g.ugr && !isMisplaced(g.place) && !g.plan.targets.ugr && isIn(r.room, g.plan.position))
        judge(r.room.name + ", " + g.plan.name, "glare UGR", "", r.targets.ugr, *g.ugr, true);
    }
    if (r.wattsKnown() && r.areaM2 > 0)
      judge(r.room.name, "power density", "W/m²", r.targets.wattsPerM2, r.wattsW / r.areaM2, true);
  }
  return list;
}

namespace {

RoomTarget wantedIn(const RoomReading& r) {
  const RoomUse* use = findRoomUse(r.room.use);
  RoomTarget t;
  t.room = r.room.name, t.origin = "stated";
  if (!use) use = useByName(r.room.name), t.origin = "name";
  if (!use) use = findRoomUse(kAssumedUse), t.origin = "assumed";
  t.use = use->name;
  const Target target = r.targets.lux.value_or(*use->targets.lux);
  if (r.targets.lux && r.room.use.empty()) t.origin = "target", t.use.clear();
  t.wantedLux = target.value, t.source = target.source;
  return t;
}

}  // namespace

std::vector<RoomTarget> roomTargets(const Measurements& m) {
  std::vector<RoomTarget> list;
  for (const RoomReading& r : m.rooms) {
    RoomTarget t = wantedIn(r);
    bool outdoors = false;
    for (const GridReading& g : m.grids) {
      if (g.room != r.room.name || g.kind != SurfaceKind::WorkPlane) continue;
      const Statistics s = g.lux();
      outdoors = outdoors || g.outdoors;
      if (s.points > 0) t.foundLux = s.mean * m.maintenanceFactor;
    }
    if (!outdoors) list.push_back(std::move(t));
  }
  return list;
}

}  // namespace roomlight
