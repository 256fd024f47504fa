#include "gather/noise_map.h"

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr int kReach = 2;           // pixels to each side that a filter shares noise with, at least
constexpr float kFacing = 0.9f;     // cosine between normals, and
constexpr float kPlane = 0.1f;      // slope off the tangent plane, of neighbours that are alike
constexpr float kEdge = 0.1f;       // variance of coverage where one camera ray meets an edge, of contrast squared
constexpr float kDark = 0.02f;      // of the picture's mean: where noise is hardly seen

struct Look {
  Vec3 normal, position;
  float luminance = 0, variance = 0;  // of the pixel's mean; the variance without that of shadows' edges,
  float sharpVariance = 0;            // which no filter shares out
  float surface = 0;
  bool edge = false;
};

Look lookOf(const FilterPixel& sum, const PixelCount& count) {
  const FilterPixel p = meanOf(sum, count);
  Look l;
  l.normal = p.normal, l.position = p.position, l.surface = p.surface;
  l.luminance = luminance(p.diffuse + p.sharp + p.specular + p.rest);
  const float albedo = std::max(luminance(p.albedo), 1e-3f);
  l.variance = p.diffuseVariance * albedo * albedo + p.specularVariance;
  l.sharpVariance = p.sharpVariance * albedo * albedo;
  l.edge = count.edge;
  return l;
}

bool alike(const Look& a, const Look& b) {
  if (b.surface <= 0 || dot(a.normal, b.normal) < kFacing) return false;
  const Vec3 between = b.position - a.position;
  return std::abs(dot(a.normal, between)) <= kPlane * length(between) + 1e-3f;
}

}  // namespace

std::vector<uint8_t> noisyPixels(const FilterInput& sums, const std::vector<PixelCount>& counts, float tolerance) {
  const int width = sums.width, height = sums.height;
  std::vector<Look> looks(counts.size());
  std::vector<double> rows(static_cast<size_t>(height));
  parallelFor(static_cast<size_t>(height), 8, [&](size_t y) {
    for (size_t x = 0; x < static_cast<size_t>(width); ++x) {
      const size_t i = y * static_cast<size_t>(width) + x;
      looks[i] = lookOf(sums.pixels[i], counts[i]);
      rows[y] += static_cast<double>(looks[i].luminance);
    }
  });
  double mean = 0;
  for (const double r : rows) mean += r / static_cast<double>(counts.size());
  const float dark = kDark * static_cast<float>(mean);
  std::vector<uint8_t> out(counts.size());
  parallelFor(static_cast<size_t>(height), 4, [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      const size_t i = row * static_cast<size_t>(width) + static_cast<size_t>(x);
      const Look& own = looks[i];
      // Nothing here may follow the pixel's own luminance: refining those that came out dark would make pictures too bright.
      float variance = 0, like = 0, around = 0, all = 0, level = 0, sharp = 0, beside = 0, low = kInfinity, high = 0;
      for (int dy = -kReach; dy <= kReach; ++dy) {
        for (int dx = -kReach; dx <= kReach; ++dx) {
          const int qx = x + dx, qy = y + dy;
          if (qx < 0 || qy < 0 || qx >= width || qy >= height) continue;
          const Look& o = looks[static_cast<size_t>(qy) * static_cast<size_t>(width) + static_cast<size_t>(qx)];
          if (std::max(std::abs(dx), std::abs(dy)) <= 1) low = std::min(low, o.luminance), high = std::max(high, o.luminance), sharp += o.sharpVariance, beside += 1;
          all += 1, around += o.variance, level += o.luminance;
          if ((dx == 0 && dy == 0) || (own.surface > 0 && alike(own, o))) variance += o.variance, like += 1;
        }
      }
      level = level / all + dark;
      // The variance of a few pixels, each of few samples, may be too small by chance.
      variance = std::max(variance / (like * like), around / (all * like)) + sharp / beside;
      if (own.edge) variance += kEdge * (high - low) * (high - low) / static_cast<float>(std::max(1u, counts[i].rays));
      out[i] = variance > tolerance * tolerance * level * level;
    }
  });
  return out;
}

}  // namespace roomlight
