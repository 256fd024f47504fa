#include "gather/pixel_shader.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr int kReach = 2;           // pixels to each side that a filter shares noise with, at least
constexpr float kFacing = 0.9f;     // cosine between normals, and
constexpr float kPlane = 0.1f;      // slope off the tangent plane, of neighbours that are alike
constexpr float kEdge = 0.1f;       // variance of coverage where one camera ray meets an edge, of contrast squared
constexpr float kMostNeeded = 65535;  // rays
constexpr float kDark = 0.02f;      // of the picture's mean: where noise is hardly seen

struct Look {
  Vec3 normal, position;
  float luminance = 0, variance = 0;  // of the pixel's mean; the variance without that of shadows' edges,
  float sharpVariance = 0;            // which no filter shares out
  float surface = 0;
  bool edge = false;
  bool known = true;  // whether all of its light was sampled
};

Look lookOf(const FilterPixel& sum, const PixelCount& count) {
  const FilterPixel p = meanOf(sum, count);
  Look l;
  l.normal = p.normal, l.position = p.position, l.surface = p.surface;
  l.luminance = luminance(p.diffuse + p.rare + p.sharp + p.specular + p.rest);
  const float albedo = std::max(luminance(p.albedo), 1e-3f);
  l.variance = p.diffuseVariance * albedo * albedo + p.specularVariance;
  l.sharpVariance = p.sharpVariance * albedo * albedo;
  l.edge = count.edge;
  l.known = p.diffuseShare > 0 && p.specularShare > 0;
  return l;
}

struct Looks {
  std::vector<Look> pixels;
  float dark;  // luminance where noise is hardly seen
};

Looks looksOf(const FilterInput& sums, const std::vector<PixelCount>& counts) {
  std::vector<Look> looks(counts.size());
  std::vector<double> rows(static_cast<size_t>(sums.height)), known(rows.size());
  parallelFor(rows.size(), 8, [&](size_t y) {
    for (size_t x = 0; x < static_cast<size_t>(sums.width); ++x) {
      const size_t i = y * static_cast<size_t>(sums.width) + x;
      looks[i] = lookOf(sums.pixels[i], counts[i]);
      if (looks[i].known) rows[y] += static_cast<double>(looks[i].luminance), known[y] += 1;
    }
  });
  double mean = 0, allKnown = 0;
  for (const double k : known) allKnown += k;
  for (const double r : rows) mean += r / std::max(1.0, allKnown);
  return {std::move(looks), kDark * static_cast<float>(mean)};
}

bool alike(const Look& a, const Look& b) {
  return b.surface > 0 && onOneSurface(a.normal, a.position, b.normal, b.position);
}

}  // namespace

bool onOneSurface(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition) {
  const Vec3 between = otherPosition - position;
  return dot(normal, otherNormal) >= kFacing && std::abs(dot(normal, between)) <= kPlane * length(between) + 1e-3f;
}

FilterPixel meanBeside(const FilterInput& sums, const std::vector<PixelCount>& counts, size_t i) {
  constexpr float kLeastAlbedo = 1e-3f;
  const int w = sums.width, x = static_cast<int>(i) % w, y = static_cast<int>(i) / w;
  FilterPixel own = meanOf(sums.pixels[i], counts[i]);
  if (!(own.surface > 0)) return own;
  FilterPixel sum;
  sum.weight = 0;
  float count = 0;
  for (const auto& [dx, dy] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
    const int qx = sums.wraps ? (x + dx + w) % w : x + dx, qy = y + dy;
    if (qx < 0 || qy < 0 || qx >= w || qy >= sums.height) continue;
    const size_t q = static_cast<size_t>(qy) * static_cast<size_t>(w) + static_cast<size_t>(qx);
    const FilterPixel o = meanOf(sums.pixels[q], counts[q]);
    if (!(o.surface > 0) || !onOneSurface(own.normal, own.position, o.normal, o.position)) continue;
    const Vec3 albedo = max(o.albedo, Vec3(kLeastAlbedo));
    sum.diffuse += o.diffuse / albedo, sum.rare += o.rare / albedo, sum.sharp += o.sharp / albedo,
        sum.specular += o.specular, sum.rest += o.rest;
    sum.diffuseVariance += o.diffuseVariance, sum.sharpVariance += o.sharpVariance,
        sum.specularVariance += o.specularVariance, sum.weight += o.weight;
    count += 1;
  }
  if (count == 0) return own;
  const Vec3 albedo = max(own.albedo, Vec3(kLeastAlbedo)) / count;
  own.diffuse = sum.diffuse * albedo, own.rare = sum.rare * albedo, own.sharp = sum.sharp * albedo,
  own.specular = sum.specular / count, own.rest = sum.rest / count;
  own.diffuseVariance = sum.diffuseVariance / count, own.sharpVariance = sum.sharpVariance / count,
  own.specularVariance = sum.specularVariance / count, own.weight = sum.weight / count;
  return own;
}

std::vector<uint16_t> raysNeeded(const FilterInput& sums, const std::vector<PixelCount>& counts,
                                 const FilteredLuminance& left, float tolerance) {
  const bool isFiltered = !left.variance.empty();
  const int width = sums.width, height = sums.height;
  const Looks looks = looksOf(sums, counts);
  std::vector<uint16_t> out(counts.size());
  parallelFor(static_cast<size_t>(height), 4, [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      const size_t i = row * static_cast<size_t>(width) + static_cast<size_t>(x);
      const Look& own = looks.pixels[i];
      // Nothing here may follow the pixel's own luminance: refining those that came out dark would make pictures too
      // bright.
      float variance = 0, like = 0, around = 0, all = 0, level = 0, sharp = 0, beside = 0, low = kInfinity, high = 0;
      for (int dy = -kReach; dy <= kReach; ++dy) {
        for (int dx = -kReach; dx <= kReach; ++dx) {
          const int qx = sums.wraps ? (x + dx + width) % width : x + dx, qy = y + dy;
          if (qx < 0 || qy < 0 || qx >= width || qy >= height) continue;
          const size_t q = static_cast<size_t>(qy) * static_cast<size_t>(width) + static_cast<size_t>(qx);
          const Look& o = looks.pixels[q];
          if (std::max(std::abs(dx), std::abs(dy)) <= 1) sharp += o.sharpVariance, beside += 1;
          if (!o.known) continue;
          if (std::max(std::abs(dx), std::abs(dy)) <= 1) {
            const float l = isFiltered ? left.luminance[q] : o.luminance;  // noise is no contrast
            low = std::min(low, l), high = std::max(high, l);
          }
          if (isFiltered) {
            if (q != i) all += 1, level += o.luminance;
            continue;
          }
          all += 1, around += o.variance, level += o.luminance;
          if ((dx == 0 && dy == 0) || (own.surface > 0 && alike(own, o))) variance += o.variance, like += 1;
        }
      }
      all = std::max(all, 1.0f), like = std::max(like, 1.0f);  // what is known of none is believed to be as it should
      level = level / all + looks.dark;
      // The variance of a few pixels, each of few samples, may be too small by chance.
      variance =
          isFiltered ? left.variance[i] : std::max(variance / (like * like), around / (all * like)) + sharp / beside;
      if (own.edge && high >= low)
        variance += kEdge * (high - low) * (high - low) / static_cast<float>(std::max(1u, counts[i].rays));
      const float allowed = tolerance * tolerance * level * level,
                  rays = static_cast<float>(std::max(1u, counts[i].rays));
      if (variance > allowed)
        out[i] =
            static_cast<uint16_t>(std::ceil(std::min(kMostNeeded, rays * (variance / std::max(allowed, 1e-30f) - 1))));
    }
  });
  return out;
}

}  // namespace roomlight
