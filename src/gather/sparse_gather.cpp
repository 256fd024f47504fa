#include "gather/pixel_shader.h"

namespace roomlight {
namespace {

// Whether a neighbour in the tile sees another surface, or the pixel none or several.
bool isLone(const FilterInput& sums, const PixelCount& count, const Rectangle& tile, int x, int y) {
  const auto at = [&](int i, int j) -> const FilterPixel& {
    return sums.pixels[static_cast<size_t>(j) * static_cast<size_t>(sums.width) + static_cast<size_t>(i)];
  };
  const FilterPixel& own = at(x, y);
  if (count.edge || own.surface <= 0) return true;
  const Vec3 normal = normalize(own.normal), position = own.position / own.surface;
  for (int j = std::max(tile.y0, y - 1); j < std::min(tile.y1, y + 2); ++j) {
    for (int i = std::max(tile.x0, x - 1); i < std::min(tile.x1, x + 2); ++i) {
      const FilterPixel& o = at(i, j);
      if (o.surface <= 0 || !onOneSurface(normal, position, normalize(o.normal), o.position / o.surface)) return true;
    }
  }
  return false;
}

}  // namespace

void gatherSparsely(TileWork& work, const Rectangle& tile, uint32_t every, float rayRoughness, uint32_t rays,
                    const FilterInput& sums) {
  for (size_t begin = 0, end; begin < work.parts.size(); begin = end) {
    // The parts of a pixel follow one another. The light of several surfaces is not kept apart: all of them gather.
    for (end = begin + 1; end < work.parts.size() && work.parts[end].pixel.sum == work.parts[begin].pixel.sum;) ++end;
    const TileWork::Part& first = work.parts[begin];
    const auto pixel = static_cast<int>(first.pixel.sum - sums.pixels.data());
    PixelCount& count = *first.pixel.count;
    const bool alone = end - begin > 1 || isLone(sums, count, tile, pixel % sums.width, pixel / sums.width);
    const uint32_t gathers = first.turn ? every : alone ? 1 : 0;
    const bool smooth = work.shadings[first.first].s.m.roughness < rayRoughness;
    const uint32_t glossy = gathers == 0 && smooth ? 1 : gathers;
    for (size_t p = begin; p < end; ++p) {
      TileWork::Part& part = work.parts[p];
      part.gathers = gathers, part.glossy = glossy;
      for (uint32_t s = 0; s < part.count; ++s) work.shadings[part.first + s].gathers = static_cast<int>(gathers);
    }
    count.gathered += rays * gathers - rays, count.glossy += rays * glossy - rays;
  }
}

}  // namespace roomlight
