// Designs that are proposed: a spread of the front, each as a lighting file and certified by the full solution.
#pragma once

#include <nlohmann/json.hpp>

#include "measure/measurements.h"
#include "optimise/evaluate.h"
#include "search/archive.h"

namespace roomlight::optimise {

// A design, and what its numbers stand for.
struct Design {
  const StudyFile& study;
  const Candidates& candidates;
  const Model& model;
  search::ConstGenome genome;
};

// One lamp of a design, for people.
struct BillLine {
  std::string name, place;  // "Downlight 60", "Living ceiling 3"
  Vec3 position;
  std::string aim;
  double kelvin = 0, wattsW = 0, price = 0;
  std::vector<double> dimming;  // per condition
};
std::vector<BillLine> billOf(const Design& design);

// Lamps of a design in a condition as a lighting file's `lamps`: each at its level, in its colour.
nlohmann::json lampsOf(const Design& design, size_t condition);

// A whole lighting file: the study's fixed lighting, the condition's daylight, the design's lamps. Photometric files by
// absolute path.
Result<std::string> lightingFileOf(const StudyFile& study, const nlohmann::json& lamps, const nlohmann::json& daylight);

// Of each condition: letters and digits of its name, lower case, others as _, and a number where that is taken.
std::vector<std::string> fileNamesOf(const std::vector<Condition>& conditions);

// How far the prediction is from the full solution, over the points of all zones.
struct Certificate {
  struct OfCondition {
    std::vector<float> fullLux, predictedLux;  // per point of the meters, lamps as new
    std::vector<float> fullErrorLux;  // standard errors of fullLux
    double maxPercent = 0, meanPercent = 0;  // of points with at least kJudgedLux in the full solution
    double uncertainPercent = 0;  // standard error of the full solution at the point of maxPercent
    size_t judged = 0;
    std::vector<double> fullUgr;  // per eye, with the maintenance factor; below 0: cannot be judged
  };
  std::vector<OfCondition> conditions;
  std::vector<Image> pictures;  // of the cameras, in the first condition; exposed, white-balanced and tone-mapped
  double seconds = 0;
  const OfCondition& worst() const;  // with the largest difference
};
// "largest 4.1 % (full solution uncertain by 1.2 % there)"
std::string largestDifference(const Certificate::OfCondition& c);
// What goals are judged by at every point: the full solution with the maintenance factor.
std::vector<float> maintainedLux(const StudyFile& study, const Model& model, const Certificate::OfCondition& c,
                                 size_t condition);

constexpr double kJudgedLux = 1;
constexpr int kPictureWidth = 640, kPictureHeight = 360;

// Solved by technique hybrid, with the design's lamps alone beside what is fixed. Empty where cancelled.
Result<std::optional<Certificate>> certify(const Scene& home, const Design& design, const Meters& meters,
                                           std::span<const Camera> cameras, const RenderSettings& render,
                                           Stages& stages);

// About `count` designs of a front, spread over it: among those that miss targets by at most kProposedMissPercent more
// than the best, first the best of each objective, then each that is farthest from those chosen. Indices, in the order
// of the first objective.
constexpr double kProposedMissPercent = 10;
std::vector<size_t> spreadOf(const Model& model, const search::Archive& front, size_t count);

}  // namespace roomlight::optimise
