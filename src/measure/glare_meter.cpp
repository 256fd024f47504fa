#include "measure/glare.h"

#include <fmt/format.h>

#include <cmath>

#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"
#include "trace/lamp_light.h"
#include "trace/spherical_triangle.h"
#include "trace/surface_point.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr double kRaysALuminaire = 4096;
constexpr uint32_t kRaysALamp = 64;
constexpr double kTightness = 0.2;         // of the tolerance of other meters: the background is a difference
constexpr float kAlmost = 1 - 1e-4f;       // of the way to a luminaire
constexpr double kLeastSolidAngleSr = 1e-12;

// Sums over what is visible of one luminaire.
struct Seen {
  Vec3 direction;              // weighted by solid angle
  double solidAngleSr = 0, lux = 0;
  double areaM2 = 0;           // projected
  double luminanceSr = 0;      // luminance times solid angle
  double intensityCd = 0;
};

struct Emitting {
  TriangleVertices v;
  uint32_t number;
  float solidAngleSr;
};

// Triangles of an instance that turn their emitting side to the eye.
std::vector<Emitting> facing(const Scene& scene, uint32_t instance, Vec3 eye) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const float mirror = scene.instances[instance].worldFromObject.determinant() < 0 ? -1.0f : 1.0f;
  std::vector<Emitting> list;
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleVertices v = worldTriangle(scene, instance, t);
    const bool front = dot(cross(v.b - v.a, v.c - v.a) * mirror, eye - v.a) > 0;
    if (!front && !material.doubleSided) continue;
    const float sr = std::abs(triangleSolidAngle(eye, v.a, v.b, v.c));
    if (sr > 0 && std::isfinite(sr)) list.push_back({v, t, sr});
  }
  return list;
}

Seen look(const RayScene& rays, uint32_t instance, Vec3 eye, Vec3 view) {
  const Scene& scene = rays.scene();
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)];
  const std::vector<Emitting> triangles = facing(scene, instance, eye);
  double all = 0;
  for (const Emitting& t : triangles) all += static_cast<double>(t.solidAngleSr);
  Seen seen;
  for (const Emitting& t : triangles) {
    const auto samples = static_cast<uint32_t>(std::ceil(kRaysALuminaire * static_cast<double>(t.solidAngleSr) / all));
    const Vec3 normal = normalize(cross(t.v.b - t.v.a, t.v.c - t.v.a));
    // Points are even over the area; their solid angles together are that of the triangle.
    struct Point {
      Vec3 direction, light;
      double weight, distance2;
    };
    std::vector<Point> points;
    double weights = 0;
    for (uint32_t i = 0; i < samples; ++i) {
      const Vec2 b = sampleTriangle(Sampler(t.number, i, instance).next2());
      const Vec3 to = t.v.a + (t.v.b - t.v.a) * b.x + (t.v.c - t.v.a) * b.y - eye;
      const double distance2 = static_cast<double>(lengthSquared(to)),
                   weight = static_cast<double>(std::abs(dot(to, normal))) / std::pow(distance2, 1.5);
      const Vec3 light = materialAt(scene, mesh, TrianglePoint{t.number, b.x, b.y}).emission *
                         rays.transmittance({eye, to, 0, kAlmost});
      weights += weight;
      points.push_back({normalize(to), light, weight, distance2});
    }
    for (const Point& p : points) {
      const double l = static_cast<double>(luminance(p.light)),
                   sr = static_cast<double>(t.solidAngleSr) * p.weight / std::max(weights, 1e-30);
      if (l <= 0) continue;
      seen.direction += p.direction * static_cast<float>(sr);
      seen.solidAngleSr += sr, seen.luminanceSr += l * sr;
      seen.lux += l * sr * static_cast<double>(std::max(0.0f, dot(p.direction, view)));
      seen.areaM2 += sr * p.distance2, seen.intensityCd += l * sr * p.distance2;
    }
  }
  return seen;
}

// Projected area towards a direction away from the lamp, m²; of a lamp without an opening none.
double openingTowards(const Lamp& lamp, Vec3 away) {
  if (!lamp.extended || !lamp.web) return 0;
  const double area = static_cast<double>(lamp.web->sizeC0M) * static_cast<double>(lamp.web->sizeC90M);
  return area * (lamp.web->round ? static_cast<double>(kPi) / 4 : 1) *
         static_cast<double>(std::abs(dot(away, lamp.direction)));
}

}  // namespace

// A small source, or as large as its opening. What is visible of that is sampled.
SeenLamp seenLamp(const RayScene& rays, const Lamp& lamp, Vec3 eye, Vec3 view) {
  const Vec3 to = lamp.position - eye;
  const float distance = length(to);
  const Vec3 direction = to / std::max(distance, 1e-6f);
  const uint32_t samples = lamp.extended ? kRaysALamp : 1;
  SeenLamp out;
  double cd = 0;  // towards the eye
  for (uint32_t k = 0; k < samples; ++k) {
    const LightSample light = sampleLamp(lamp, eye, Sampler(0, k, 0).next2());
    if (!light.valid()) continue;
    const double l =
        static_cast<double>(luminance(light.radiance * rays.transmittance(shadowRay(eye, eye, light)))) / samples;
    out.directLux += l * static_cast<double>(std::max(0.0f, dot(light.wi, view))),
        cd += l * static_cast<double>(light.distance * light.distance);
  }
  if (cd <= 0 || dot(direction, view) <= 0) return out;
  out.areaM2 = openingTowards(lamp, -direction);
  const double distance2 = static_cast<double>(distance * distance);
  out.source = out.areaM2 < kSmallSourceM2 ? smallSource(direction, cd, static_cast<double>(distance))
                                           : GlareSource{direction, cd / out.areaM2, out.areaM2 / distance2};
  return out;
}

SeenLamps seenLamps(const RayScene& rays, Vec3 eye, Vec3 view) {
  const Scene& scene = rays.scene();
  std::vector<uint32_t> emitting;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    if (!isBlack(scene.materials[static_cast<size_t>(mesh.material)].emission)) emitting.push_back(i);
  }
  std::vector<Seen> seen(emitting.size());
  parallelFor(emitting.size(), 1, [&](size_t i) { seen[i] = look(rays, emitting[i], eye, view); });
  SeenLamps out;
  for (const Seen& s : seen) {
    out.directLux += s.lux;
    const Vec3 direction = lengthSquared(s.direction) > 0 ? normalize(s.direction) : view;
    if (s.solidAngleSr < kLeastSolidAngleSr || dot(direction, view) <= 0) continue;
    if (s.areaM2 < kSmallSourceM2) {
      out.sources.push_back(smallSource(direction, s.intensityCd, std::sqrt(s.areaM2 / s.solidAngleSr)));
    } else {
      out.sources.push_back({direction, s.luminanceSr / s.solidAngleSr, s.solidAngleSr});
    }
    if (s.areaM2 > kLargeSourceM2) ++out.large;
  }
  for (const Lamp& lamp : scene.lamps) {
    if (lamp.kind == LampKind::Area) continue;  // they are meshes too
    const SeenLamp one = seenLamp(rays, lamp, eye, view);
    out.directLux += one.directLux;
    if (one.source) out.sources.push_back(*one.source);
    if (one.areaM2 > kLargeSourceM2) ++out.large;
  }
  return out;
}

std::vector<GlareReading> readGlares(const LitScene& lit, std::span<const GlarePlan> plans,
                                     const MeterSettings& settings, const Progress& progress,
                                     std::vector<std::string>& warnings) {
  std::vector<SurfaceElement> eyes;
  for (const GlarePlan& plan : plans) eyes.push_back({plan.position, plan.direction});
  MeterSettings tight = settings;
  tight.tolerance *= kTightness;
  const std::vector<MeterReading> light = lit.illuminance(eyes, tight, progress);
  std::vector<GlareReading> list;
  for (size_t i = 0; i < plans.size(); ++i) {
    const SeenLamps lamps = seenLamps(lit.rays(), plans[i].position, plans[i].direction);
    GlareReading r;
    r.plan = plans[i];
    r.sources = lamps.sources.size();
    r.eyeLux = static_cast<double>(luminance(light[i].illuminanceLux));
    const double indirectLux = r.eyeLux - lamps.directLux, error = light[i].standardErrorLux;
    r.backgroundCdM2 = std::max(0.0, indirectLux) / static_cast<double>(kPi);
    // A background that is as good as its noise is no ground to judge on.
    if (indirectLux > 2 * error && indirectLux > 0) {
      r.ugr = lamps.sources.empty() ? 0 : std::max(0.0, ugr(lamps.sources, plans[i].direction, r.backgroundCdM2));
      r.ugrError = 8 / std::log(10.0) * error / indirectLux;
    } else {
      warnings.push_back(
          fmt::format("{}: no glare rating, since no light but that straight from lamps reaches the eye", r.plan.name));
    }
    if (lamps.large > 0)
      warnings.push_back(fmt::format("{}: {} luminaires show more than 1.5 m², where UGR is too mild (CIE 147)",
                                     r.plan.name, lamps.large));
    list.push_back(std::move(r));
  }
  return list;
}

}  // namespace roomlight
