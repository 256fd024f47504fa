#include "bake/budget.h"

#include <algorithm>
#include <cmath>

namespace roomlight::bake {
namespace {

constexpr float kCoarsestM = 0.016f, kLongestTexel = 4;
constexpr float kStep = 1.4142135f;  // of the length of a texel
// What is reckoned to be left of each part after a step; where that is wrong textures make up for it.
constexpr double kGeometryLeft = 0.75, kTexturesLeft = 0.35, kLightLeft = 0.55;

struct Step {
  double* part;
  double left;
  bool possible;
};

}  // namespace

BakeSettings withinBudget(BakeSettings s, FileParts parts, size_t bytes) {
  const float longest = kLongestTexel * s.charts.texelM;
  while (parts.sum() > static_cast<double>(bytes)) {
    Step steps[] = {{&parts.geometry, kGeometryLeft, s.simplifyM * 2 <= kCoarsestM},
                    {&parts.textures, kTexturesLeft, s.glb.mostTexturePixels / 2 >= kSmallestTexture},
                    {&parts.light, kLightLeft, s.charts.texelM * kStep <= longest * 1.001f}};
    // What is taken away, not what is there: geometry gives little.
    const auto gain = [](const Step& step) { return step.possible ? *step.part * (1 - step.left) : 0; };
    Step* best = std::max_element(std::begin(steps), std::end(steps),
                                  [&](const Step& a, const Step& b) { return gain(a) < gain(b); });
    if (!(gain(*best) > 0)) break;
    *best->part *= best->left;
    if (best->part == &parts.geometry) s.simplifyM *= 2;
    if (best->part == &parts.textures) s.glb.mostTexturePixels /= 2;
    if (best->part == &parts.light) s.charts.texelM *= kStep, s.atlas.texelM *= kStep, s.placesApartM *= kStep;
  }
  return s;
}

}  // namespace roomlight::bake
