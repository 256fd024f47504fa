#include "look/display.h"

#include "base/parallel.h"
#include "look/pyramid.h"

namespace roomlight {
namespace {

constexpr int kSmallest = 8;
constexpr size_t kFirstLevel = 2;  // nearer than four pixels is the thing itself

Plane scattered(Plane plane) {
  const std::vector<Plane> levels = gaussianPyramid(std::move(plane), kSmallest);
  const size_t first = std::min(kFirstLevel, levels.size() - 1), count = levels.size() - first;
  Plane sum;
  for (size_t k = levels.size(); k-- > 0;) {
    Plane level =
        sum.width > 0 ? doubled(sum, levels[k].width, levels[k].height) : Plane(levels[k].width, levels[k].height);
    if (k >= first) {
      for (size_t i = 0; i < level.values.size(); ++i)
        level.values[i] += levels[k].values[i] / static_cast<float>(count);
    }
    sum = std::move(level);
  }
  return sum;
}

}  // namespace

void addGlare(Image& image, float share) {
  parallelFor(3, 1, [&](size_t channel) {
    const int c = static_cast<int>(channel);
    Plane plane(image.width, image.height);
    for (size_t i = 0; i < image.pixels.size(); ++i) plane.values[i] = image.pixels[i][c];
    const Plane around = scattered(std::move(plane));
    for (size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i][c] = (1 - share) * image.pixels[i][c] + share * around.values[i];
  });
}

}  // namespace roomlight
