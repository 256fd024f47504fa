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
constexpr float kMissed = 0.4f;     // chance that a pixel beside an edge has a part of it that its rays have missed
constexpr float kThinPixels = 2;    // around, whose light tells of things thinner than pixels
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

// Beside an edge: of `rays` none has met what is beyond, which may cover a little of the pixel all the same. By the
// posterior of that coverage after n such rays, the mean square is 2 / ((n + 2) (n + 3)). `contrast2`: squared, in
// units of the variance allowed.
float raysForMissed(float contrast2, float rays) { return std::sqrt(2 * kMissed * contrast2) - 2 - rays; }

// What lies around a pixel. Nothing here may follow the pixel's own luminance: refining those that came out dark would
// make pictures too bright.
struct Around {
  float variance = 0, like = 0;             // of like neighbours
  float around = 0, all = 0, level = 0;     // of all whose light is known
  float sharp = 0, beside = 0;              // of the nearest nine
  float low = kInfinity, high = 0;          // luminance of the nearest
  float thinLight = 0, thinPixels = 0;
  bool edge = false;  // in one of the nearest
};

class NoisePlan {
 public:
  NoisePlan(const FilterInput& sums, const std::vector<PixelCount>& counts, const FilteredLuminance& left,
            const Plane& thin, float tolerance)
      : sums_(sums),
        counts_(counts),
        left_(left),
        thin_(thin),
        tolerance_(tolerance),
        isFiltered_(!left.variance.empty()),
        looks_(looksOf(sums, counts)) {}

  uint16_t raysFor(int x, int y) const {
    const size_t i = indexOf(x, y);
    const Look& own = looks_.pixels[i];
    const Around a = aroundOf(x, y);
    // What is known of none is believed to be as it should.
    const float all = std::max(a.all, 1.0f), like = std::max(a.like, 1.0f), level = a.level / all + looks_.dark,
                allowed = std::max(tolerance_ * tolerance_ * level * level, 1e-30f),
                rays = static_cast<float>(std::max(1u, counts_[i].rays)), contrast = contrastOf(a);
    // The variance of a few pixels, each of few samples, may be too small by chance.
    float variance = isFiltered_ ? left_.variance[i]
                                 : std::max(a.variance / (like * like), a.around / (all * like)) + a.sharp / a.beside;
    if (own.edge) variance += kEdge * contrast * contrast / rays;
    float more = variance > allowed ? rays * (variance / allowed - 1) : 0;
    if (a.edge && !own.edge) more = std::max(more, raysForMissed(contrast * contrast / allowed, rays));
    return static_cast<uint16_t>(std::ceil(std::min(kMostNeeded, more)));
  }

 private:
  size_t indexOf(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(sums_.width) + static_cast<size_t>(x);
  }

  Around aroundOf(int x, int y) const {
    Around a;
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const int qx = sums_.wraps ? (x + dx + sums_.width) % sums_.width : x + dx, qy = y + dy;
        if (qx >= 0 && qy >= 0 && qx < sums_.width && qy < sums_.height)
          add(indexOf(x, y), indexOf(qx, qy), std::max(std::abs(dx), std::abs(dy)) <= 1, a);
      }
    }
    return a;
  }

  void add(size_t i, size_t q, bool isNear, Around& a) const {
    const Look& own = looks_.pixels[i];
    const Look& o = looks_.pixels[q];
    if (isNear) a.sharp += o.sharpVariance, a.beside += 1, a.edge |= o.edge;
    if (!thin_.values.empty() && q != i && thin_.values[q] >= 0) a.thinLight += thin_.values[q], a.thinPixels += 1;
    if (!o.known) return;
    if (isNear) {
      const float l = isFiltered_ ? left_.luminance[q] : o.luminance;  // noise is no contrast
      a.low = std::min(a.low, l), a.high = std::max(a.high, l);
    }
    if (isFiltered_) {
      if (q != i) a.all += 1, a.level += o.luminance;
      return;
    }
    a.all += 1, a.around += o.variance, a.level += o.luminance;
    if (q == i || (own.surface > 0 && alike(own, o))) a.variance += o.variance, a.like += 1;
  }

  // Of the surfaces here, in luminance.
  static float contrastOf(const Around& a) {
    if (!(a.high >= a.low)) return 0;
    if (a.thinPixels < kThinPixels) return a.high - a.low;
    const float thin = a.thinLight / a.thinPixels;
    return std::max(a.high, thin) - std::min(a.low, thin);
  }

  const FilterInput& sums_;
  const std::vector<PixelCount>& counts_;
  const FilteredLuminance& left_;
  const Plane& thin_;
  float tolerance_;
  bool isFiltered_;
  Looks looks_;
};

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
                                 const FilteredLuminance& left, const Plane& thin, float tolerance) {
  const NoisePlan plan(sums, counts, left, thin, tolerance);
  std::vector<uint16_t> out(counts.size());
  parallelFor(static_cast<size_t>(sums.height), 4, [&](size_t row) {
    for (int x = 0; x < sums.width; ++x)
      out[row * static_cast<size_t>(sums.width) + static_cast<size_t>(x)] = plan.raysFor(x, static_cast<int>(row));
  });
  return out;
}

}  // namespace roomlight
