// What every candidate lamp gives every meter, found once: light is linear, so any design is a sum of these
// (docs/methods/optimise.md).
#pragma once

#include "engine/settings.h"
#include "engine/stages.h"
#include "measure/glare.h"
#include "optimise/candidates.h"
#include "optimise/meters.h"

namespace roomlight::optimise {

// Of all sources of one kind that an eye sees: Σ L² ω / p².
struct EyeGlare {
  double directLux = 0;  // straight from them, on the plane that faces the view
  double term = 0;
  bool operator==(const EyeGlare&) const = default;
};

struct Base {                   // of one condition: daylight and lamps that stay
  std::vector<Vec3> lux;        // per element
  std::vector<EyeGlare> glare;  // per eye
};

struct Response {
  size_t elements = 0, eyes = 0;
  std::vector<Vec3> lux;  // of candidate c, white and undimmed, on element i: lux[c * elements + i], per channel
  std::vector<EyeGlare> glare;  // of candidate c at eye e: glare[c * eyes + e]
  std::vector<Base> base;  // per condition
  float worstErrorPercent =
      0;  // the largest standard error of candidates that give a point at least a tenth of what the strongest gives it
  const Vec3* of(size_t candidate) const { return lux.data() + candidate * elements; }
  const EyeGlare* glareOf(size_t candidate) const { return glare.data() + candidate * eyes; }
};

struct ResponseSettings {
  RenderSettings render;
  double tolerance = 0.005;  // of candidates at points; light that comes straight from lamps is exact
  int fewestSamples = 256;  // a point; a power of two
  int mostSamples = 8192;
  size_t atOnce = 48;  // candidates that are told apart in one solution; at most kMostLayers
};

// All that a response is found from; `home` as imported.
struct ResponseProblem {
  const Scene& home;
  const StudyFile& study;
  const Candidates& candidates;
  const Meters& meters;
  ResponseSettings settings;
};

// How many of each there are. `points` are the first of the elements.
struct ResponseSizes {
  size_t candidates = 0, elements = 0, eyes = 0, conditions = 0, points = 0;
  bool operator==(const ResponseSizes&) const = default;
};
ResponseSizes sizesOf(const ResponseProblem& problem);

// What one solution of the light gives: that of some candidates, or of a condition without any. A response is made of
// these, whoever found each.
struct ResponseItem {
  size_t first = 0, count = 0;  // candidates; none: a condition
  std::vector<Vec3> lux;  // of candidate first + c, on element i: lux[c * elements + i]; of a condition lux[i]
  std::vector<float> errorsLux;  // standard error of candidate first + c at point i: errorsLux[c * points + i]
  std::vector<EyeGlare> glare;  // as lux, by eyes
  bool operator==(const ResponseItem&) const = default;
};
// Groups of candidates, then conditions.
size_t itemCount(const ResponseProblem& problem);
// Errors: of daylight and lighting files. Empty where cancelled.
Result<std::optional<ResponseItem>> findItem(const ResponseProblem& problem, size_t item, Stages& stages);
// `items`: all of them, in order.
Response responseOf(const ResponseSizes& sizes, const std::vector<ResponseItem>& items);

// Meters of whole solutions: of conditions without candidates, and of the certificates that judge predictions by the
// same measure.
inline MeterSettings fullMeters(uint64_t seed) { return {0.003, 512, 1 << 13, seed}; }

// A lighting file: with `fixedToo` the study's own and the home's lamps where they stay; `lamps`, and the daylight of a
// condition, if not null. The home's own suns and sky are off.
Result<nlohmann::json> lightingDocument(const StudyFile& study, const nlohmann::json& daylight,
                                        const nlohmann::json& lamps, bool fixedToo);
// The home in that light.
Result<Scene> litBy(const Scene& home, const StudyFile& study, const nlohmann::json& daylight,
                    const nlohmann::json& lamps, bool fixedToo);

// What is wrong with the lighting file or with a condition's daylight, before long work: they are applied to the home.
// The error names the file, of a condition its line.
Status checkConditions(const Scene& home, const StudyFile& study);

// Σ L² ω / p² of what an eye sees.
double glareTerm(std::span<const GlareSource> sources, Vec3 view);

}  // namespace roomlight::optimise
