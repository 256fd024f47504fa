// roomlight measure: a scene and light in, light meters' readings out.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "arguments.h"
#include "base/parallel.h"
#include "base/write_file.h"
#include "commands.h"
#include "console.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "exit_status.h"
#include "measure/measure.h"
#include "measure/meter_plan.h"
#include "measure/report.h"
#include "output_files.h"
#include "report_picture.h"

namespace roomlight::cli {
namespace {

struct MeasureOptions : SceneOptions {
  std::string meters, quality, tolerance = "2%", json, csv, html, eye, view;
  std::vector<std::string> points;
  std::optional<std::string> technique;
  std::optional<int> threads;
  std::optional<std::string> seed;
  bool noPicture = false, daylightFactor = false, quiet = false;
};

// Everything that can be known to be wrong before any work is done.
struct MeasurePlan {
  RenderSettings render;
  MeasureSettings measure;
  MeterPlan onCommandLine;
  home::OpenWish open;
};

Result<PointPlan> parsePoint(const std::string& text, size_t number) {
  const Result<std::vector<float>> n = parseList("--point", text, "x,y,z or x,y,z,nx,ny,nz in metres", {3, 6});
  if (!n) return Error{n.error()};
  const std::vector<float>& v = n.value();
  PointPlan point;
  point.name = fmt::format("point {}", number);
  point.place.position = {v[0], v[1], v[2]};
  if (v.size() == 6) {
    const Vec3 normal{v[3], v[4], v[5]};
    if (length(normal) < 1e-6f) return Error{fmt::format("--point {}: the normal must not be zero", text)};
    point.place.normal = normalize(normal);
  }
  return point;
}

Result<GlarePlan> parseEye(const MeasureOptions& o) {
  const Result<std::vector<float>> eye = parseList("--eye", o.eye, "x,y,z in metres", {3}),
                                   view = parseList("--view", o.view, "x,y,z, the direction looked along", {3});
  if (!eye) return Error{eye.error()};
  if (!view) return Error{view.error()};
  GlarePlan glare;
  glare.name = "eye";
  glare.position = {eye.value()[0], eye.value()[1], eye.value()[2]};
  const Vec3 direction{view.value()[0], view.value()[1], view.value()[2]};
  if (length(direction) < 1e-6f) return Error{fmt::format("--view {}: must not be zero", o.view)};
  glare.direction = normalize(direction);
  return glare;
}

// "1%" or 0.01.
Result<double> parseTolerance(const std::string& text) {
  const bool percent = text.ends_with('%');
  const auto value = parseNumber<double>(std::string_view(text).substr(0, text.size() - (percent ? 1 : 0)));
  const double tolerance = value.value_or(0) / (percent ? 100 : 1);
  if (!value || !(tolerance >= 1e-4 && tolerance <= 0.5))
    return Error{fmt::format("--tolerance {}: write a relative error from 0.01% to 50%", text)};
  return tolerance;
}

Result<MeasurePlan> planMeasure(const MeasureOptions& o) {
  MeasurePlan plan;
  if (!o.quality.empty()) {
    if (const Status status = applyQuality(o.quality, plan.render); !status) return Error{"--" + status.error()};
  }
  plan.render.technique = o.technique.value_or(plan.render.technique);
  plan.render.threads = o.threads.value_or(plan.render.threads);
  if (o.seed) {
    const auto seed = parseNumber<uint64_t>(*o.seed);
    if (!seed) return Error{fmt::format("--seed {}: write a whole number from 0 to 18446744073709551615", *o.seed)};
    plan.render.seed = plan.measure.meters.seed = *seed;
  }
  if (const Status status = checkSettings(plan.render); !status) return Error{status.error()};
  if (const Status status = checkTechnique(plan.render.technique); !status) return Error{status.error()};
  Result<home::OpenWish> open = readSceneOptions(o);
  if (!open) return Error{open.error()};
  plan.open = std::move(open.value());
  const Result<double> tolerance = parseTolerance(o.tolerance);
  if (!tolerance) return Error{tolerance.error()};
  plan.measure.meters.tolerance = tolerance.value();
  plan.measure.maps = !o.html.empty();
  for (const std::string& text : o.points) {
    const Result<PointPlan> point = parsePoint(text, plan.onCommandLine.points.size() + 1);
    if (!point) return Error{point.error()};
    plan.onCommandLine.points.push_back(point.value());
  }
  if (o.eye.empty() != o.view.empty()) return Error{"--eye and --view: give both or none"};
  if (!o.eye.empty()) {
    const Result<GlarePlan> eye = parseEye(o);
    if (!eye) return Error{eye.error()};
    plan.onCommandLine.glares.push_back(eye.value());
  }
  return plan;
}

Status checkMeasureOutputs(const MeasureOptions& o) {
  for (const std::string& file : {o.json, o.csv, o.html}) {
    if (file.empty()) continue;
    if (const Status s = checkWritable(file); !s) return s;
  }
  return checkDistinct({o.scene, o.lighting, o.meters, o.json, o.csv, o.html, o.writeLighting});
}

struct MeasuredHome {
  Scene scene;
  MeterPlan meters;
  std::string addedLight;
};

Result<MeasuredHome> loadHomeToMeasure(const MeasureOptions& o, const MeasurePlan& plan) {
  Result<home::OpenedHome> opened = home::openHome(plan.open);
  if (!opened) return Error{opened.error()};
  if (const Status s = writeAddedLight(o, opened.value()); !s) return Error{s.error()};
  if (!o.quiet) printOpened(o, opened.value());
  MeasuredHome home{std::move(opened.value().scene), {}, opened.value().added};
  if (!o.meters.empty()) {
    Result<MeterPlan> read = readMeterFile(o.meters, home.scene.rooms);
    if (!read) return Error{read.error()};
    home.meters = std::move(read.value());
  }
  MeterPlan& m = home.meters;
  m.points.insert(m.points.end(), plan.onCommandLine.points.begin(), plan.onCommandLine.points.end());
  m.glares.insert(m.glares.end(), plan.onCommandLine.glares.begin(), plan.onCommandLine.glares.end());
  return home;
}

// All of them, even if one cannot be written; the first error.
Status writeMeasureReports(const MeasureOptions& o, const MeasurePlan& plan, const Measurements& m,
                           const MeasuredHome& home, const ReportPicture& picture) {
  const ReportHeader header{o.scene,
                            o.lighting,
                            o.meters,
                            plan.render.technique,
                            plan.render.quality,
                            version(),
                            plan.measure.meters.tolerance,
                            today(),
                            picture.jpeg,
                            picture.title,
                            home.addedLight};
  Status first = Ok{};
  const auto write = [&](const std::string& file, const auto& text) {
    if (file.empty()) return;
    if (const Status s = writeWhole(file, text()); !s && first) first = s;
  };
  write(o.json, [&] { return reportJson(header, m); });
  write(o.csv, [&] { return reportCsv(m); });
  write(o.html, [&] { return reportHtml(header, m, home.scene); });
  return first;
}

int workMeasure(const MeasureOptions& o, const MeasurePlan& plan) {
  ProgressDisplay display(o.quiet);
  const RenderProgress progress{
      [&](const std::string& stage, float f) { display.report(stage, f); }, &interrupted(), {}};
  RenderStats stats;
  Stages stages(progress, stats);
  const auto stopped = [] {
    return failed("interrupted before everything was measured; nothing was written", kInterrupted);
  };

  Result<MeasuredHome> home = stages.run("load", [&](const Progress&) { return loadHomeToMeasure(o, plan); });
  if (!home) return failed(home.error());
  if (interrupted()) return stopped();
  Result<std::unique_ptr<LitScene>> lit = lightScene(home.value().scene, plan.render, stages, {.changes = false});
  if (!lit) return failed(lit.error());
  if (!lit.value()) return stopped();
  Measurements m = measure(*lit.value(), home.value().meters, plan.measure, stages);
  lit.value().reset();
  if (interrupted()) return stopped();
  ReportPicture picture;
  if (!o.html.empty() && !o.noPicture)
    picture =
        stages.run("picture", [&](const Progress&) { return pictureFor(home.value().scene, plan.render.threads); });
  if (o.daylightFactor) {
    if (const Status s = measureDaylight(home.value().scene, home.value().meters.groundReflectance, plan.render,
                                         plan.measure.meters, m, stages);
        !s)
      return failed(s.error());
    if (interrupted()) return stopped();
  }
  if (!o.quiet) printWarnings(m.warnings);
  fmt::print("{}", reportTable(m));
  if (const Status s = writeMeasureReports(o, plan, m, home.value(), picture); !s) return failed(s.error(), kFailed);
  for (const std::string& file : {o.json, o.csv, o.html}) {
    if (!file.empty()) display.line(fmt::format("wrote {}", file));
  }
  return kOk;
}

int runMeasure(const MeasureOptions& o) {
  interrupted();  // from here on Ctrl-C is ours
  const Result<MeasurePlan> plan = planMeasure(o);
  if (!plan) return failed(plan.error());
  if (const Status s = checkMeasureOutputs(o); !s) return failed(s.error());
  int code = kFailed;
  withThreads(plan.value().render.threads, [&] { code = workMeasure(o, plan.value()); });
  return code;
}

}  // namespace

Registered addMeasure(CLI::App& program) {
  const auto o = std::make_shared<MeasureOptions>();
  CLI::App* app = program.add_subcommand("measure", "Light a scene and hold light meters into it");
  addSceneOptions(*app, *o, "SCENE");
  app->add_option(
      "--meters", o->meters,
      "Meter file: rooms, grids, points, spot meters and eyes (docs/reference/meters.md); without it, every room");
  app->add_option("--point", o->points,
                  "Incident meter at x,y,z, or x,y,z,nx,ny,nz for a receptor that does not face up; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--eye", o->eye, "Where glare (UGR) is judged: x,y,z");
  app->add_option("--view", o->view, "Direction that eye looks along: x,y,z");
  app->add_option("--technique", o->technique, listed("How light is computed:", describedTechniques()));
  app->add_option("--quality", o->quality, listed("How much is done, if nothing else says so:", qualities()));
  app->add_option("--tolerance", o->tolerance, "Relative standard error at which a meter is read")
      ->capture_default_str();
  app->add_option("--json", o->json, "Write all readings to this JSON file");
  app->add_option("--csv", o->csv, "Write all readings to this table, one line each");
  app->add_option("--html", o->html,
                  "Write a report for printing to this HTML file: a picture, plans, targets by room, false-colour "
                  "maps, a luminaire schedule");
  app->add_flag("--no-picture", o->noPicture, "Leave the picture out of the report; it takes some seconds");
  app->add_flag(
      "--daylight-factor", o->daylightFactor,
      "Measure grids and points a second time, under a CIE overcast sky alone, as a share of the light outdoors");
  app->add_option("--seed", o->seed, "Random seed; the same seed gives the same readings");
  app->add_option("--threads", o->threads, "Threads; 0: all cores");
  app->add_flag("--quiet", o->quiet, "Only the table and errors");
  app->footer(
      "Examples:\n"
      "  roomlight measure flat.glb --lighting evening.json --html report.html\n"
      "  roomlight measure flat.glb --meters desk.json --json desk_readings.json\n"
      "  roomlight measure flat.glb --point 1.2,0.75,2.0 --eye 1,1.2,3 --view 0,0,-1");
  return {app, [o] { return runMeasure(*o); }};
}

}  // namespace roomlight::cli
