#include "measure/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measure/glare.h"
#include "measure/lattice.h"
#include "scene/outline.h"

namespace roomlight {
namespace {

constexpr double kMapCells = 48;       // along the longer side of a room
constexpr double kMapTolerance = 3;    // times that of the readings
constexpr double kRoofedShare = 0.25;  // of points under a roof, from which on those under none are outdoors
constexpr float kStoreyM = 3;          // of an area, whose ceiling is not known
constexpr float kBesideCellM = 0.6f;   // a lamp so near to a point of an area hangs in it

void addHorizontal(const RoomPlan& plan, const GridSettings& grid, SurfaceKind kind, float aboveM, bool maps,
                   Measurements& m) {
  GridReading g;
  g.name = fmt::format("{}, {}", plan.room.name, kind == SurfaceKind::Floor ? "floor" : "work plane");
  g.room = plan.room.name, g.kind = kind, g.targets = plan.targets, g.floor = plan.room.floor;
  g.areaM2 = std::abs(signedAreaM2(plan.room.floor));
  const float y = plan.room.elevationM + aboveM;
  g.points.lattice = floorLattice(plan.room.floor, y, grid);
  if (maps) {
    Field map;
    Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    for (const Vec2 p : plan.room.floor)
      low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    map.lattice =
        floorLattice(plan.room.floor, y,
                     {std::max(0.1, static_cast<double>(std::max(high.x - low.x, high.y - low.y)) / kMapCells), 0, 0});
    g.map = std::move(map);
  }
  m.grids.push_back(std::move(g));
}

void countLamps(const std::vector<Luminaire>& luminaires, RoomReading& r) {
  for (const Luminaire& l : luminaires) {
    if (!isIn(r.room, l.position)) continue;
    ++r.lamps, r.wattsW += l.wattsW;
    if (l.wattsW <= 0) ++r.lampsWithoutWatts;
  }
}

void addRoom(const RoomPlan& plan, const GridSettings& grid, bool maps, Measurements& m) {
  RoomReading r;
  r.room = plan.room, r.targets = plan.targets;
  r.areaM2 = std::abs(signedAreaM2(plan.room.floor));
  countLamps(m.luminaires, r);
  if (plan.wattsW > 0) r.wattsW = plan.wattsW, r.lampsWithoutWatts = 0;
  m.rooms.push_back(std::move(r));
  if (plan.onWorkPlane) addHorizontal(plan, grid, SurfaceKind::WorkPlane, static_cast<float>(plan.workPlaneM), maps, m);
  if (plan.onFloor) addHorizontal(plan, grid, SurfaceKind::Floor, 0.01f, maps, m);
  if (!plan.onWalls) return;
  int number = 0;
  for (MeterGrid& wall : wallLattices(plan.room.floor, plan.room.elevationM, plan.room.heightM, grid)) {
    GridReading g;
    g.name = fmt::format("{}, wall {}", plan.room.name, ++number);
    g.room = plan.room.name, g.kind = SurfaceKind::Wall, g.targets = plan.targets;
    g.points.lattice = std::move(wall);
    m.grids.push_back(std::move(g));
  }
}

void addAreas(const RayScene& rays, const GridSettings& grid, bool maps, Measurements& m) {
  for (Area& area : findAreas(rays, kWorkPlaneM, grid)) {
    RoomReading r;
    r.room.name = area.name, r.room.elevationM = area.elevationM, r.areaM2 = area.areaM2;
    m.rooms.push_back(r);
    GridReading g;
    g.name = area.name + ", work plane", g.room = area.name, g.areaM2 = area.areaM2;
    g.points.lattice = std::move(area.points);
    if (maps) g.map = Field{std::move(area.map), {}, {}};
    m.grids.push_back(std::move(g));
  }
  if (m.rooms.empty())
    m.warnings.push_back("no floor under a ceiling was found; say what to measure with --meters or --point");
}

void addGrid(const GridPlan& plan, const GridSettings& grid, Measurements& m) {
  GridReading g;
  g.name = plan.name, g.kind = SurfaceKind::Rectangle, g.targets = plan.targets;
  // The task itself: nothing of it is left out.
  g.points.lattice = rectangleLattice(plan.corner, plan.alongU, plan.alongV, normalize(cross(plan.alongU, plan.alongV)),
                                      {grid.spacingM, 0, 0});
  m.grids.push_back(std::move(g));
}

// Takes points out of use that say nothing of their room.
void leaveOut(const RayScene& rays, Measurements& m) {
  size_t cells = 0, roofed = 0;
  for (const GridReading& g : m.grids)
    cells += g.points.lattice.count(), roofed += cellsUnderRoof(rays, g.points.lattice);
  const bool roofs = static_cast<double>(roofed) >= kRoofedShare * static_cast<double>(cells);
  for (GridReading& g : m.grids) {
    const size_t before = g.points.lattice.count();
    LatticePlaces places = leaveOutMisplaced(rays, g.points.lattice, roofs);
    g.leftOut = std::move(places.leftOut), g.outdoors = places.outdoors;
    if (g.map) leaveOutMisplaced(rays, g.map->lattice, roofs);
    if (before == 0)
      m.warnings.push_back(fmt::format("{}: no point to measure at; set 'border' or 'spacing' smaller", g.name));
  }
}

// Of the readings so far; `readings` are new ones.
void addCertainty(const std::vector<MeterReading>& readings, std::vector<double>& errors) {
  for (const MeterReading& r : readings) {
    const double lux = static_cast<double>(luminance(r.illuminanceLux));
    if (lux > 0) errors.push_back(r.standardErrorLux / lux);
  }
}

Certainty certaintyOf(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  return {errors.size(), errors.back(), errors[errors.size() / 2]};
}

void readFields(const LitScene& lit, const std::vector<Field*>& fields, const MeterSettings& settings,
                const Progress& progress, std::vector<double>& errors) {
  std::vector<SurfaceElement> elements;
  for (const Field* f : fields) {
    for (const SurfaceElement& e : f->lattice.elements()) elements.push_back(e);
  }
  if (elements.empty()) return;
  std::vector<float> lux;
  const std::vector<MeterReading> readings = lit.illuminance(elements, settings, progress);
  for (const MeterReading& r : readings) lux.push_back(luminance(r.illuminanceLux));
  addCertainty(readings, errors);
  size_t first = 0;
  for (Field* f : fields) {
    const size_t count = f->lattice.count();
    f->lux = f->lattice.spread(std::span(lux).subspan(first, count));
    first += count;
  }
}

void readPoints(const LitScene& lit, const MeterPlan& plan, const MeterSettings& settings, const Progress& progress,
                Measurements& m, std::vector<double>& errors) {
  std::vector<SurfaceElement> elements;
  for (const PointPlan& p : plan.points) elements.push_back(p.place);
  const std::vector<MeterReading> readings = lit.illuminance(elements, settings, progress);
  for (size_t i = 0; i < readings.size(); ++i) {
    m.points.push_back({plan.points[i], static_cast<double>(luminance(readings[i].illuminanceLux)),
                        readings[i].standardErrorLux, std::nullopt});
  }
  addCertainty(readings, errors);
}

// A room found without an outline is where its points are.
bool isOver(const GridReading& g, float elevationM, Vec3 p) {
  if (p.y < elevationM || p.y > elevationM + kStoreyM) return false;
  for (const SurfaceElement& e : (g.map ? *g.map : g.points).lattice.elements()) {
    if (std::hypot(e.position.x - p.x, e.position.z - p.z) < kBesideCellM) return true;
  }
  return false;
}

// Says of each luminaire which room it is in.
void nameRooms(Measurements& m) {
  for (Luminaire& l : m.luminaires) {
    for (RoomReading& r : m.rooms) {
      const bool outlined = !r.room.floor.empty();
      const bool inside =
          outlined ? isIn(r.room, l.position) : std::any_of(m.grids.begin(), m.grids.end(), [&](const GridReading& g) {
            return g.room == r.room.name && isOver(g, r.room.elevationM, l.position);
          });
      if (!inside) continue;
      l.room = r.room.name;
      if (!outlined) ++r.lamps, r.wattsW += l.wattsW, r.lampsWithoutWatts += l.wattsW <= 0;
      break;
    }
  }
}

}  // namespace

Measurements measure(const LitScene& lit, const MeterPlan& plan, const MeasureSettings& settings, Stages& stages) {
  Measurements m;
  m.maintenanceFactor = plan.maintenanceFactor;
  const RayScene& rays = lit.rays();
  m.luminaires = luminairesOf(rays.scene());
  stages.run("places", [&](const Progress&) {
    for (const RoomPlan& room : plan.rooms) addRoom(room, plan.grid, settings.maps, m);
    if (plan.empty()) {
      for (const Room& room : rays.scene().rooms) addRoom(planRoom(room), plan.grid, settings.maps, m);
      if (m.rooms.empty()) addAreas(rays, plan.grid, settings.maps, m);
    }
    for (const GridPlan& grid : plan.grids) addGrid(grid, plan.grid, m);
    leaveOut(rays, m);
    return 0;
  });
  std::vector<Field*> points, maps;
  std::vector<double> errors, ofMaps;
  for (GridReading& g : m.grids) {
    points.push_back(&g.points);
    if (g.map) maps.push_back(&*g.map);
  }
  if (!plan.points.empty())
    stages.run("points", [&](const Progress& p) { return readPoints(lit, plan, settings.meters, p, m, errors), 0; });
  if (!points.empty())
    stages.run("grids", [&](const Progress& p) { return readFields(lit, points, settings.meters, p, errors), 0; });
  if (!maps.empty()) {
    MeterSettings rough = settings.meters;
    rough.tolerance *= kMapTolerance;
    stages.run("maps", [&](const Progress& p) { return readFields(lit, maps, rough, p, ofMaps), 0; });
  }
  if (!plan.spots.empty())
    stages.run("spots", [&](const Progress& p) { return m.spots = readSpots(lit, plan.spots, p), 0; });
  if (!plan.glares.empty())
    stages.run("glare", [&](const Progress& p) {
      return m.glares = readGlares(lit, plan.glares, settings.meters, p, m.warnings), 0;
    });
  m.certainty = certaintyOf(std::move(errors));
  for (PointReading& p : m.points) p.place = placeOf(rays, p.plan.place.position);
  for (SpotReading& s : m.spots) s.place = placeOf(rays, s.plan.position);
  for (GlareReading& g : m.glares) g.place = placeOf(rays, g.plan.position);
  nameRooms(m);
  const std::vector<std::string> lines = misplaced(m);
  m.warnings.insert(m.warnings.end(), lines.begin(), lines.end());
  const std::vector<std::string> open = notJudged(m);
  m.warnings.insert(m.warnings.end(), open.begin(), open.end());
  const Lights& lights = lit.lights();
  if (!lights.hasLocal() && lights.sunCount() == 0 && !lights.sky().present())
    m.warnings.push_back("the scene has no light at all: give it some by --lighting");
  return m;
}

namespace {

constexpr int kPixels = 16;  // a side

}  // namespace

Camera cameraAt(Vec3 position, Vec3 direction, float yFovRad) {
  const Vec3 back = -direction;
  const Vec3 upwards = std::abs(direction.y) < 0.999f ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
  const Vec3 right = normalize(cross(upwards, back));
  Camera camera;
  camera.worldFromCamera = {right, cross(back, right), back, position};
  camera.yFovRad = yFovRad;
  camera.aspect = 1;
  return camera;
}

std::vector<SpotReading> readSpots(const LitScene& lit, std::span<const SpotPlan> plans, const Progress& progress) {
  std::vector<SpotReading> list;
  for (const SpotPlan& plan : plans) {
    if (progress.stop()) break;
    const Image image = lit.picture(
        cameraAt(plan.position, plan.direction, static_cast<float>(plan.angleDeg) * kPi / 180), kPixels, kPixels);
    double sum = 0;
    for (const Vec3& p : image.pixels) sum += static_cast<double>(luminance(p));
    list.push_back({plan, sum / static_cast<double>(std::max<size_t>(1, image.pixels.size()))});
    progress.at(static_cast<float>(list.size()) / static_cast<float>(plans.size()));
  }
  return list;
}

}  // namespace roomlight
