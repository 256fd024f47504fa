#include "gather/pixel_shader.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight {

bool onOneSheet(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition) {
  constexpr float kFacing = 0.6f, kToleranceM = 0.02f, kSlope = 0.5f;
  if (!(length(normal) > 0) || !(length(otherNormal) > 0)) return false;
  const Vec3 n = normalize(normal), m = normalize(otherNormal), between = otherPosition - position;
  const float off = std::max(std::abs(dot(n, between)), std::abs(dot(m, between))),
              along = std::sqrt(std::max(0.0f, lengthSquared(between) - off * off));
  return dot(n, m) > kFacing && off < kToleranceM + kSlope * along;
}

void addFragments(Fragments& fragments, int layer, const FilterInput& means, const std::vector<PixelCount>& counts,
                  std::span<const Vec3> irradiance, Image& image) {
  constexpr int kReach = 2;
  for (size_t k = 0; k < fragments.all.size(); ++k) {
    Fragment& f = fragments.all[k];
    const int x = static_cast<int>(f.pixel) % means.width, y = static_cast<int>(f.pixel) / means.width;
    const Vec3 place = f.position / f.surface;
    Vec3 sum;
    float count = 0, brightest = 0;
    for (int j = std::max(0, y - kReach); j <= std::min(means.height - 1, y + kReach); ++j) {
      for (int i = std::max(0, x - kReach); i <= std::min(means.width - 1, x + kReach); ++i) {
        const size_t other = static_cast<size_t>(j) * static_cast<size_t>(means.width) + static_cast<size_t>(i);
        const FilterPixel& o = means.pixels[other];
        if (o.surface > 0) brightest = std::max(brightest, luminance(irradiance[other]));
        if (other == f.pixel || o.surface <= 0 || !onOneSheet(f.normal, place, o.normal, o.position)) continue;
        const float weight = o.surface / static_cast<float>((i - x) * (i - x) + (j - y) * (j - y));
        sum += irradiance[other] * weight, count += weight;
      }
    }
    // What is seen in one pixel alone is known by a few rays: no brighter than what is around it.
    const Vec3 found = fragments.diffuse(k, layer) / max(f.albedo, Vec3(1e-3f));
    if (layer < 0) f.kept = std::min(1.0f, brightest / std::max(luminance(found), 1e-20f));
    const Vec3 own = found * f.kept;
    const float inverse = 1 / static_cast<float>(std::max(1u, counts[f.pixel].rays));
    image.pixels[f.pixel] += (count > 0 ? sum / count : own) * max(f.albedo, Vec3(0)) * inverse;
  }
}

namespace {

// Whether a pixel beside the fragment's shows the same sheet as its own surface.
bool isShownBeside(const Fragment& f, const FilterInput& sums, const std::vector<PixelCount>& counts) {
  const int x = static_cast<int>(f.pixel) % sums.width, y = static_cast<int>(f.pixel) / sums.width;
  const Vec3 place = f.position / f.surface;
  for (int j = std::max(0, y - 1); j <= std::min(sums.height - 1, y + 1); ++j) {
    for (int k = x - 1; k <= x + 1; ++k) {
      const int i = sums.wraps ? (k + sums.width) % sums.width : k;
      if (i < 0 || i >= sums.width || (i == x && j == y)) continue;
      const size_t other = static_cast<size_t>(j) * static_cast<size_t>(sums.width) + static_cast<size_t>(i);
      const FilterPixel o = meanOf(sums.pixels[other], counts[other]);
      if (o.surface > 0 && onOneSheet(f.normal, place, o.normal, o.position)) return true;
    }
  }
  return false;
}

}  // namespace

Plane thinThings(const std::vector<Fragments>& fragments, const FilterInput& sums,
                 const std::vector<PixelCount>& counts) {
  Plane light(sums.width, sums.height), rays(sums.width, sums.height);
  parallelFor(fragments.size(), 4, [&](size_t tile) {  // a pixel belongs to one of them
    for (const Fragment& f : fragments[tile].all) {
      if (!isShownBeside(f, sums, counts)) light.values[f.pixel] += f.luminance, rays.values[f.pixel] += f.surface;
    }
  });
  for (size_t i = 0; i < light.values.size(); ++i)
    light.values[i] = rays.values[i] > 0 ? light.values[i] / rays.values[i] : -1;
  return light;
}

}  // namespace roomlight
