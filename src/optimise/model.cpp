#include "optimise/model.h"

#include <algorithm>
#include <cmath>

#include "photometry/colour_temperature.h"
#include "scene/outline.h"

namespace roomlight::optimise {
namespace {

constexpr double kLeastBackgroundCdM2 = 1e-6;

size_t padded(size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

// Rows of light on all elements, in the layout of columns.
class Rows {
 public:
  Rows(const Model& model, const Meters& meters) : model_(model), meters_(meters) {}

  // `tint`: what white light is multiplied by; `directLux` per eye: what comes straight and is no background.
  template <class Direct>
  void fill(const Vec3* lux, Vec3 tint, double factor, const Direct& directLux, float* out) const {
    const auto scale = static_cast<float>(factor);
    const auto light = [&](size_t i) { return luminance(lux[i] * tint) * scale; };
    for (size_t z = 0; z < meters_.zones.size(); ++z) {
      const ZonePoints& points = meters_.zones[z];
      const size_t end = padded(points.count);
      // Copies of the last point: they change neither the least nor, where sums leave them out, the mean.
      for (size_t k = 0; k < end; ++k)
        out[model_.zones[z].first + k] = light(points.first + std::min(k, points.count - 1));
    }
    for (size_t e = 0; e < model_.eyes.size(); ++e)
      out[model_.firstEye + e] =
          std::max(0.0f, light(meters_.firstEye + e) - static_cast<float>(directLux(e)) * scale) / kPi;
    for (size_t s = 0; s < meters_.seen.size(); ++s)
      out[model_.firstSeen + s] = luminance(lux[meters_.firstSeen + s] * tint * meters_.seen[s].albedo) * scale / kPi;
  }

 private:
  const Model& model_;
  const Meters& meters_;
};

double areaOf(const StudyFile& study) {
  if (study.areaM2 > 0) return study.areaM2;
  double sum = 0;
  std::vector<std::string> names;
  const auto add = [&](const Room& room) {
    if (room.floor.empty() || std::find(names.begin(), names.end(), room.name) != names.end()) return;
    names.push_back(room.name);
    sum += std::abs(signedAreaM2(room.floor));
  };
  for (const Zone& z : study.zones) add(z.room);
  for (const PlaceRule& p : study.places) add(p.room);
  return sum;
}

void addConditions(const StudyFile& study, Model& m) {
  const auto judged = [](const auto& list, size_t c) {
    std::vector<uint32_t> out;
    for (size_t i = 0; i < list.size(); ++i) {
      if (std::find(list[i].conditions.begin(), list[i].conditions.end(), c) != list[i].conditions.end())
        out.push_back(static_cast<uint32_t>(i));
    }
    return out;
  };
  for (size_t c = 0; c < study.conditions.size(); ++c)
    m.conditions.push_back({study.conditions[c].weight, study.conditions[c].hoursPerYear, judged(study.zones, c),
                            judged(study.eyes, c), judged(study.ratios, c)});
}

void addPlaces(const StudyFile& study, const Candidates& candidates, Model& m) {
  for (const Place& p : candidates.places) m.ruleOfPlace.push_back(static_cast<uint32_t>(p.rule));
  for (const PlaceRule& r : study.places) m.mostOfRule.push_back(r.most);
  for (const size_t first : candidates.firstOption) m.firstOption.push_back(static_cast<uint32_t>(first));
  m.conflicts = candidates.conflicts;
  for (const LampOption& o : candidates.options) {
    const Candidate& c = candidates.candidates[o.candidate];
    const Luminaire& l = study.catalogue.luminaires[c.luminaire];
    m.options.push_back({static_cast<uint32_t>(c.place), c.luminaire, l.wattsW, l.standbyW, l.price, l.dimmable});
  }
}

}  // namespace

Model makeModel(const StudyFile& study, const Candidates& candidates, const Meters& meters, const Response& response) {
  Model m;
  for (size_t z = 0; z < study.zones.size(); ++z) {
    m.zones.push_back(
        {m.rows, meters.zones[z].count, study.zones[z].meanLux, study.zones[z].u0, study.zones[z].weight});
    m.rows += padded(meters.zones[z].count);
  }
  for (const Eye& e : study.eyes) m.eyes.push_back({e.ugr});
  for (const Ratio& r : study.ratios) m.ratios.push_back({r.most});
  m.firstEye = m.rows, m.firstSeen = m.firstEye + m.eyes.size();
  m.rows = padded(m.firstSeen + meters.seen.size());
  m.objectives = study.objectives, m.dimming = study.dimming;
  m.mostWatts = study.mostWatts, m.mostCost = study.mostCost, m.mostFittings = study.mostFittings;
  m.areaM2 = areaOf(study);
  addConditions(study, m);
  addPlaces(study, candidates, m);

  const Rows rows(m, meters);
  const double f = study.maintenance;
  m.columns.resize(m.options.size() * m.rows), m.glare.resize(m.options.size() * m.eyes.size());
  for (size_t o = 0; o < candidates.options.size(); ++o) {
    const LampOption& option = candidates.options[o];
    const EyeGlare* glare = response.glareOf(option.candidate);
    rows.fill(
        response.of(option.candidate), blackBodyColour(option.kelvin), f, [&](size_t e) { return glare[e].directLux; },
        m.columns.data() + o * m.rows);
    for (size_t e = 0; e < m.eyes.size(); ++e) m.glare[o * m.eyes.size() + e] = glare[e].term * f * f;
  }
  m.base.resize(m.conditions.size() * m.rows), m.baseGlare.resize(m.conditions.size() * m.eyes.size());
  for (size_t c = 0; c < m.conditions.size(); ++c) {
    rows.fill(
        response.base[c].lux.data(), Vec3(1), 1, [&](size_t e) { return response.base[c].glare[e].directLux; },
        m.base.data() + c * m.rows);
    for (size_t e = 0; e < m.eyes.size(); ++e) m.baseGlare[c * m.eyes.size() + e] = response.base[c].glare[e].term;
  }
  const auto addMeans = [&](const float* rows_, std::vector<double>& out) {
    for (const ModelZone& z : m.zones) {
      double sum = 0;
      for (size_t k = 0; k < z.count; ++k) sum += static_cast<double>(rows_[z.first + k]);
      out.push_back(sum / static_cast<double>(z.count));
    }
  };
  for (size_t o = 0; o < m.options.size(); ++o) addMeans(m.column(o), m.means);
  for (size_t c = 0; c < m.conditions.size(); ++c) addMeans(m.baseOf(c), m.baseMeans);
  return m;
}

std::vector<ChosenLamp> chosenLamps(const Model& model, search::ConstGenome design) {
  std::vector<ChosenLamp> out;
  for (size_t p = 0; p < model.places(); ++p) {
    if (design.integers[p] <= 0) continue;
    const ChosenLamp lamp{static_cast<uint32_t>(p),
                          model.firstOption[p] + static_cast<uint32_t>(design.integers[p]) - 1};
    bool on = model.levels() == 0;
    for (size_t c = 0; c < model.conditions.size() && !on; ++c) on = dimmingOf(model, design, lamp, c) > 0;
    if (on) out.push_back(lamp);
  }
  return out;
}

double dimmingOf(const Model& model, search::ConstGenome design, ChosenLamp lamp, size_t condition) {
  const size_t levels = model.levels();
  if (levels == 0) return 1;
  const double d = design.reals[lamp.place * levels + (levels == 1 ? 0 : condition)];
  if (!model.options[lamp.option].dimmable) return d >= 0.5 ? 1 : 0;
  return d < kOff ? 0 : d;
}

void levelsOf(const Model& model, std::span<const ChosenLamp> lamps, search::ConstGenome design, size_t condition,
              std::vector<double>& levels) {
  levels.clear();
  for (const ChosenLamp& lamp : lamps) levels.push_back(dimmingOf(model, design, lamp, condition));
}

double glareAt(const Model& model, std::span<const ChosenLamp> lamps, std::span<const double> levels, size_t condition,
               size_t eye) {
  double sum = model.baseGlare[condition * model.eyes.size() + eye];
  for (size_t i = 0; i < lamps.size(); ++i)
    sum += levels[i] * levels[i] * model.glare[lamps[i].option * model.eyes.size() + eye];
  return sum;
}

double backgroundAt(const Model& model, std::span<const ChosenLamp> lamps, std::span<const double> levels,
                    size_t condition, size_t eye) {
  double sum = static_cast<double>(model.baseOf(condition)[model.firstEye + eye]);
  for (size_t i = 0; i < lamps.size(); ++i)
    sum += levels[i] * static_cast<double>(model.column(lamps[i].option)[model.firstEye + eye]);
  return sum;
}

double ugrOf(double glare, double backgroundCdM2) {
  return glare > 0 ? std::max(0.0, 8 * std::log10(0.25 * glare / std::max(backgroundCdM2, kLeastBackgroundCdM2))) : 0;
}

double glareOfUgr(double ugr) { return 4 * std::pow(10, ugr / 8); }

}  // namespace roomlight::optimise
