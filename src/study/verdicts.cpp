#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/settings.h"
#include "study/published.h"
#include "study/report.h"

namespace roomlight {
namespace {

const StudyCurve* curveOf(const StudyCase& c, const std::string& technique) {
  const auto found = std::find_if(c.curves.begin(), c.curves.end(), [&](const StudyCurve& curve) {
    return curve.technique == technique && !curve.points.empty();
  });
  return found == c.curves.end() ? nullptr : &*found;
}

std::string place(const StudyCase& c) { return c.scene + ", " + c.light; }

std::string listOf(const std::vector<std::string>& names) {
  std::string s;
  for (const std::string& n : names) s += (s.empty() ? "" : "; ") + n;
  return s;
}

StudyVerdict settles(const StudyResults& r) {
  const double wanted = published::kTechniques[0].settledMse;
  int met = 0, cases = 0;
  double worst = 0;
  std::string where;
  for (const StudyCase& c : r.cases) {
    const StudyCurve* cone = curveOf(c, technique::kCone);
    if (!cone) continue;
    const double e = errorOf(settledPoint(*cone));
    ++cases, met += e <= wanted;
    if (e >= worst) worst = e, where = place(c);
  }
  return {fmt::format("cone settles at an mse of at most {} everywhere", wanted),
          fmt::format("{} of {}; largest {:.4f}, {}", met, cases, worst, where), met == cases && cases > 0};
}

StudyVerdict below(const StudyResults& r) {
  std::vector<std::string> lost;
  int pairs = 0, open = 0;
  for (const StudyCase& c : r.cases) {
    const StudyCurve* cone = curveOf(c, technique::kCone);
    if (!cone) continue;
    for (const StudyCurve& rival : c.curves) {
      if (rival.kind != "rival" || rival.points.empty()) continue;
      ++pairs;
      const double e = errorOf(settledPoint(rival)), own = errorOf(settledPoint(*cone));
      if (e < own) lost.push_back(fmt::format("{} ({:.4f}, cone {:.4f}): {}", rival.technique, e, own, place(c)));
      if (e >= own && !hasSettled(rival)) ++open;
    }
  }
  std::string text =
      lost.empty() ? fmt::format("below in all {} pairs", pairs)
                   : fmt::format("below in {} of {} pairs; not below ", pairs - static_cast<int>(lost.size()), pairs) +
                         listOf(lost);
  if (open > 0) text += fmt::format("; in {} of them the rival was stopped while its error still fell", open);
  return {"cone settles below each rival everywhere", text, lost.empty() && pairs > 0};
}

// Of the scene that is named last: scenes grow.
std::vector<StudyVerdict> ratios(const StudyResults& r) {
  std::vector<StudyVerdict> out;
  if (r.cases.empty()) return out;
  for (size_t i = 1; i < published::kTechniques.size(); ++i) {
    const auto& rival = published::kTechniques[i];
    const double wanted = published::kTechniques[0].drawingS[5] / rival.drawingS[5];
    std::string measured;
    bool met = true, any = false;
    for (const StudyCase& c : r.cases) {
      const StudyCurve *cone = curveOf(c, technique::kCone), *other = curveOf(c, rival.name);
      if (c.scene != r.cases.back().scene || !cone || !other) continue;
      const double ratio = *timeRatioAtEqualError(*cone, *other);
      measured += fmt::format("{}{} {:.2f}", measured.empty() ? "" : "; ", c.light, ratio);
      met = met && ratio <= wanted, any = true;
    }
    if (any)
      out.push_back({fmt::format("time at equal error, {}: cone over {} at most {:.2f}", r.cases.back().scene,
                                 rival.name, wanted),
                     measured, met});
  }
  return out;
}

// The quickest of hybrid's ways over the quickest of all others that are not the judge, each pair at the least error
// that both reach.
StudyVerdict hybridFirst(const StudyResults& r) {
  int met = 0, cases = 0;
  double worst = 0;
  std::string where;
  for (const StudyCase& c : r.cases) {
    double ratio = 0;
    bool any = false;
    for (const StudyCurve& other : c.curves) {
      if (other.kind == "judge" || other.technique.starts_with(technique::kHybrid) || other.points.empty()) continue;
      double best = std::numeric_limits<double>::infinity();
      for (const StudyCurve& own : c.curves) {
        if (own.technique.starts_with(technique::kHybrid) && !own.points.empty())
          best = std::min(best, *timeRatioAtEqualError(own, other));
      }
      if (std::isfinite(best)) ratio = std::max(ratio, best), any = true;
    }
    if (!any) continue;
    ++cases, met += ratio <= 0.5;
    if (ratio >= worst) worst = ratio, where = place(c);
  }
  return {"time at equal error: hybrid at most half of the best of the others everywhere",
          fmt::format("{} of {}; largest {:.2f}, {}", met, cases, worst, where), met == cases && cases > 0};
}

// The one of ours with the most frames a second along the walk of a scene.
const StudyFrames* quickestOfOurs(const StudyResults& r, const std::string& scene) {
  const StudyFrames* quickest = nullptr;
  for (const StudyFrames& f : r.frames) {
    if (f.scene != scene || f.kind != "ours" || f.runs.empty()) continue;
    if (!quickest || f.cost.framesPerSecond > quickest->cost.framesPerSecond) quickest = &f;
  }
  return quickest;
}

std::vector<StudyVerdict> frames(const StudyResults& r) {
  std::vector<StudyVerdict> out;
  std::set<std::string> scenes;
  for (const StudyFrames& f : r.frames) scenes.insert(f.scene);
  for (size_t i = 1; i < published::kTechniques.size() && !scenes.empty(); ++i) {
    const auto& rival = published::kTechniques[i];
    const double wanted = published::kTechniques[0].framesPerSecond / rival.framesPerSecond;
    double worst = std::numeric_limits<double>::infinity();
    std::string where;
    std::set<std::string> quickest;  // of ours in any of them
    for (const std::string& scene : scenes) {
      double other = 0;
      for (const StudyFrames& f : r.frames) {
        if (f.scene == scene && f.technique == rival.name) other = f.cost.framesPerSecond;
      }
      if (!(other > 0)) continue;
      const StudyFrames* own = quickestOfOurs(r, scene);
      if (own) quickest.insert("'" + own->technique + "'");
      const double ratio = own ? own->cost.framesPerSecond / other : 0;
      if (ratio < worst) worst = ratio, where = scene;
    }
    if (!std::isfinite(worst)) continue;
    std::string text = fmt::format("least {:.2f} times, {}", worst, where);
    if (!quickest.empty()) text += "; quickest of ours: " + listOf({quickest.begin(), quickest.end()});
    out.push_back({fmt::format("frames a second: cone or hybrid at least {:.2f} times those of {}", wanted, rival.name),
                   text, worst >= wanted});
  }
  return out;
}

}  // namespace

std::vector<StudyVerdict> studyVerdicts(const StudyResults& r) {
  if (!r.againstPublished) return {};
  const auto has = [&](const std::string& start, const std::string& kind) {
    return std::any_of(r.cases.begin(), r.cases.end(), [&](const StudyCase& c) {
      return std::any_of(c.curves.begin(), c.curves.end(), [&](const StudyCurve& curve) {
        return !curve.points.empty() && curve.technique.starts_with(start) && (kind.empty() || curve.kind == kind);
      });
    });
  };
  std::vector<StudyVerdict> out;
  if (has(technique::kCone, "")) out.push_back(settles(r));
  if (has(technique::kCone, "") && has("", "rival")) out.push_back(below(r));
  for (const StudyVerdict& v : ratios(r)) out.push_back(v);
  if (has(technique::kHybrid, "") && has("", "rival")) out.push_back(hybridFirst(r));
  for (const StudyVerdict& v : frames(r)) out.push_back(v);
  return out;
}

}  // namespace roomlight
