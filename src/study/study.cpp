#include "study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "base/progress.h"
#include "compare/compare.h"

namespace roomlight {
namespace {

nlohmann::json toJson(const RenderCost& c) {
  auto stages = nlohmann::json::array();
  for (const auto& [name, seconds] : c.stages) stages.push_back({name, seconds});
  return {{"seconds", c.seconds},
          {"processorSeconds", c.processorSeconds},
          {"memoryMiB", c.memoryMiB},
          {"samples", c.samples},
          {"stages", stages}};
}

double number(const nlohmann::json& j, const char* key) {
  return j.contains(key) && j[key].is_number() ? j[key].get<double>() : 0;
}

nlohmann::json toJson(const Report& r) {
  return {{"mse", r.mse},
          {"mseBeyondNoise", r.mseBeyondNoise.value_or(r.mse)},
          {"flip", r.flip},
          {"meanErrorPercent", r.meanLuminanceErrorPercent}};
}

// Tells how much is done, by units of work that are known beforehand, and how long the rest will take by how long what
// was really measured took.
class Pace {
 public:
  Pace(const StudyProgress& progress, size_t units) : progress_(progress), units_(std::max<size_t>(1, units)) {}
  void now(const std::string& what, double partOfUnit = 0) {
    const double done = (static_cast<double>(done_) + partOfUnit) / static_cast<double>(units_);
    const double each = measured_ > 0 ? watch_.seconds() / measured_ : -1;
    if (progress_.report)
      progress_.report(what, done, each < 0 ? -1 : each * (static_cast<double>(units_ - done_) - partOfUnit));
  }
  // `measured`: not found in the store.
  void unit(bool measured) {
    ++done_;
    if (measured) ++measured_;
  }

 private:
  const StudyProgress& progress_;
  size_t units_, done_ = 0;
  double measured_ = 0;
  Stopwatch watch_;
};

bool isOf(const ExternalPicture& e, const std::string& scene, const std::string& light) {
  return (e.scene.empty() || e.scene == scene) && (e.light.empty() || e.light == light);
}

// One scene in one light, measured or read from the store.
class CaseStudy {
 public:
  CaseStudy(const StudyPlan& plan, const StudySettings& settings, const RunStore& store, const StudyTools& tools,
            const StudyProgress& progress, Pace& pace)
      : plan_(plan), settings_(settings), store_(store), tools_(tools), progress_(progress), pace_(pace) {}

  // What is left out is told in `remarks`.
  Result<StudyCase> run(const StudyScene& scene, const StudyLight& light, std::vector<std::string>& remarks);

 private:
  StudyRender request(const StudyTechnique& t, int samples, const std::filesystem::path& picture) const {
    StudyRender ask = view_;
    ask.technique = t.technique, ask.settings = t.settings, ask.samples = samples, ask.picture = picture;
    return ask;
  }
  // Of a kind of result: "point", "error", "run 2".
  RunStore::Key keyOf(const std::string& kind, const StudyTechnique& t, int samples) const {
    return {{kind, out_.scene, out_.light, t.name, fmt::format("{}", samples)},
            fmt::format("{} | {} | {} {} | {} samples", settings_.program, what_, t.technique, t.settings, samples)};
  }

  bool explore(const StudyTechnique& t, StudyCurve& curve);
  Result<nlohmann::json> errorOfPicture(RunStore::Key key, const std::filesystem::path& picture) const;
  Result<StudyPoint> point(const StudyTechnique& t, int samples, bool& measured);
  bool timeAgain(const StudyTechnique& t, StudyCurve& curve, int run);
  Status addExternal(const ExternalPicture& e);
  void addExternals(std::vector<std::string>& remarks);
  void sumUp();

  const StudyPlan& plan_;
  const StudySettings& settings_;
  const RunStore& store_;
  const StudyTools& tools_;
  const StudyProgress& progress_;
  Pace& pace_;
  StudyCase out_;
  StudyRender view_;
  std::string what_;  // scene, light and size: what every result depends on
  Reference reference_;
};

// Against the reference as it is now: it may have become better since.
Result<nlohmann::json> CaseStudy::errorOfPicture(RunStore::Key key, const std::filesystem::path& picture) const {
  key.circumstances += fmt::format(" | reference of {:.0f} samples", reference_.samples);
  if (const auto kept = store_.find(key)) return *kept;
  const Result<Image> image = readImage(picture);
  if (!image) return Error{image.error()};
  const Result<Report> report = compare(reference_.first, reference_.second, image.value());
  if (!report) return Error{fmt::format("{}: {}", picture.string(), report.error())};
  const nlohmann::json error = toJson(report.value());
  if (const Status s = store_.keep(key, error); !s) return Error{s.error()};
  return error;
}

// The picture with so many samples: its first run, and its error.
Result<StudyPoint> CaseStudy::point(const StudyTechnique& t, int samples, bool& measured) {
  const RunStore::Key key = keyOf("point", t, samples);
  const std::filesystem::path picture = store_.file(key, ".exr");
  std::optional<nlohmann::json> cost = store_.find(key);
  if (!cost || !std::filesystem::exists(picture)) {
    measured = true;
    store_.forget(key);  // until the picture is whole
    const Result<RenderCost> made = tools_.render(request(t, samples, picture));
    if (!made) return Error{made.error()};
    cost = toJson(made.value());
    if (const Status s = store_.keep(key, *cost); !s) return Error{s.error()};
  }
  const Result<nlohmann::json> error = errorOfPicture(keyOf("error", t, samples), picture);
  if (!error) return Error{error.error()};
  StudyPoint p;
  p.samples = samples;
  p.runsS = {number(*cost, "seconds")};
  p.seconds = p.runsS[0];
  p.processorSeconds = number(*cost, "processorSeconds"), p.memoryMiB = number(*cost, "memoryMiB");
  p.mse = number(error.value(), "mse"), p.mseBeyondNoise = number(error.value(), "mseBeyondNoise");
  p.flip = number(error.value(), "flip"), p.meanErrorPercent = number(error.value(), "meanErrorPercent");
  p.picture = picture.filename().string();
  return p;
}

// Twice the samples each time until the error settles. Whether anything was measured.
bool CaseStudy::explore(const StudyTechnique& t, StudyCurve& curve) {
  bool measured = false;
  for (int samples = 1; samples <= settings_.mostSamples && !progress_.stop(); samples *= 2) {
    pace_.now(fmt::format("{}, {}: {}, {} samples", out_.scene, out_.light, t.name, samples));
    Result<StudyPoint> p = point(t, samples, measured);
    if (!p) {
      if (!progress_.stop()) curve.failed = p.error();
      break;
    }
    curve.points.push_back(std::move(p.value()));
    const size_t n = curve.points.size();
    const double grows = n < 2 ? 1 : curve.points[n - 1].seconds / curve.points[n - 2].seconds;
    if (hasSettled(curve) || curve.points.back().seconds * std::clamp(grows, 1.0, 2.0) > settings_.mostSeconds) break;
  }
  return measured;
}

bool CaseStudy::timeAgain(const StudyTechnique& t, StudyCurve& curve, int run) {
  bool measured = false;
  for (StudyPoint& p : curve.points) {
    if (progress_.stop()) break;
    const RunStore::Key key = keyOf(fmt::format("run {}", run + 1), t, p.samples);
    std::optional<nlohmann::json> kept = store_.find(key);
    if (!kept) {
      pace_.now(fmt::format("{}, {}: {}, {} samples, run {}", out_.scene, out_.light, t.name, p.samples, run + 1));
      measured = true;
      const std::filesystem::path picture = store_.file(key, ".exr");
      const Result<RenderCost> cost = tools_.render(request(t, p.samples, picture));
      std::error_code ignored;
      std::filesystem::remove(picture, ignored);
      if (!cost) {
        if (!progress_.stop()) curve.failed = cost.error();
        break;
      }
      kept = toJson(cost.value());
      if (!store_.keep(key, *kept)) break;
    }
    p.runsS.push_back(number(*kept, "seconds"));
  }
  return measured;
}

Status CaseStudy::addExternal(const ExternalPicture& e) {
  const Result<Image> image = readImage(e.file);
  if (!image) return Error{image.error()};
  const Result<Report> r = compare(reference_.first, reference_.second, image.value());
  if (!r) return Error{r.error()};
  const std::filesystem::path copy = store_.file({{"external", out_.scene, out_.light, e.name}, what_}, ".exr");
  if (const Status s = writeExr(copy, image.value(), {}); !s) return s;
  out_.externals.push_back({e.name, e.seconds, r.value().mse, r.value().mseBeyondNoise.value_or(r.value().mse),
                            r.value().flip, r.value().meanLuminanceErrorPercent, copy.filename().string()});
  return Ok{};
}

void CaseStudy::addExternals(std::vector<std::string>& remarks) {
  for (const ExternalPicture& e : settings_.externals) {
    if (!isOf(e, out_.scene, out_.light)) continue;
    if (const Status s = addExternal(e); !s)
      remarks.push_back(fmt::format("{}, {}: --external {}: left out: {}", out_.scene, out_.light, e.name, s.error()));
  }
}

void CaseStudy::sumUp() {
  for (StudyCurve& curve : out_.curves) {
    for (StudyPoint& p : curve.points) p.seconds = medianOf(p.runsS);
  }
}

Result<StudyCase> CaseStudy::run(const StudyScene& scene, const StudyLight& light, std::vector<std::string>& remarks) {
  out_.scene = scene.name, out_.light = light.name, out_.lighting = light.lighting.filename().string();
  view_.scene = scene.file, view_.lighting = light.lighting, view_.camera = scene.camera, view_.width = settings_.width,
  view_.height = settings_.height;
  what_ = fmt::format("{} {} | {} | {}x{}", scene.file.filename().string(), contentHash(scene.file),
                      light.lighting.empty() ? "own light" : contentHash(light.lighting), view_.width, view_.height) +
          (scene.camera.empty() ? "" : " | camera " + scene.camera);
  const std::string doing = fmt::format("{}, {}: reference", scene.name, light.name);
  pace_.now(doing);
  bool made = false;
  Result<Reference> reference =
      makeReference({view_, settings_.reference, {{"reference", scene.name, light.name}, what_}}, store_, tools_,
                    progress_, [&](double part) { made = true, pace_.now(doing, part); });
  if (!reference) return Error{reference.error()};
  pace_.unit(made);
  reference_ = std::move(reference.value());
  out_.first = reference_.firstFile.filename(), out_.second = reference_.secondFile.filename();
  out_.noiseMse = reference_.noiseMse, out_.referenceS = reference_.seconds, out_.referenceSamples = reference_.samples,
  out_.referenceConverged = reference_.converged;

  const std::vector<StudyTechnique> techniques = plan_.techniquesIn("pictures");
  for (const StudyTechnique& t : techniques) {
    out_.curves.push_back({t.name, t.kind, {}, {}});
    pace_.unit(explore(t, out_.curves.back()));
  }
  // In turn: what else the machine does meanwhile meets all techniques alike.
  for (int run = 1; run < settings_.runs; ++run) {
    for (size_t i = 0; i < techniques.size(); ++i) pace_.unit(timeAgain(techniques[i], out_.curves[i], run));
  }
  sumUp();
  addExternals(remarks);
  return std::move(out_);
}

// Frames a second along the walks of scenes, measured or read from the store.
class WalkStudy {
 public:
  WalkStudy(const StudySettings& settings, const RunStore& store, const StudyTools& tools,
            const StudyProgress& progress, Pace& pace)
      : settings_(settings), store_(store), tools_(tools), progress_(progress), pace_(pace) {}

  // What goes wrong is told in the results' remarks.
  void run(const StudyPlan& plan, StudyResults& results);

 private:
  Result<WalkCost> once(const StudyScene& scene, const StudyTechnique& t, int run, bool& measured) const;
  std::vector<StudyFrames> through(const StudyScene& scene, const std::vector<StudyTechnique>& techniques);

  const StudySettings& settings_;
  const RunStore& store_;
  const StudyTools& tools_;
  const StudyProgress& progress_;
  Pace& pace_;
};

Result<WalkCost> WalkStudy::once(const StudyScene& scene, const StudyTechnique& t, int run, bool& measured) const {
  const std::filesystem::path& lighting = scene.walkLight.lighting;
  const std::string circumstances =
      fmt::format("{} | {} | {} | {} | {} {} | {}x{}, {} frames", settings_.program, contentHash(scene.file),
                  contentHash(lighting), contentHash(scene.walk), t.technique, t.settings, settings_.walkWidth,
                  settings_.walkHeight, settings_.walkFrames);
  const RunStore::Key key{{fmt::format("walk {}", run + 1), scene.name, t.name}, circumstances};
  if (const auto kept = store_.find(key))
    return WalkCost{static_cast<int>(number(*kept, "frames")), number(*kept, "framesPerSecond"),
                    number(*kept, "updateMs"), number(*kept, "pictureMs")};
  measured = true;
  const Result<WalkCost> cost = tools_.walk(
      {scene.file, lighting, scene.walk, settings_.walkWidth, settings_.walkHeight, t.technique, t.settings});
  if (!cost) return cost;
  const WalkCost& c = cost.value();
  if (const Status s = store_.keep(key, {{"frames", c.frames},
                                         {"framesPerSecond", c.framesPerSecond},
                                         {"updateMs", c.updateMs},
                                         {"pictureMs", c.pictureMs}});
      !s)
    return Error{s.error()};
  return cost;
}

// The median run of each.
WalkCost medianCost(const std::vector<WalkCost>& runs) {
  const auto of = [&](double WalkCost::*member) {
    std::vector<double> values;
    for (const WalkCost& w : runs) values.push_back(w.*member);
    return medianOf(std::move(values));
  };
  return {runs.empty() ? 0 : runs.front().frames, of(&WalkCost::framesPerSecond), of(&WalkCost::updateMs),
          of(&WalkCost::pictureMs)};
}

// Techniques in turn, run after run.
std::vector<StudyFrames> WalkStudy::through(const StudyScene& scene, const std::vector<StudyTechnique>& techniques) {
  std::vector<StudyFrames> found;
  for (const StudyTechnique& t : techniques)
    found.push_back({scene.name, scene.walkLight.name, t.name, t.kind, {}, {}, {}});
  for (int run = 0; run < settings_.runs; ++run) {
    for (size_t i = 0; i < found.size() && !progress_.stop(); ++i) {
      pace_.now(fmt::format("{}: frames a second, {}, run {}", scene.name, found[i].technique, run + 1));
      bool measured = false;
      if (found[i].failed.empty()) {
        const Result<WalkCost> cost = once(scene, techniques[i], run, measured);
        if (cost) found[i].runs.push_back(cost.value());
        if (!cost && !progress_.stop()) found[i].failed = cost.error();
      }
      pace_.unit(measured);
    }
  }
  return found;
}

void WalkStudy::run(const StudyPlan& plan, StudyResults& results) {
  const std::vector<StudyTechnique> techniques = plan.techniquesIn("walks");
  for (const StudyScene& scene : plan.scenes) {
    if (scene.walk.empty() || !tools_.walk) continue;
    for (StudyFrames& f : through(scene, techniques)) {
      if (f.runs.empty() && f.failed.empty()) continue;  // stopped before
      f.cost = medianCost(f.runs);
      if (!f.failed.empty())
        results.remarks.push_back(fmt::format("{}: walk: {}: {}", scene.name, f.technique, f.failed));
      results.frames.push_back(std::move(f));
    }
  }
}

// Whether the view has anything to be compared with a reference.
bool isWanted(const StudyPlan& plan, const StudySettings& settings, const StudyScene& scene, const StudyLight& light) {
  if (!plan.techniquesIn("pictures").empty()) return true;
  return std::any_of(settings.externals.begin(), settings.externals.end(),
                     [&](const ExternalPicture& e) { return isOf(e, scene.name, light.name); });
}

// Of Pace: a reference of a view and each run of each technique.
size_t unitsOf(const StudyPlan& plan, const StudySettings& settings, const StudyTools& tools) {
  const auto runs = static_cast<size_t>(settings.runs);
  const size_t ofView = 1 + plan.techniquesIn("pictures").size() * runs,
               ofWalk = plan.techniquesIn("walks").size() * runs;
  size_t units = 0;
  for (const StudyScene& s : plan.scenes) {
    for (const StudyLight& light : s.lights) units += isWanted(plan, settings, s, light) ? ofView : 0;
    if (!s.walk.empty() && tools.walk) units += ofWalk;
  }
  return units;
}

}  // namespace

bool nothingMeasured(const StudyResults& r) {
  return r.cases.empty() &&
         std::all_of(r.frames.begin(), r.frames.end(), [](const StudyFrames& f) { return f.runs.empty(); });
}

Result<StudyResults> runStudy(const StudyPlan& plan, const StudySettings& settings, const RunStore& store,
                              const StudyTools& tools, const StudyProgress& progress,
                              const std::function<void(const StudyResults&)>& soFar) {
  Pace pace(progress, unitsOf(plan, settings, tools));
  StudyResults results;
  results.againstPublished = plan.againstPublished;
  for (const StudyScene& scene : plan.scenes) {
    for (const StudyLight& light : scene.lights) {
      if (progress.stop()) break;
      if (!isWanted(plan, settings, scene, light)) continue;
      Result<StudyCase> one =
          CaseStudy(plan, settings, store, tools, progress, pace).run(scene, light, results.remarks);
      if (!one && progress.stop()) break;
      if (!one) {
        results.remarks.push_back(fmt::format("{}, {}: left out: {}", scene.name, light.name, one.error()));
        continue;
      }
      for (const StudyCurve& c : one.value().curves) {
        if (!c.failed.empty())
          results.remarks.push_back(fmt::format("{}, {}: {}: {}", scene.name, light.name, c.technique, c.failed));
      }
      results.cases.push_back(std::move(one.value()));
      if (soFar) soFar(results);
    }
  }
  WalkStudy(settings, store, tools, progress, pace).run(plan, results);
  results.complete = !progress.stop();
  if (soFar) soFar(results);
  return results;
}

}  // namespace roomlight
