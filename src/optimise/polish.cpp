#include "optimise/improve.h"

#include <algorithm>

#include "optimise/dimming_program.h"
#include "optimise/evaluate.h"

namespace roomlight::optimise {
namespace {

constexpr int kMostCuts = 4;        // programs that one climb may solve
constexpr int kHalvings = 30;       // of the way to a limit of glare
constexpr double kRounding = 1e-9;  // relative

// Common dimming is one program, else each condition has its own.
size_t programsOf(const Model& m) { return m.dimming == Dimming::Common ? 1 : m.conditions.size(); }

std::vector<double> between(const std::vector<double>& a, const std::vector<double>& b, double t) {
  std::vector<double> out(a.size());
  for (size_t i = 0; i < a.size(); ++i) out[i] = a[i] + t * (b[i] - a[i]);
  return out;
}

// The levels that one program is for. UGR keeps its limit where f(d) = Σ L² ω / p² - k · background <= 0, which is
// convex: the best without it is found first; where that glares, the way there from levels that do not ends on the
// limit, and the tangent there cuts the program's corner off (supporting hyperplanes: Veinott 1967).
class Polisher {
 public:
  Polisher(const Model& m, search::Genome design, const search::Wish& wish, const std::vector<ChosenLamp>& lamps,
           size_t k)
      : m_(m),
        design_(design),
        wish_(wish),
        lamps_(lamps),
        k_(k),
        first_(programsOf(m) == 1 ? 0 : k),
        end_(programsOf(m) == 1 ? m.conditions.size() : k + 1),
        program_(m, lamps, {first_, end_, true}) {
    const LinearWeights weights = linearWeights(m, wish);
    program_.addCosts(weights, 1 / static_cast<double>(programsOf(m)));
    program_.addGoals(weights);
    program_.addRatios();
    levelsOf(m, lamps, design, first_, now_);
  }

  // Leaves the best in the design. Returns the cost in evaluations.
  size_t run() {
    const std::vector<double> limits = limitsOfGlare(), now = limitsOrNow(limits);
    switchLamps();
    climb(now);
    if (now != limits) climb(limits);
    if (!best_.empty()) put(best_);
    return cost_;
  }

 private:
  // Calls see(condition, eye, number) for eyes that are judged.
  template <class See>
  void eachEye(const See& see) const {
    size_t number = 0;
    for (size_t c = first_; c < end_; ++c) {
      for (const uint32_t e : m_.conditions[c].eyes) see(c, e, number++);
    }
  }
  // Σ L² ω / p² for a cd/m² of background at most, of every judged eye.
  std::vector<double> limitsOfGlare() const {
    std::vector<double> out;
    eachEye([&](size_t, uint32_t e, size_t) { out.push_back(glareOfUgr(m_.eyes[e].ugr)); });
    return out;
  }
  // As it is now where that is more.
  std::vector<double> limitsOrNow(std::vector<double> limits) const {
    eachEye([&](size_t c, uint32_t e, size_t i) {
      const double background = backgroundAt(m_, lamps_, now_, c, e);
      if (background > 0)
        limits[i] = std::max(limits[i], glareAt(m_, lamps_, now_, c, e) / background * (1 + kRounding));
    });
    return limits;
  }
  bool within(const std::vector<double>& levels, const std::vector<double>& limits) const {
    bool all = true;
    eachEye([&](size_t c, uint32_t e, size_t i) {
      all = all &&
            glareAt(m_, lamps_, levels, c, e) <= limits[i] * backgroundAt(m_, lamps_, levels, c, e) * (1 + kRounding);
    });
    return all;
  }
  // How far from `inside` towards `to` the limits hold.
  double reach(const std::vector<double>& inside, const std::vector<double>& to,
               const std::vector<double>& limits) const {
    if (within(to, limits)) return 1;
    double low = 0, high = 1;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (low + high) / 2;
      (within(between(inside, to, middle), limits) ? low : high) = middle;
    }
    return low;
  }
  // The levels now, those that can be dimmed so far that the limits hold; empty where that is not enough.
  std::vector<double> dimmedWithin(const std::vector<double>& limits) const {
    std::vector<double> dark = now_;
    for (size_t i = 0; i < lamps_.size(); ++i) dark[i] = canBeDimmed(i) ? 0 : now_[i];
    if (!within(dark, limits) && !within(now_, limits)) return {};
    return within(now_, limits) ? now_ : between(dark, now_, reach(dark, now_, limits));
  }

  bool canBeDimmed(size_t lamp) const { return m_.options[lamps_[lamp].option].dimmable; }
  // Lamps that are either on or off are rounded once, then the others follow.
  void switchLamps() {
    bool any = false;
    for (size_t i = 0; i < lamps_.size(); ++i) any = any || !canBeDimmed(i);
    if (!any) return;
    const std::vector<double> x = solve(program_);
    for (size_t i = 0; i < x.size(); ++i) {
      if (canBeDimmed(i)) continue;
      now_[i] = x[i] >= 0.5 ? 1 : 0;
      program_.fix(i, x[i] >= 0.5);
    }
  }
  // Empty where there is no solution.
  std::vector<double> solve(const DimmingProgram& program) {
    cost_ += program.costOfSolving();
    Result<std::vector<double>> x = program.solve();
    return x ? std::move(x.value()) : std::vector<double>();
  }
  void climb(const std::vector<double>& limits) {
    const std::vector<double> inside = dimmedWithin(limits);
    DimmingProgram program = program_;
    for (int i = 0; i < kMostCuts && !inside.empty(); ++i) {
      const std::vector<double> best = solve(program);
      if (best.empty()) return;
      const double far = reach(inside, best, limits);
      const std::vector<double> levels = between(inside, best, far);
      offer(levels);
      if (far >= 1) return;
      eachEye([&](size_t c, uint32_t e, size_t number) { program.addGlareCut(c, e, limits[number], levels); });
    }
  }

  void put(const std::vector<double>& levels) {
    for (size_t i = 0; i < lamps_.size(); ++i)
      design_.reals[lamps_[i].place * m_.levels() + k_] = std::clamp(levels[i], 0.0, 1.0);
  }
  // Of all that were offered the one stays that is best by the objectives themselves.
  void offer(const std::vector<double>& levels) {
    put(levels);
    const DesignResult result = resultOf(m_, design_);
    double sum = 0;
    for (size_t o = 0; o < m_.objectives.size(); ++o) sum += wish_.weights[o] * result.of(m_.objectives[o]);
    ++cost_;
    if (best_.empty() || sum < least_) best_ = levels, least_ = sum;
  }

  const Model& m_;
  search::Genome design_;
  const search::Wish& wish_;
  const std::vector<ChosenLamp>& lamps_;
  size_t k_, first_, end_;  // the level of each lamp that is polished; its conditions
  DimmingProgram program_;
  std::vector<double> now_, best_;
  double least_ = 0;
  size_t cost_ = 0;
};

// Lamps of the design, with those that are off: dimming may light them.
std::vector<ChosenLamp> hungLamps(const Model& m, search::ConstGenome design) {
  std::vector<ChosenLamp> out;
  for (size_t p = 0; p < m.places(); ++p) {
    if (design.integers[p] > 0)
      out.push_back({static_cast<uint32_t>(p), m.firstOption[p] + static_cast<uint32_t>(design.integers[p]) - 1});
  }
  return out;
}

}  // namespace

size_t polish(const Model& m, search::Genome design, const search::Wish& wish) {
  const std::vector<ChosenLamp> lamps = chosenLamps(m, design);
  if (m.levels() == 0 || lamps.empty() || !(linearWeights(m, wish).miss > 0) || !(weightOfGoals(m) > 0)) return 0;
  size_t cost = 0;
  for (size_t k = 0; k < programsOf(m); ++k) cost += Polisher(m, design, wish, lamps, k).run();
  return cost;
}

Result<LeastWatts> leastWatts(const Model& m, search::ConstGenome design, size_t condition) {
  const std::vector<ChosenLamp> lamps = hungLamps(m, design);
  search::LinearProgram p;
  const ModelCondition& c = m.conditions[condition];
  for (const uint32_t z : c.zones) {
    if (m.zones[z].meanLux <= 0) continue;
    for (const ChosenLamp& l : lamps) p.a.values.push_back(m.means[l.option * m.zones.size() + z]);
    p.atLeast.push_back(m.zones[z].meanLux - m.baseMeans[condition * m.zones.size() + z]);
  }
  p.a.rows = p.atLeast.size(), p.a.columns = lamps.size();
  for (const ChosenLamp& l : lamps) p.cost.push_back(m.options[l.option].wattsW);
  const auto solution = search::minimise(p);
  if (!solution) return Error{solution.error()};
  return LeastWatts{solution.value().cost, solution.value().x};
}

}  // namespace roomlight::optimise
