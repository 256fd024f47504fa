#include "measure/drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/views.h"
#include "measure/measurements.h"
#include "report/page.h"

namespace roomlight {
namespace {

constexpr float kCutM = 1.2f, kMarginM = 0.4f;
constexpr float kTopStoreyM = 4;           // how far above the highest floor luminaires belong to it
constexpr float kUnderFloorM = 0.3f;
constexpr float kWidthPx = 860, kHeightPx = 600;
constexpr float kLeastCmAPixel = 0.75f;    // small homes are not drawn larger
constexpr float kNarrowPx = 92;            // rooms narrower than this have a short label

struct PlacedRoom {
  const RoomReading* reading = nullptr;
  const GridReading* grid = nullptr;  // its work plane; may be null
  const RoomTarget* target = nullptr;
};

const MeterGrid& latticeOf(const GridReading& g) { return (g.map ? *g.map : g.points).lattice; }

Bounds3 boundsOf(const PlacedRoom& r) {
  Bounds3 b;
  for (const Vec2 p : r.reading->room.floor) b.add({p.x, 0, p.y});
  if (!b.empty() || !r.grid) return b;
  const MeterGrid& l = latticeOf(*r.grid);
  const Vec3 half = abs(l.u * (l.stepUM / 2)) + abs(l.v * (l.stepVM / 2));
  for (const SurfaceElement& e : l.elements()) b.add(e.position - half), b.add(e.position + half);
  return b;
}

std::string outlineOf(const PlacedRoom& r) {
  if (!r.reading->room.floor.empty()) return pathOf(r.reading->room.floor, true);
  if (!r.grid) return {};
  const MeterGrid& l = latticeOf(*r.grid);  // of a room that was found: along x and z
  return pathOf(l, [&](Vec2 cells) {
    const Vec3 p = l.corner + l.u * (cells.x * l.stepUM) + l.v * (cells.y * l.stepVM);
    return Vec2{p.x, p.z};
  });
}

// Where a room's label goes.
Vec2 labelPlace(const PlacedRoom& r) {
  if (!r.reading->room.floor.empty()) return middleOf(r.reading->room);
  const std::vector<SurfaceElement> elements = latticeOf(*r.grid).elements();
  Vec3 mean;
  for (const SurfaceElement& e : elements) mean += e.position / static_cast<float>(elements.size());
  const auto nearest =
      std::min_element(elements.begin(), elements.end(), [&](const SurfaceElement& a, const SurfaceElement& b) {
        return lengthSquared(a.position - mean) < lengthSquared(b.position - mean);
      });
  return {nearest->position.x, nearest->position.z};
}

class Storey {
 public:
  Storey(std::vector<PlacedRoom> rooms, float elevationM, float topM)
      : rooms_(std::move(rooms)), elevationM_(elevationM), topM_(topM) {
    for (const PlacedRoom& r : rooms_) bounds_.add(boundsOf(r));
    const Vec3 margin(kMarginM);
    bounds_ = {bounds_.lo - margin, bounds_.hi + margin};
    cmAPixel_ = std::max({kLeastCmAPixel, bounds_.size().x * 100 / kWidthPx, bounds_.size().z * 100 / kHeightPx});
  }

  std::string svg(const Measurements& m, const Scene& scene, const Schedule& schedule) const {
    const Vec3 size = bounds_.size() * 100;
    std::string s = openSvg("plan", "plan", {bounds_.lo.x, bounds_.lo.z}, {size.x, size.z + 34 * cmAPixel_},
                            cmAPixel_);  // with the scale bar
    const Marks marks = lamps(m, schedule);
    for (const PlacedRoom& r : rooms_)
      s += fmt::format("<path class=\"room {}\" d=\"{}\"/>\n", kindOf(r), outlineOf(r));
    s += cutLines(scene);
    for (const auto& [place, mark] : marks) s += mark;
    for (const PlacedRoom& r : rooms_) s += label(r, marks);
    return s + scaleBar() + "</svg>\n";
  }

 private:
  static const char* kindOf(const PlacedRoom& r) {
    return !r.target || !r.target->foundLux ? "open" : r.target->met() ? "ok" : "low";
  }

  std::string cutLines(const Scene& scene) const {
    const PlanFrame frame{
        {0, elevationM_ + kCutM, 0}, {1, 0, 0}, {0, 0, 1}, {bounds_.lo.x, bounds_.lo.z}, {bounds_.hi.x, bounds_.hi.z}};
    return fmt::format("<path class=\"cut\" d=\"{}\"/>\n", pathOf(cutPlan(scene, frame)));
  }

  using Marks = std::vector<std::pair<Vec2, std::string>>;  // where in the plan, and what is drawn

  Marks lamps(const Measurements& m, const Schedule& schedule) const {
    Marks marks;
    for (size_t i = 0; i < m.luminaires.size(); ++i) {
      const Luminaire& l = m.luminaires[i];
      const Vec3 p = l.position;
      if (p.y < elevationM_ - kUnderFloorM || p.y > topM_ || p.x < bounds_.lo.x || p.x > bounds_.hi.x ||
          p.z < bounds_.lo.z || p.z > bounds_.hi.z)
        continue;
      marks.emplace_back(Vec2{p.x, p.z},
                         fmt::format("<g class=\"lamp\" transform=\"translate({} {}) scale({:.3f})\"><title>{}, {:.2f} "
                                     "m</title><circle r=\"8.5\"/><text y=\".5\">{}</text></g>\n",
                                     cm(p.x), cm(p.z), cmAPixel_, report::escaped(l.name), p.y, schedule.rowOf[i] + 1));
    }
    return marks;
  }

  // The first place near to the wanted one that no lamp's mark covers.
  Vec2 clearOf(const Marks& marks, Vec2 wanted) const {
    const float pixelM = cmAPixel_ / 100;
    for (const float down : {0.0f, 30.0f, -34.0f, 46.0f, -50.0f}) {
      const Vec2 at{wanted.x, wanted.y + down * pixelM};
      const bool covered = std::any_of(marks.begin(), marks.end(), [&](const auto& mark) {
        const Vec2 d = (mark.first - at) * (1 / pixelM);
        return std::abs(d.x) < 38 && d.y > -26 && d.y < 36;
      });
      if (!covered) return at;
    }
    return wanted;
  }

  std::string label(const PlacedRoom& r, const Marks& marks) const {
    if (r.reading->room.floor.empty() && (!r.grid || latticeOf(*r.grid).count() == 0)) return {};
    const Vec2 at = clearOf(marks, labelPlace(r));
    const bool isNarrow = boundsOf(r).size().x * 100 / cmAPixel_ < kNarrowPx;
    std::string s = fmt::format("<g class=\"label{}\" transform=\"translate({} {}) scale({:.3f})\">",
                                isNarrow ? " narrow" : "", cm(at.x), cm(at.y), cmAPixel_);
    s += fmt::format("<text class=\"name\" y=\"-5\">{}</text>",
                     report::escaped(r.reading->room.name.empty() ? "room" : r.reading->room.name));
    const Statistics l = r.grid ? r.grid->lux() : Statistics();
    if (l.points > 0) {
      const char* mark = !r.target ? "" : r.target->met() ? " ✓" : " ✗";
      s += fmt::format("<text y=\"10\">{} lx{}</text>", threeDigits(l.mean), mark);
    }
    if (!isNarrow) s += fmt::format("<text class=\"soft\" y=\"24\">{:.1f} m²</text>", r.reading->areaM2);
    return s + "</g>\n";
  }

  std::string scaleBar() const {
    const int metres = bounds_.size().x > 12 ? 5 : bounds_.size().x > 4 ? 2 : 1;
    const float x = bounds_.lo.x * 100 + kMarginM * 100, y = bounds_.hi.z * 100 + 14 * cmAPixel_;
    return fmt::format(
        "<g class=\"bar\"><path d=\"M{0:.0f},{1:.0f}v{2:.0f}h{3}v-{2:.0f}\"/><text x=\"{4:.0f}\" y=\"{5:.0f}\">{6} "
        "m</text></g>\n",
        x, y, 6 * cmAPixel_, metres * 100, x + static_cast<float>(metres) * 100 + 7 * cmAPixel_, y + 8 * cmAPixel_,
        metres);
  }

  std::vector<PlacedRoom> rooms_;
  float elevationM_, topM_, cmAPixel_ = 1;
  Bounds3 bounds_;
};

}  // namespace

const char* const kOverviewPlanStyle = R"(
.plan{display:block;max-width:100%;height:auto;margin:10px 0 4px}
.plan .room{stroke:none}
.plan .ok{fill:#e3f1e8}.plan .low{fill:#fbe6df}.plan .open{fill:#eef0f2}
.plan .cut{fill:none;stroke:#1d2530;stroke-width:calc(1.1*var(--px));stroke-linejoin:round;stroke-linecap:round}
.plan .lamp circle{fill:#ffd766;stroke:#1d2530;stroke-width:1.1}
.plan .lamp text{font-size:9.5px;font-weight:600;text-anchor:middle;dominant-baseline:central}
.plan .label text{font-size:12px;text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-opacity:.85;stroke-width:3px;stroke-linejoin:round}
.plan .label .name{font-weight:600;font-size:13px}
.plan .label .soft{fill:var(--soft);font-size:11px}
.plan .narrow text{font-size:10px}.plan .narrow .name{font-size:10px}
.plan .bar path{fill:none;stroke:var(--ink);stroke-width:calc(1.4*var(--px))}
.plan .bar text{font-size:calc(12*var(--px))}
)";

std::vector<OverviewPlan> overviewPlans(const Measurements& m, const Scene& scene, const Schedule& schedule) {
  const std::vector<RoomTarget> targets = roomTargets(m);
  std::vector<PlacedRoom> rooms;
  for (const RoomReading& r : m.rooms) {
    PlacedRoom room{&r, nullptr, nullptr};
    for (const GridReading& g : m.grids) {
      if (!room.grid && g.room == r.room.name && g.kind == SurfaceKind::WorkPlane) room.grid = &g;
    }
    for (const RoomTarget& t : targets) {
      if (t.room == r.room.name) room.target = &t;
    }
    if (!boundsOf(room).empty()) rooms.push_back(room);
  }
  std::stable_sort(rooms.begin(), rooms.end(), [](const PlacedRoom& a, const PlacedRoom& b) {
    return a.reading->room.elevationM < b.reading->room.elevationM;
  });
  std::vector<std::vector<PlacedRoom>> storeys;
  for (const PlacedRoom& r : rooms) {
    if (storeys.empty() || r.reading->room.elevationM - storeys.back().front().reading->room.elevationM > kLevelsApartM)
      storeys.emplace_back();
    storeys.back().push_back(r);
  }
  std::vector<OverviewPlan> plans;
  for (size_t i = 0; i < storeys.size(); ++i) {
    const float elevation = storeys[i].front().reading->room.elevationM;
    const float top = i + 1 < storeys.size() ? storeys[i + 1].front().reading->room.elevationM - kUnderFloorM
                                             : elevation + kTopStoreyM;
    plans.push_back({elevation, Storey(storeys[i], elevation, top).svg(m, scene, schedule)});
  }
  return plans;
}

}  // namespace roomlight
