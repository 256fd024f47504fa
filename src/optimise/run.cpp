#include "optimise/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/hash.h"
#include "base/progress.h"
#include "base/write_file.h"
#include "engine/settings.h"
#include "home/open_home.h"
#include "optimise/evaluate.h"
#include "optimise/improve.h"
#include "optimise/store.h"
#include "scene/find_named.h"

namespace roomlight::optimise {
namespace {

constexpr double kKeepEveryS = 10;     // the state of the search
constexpr size_t kTracePoints = 200;   // of the hypervolume over a search
constexpr double kTraceS = 2, kTraceShare = 0.05;  // what the trace may take: so long, and so much of the search's time
constexpr size_t kRelaxedShare = 20;  // hybrid: of the first generation, one in so many
constexpr double kPolishShare =
    0.25;  // hybrid: of all evaluations; linear programs are dear beside evaluations of designs
constexpr size_t kFewestProposed = 8;

// One that was kept is no use where it has gone beyond a smaller budget: the same seed gives the same front.
bool isWithin(const search::State& known, const search::Settings& settings) {
  return known.evaluations <= settings.evaluations || known.settings.evaluations == settings.evaluations;
}

// Lighting files of an earlier run would look like designs of this one: "design_" and a number.
void removeOldDesigns(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string(), begin = "design_";
    if (name.starts_with(begin) && name.ends_with(".json") && name.find_first_of("0123456789") == begin.size())
      old.push_back(entry.path());
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file, ignored);
}

}  // namespace

// The hypervolume over a search, now and then.
class Trace {
 public:
  explicit Trace(const Model& model) : model_(model) {}
  // `last`: in any case.
  void see(const search::State& s, bool last) {
    if (!points_.empty() && s.evaluations == points_.back().evaluations) return;
    const bool due = points_.empty() || search::fractionDone(s) >= done_ + 1.0 / kTracePoints;
    if (!last && (!due || takenS_ > kTraceS + kTraceShare * s.seconds)) return;
    const Stopwatch watch;
    done_ = search::fractionDone(s);
    points_.push_back({s.evaluations, s.seconds, hypervolumeOf(model_, s.archive)});
    takenS_ += watch.seconds();
  }
  double hypervolume() const { return points_.empty() ? 0 : points_.back().hypervolume; }
  const std::vector<TracePoint>& points() const { return points_; }

 private:
  const Model& model_;
  std::vector<TracePoint> points_;
  double done_ = 0, takenS_ = 0;
};

Status Run::read() {
  // Light comes by the study's conditions.
  home::OpenWish wish;
  wish.scene = wish_.home, wish.light = home::LightWish::File, wish.metresPerUnit = wish_.metresPerUnit;
  Result<home::OpenedHome> opened = home::openHome(wish);
  if (!opened) return Error{opened.error()};
  for (const std::string& note : opened.value().notes) news_.line(note);
  home_ = std::move(opened.value().scene);
  Result<StudyFile> study = readStudy(wish_.study, home_.rooms);
  if (!study) return Error{study.error()};
  study_ = std::move(study.value());
  for (const std::string& name : study_.cameras) {
    const Result<Camera> camera = findCamera(home_, name);
    if (!camera) return Error{fmt::format("{}: cameras: {}", wish_.study.string(), camera.error())};
    cameras_.push_back(camera.value());
  }
  if (cameras_.empty()) cameras_.push_back(defaultCamera(home_));
  const ResponseSettings response{};
  const std::string settings =
      fmt::format("{} {} {} {} {} {}", version(), settingsToJson(wish_.render), response.tolerance,
                  response.fewestSamples, response.mostSamples, response.atOnce);
  if (wish_.evaluations) study_.evaluations = *wish_.evaluations;
  if (wish_.certified) study_.certified = *wish_.certified;
  if (wish_.seed) study_.seed = *wish_.seed;
  if (const Status s = checkConditions(home_, study_); !s) return s;
  const Result<std::string> hash = inputHash(home_, study_, settings);
  if (!hash) return Error{hash.error()};
  hash_ = hash.value();
  return Ok{};
}

// Candidates and meters.
Status Run::prepare(Stages& stages) {
  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(home_); });
  Result<Candidates> candidates = findCandidates(study_, rays);
  if (!candidates) return Error{candidates.error()};
  candidates_ = std::move(candidates.value());
  Result<Meters> meters = placeMeters(study_, rays);
  if (!meters) return Error{meters.error()};
  meters_ = std::move(meters.value());
  news_.line(fmt::format("{} places, {} candidate lamps, {} points, {} eyes", candidates_.places.size(),
                         candidates_.candidates.size(), meters_.points(), study_.eyes.size()));
  return Ok{};
}

// From the folder, or found and kept there. Empty where cancelled.
Result<std::optional<Run::FoundItem>> Run::itemAt(size_t index, Stages& stages) const {
  const ResponseSizes sizes = sizesOf(problem());
  const ItemPlace place{index, itemCount(problem())};
  Result<std::optional<ResponseItem>> known = loadItem(wish_.folder, hash_, sizes, place);
  if (!known) news_.warning(known.error());
  if (known && known.value()) return std::optional(FoundItem{std::move(*known.value()), true});
  Result<std::optional<ResponseItem>> found = findItem(problem(), index, stages);
  if (!found) return Error{found.error()};
  if (!found.value()) return std::optional<FoundItem>();
  Status kept = saveItem(wish_.folder, hash_, sizes, place, *found.value());
  return std::optional(FoundItem{std::move(*found.value()), false, std::move(kept)});
}

Result<std::optional<Response>> Run::responseByItems(Stages& stages) {
  const Stopwatch watch;
  std::vector<ResponseItem> items;
  const size_t all = itemCount(problem()), groups = all - study_.conditions.size();
  size_t known = 0;
  bool isWarned = false;
  for (size_t i = 0; i < all; ++i) {
    Result<std::optional<FoundItem>> found = itemAt(i, stages);
    if (!found) return Error{found.error()};
    if (!found.value()) return std::optional<Response>();
    FoundItem& one = *found.value();
    if (!one.kept && !std::exchange(isWarned, true)) news_.warning(one.kept.error());
    items.push_back(std::move(one.item));
    known += one.isKnown;
    if (i + 1 == groups) report_.responseSeconds = watch.seconds();
  }
  report_.baseSeconds = watch.seconds() - report_.responseSeconds;
  if (known > 0) news_.line(fmt::format("{} of {} solutions are known from before", known, all));
  return std::optional(responseOf(sizesOf(problem()), items));
}

// Once the response is kept whole.
void Run::removeItems() const {
  std::error_code ignored;
  const size_t all = itemCount(problem());
  for (size_t i = 0; i < all; ++i) std::filesystem::remove(wish_.folder / itemFileName({i, all}), ignored);
}

Status Run::respond(Stages& stages) {
  if (const Status s = prepare(stages); !s || stopped()) return s;
  const std::filesystem::path file = wish_.folder / "response.bin";
  Result<std::optional<Response>> known = loadResponse(file, hash_, sizesOf(problem()));
  if (!known) news_.warning(known.error());
  if (known && known.value()) {
    news_.line("the response of all candidates is known from before");
    response_ = std::move(*known.value());
    removeItems();
  } else {
    Result<std::optional<Response>> found = responseByItems(stages);
    if (!found) return Error{found.error()};
    if (!found.value()) return Ok{};
    response_ = std::move(*found.value());
    news_.line(fmt::format("response of {} candidates at {} points in {:.1f} s, conditions without them in {:.1f} s",
                           candidates_.candidates.size(), meters_.points(), report_.responseSeconds,
                           report_.baseSeconds));
    const Status saved = saveResponse(file, hash_, response_);
    if (!saved) news_.warning(saved.error());
    if (saved) removeItems();
  }
  model_ = makeModel(study_, candidates_, meters_, response_);
  report_.designsASecond = designsASecond(model_);
  news_.line(fmt::format("{:.0f} designs are evaluated a second", report_.designsASecond));
  return Ok{};
}

std::string Run::partFile(size_t part, size_t parts) {
  return fmt::format("part_{:02}_of_{:02}.json", part + 1, parts);
}

Status Run::respondPart(Stages& stages) {
  if (const Status s = prepare(stages); !s || stopped()) return s;
  const size_t all = itemCount(problem());
  const auto whole = loadResponse(wish_.folder / "response.bin", hash_, sizesOf(problem()));
  const bool isKnown = whole && whole.value();
  nlohmann::ordered_json solutions = nlohmann::ordered_json::array();
  for (size_t i = wish_.part; i < all && !isKnown; i += wish_.parts) {
    const Result<std::optional<FoundItem>> found = itemAt(i, stages);
    if (!found) return Error{found.error()};
    if (!found.value()) return Ok{};
    if (!found.value()->kept) return found.value()->kept;
    solutions.push_back(i);
  }
  const nlohmann::ordered_json told = {
      {"part", wish_.part + 1}, {"parts", wish_.parts}, {"solutions", solutions}, {"all", all}};
  news_.line(
      isKnown ? "the response of all candidates is known from before"
              : fmt::format("part {} of {}: {} of {} solutions", wish_.part + 1, wish_.parts, solutions.size(), all));
  return writeWhole(wish_.folder / partFile(wish_.part, wish_.parts), told.dump() + "\n");
}

// The hybrid begins with what linear programs over all lamps at once say, and pays for it.
search::State Run::start(const search::Problem& problem, const search::Settings& settings) const {
  if (settings.method != search::Method::hybrid) return search::start(problem, settings);
  const Stopwatch watch;
  const RelaxedDesigns relaxed = relaxedDesigns(model_, std::max<size_t>(1, settings.population / kRelaxedShare));
  const double seconds = watch.seconds();
  search::State state = search::start(problem, settings, relaxed.designs);
  state.evaluations += relaxed.evaluations, state.seconds += seconds;
  return state;
}

Result<search::State> Run::searchBy(const search::Problem& problem, search::Method method, Trace& trace) {
  search::Settings settings;
  settings.method = method, settings.seed = study_.seed, settings.evaluations = study_.evaluations,
  settings.population = study_.population, settings.seconds = wish_.seconds;
  settings.polishShare = kPolishShare;
  if (const Status s = search::check(problem, settings); !s) return Error{s.error()};
  const char* name = search::nameOf(method);
  const std::filesystem::path file = wish_.folder / fmt::format("search_{}.json", name);
  const std::string hash = hashOf(hash_ + fmt::format(" {} {} {}", name, settings.seed, settings.population));
  search::State state;
  Result<std::optional<search::State>> known = loadSearch(file, hash, problem);
  if (!known) news_.warning(known.error());
  if (known && known.value() && isWithin(*known.value(), settings)) {
    state = std::move(*known.value());
    state.settings.evaluations = settings.evaluations, state.settings.seconds = settings.seconds;
  } else {
    state = start(problem, settings);
  }
  const Stopwatch watch;
  double kept = 0;
  Status written = Ok{};
  search::run(problem, state, {{}, wish_.stop}, [&](const search::State& s) {
    trace.see(s, false);
    news_.search(name, s, trace.hypervolume(), false);
    if (watch.seconds() - kept < kKeepEveryS || !written) return;
    kept = watch.seconds();
    written = saveSearch(file, hash, s);
  });
  trace.see(state, true);
  news_.search(name, state, trace.hypervolume(), true);
  if (written) written = saveSearch(file, hash, state);
  if (!written) news_.warning(written.error());
  return state;
}

Status Run::searchAll() {
  const search::Problem problem = problemOf(model_);
  for (size_t i = 0; i < wish_.methods.size() && !stopped(); ++i) {
    Trace trace(model_);
    Result<search::State> state = searchBy(problem, wish_.methods[i], trace);
    if (!state) return Error{state.error()};
    report_.methods.push_back({search::nameOf(wish_.methods[i]), state.value().evaluations, state.value().polished,
                               state.value().seconds, trace.hypervolume(), trace.points()});
    if (i == 0) report_.front = std::move(state.value().archive);
  }
  if (report_.front.size() == 0) return Ok{};
  report_.lookUpsASecond = lookUpsASecond(model_, report_.front);
  report_.facts = {
      {"program", "roomlight " + std::string(version())},
      {"home", wish_.home.string()},
      {"seed", fmt::format("{}", study_.seed)},
      {"technique", wish_.render.technique + ", quality " + wish_.render.quality},
      {"candidates' standard error", fmt::format("{:.2f} % at the worst point", response_.worstErrorPercent)},
      {"a second",
       fmt::format("{:.0f} designs evaluated; {:.0f} looked up among those of the front, as a surrogate would",
                   report_.designsASecond, report_.lookUpsASecond)}};
  return Ok{};
}

Status Run::writeDesign(search::ConstGenome design, size_t number, Proposed& out) const {
  const std::vector<std::string> names = fileNamesOf(study_.conditions);
  for (size_t c = 0; c < names.size(); ++c) {
    const Result<std::string> text =
        lightingFileOf(study_, lampsOf({study_, candidates_, model_, design}, c), study_.conditions[c].daylight);
    if (!text) return Error{text.error()};
    out.lightingFiles.push_back(names.size() == 1 ? fmt::format("design_{}.json", number)
                                                  : fmt::format("design_{}_{}.json", number, names[c]));
    if (const Status s = writeWhole(wish_.folder / out.lightingFiles.back(), text.value()); !s) return s;
  }
  return Ok{};
}

Status Run::propose() {
  removeOldDesigns(wish_.folder);
  for (const size_t index :
       spreadOf(model_, report_.front, std::max(static_cast<size_t>(study_.certified), kFewestProposed))) {
    const size_t number = report_.designs.size() + 1;
    const search::ConstGenome design = std::as_const(report_.front.designs)[index];
    Proposed d{index,
               fmt::format("design {}", number),
               billOf({study_, candidates_, model_, design}),
               resultOf(model_, design),
               {},
               {}};
    if (const Status s = writeDesign(design, number, d); !s) return s;
    report_.designs.push_back(std::move(d));
  }
  const bool dark =
      std::all_of(report_.designs.begin(), report_.designs.end(), [](const Proposed& d) { return d.bill.empty(); });
  if (dark)
    news_.warning(
        "no design has a lamp: the limits are too small for any, or no objective asks for light (targetMiss)");
  return Ok{};
}

Status Run::certifyAll(Stages& stages) {
  const size_t count = std::min(report_.designs.size(), static_cast<size_t>(study_.certified));
  for (size_t i = 0; i < count && !stopped(); ++i) {
    Proposed& d = report_.designs[i];
    Result<std::optional<Certificate>> c =
        certify(home_, {study_, candidates_, model_, std::as_const(report_.front.designs)[d.index]}, meters_, cameras_,
                wish_.render, stages);
    if (!c) return Error{c.error()};
    d.certificate = std::move(c.value());
    if (!d.certificate) break;
    std::string differences;
    for (size_t k = 0; k < study_.conditions.size(); ++k) {
      const Certificate::OfCondition& r = d.certificate->conditions[k];
      differences += fmt::format("{}{}: {} points, mean {:.2f} %, {}", k ? "; " : "", study_.conditions[k].name,
                                 r.judged, r.meanPercent, largestDifference(r));
    }
    news_.line(fmt::format("{} certified in {:.1f} s: prediction against full solution {}", d.name,
                           d.certificate->seconds, differences));
  }
  return Ok{};
}

Status Run::write(const std::string& plots) const {
  const Result<std::string> html = reportHtml(report_, home_, plots);
  if (!html) return Error{html.error()};
  const std::string texts[] = {html.value(), runJson(report_), pointsCsv(report_), frontCsv(report_)};
  for (size_t i = 0; i < std::size(texts); ++i) {
    if (const Status s = writeWhole(wish_.folder / kFiles[i], texts[i]); !s) return s;
  }
  return Ok{};
}

}  // namespace roomlight::optimise
