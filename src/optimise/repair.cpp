#include "optimise/improve.h"

#include <algorithm>

namespace roomlight::optimise {
namespace {

constexpr double kRounding = 1e-9;

// Lamps that are kept so far, and whether one more fits.
class Kept {
 public:
  explicit Kept(const Model& m) : m_(m), taken_(m.places(), 0), ofRule_(m.mostOfRule.size(), 0) {}

  // Null: nothing.
  const char* whyNot(ChosenLamp lamp) const {
    const ModelOption& o = m_.options[lamp.option];
    const uint32_t rule = m_.ruleOfPlace[lamp.place];
    for (const uint32_t other : m_.conflicts[lamp.place]) {
      if (taken_[other]) return "two lamps are too near to each other";
    }
    if (ofRule_[rule] + 1 > m_.mostOfRule[rule]) return "a place has more lamps than its 'most'";
    if (m_.mostFittings > 0 && fittings_ + 1 > m_.mostFittings) return "there are more fittings than the limit";
    if (m_.mostWatts > 0 && watts_ + o.wattsW > m_.mostWatts + kRounding)
      return "more watts are installed than the limit";
    if (m_.mostCost > 0 && cost_ + o.price > m_.mostCost + kRounding) return "it costs more than the limit";
    return nullptr;
  }
  void add(ChosenLamp lamp) {
    taken_[lamp.place] = 1, ++ofRule_[m_.ruleOfPlace[lamp.place]], ++fittings_;
    watts_ += m_.options[lamp.option].wattsW, cost_ += m_.options[lamp.option].price;
  }

 private:
  const Model& m_;
  std::vector<uint8_t> taken_;
  std::vector<int> ofRule_;
  int fittings_ = 0;
  double watts_ = 0, cost_ = 0;
};

}  // namespace

void repair(const Model& m, search::Genome design) {
  std::vector<ChosenLamp> lamps = chosenLamps(m, design);
  const size_t levels = m.levels();
  const auto most = [&](ChosenLamp l) {
    return levels == 0 ? 0.0
                       : *std::max_element(design.reals.begin() + static_cast<std::ptrdiff_t>(l.place * levels),
                                           design.reals.begin() + static_cast<std::ptrdiff_t>((l.place + 1) * levels));
  };
  std::stable_sort(lamps.begin(), lamps.end(), [&](ChosenLamp a, ChosenLamp b) { return most(a) > most(b); });
  Kept kept(m);
  for (const ChosenLamp& lamp : lamps) {
    if (!kept.whyNot(lamp)) {
      kept.add(lamp);
    } else {
      design.integers[lamp.place] = 0;
    }
  }
}

std::string brokenBy(const Model& m, search::ConstGenome design) {
  Kept kept(m);
  for (const ChosenLamp& lamp : chosenLamps(m, design)) {
    if (const char* why = kept.whyNot(lamp)) return why;
    kept.add(lamp);
  }
  return {};
}

}  // namespace roomlight::optimise
