#include "roomlight/measure.h"

#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "cli/report_picture.h"
#include "conversions.h"
#include "engine/stages.h"
#include "engine/technique.h"
#include "measure/measure.h"
#include "measure/report.h"

namespace roomlight::v1 {
namespace {

struct Plan {
  RenderSettings render;
  MeasureSettings measure;
};

Result<Plan> planOf(const MeterOptions& o) {
  Plan plan;
  if (const auto s = applyQuality(o.quality, plan.render); !s) return badInput(s.error());
  plan.render.technique = o.technique, plan.render.threads = o.threads, plan.render.seed = o.seed;
  if (const auto s = checkSettings(plan.render); !s) return badInput(s.error());
  if (const auto t = techniqueNamed(o.technique); !t) return badInput(t.error());
  if (!(o.tolerance >= 1e-4 && o.tolerance <= 0.5)) return badInput("tolerance: must be from 0.0001 to 0.5");
  plan.measure.meters.tolerance = o.tolerance, plan.measure.meters.seed = o.seed;
  plan.measure.maps = true;
  return plan;
}

// `numbers`: three each.
Result<std::vector<SurfaceElement>> elementsOf(std::span<const float> positions, std::span<const float> normals) {
  if (positions.size() != normals.size() || positions.size() % 3 != 0)
    return badInput("positions and normals: give three numbers each for every meter");
  std::vector<SurfaceElement> elements(positions.size() / 3);
  for (size_t i = 0; i < elements.size(); ++i) {
    const roomlight::Vec3 position(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    const roomlight::Vec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    if (!isPlace(position) || !isPlace(normal) || !(length(normal) > 1e-6f))
      return badInput(fmt::format("meter {}: its position must be within 1000 km and its normal not zero", i));
    elements[i].position = position, elements[i].normal = normalize(normal);
  }
  return elements;
}

}  // namespace

struct MeterReport::State {
  Home home;
  ReportHeader header;
  Measurements measurements;
};

std::string MeterReport::table() const { return reportTable(state_->measurements); }
std::string MeterReport::json() const { return reportJson(state_->header, state_->measurements); }
std::string MeterReport::csv() const { return reportCsv(state_->measurements); }
std::string MeterReport::html() const {
  return reportHtml(state_->header, state_->measurements, state_->home.state().opened.scene);
}
const std::vector<std::string>& MeterReport::warnings() const { return state_->measurements.warnings; }

Result<MeterReport> measure(const Home& home, const MeterOptions& options, const Progress& progress) {
  return guardedOn(options.threads, [&]() -> Result<MeterReport> {
    const Result<Plan> plan = planOf(options);
    if (!plan) return plan.error();
    const home::OpenedHome& opened = home.state().opened;
    MeterPlan meters;
    if (!options.meters.empty()) {
      roomlight::Result<MeterPlan> read = readMeterFile(options.meters, opened.scene.rooms);
      if (!read) return badInput(read.error());
      meters = std::move(read).value();
    }
    const RenderProgress inner = toInternal(progress);
    RenderStats stats;
    Stages stages(inner, stats);
    roomlight::Result<std::unique_ptr<LitScene>> lit =
        lightScene(opened.scene, plan->render, stages, {.changes = false});
    if (!lit) return badInput(lit.error());
    if (!lit.value()) return interrupted();
    Measurements m = roomlight::measure(*lit.value(), meters, plan->measure, stages);
    lit.value().reset();
    if (!stages.cancelled() && options.daylightFactor) {
      Scene outdoors = opened.scene;
      if (const auto s =
              measureDaylight(outdoors, meters.groundReflectance, plan->render, plan->measure.meters, m, stages);
          !s)
        return badInput(s.error());
    }
    if (stages.cancelled()) return interrupted();
    const ReportHeader header{home.state().file,
                              home.state().lighting,
                              options.meters,
                              options.technique,
                              options.quality,
                              roomlight::version(),
                              options.tolerance,
                              cli::today(),
                              "",
                              "",
                              opened.added};
    return MeterReport(std::shared_ptr<const MeterReport::State>(new MeterReport::State{home, header, std::move(m)}));
  });
}

struct Meters::State {
  Home home;
  Plan plan;
  std::unique_ptr<LitScene> lit;
  mutable std::timed_mutex one;  // reads at a time
};

Result<Meters> Meters::of(const Home& home, const MeterOptions& options, const Progress& progress) {
  return guardedOn(options.threads, [&]() -> Result<Meters> {
    const Result<Plan> plan = planOf(options);
    if (!plan) return plan.error();
    const RenderProgress inner = toInternal(progress);
    RenderStats stats;
    Stages stages(inner, stats);
    roomlight::Result<std::unique_ptr<LitScene>> lit =
        lightScene(home.state().opened.scene, plan->render, stages, {.changes = false});
    if (!lit) return badInput(lit.error());
    if (!lit.value()) return interrupted();
    return Meters(std::shared_ptr<const State>(new State{home, *plan, std::move(lit).value(), {}}));
  });
}

Result<std::vector<Reading>> Meters::illuminance(std::span<const float> positions, std::span<const float> normals,
                                                 const Progress& progress) const {
  const auto turn = turnAt(state_->one, progress);
  if (!turn) return interrupted();
  return guardedOn(state_->plan.render.threads, [&]() -> Result<std::vector<Reading>> {
    const Result<std::vector<SurfaceElement>> elements = elementsOf(positions, normals);
    if (!elements) return elements.error();
    roomlight::Progress inner;
    if (progress.report) inner.report = [&](float fraction) { progress.report("meters", fraction); };
    inner.cancelled = progress.cancelled;
    std::vector<Reading> readings;
    for (const MeterReading& r : state_->lit->illuminance(*elements, state_->plan.measure.meters, inner))
      readings.push_back({luminance(r.illuminanceLux), static_cast<float>(r.standardErrorLux)});
    if (inner.stop()) return interrupted();
    return readings;
  });
}

}  // namespace roomlight::v1
