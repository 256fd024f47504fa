// One run: from a home and a study file to designs on the best trade-offs. Its folder keeps the response and the
// searches, so that a run that was stopped goes on where it was:
//
//     Run run({.home = "flat.sh3d", .study = "goals.toml", .folder = "out"}, news);
//     run.read(); run.respond(stages); run.searchAll(); run.propose(); run.certifyAll(stages); run.write();
//
// Each is asked for its Status, and `stopped()` between them.
#pragma once

#include <atomic>
#include <functional>

#include "engine/stages.h"
#include "optimise/report.h"
#include "search/search.h"

namespace roomlight::optimise {

struct RunWish {
  std::optional<float> metresPerUnit;  // of the home; none: the file's, or guessed
  std::filesystem::path home, study, folder;
  RenderSettings render;
  std::vector<search::Method> methods = {
      search::Method::hybrid};  // the first finds the front, the others are compared with it
  // Instead of the study's:
  std::optional<size_t> evaluations;
  std::optional<int> certified;
  std::optional<uint64_t> seed;
  double seconds = 0;                         // of each search at most; 0: none
  size_t part = 0, parts = 1;                 // of respondPart(): from 0, of so many
  const std::atomic<bool>* stop = nullptr;
};

// What is told while it goes on.
struct RunNews {
  std::function<void(const std::string&)> line;     // something is done
  std::function<void(const std::string&)> warning;  // something cannot be kept for another run, or was not kept whole
  std::function<void(const char* method, const search::State& state, double hypervolume, bool last)> search;
};

class Trace;

class Run {
 public:
  Run(RunWish wish, RunNews news) : wish_(std::move(wish)), news_(std::move(news)) {}
  Run(const Run&) = delete;  // the report refers to what lies beside it
  Run& operator=(const Run&) = delete;

  // Home, study and what they name. Errors: of any of these files.
  Status read();
  // Candidates, meters, and what each candidate gives at each of them: from the folder, where it is of the same inputs.
  Status respond(Stages& stages);
  // A part of the response, for processes that share it by a folder: of all solutions that it takes (ResponseItem)
  // every one whose number has remainder `part` by `parts`, into files that respond() takes up. Writes how far it came
  // to partFile() of the wish's folder.
  Status respondPart(Stages& stages);
  static std::string partFile(size_t part, size_t parts);  // "part_03_of_08.json"
  // By every method, each going on from the folder. Stopped, those so far; there is a front all the same once the first
  // has begun.
  Status searchAll();
  // Chooses designs of the front and writes their lighting files.
  Status propose();
  // The study's number of designs, solved in full. Stopped, those so far.
  Status certifyAll(Stages& stages);
  // index.html, run.json, points.csv, front.csv. `plots`: as of report::page().
  Status write(const std::string& plots = {}) const;

  bool stopped() const { return wish_.stop && *wish_.stop; }
  const Report& report() const { return report_; }
  static constexpr const char* kFiles[] = {"index.html", "run.json", "points.csv", "front.csv"};

 private:
  Status prepare(Stages& stages);
  ResponseProblem problem() const { return {home_, study_, candidates_, meters_, {.render = wish_.render}}; }
  struct FoundItem {
    ResponseItem item;
    bool isKnown = false;  // the folder had it
    Status kept = Ok{};  // else: whether it has now
  };
  Result<std::optional<FoundItem>> itemAt(size_t index, Stages& stages) const;
  Result<std::optional<Response>> responseByItems(Stages& stages);
  void removeItems() const;
  Result<search::State> searchBy(const search::Problem& problem, search::Method method, Trace& trace);
  search::State start(const search::Problem& problem, const search::Settings& settings) const;
  Status writeDesign(search::ConstGenome design, size_t number, Proposed& out) const;

  const RunWish wish_;
  const RunNews news_;
  Scene home_;
  StudyFile study_;
  Candidates candidates_;
  Meters meters_;
  Response response_;
  Model model_;
  std::vector<Camera> cameras_;
  std::string hash_;
  Report report_{study_, candidates_, meters_, model_, {}, {}, {}, {}};
};

}  // namespace roomlight::optimise
