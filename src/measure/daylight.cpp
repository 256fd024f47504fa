#include "measure/measure.h"

#include <cmath>

#include "photometry/sky_luminance.h"

namespace roomlight {
namespace {

constexpr double kPiD = 3.14159265358979323846;
constexpr int kTraditionalOvercast = 16;  // of the CIE's types
constexpr int kRows = 256, kColumns = 16;  // the sky is the same all around

}  // namespace

double overcastOutdoorLux(double zenithCdM2) { return 7 * kPiD / 9 * zenithCdM2; }

void lightByOvercastSky(Scene& scene, double groundReflectance) {
  scene.lamps.clear();
  scene.suns.clear();
  for (Material& m : scene.materials) m.emission = {};
  const double zenith = kOvercastLux / overcastOutdoorLux(1);
  Image image(kColumns, kRows);
  for (int row = 0; row < kRows; ++row) {
    const double altitude = kPiD * (0.5 - (row + 0.5) / kRows);
    const double l = altitude > 0 ? zenith * cieSkyLuminance(kTraditionalOvercast, std::sin(altitude), 0, 0)
                                  : groundReflectance * kOvercastLux / kPiD;
    for (int column = 0; column < kColumns; ++column) image.at(column, row) = Vec3(static_cast<float>(l));
  }
  scene.sky = {};
  scene.sky.image = std::move(image);
}

void addDaylight(Measurements& m, const LitScene& lit, const MeterSettings& settings, Stages& stages) {
  std::vector<SurfaceElement> elements;
  for (const PointReading& p : m.points) elements.push_back(p.plan.place);
  for (const GridReading& g : m.grids) {
    for (const SurfaceElement& e : g.points.lattice.elements()) elements.push_back(e);
  }
  if (elements.empty()) return;
  const std::vector<MeterReading> readings =
      stages.run("daylight", [&](const Progress& p) { return lit.illuminance(elements, settings, p); });
  std::vector<float> percent;
  for (const MeterReading& r : readings)
    percent.push_back(luminance(r.illuminanceLux) * static_cast<float>(100 / kOvercastLux));
  size_t next = 0;
  for (PointReading& p : m.points) p.daylightPercent = static_cast<double>(percent[next++]);
  for (GridReading& g : m.grids) {
    const size_t count = g.points.lattice.count();
    g.points.daylightPercent = g.points.lattice.spread(std::span(percent).subspan(next, count));
    next += count;
  }
}

Status measureDaylight(Scene& scene, double groundReflectance, const RenderSettings& render,
                       const MeterSettings& settings, Measurements& m, Stages& stages) {
  std::vector<Lamp> lamps = scene.lamps;
  std::vector<Material> materials = scene.materials;
  lightByOvercastSky(scene, groundReflectance);
  const Result<std::unique_ptr<LitScene>> lit = lightScene(scene, render, stages, {.changes = false});
  if (!lit) return Error{lit.error()};
  if (lit.value()) addDaylight(m, *lit.value(), settings, stages);
  scene.lamps = std::move(lamps);
  scene.materials = std::move(materials);
  return Ok{};
}

}  // namespace roomlight
