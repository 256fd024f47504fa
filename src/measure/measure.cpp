#include "measure/measure.h"

#include <fmt/format.h>

#include <cmath>

#include "measure/areas.h"
#include "measure/glare_meter.h"
#include "scene/outline.h"
#include "measure/spot_meter.h"

namespace roomlight {
namespace {

constexpr double kMapCells = 48;       // along the longer side of a room
constexpr double kMapTolerance = 3;    // times that of the readings

void addHorizontal(const RayScene& rays, const RoomPlan& plan, const GridSettings& grid, SurfaceKind kind, float aboveM, bool maps, Measurements& m) {
  GridReading g;
  g.name = fmt::format("{}, {}", plan.room.name, kind == SurfaceKind::Floor ? "floor" : "work plane");
  g.room = plan.room.name, g.kind = kind, g.targets = plan.targets, g.floor = plan.room.floor;
  const float y = plan.room.elevationM + aboveM;
  g.points.lattice = floorLattice(plan.room.floor, y, grid);
  g.leftOut = leaveOutThings(rays, g.points.lattice);
  if (g.points.lattice.count() == 0) m.warnings.push_back(fmt::format("{}: no free point to measure at; set 'border' or 'spacing' smaller", g.name));
  if (maps) {
    Field map;
    Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    for (const Vec2 p : plan.room.floor) low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    map.lattice = floorLattice(plan.room.floor, y, {std::max(0.1, static_cast<double>(std::max(high.x - low.x, high.y - low.y)) / kMapCells), 0, 0});
    leaveOutThings(rays, map.lattice);
    g.map = std::move(map);
  }
  m.grids.push_back(std::move(g));
}

// Lamps without geometry, and things that emit; a lamp of kind Area is one of those, too, and states their watts.
void countLamps(const Scene& scene, RoomReading& r) {
  const auto inside = [&](Vec3 p) { return contains(r.room.floor, {p.x, p.z}) && p.y >= r.room.elevationM && p.y <= r.room.elevationM + r.room.heightM; };
  size_t stated = 0;
  for (const Lamp& lamp : scene.lamps) {
    if (!inside(lamp.position)) continue;
    if (lamp.kind != LampKind::Area) ++r.lamps;
    if (lamp.wattsW > 0) ++stated;
    r.wattsW += static_cast<double>(lamp.wattsW);
  }
  for (const Instance& i : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    if (!isBlack(scene.materials[static_cast<size_t>(mesh.material)].emission) && inside(instanceBounds(scene, i).centre())) ++r.lamps;
  }
  r.lampsWithoutWatts = r.lamps - std::min(r.lamps, stated);
}

void addRoom(const RayScene& rays, const RoomPlan& plan, const GridSettings& grid, bool maps, Measurements& m) {
  RoomReading r;
  r.room = plan.room, r.targets = plan.targets;
  r.areaM2 = std::abs(signedAreaM2(plan.room.floor));
  countLamps(rays.scene(), r);
  if (plan.wattsW > 0) r.wattsW = plan.wattsW, r.lampsWithoutWatts = 0;
  m.rooms.push_back(std::move(r));
  if (plan.onWorkPlane) addHorizontal(rays, plan, grid, SurfaceKind::WorkPlane, static_cast<float>(plan.workPlaneM), maps, m);
  if (plan.onFloor) addHorizontal(rays, plan, grid, SurfaceKind::Floor, 0.01f, maps, m);
  if (!plan.onWalls) return;
  int number = 0;
  for (Lattice& wall : wallLattices(plan.room.floor, plan.room.elevationM, plan.room.heightM, grid)) {
    GridReading g;
    g.name = fmt::format("{}, wall {}", plan.room.name, ++number);
    g.room = plan.room.name, g.kind = SurfaceKind::Wall, g.targets = plan.targets;
    g.points.lattice = std::move(wall);
    g.leftOut = leaveOutThings(rays, g.points.lattice);
    m.grids.push_back(std::move(g));
  }
}

void addAreas(const RayScene& rays, const GridSettings& grid, bool maps, Measurements& m) {
  for (Area& area : findAreas(rays, kWorkPlaneM, grid)) {
    RoomReading r;
    r.room.name = area.name, r.room.elevationM = area.elevationM, r.areaM2 = area.areaM2;
    m.rooms.push_back(r);
    GridReading g;
    g.name = area.name + ", work plane", g.room = area.name;
    g.points.lattice = std::move(area.points);
    if (maps) g.map = Field{std::move(area.map), {}, {}};
    m.grids.push_back(std::move(g));
  }
  if (m.rooms.empty()) m.warnings.push_back("no floor under a ceiling was found; say what to measure with --meters or --point");
}

void addGrid(const RayScene& rays, const GridPlan& plan, const GridSettings& grid, Measurements& m) {
  GridReading g;
  g.name = plan.name, g.kind = SurfaceKind::Rectangle, g.targets = plan.targets;
  // The task itself: nothing of it is left out.
  g.points.lattice = rectangleLattice(plan.corner, plan.alongU, plan.alongV, normalize(cross(plan.alongU, plan.alongV)), {grid.spacingM, 0, 0});
  g.leftOut = leaveOutThings(rays, g.points.lattice);
  m.grids.push_back(std::move(g));
}

void readFields(const LitScene& lit, const std::vector<Field*>& fields, const MeterSettings& settings, const Progress& progress) {
  std::vector<SurfaceElement> elements;
  for (const Field* f : fields) {
    for (const SurfaceElement& e : f->lattice.elements()) elements.push_back(e);
  }
  if (elements.empty()) return;
  std::vector<float> lux;
  for (const MeterReading& r : lit.illuminance(elements, settings, progress)) lux.push_back(luminance(r.illuminanceLux));
  size_t first = 0;
  for (Field* f : fields) {
    const size_t count = f->lattice.count();
    f->lux = f->lattice.spread(std::span(lux).subspan(first, count));
    first += count;
  }
}

void readPoints(const LitScene& lit, const MeterPlan& plan, const MeterSettings& settings, const Progress& progress, Measurements& m) {
  std::vector<SurfaceElement> elements;
  for (const PointPlan& p : plan.points) {
    elements.push_back(p.place);
    if (insideThing(lit.rays(), p.place.position)) m.warnings.push_back(fmt::format("{}: lies inside a thing, where little light comes", p.name));
  }
  const std::vector<MeterReading> readings = lit.illuminance(elements, settings, progress);
  for (size_t i = 0; i < readings.size(); ++i) {
    m.points.push_back({plan.points[i], static_cast<double>(luminance(readings[i].illuminanceLux)), readings[i].standardErrorLux, std::nullopt});
  }
}

}  // namespace

Measurements measure(const LitScene& lit, const MeterPlan& plan, const MeasureSettings& settings, Stages& stages) {
  Measurements m;
  m.maintenanceFactor = plan.maintenanceFactor;
  const RayScene& rays = lit.rays();
  stages.run("places", [&](const Progress&) {
    for (const RoomPlan& room : plan.rooms) addRoom(rays, room, plan.grid, settings.maps, m);
    if (plan.empty()) {
      for (const Room& room : rays.scene().rooms) addRoom(rays, planRoom(room), plan.grid, settings.maps, m);
      if (m.rooms.empty()) addAreas(rays, plan.grid, settings.maps, m);
    }
    for (const GridPlan& grid : plan.grids) addGrid(rays, grid, plan.grid, m);
    return 0;
  });
  std::vector<Field*> points, maps;
  for (GridReading& g : m.grids) {
    points.push_back(&g.points);
    if (g.map) maps.push_back(&*g.map);
  }
  if (!plan.points.empty()) stages.run("points", [&](const Progress& p) { return readPoints(lit, plan, settings.meters, p, m), 0; });
  if (!points.empty()) stages.run("grids", [&](const Progress& p) { return readFields(lit, points, settings.meters, p), 0; });
  if (!maps.empty()) {
    MeterSettings rough = settings.meters;
    rough.tolerance *= kMapTolerance;
    stages.run("maps", [&](const Progress& p) { return readFields(lit, maps, rough, p), 0; });
  }
  if (!plan.spots.empty()) stages.run("spots", [&](const Progress& p) { return m.spots = readSpots(lit, plan.spots, p), 0; });
  if (!plan.glares.empty()) stages.run("glare", [&](const Progress& p) { return m.glares = readGlares(lit, plan.glares, settings.meters, p, m.warnings), 0; });
  const std::vector<std::string> open = notJudged(m);
  m.warnings.insert(m.warnings.end(), open.begin(), open.end());
  const Lights& lights = lit.lights();
  if (!lights.hasLocal() && lights.sunCount() == 0 && !lights.sky().present()) m.warnings.push_back("the scene has no light at all: give it some by --lighting");
  return m;
}

}  // namespace roomlight
