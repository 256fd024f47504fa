#include <cmath>
#include <nlohmann/json.hpp>

#include "measure/measurements.h"
#include "measure/report.h"

namespace roomlight {
namespace {

using Json = nlohmann::ordered_json;

Json vector(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json statistics(const Statistics& s) {
  return {{"points", s.points}, {"mean", s.mean}, {"min", s.least}, {"max", s.most}, {"u0", s.u0()}, {"u1", s.u1()}};
}

const char* kindName(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::WorkPlane: return "workPlane";
    case SurfaceKind::Floor: return "floor";
    case SurfaceKind::Wall: return "wall";
    case SurfaceKind::Rectangle: break;
  }
  return "rectangle";
}

Json values(const std::vector<float>& list) {
  Json j = Json::array();
  for (const float v : list) j.push_back(finite(static_cast<double>(v)));
  return j;
}

Json gridJson(const GridReading& g) {
  const MeterGrid& l = g.points.lattice;
  Json j = {{"name", g.name}, {"room", g.room}, {"surface", kindName(g.kind)}, {"illuminanceLux", statistics(g.lux())}};
  if (!g.points.daylightPercent.empty())
    j["daylightFactorPercent"] = statistics(statisticsOf(g.points.daylightPercent));
  j["outdoors"] = g.outdoors;
  j["leftOut"] = Json::array();  // cells of the lattice, row by row from 0
  for (const LeftOutCell& c : g.leftOut) j["leftOut"].push_back({{"cell", c.cell}, {"place", placeName(c.place)}});
  j["lattice"] = {{"columns", l.columns},
                  {"rows", l.rows},
                  {"firstM", vector(l.columns && l.rows ? l.centre(0, 0) : l.corner)},
                  {"columnStepM", vector(l.u * l.stepUM)},
                  {"rowStepM", vector(l.v * l.stepVM)},
                  {"normal", vector(l.normal)}};
  j["lux"] = values(g.points.lux);  // row by row; null where nothing was measured
  if (!g.points.daylightPercent.empty()) j["daylightPercent"] = values(g.points.daylightPercent);
  return j;
}

Json roomJson(const RoomReading& r) {
  Json j = {{"name", r.room.name}, {"use", r.room.use}, {"areaM2", r.areaM2}, {"lamps", r.lamps}};
  j["wattsW"] = r.wattsKnown() ? Json(r.wattsW) : Json(nullptr);
  j["wattsPerM2"] = r.wattsKnown() && r.areaM2 > 0 ? Json(r.wattsW / r.areaM2) : Json(nullptr);
  return j;
}

Json pointJson(const PointReading& p) {
  Json j = {{"name", p.plan.name},
            {"positionM", vector(p.plan.place.position)},
            {"normal", vector(p.plan.place.normal)},
            {"illuminanceLux", p.lux},
            {"standardErrorLux", p.standardErrorLux},
            {"ev100", finite(incidentEv100(p.lux))},
            {"place", placeName(p.place)}};
  if (p.daylightPercent) j["daylightFactorPercent"] = *p.daylightPercent;
  return j;
}

Json spotJson(const SpotReading& s) {
  return {{"name", s.plan.name},
          {"positionM", vector(s.plan.position)},
          {"direction", vector(s.plan.direction)},
          {"angleDeg", s.plan.angleDeg},
          {"luminanceCdM2", s.luminanceCdM2},
          {"ev100", finite(reflectedEv100(s.luminanceCdM2))},
          {"place", placeName(s.place)}};
}

Json glareJson(const GlareReading& g) {
  return {{"name", g.plan.name},
          {"positionM", vector(g.plan.position)},
          {"direction", vector(g.plan.direction)},
          {"ugr", g.ugr ? Json(*g.ugr) : Json(nullptr)},
          {"ugrStandardError", g.ugrError},
          {"backgroundCdM2", g.backgroundCdM2},
          {"eyeLux", g.eyeLux},
          {"luminairesSeen", g.sources},
          {"place", placeName(g.place)}};
}

Json verdictJson(const Verdict& v) {
  return {{"where", v.where}, {"what", v.what}, {"unit", v.unit},    {v.atMost ? "atMost" : "atLeast", v.wanted},
          {"found", v.got},   {"met", v.met()}, {"source", v.source}};
}

}  // namespace

Json meansJson(const Measurements& m) {
  const std::optional<HomeMeans> means = homeMeans(m);
  if (!means) return nullptr;
  return {{"rooms", means->rooms},
          {"areaM2", means->areaM2},
          {"meanOfRoomsLux", means->ofRoomsLux},
          {"meanOfAreaLux", means->ofAreaLux}};
}

Json luminaireJson(const Luminaire& l) {
  Json j = {{"name", l.name}, {"kind", l.kind}, {"count", l.count}, {"room", l.room}, {"fluxLm", l.fluxLm}};
  j["wattsW"] = l.wattsW > 0 ? Json(l.wattsW) : Json(nullptr);
  j["lumenPerWatt"] = l.wattsW > 0 ? Json(l.fluxLm / l.wattsW) : Json(nullptr);
  j["kelvin"] = l.kelvin ? Json(*l.kelvin) : Json(nullptr);
  return j;
}

Json roomTargetJson(const RoomTarget& t) {
  Json j = {{"room", t.room}, {"use", t.use}, {"useFrom", t.origin}};
  j["wantedLux"] = t.wantedLux, j["source"] = t.source;
  j["foundLux"] = t.foundLux ? Json(*t.foundLux) : Json(nullptr);
  j["met"] = t.foundLux ? Json(t.met()) : Json(nullptr);
  return j;
}

std::string reportJson(const ReportHeader& header, const Measurements& m) {
  Json rooms = Json::array(), grids = Json::array(), points = Json::array(), spots = Json::array(),
       glares = Json::array(), targets = Json::array(), luminaires = Json::array(), byRoom = Json::array();
  for (const RoomReading& r : m.rooms) rooms.push_back(roomJson(r));
  for (const GridReading& g : m.grids) grids.push_back(gridJson(g));
  for (const PointReading& p : m.points) points.push_back(pointJson(p));
  for (const SpotReading& s : m.spots) spots.push_back(spotJson(s));
  for (const GlareReading& g : m.glares) glares.push_back(glareJson(g));
  for (const Verdict& v : verdictsOf(m)) targets.push_back(verdictJson(v));
  for (const Luminaire& l : scheduleOf(m.luminaires).rows) luminaires.push_back(luminaireJson(l));
  for (const RoomTarget& t : roomTargets(m)) byRoom.push_back(roomTargetJson(t));
  const Json j = {{"roomlight", header.version},
                  {"date", header.date},
                  {"scene", header.scene},
                  {"lighting", header.lighting},
                  {"meters", header.meters},
                  {"technique", header.technique},
                  {"quality", header.quality},
                  {"tolerance", header.tolerance},
                  {"maintenanceFactor", m.maintenanceFactor},
                  {"certainty",
                   {{"meters", m.certainty.meters},
                    {"medianStandardError", m.certainty.median},
                    {"largestStandardError", m.certainty.worst}}},
                  {"home", meansJson(m)},
                  {"rooms", rooms},
                  {"grids", grids},
                  {"points", points},
                  {"spots", spots},
                  {"glare", glares},
                  {"targets", targets},
                  {"roomTargets", byRoom},
                  {"luminaires", luminaires},
                  {"warnings", m.warnings}};
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace roomlight
