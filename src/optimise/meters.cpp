#include "optimise/meters.h"

#include <fmt/format.h>

#include "measure/lattice.h"
#include "scene/surface.h"
#include "trace/surface_point.h"

namespace roomlight::optimise {
namespace {

constexpr float kBefore = 1e-3f;  // of the way back from a surface to the eye

MeterGrid latticeOf(const Zone& z) {
  if (!z.rectangle)
    return floorLattice(z.room.floor, z.room.elevationM + static_cast<float>(z.workPlaneM),
                        {z.spacingM, z.borderM, GridSettings().borderShare});
  return rectangleLattice(z.corner, z.alongU, z.alongV, normalize(cross(z.alongU, z.alongV)), {z.spacingM, 0, 0});
}

// Where the eye's line towards `target` ends, facing the eye.
std::optional<std::pair<SurfaceElement, SeenPlace>> seenFrom(const RayScene& rays, Vec3 eye, Vec3 target) {
  const Vec3 d = normalize(target - eye);
  const Hit hit = rays.intersect({eye, d, 1e-4f, kInfinity});
  if (!hit.valid()) return std::nullopt;
  const SurfacePoint s = surfaceAt(rays.scene(), hit, d);
  const Vec3 n = dot(s.ng, d) < 0 ? s.ng : -s.ng;
  return std::pair{SurfaceElement{s.p + n * kBefore, n}, SeenPlace{bihemisphericalAlbedo(s.m)}};
}

}  // namespace

Result<Meters> placeMeters(const StudyFile& study, const RayScene& rays) {
  Meters out;
  for (const Zone& z : study.zones) {
    ZonePoints points;
    points.lattice = latticeOf(z);
    if (out.elements.size() + points.lattice.count() > kMostPoints)
      return Error{fmt::format("{}:{}: zone '{}': there are more than {} points; set 'spacing' larger",
                               study.file.string(), z.line, z.name, kMostPoints)};
    points.leftOut = leaveOutThings(rays, points.lattice);
    points.first = out.elements.size();
    for (const SurfaceElement& e : points.lattice.elements()) out.elements.push_back(e);
    points.count = out.elements.size() - points.first;
    if (points.count == 0)
      return Error{fmt::format("{}:{}: zone '{}': no free point to measure at; set 'border' or 'spacing' smaller",
                               study.file.string(), z.line, z.name)};
    out.zones.push_back(std::move(points));
  }
  out.firstEye = out.elements.size();
  for (const Eye& e : study.eyes) out.elements.push_back({e.position, e.direction});
  out.firstSeen = out.elements.size();
  for (const Ratio& r : study.ratios) {
    for (const Vec3 target : {r.task, r.surround}) {
      const auto seen = seenFrom(rays, r.eye, target);
      if (!seen)
        return Error{fmt::format("{}: ratio '{}': the eye sees only sky towards {:g}, {:g}, {:g}", study.file.string(),
                                 r.name, target.x, target.y, target.z)};
      out.elements.push_back(seen->first), out.seen.push_back(seen->second);
    }
  }
  return out;
}

}  // namespace roomlight::optimise
