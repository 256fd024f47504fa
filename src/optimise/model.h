// All that evaluating a design needs, flat: columns of light that add up, goals, watts and prices.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "optimise/response.h"
#include "search/problem.h"

namespace roomlight::optimise {

constexpr double kHoursAYear = 8760;
constexpr size_t kLanes = 8;  // floats that are summed side by side; columns are padded to them

struct ModelOption {
  uint32_t place = 0;
  size_t luminaire = 0;
  double wattsW = 0, standbyW = 0, price = 0;
  bool dimmable = true;
};

struct ModelZone {
  size_t first = 0, count = 0;  // rows; `first` is a multiple of kLanes, what pads the last ones are copies
  double meanLux = 0, u0 = 0, weight = 1;
};

struct ModelEye {
  double ugr = 19;
};

struct ModelRatio {
  double most = 10;
};

struct ModelCondition {
  double weight = 1, hours = 0;
  std::vector<uint32_t> zones, eyes, ratios;  // judged in it
};

// Columns: first points of the zones (padded zone by zone), then backgrounds of eyes (cd/m²), then luminances seen
// (cd/m²); lengths are multiples of kLanes. Lux and cd/m² are with the maintenance factor.
struct Model {
  size_t rows = 0, firstEye = 0, firstSeen = 0;
  std::vector<float> columns;               // of option o at row r: columns[o * rows + r]
  std::vector<float> base;                  // of condition c: base[c * rows + r]
  std::vector<double> means,
      baseMeans;     // over each zone: of option o in zone z: means[o * zones.size() + z]; of condition c
  std::vector<double> glare,
      baseGlare;     // Σ L² ω / p²: of option o at eye e: glare[o * eyes.size() + e]; of condition c
  std::vector<ModelOption> options;
  std::vector<uint32_t> firstOption;        // per place, and the end
  std::vector<std::vector<uint32_t>> conflicts;
  std::vector<uint32_t> ruleOfPlace;
  std::vector<int> mostOfRule;
  std::vector<ModelZone> zones;
  std::vector<ModelEye> eyes;
  std::vector<ModelRatio> ratios;
  std::vector<ModelCondition> conditions;
  std::vector<Objective> objectives;
  Dimming dimming = Dimming::ByCondition;
  double mostWatts = 0, mostCost = 0;  // 0: no limit
  int mostFittings = 0;
  double areaM2 = 0;

  size_t places() const { return ruleOfPlace.size(); }
  size_t levels() const { return dimming == Dimming::None ? 0 : dimming == Dimming::Common ? 1 : conditions.size(); }
  const float* column(size_t option) const { return columns.data() + option * rows; }
  const float* baseOf(size_t condition) const { return base.data() + condition * rows; }
};

Model makeModel(const StudyFile& study, const Candidates& candidates, const Meters& meters, const Response& response);

// The rows of the model that are a zone's points, in the order of the meters.
inline std::span<const float> pointsOf(const ModelZone& zone, std::span<const float> rows) {
  return rows.subspan(zone.first, zone.count);
}

// Below this a lamp is off; one that is off in every condition is not part of the design: nobody buys it.
constexpr double kOff = 0.005;

// Lamps of the design, by place.
struct ChosenLamp {
  uint32_t place = 0, option = 0;
};
std::vector<ChosenLamp> chosenLamps(const Model& model, search::ConstGenome design);
// Share of full light of a chosen lamp in a condition, 0 to 1.
double dimmingOf(const Model& model, search::ConstGenome design, ChosenLamp lamp, size_t condition);
// The same of all lamps, into `levels`.
void levelsOf(const Model& model, std::span<const ChosenLamp> lamps, search::ConstGenome design, size_t condition,
              std::vector<double>& levels);

// What an eye sees in a condition with lamps at these levels: Σ L² ω / p², and the background in cd/m².
double glareAt(const Model& model, std::span<const ChosenLamp> lamps, std::span<const double> levels, size_t condition,
               size_t eye);
double backgroundAt(const Model& model, std::span<const ChosenLamp> lamps, std::span<const double> levels,
                    size_t condition, size_t eye);
// UGR of the two, at least 0; and what of the first there may be for a cd/m² of the second.
double ugrOf(double glare, double backgroundCdM2);
double glareOfUgr(double ugr);

}  // namespace roomlight::optimise
