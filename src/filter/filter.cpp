#include "filter/filter.h"

#include <cmath>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kKernel[3] = {0.25f, 0.5f, 0.25f};
constexpr float kSigmas = 3;               // differences within so many standard deviations count as noise
constexpr float kSharpSigmas = 1;          // for sharp shadows, which differ where they should
constexpr float kPlaneTolerance = 0.01f;   // metres off the tangent plane, and
constexpr float kSlope = 0.3f;             // of the distance between the two points
constexpr float kMirrorRoughness = 0.08f;  // reflections below this are pictures, not light
constexpr int kSpecularPasses = 3;

struct Value {
  Vec3 light;
  float variance = 0;
};
struct Lights {
  Value diffuse, sharp, specular;
};

// What tells which pixels see like surfaces, packed for the many look-ups.
struct Guide {
  Vec3 normal;
  float surface = 0;
  Vec3 position;
  float roughness = 0;
};

// Variances of diffuse, sharp and specular light.
using Noise = std::vector<Vec3>;

// e^-x from 0 to 3 within 0.03; 0 from 8 on.
float falloff(float x) {
  const float a = std::max(0.0f, 1 - 0.125f * x), b = a * a, c = b * b;
  return c * c;
}

// Means over 3 x 3 pixels, for the variance of single pixels is itself noise; but no less than a pixel's own, so that an outlier
// is taken for one.
Noise noiseOf(const std::vector<Lights>& lights, int w, int h) {
  const auto width = static_cast<size_t>(w);
  Noise own(lights.size()), rows(lights.size()), out(lights.size());
  parallelFor(static_cast<size_t>(h), 8, [&](size_t y) {
    Vec3* at = &own[y * width];
    for (size_t x = 0; x < width; ++x) {
      const Lights& l = lights[y * width + x];
      at[x] = {l.diffuse.variance, l.sharp.variance, l.specular.variance};
    }
    for (size_t x = 0; x < width; ++x) rows[y * width + x] = (at[x == 0 ? x : x - 1] + at[x] + at[x + 1 == width ? x : x + 1]) * (1.0f / 3);
  });
  parallelFor(static_cast<size_t>(h), 8, [&](size_t y) {
    const size_t above = y == 0 ? y : y - 1, below = y + 1 == static_cast<size_t>(h) ? y : y + 1;
    for (size_t x = 0; x < width; ++x) {
      const Vec3 mean = (rows[above * width + x] + rows[y * width + x] + rows[below * width + x]) * (1.0f / 3);
      out[y * width + x] = max(mean, own[y * width + x]);
    }
  });
  return out;
}

// A weighted mean under way.
struct Sum {
  Vec3 light;
  float variance, total;
  Sum(const Value& own, float k) : light(own.light * k), variance(own.variance * k * k), total(k) {}
  void add(const Value& v, float k) { light += v.light * k, variance += v.variance * k * k, total += k; }
  Value mean() const { return {light / total, variance / (total * total)}; }
};

// How far the light of two pixels differs, in units of their noise together: as seen from either, so that as much passes from a
// bright spot to its surroundings as back.
float difference(const Value& a, const Value& b, float varianceA, float varianceB, float sigmas) {
  return std::abs(luminance(a.light) - luminance(b.light)) / (sigmas * std::sqrt(varianceA + varianceB) + 1e-6f);
}

// One pass over neighbours `step` pixels away.
std::vector<Lights> pass(const std::vector<Lights>& in, const std::vector<Guide>& guides, int w, int h, int step, bool filterSpecular) {
  const Noise noise = noiseOf(in, w, h);
  std::vector<Lights> out(in.size());
  parallelFor(static_cast<size_t>(h), 4, [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < w; ++x) {
      const size_t p = row * static_cast<size_t>(w) + static_cast<size_t>(x);
      const Guide& g = guides[p];
      const Lights& own = in[p];
      out[p] = own;
      if (g.surface <= 0) continue;
      const bool glossy = filterSpecular && g.roughness >= kMirrorRoughness;
      Sum diffuse(own.diffuse, kKernel[1] * kKernel[1]), sharp(own.sharp, kKernel[1] * kKernel[1]), specular(own.specular, kKernel[1] * kKernel[1]);
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const int qx = x + i * step, qy = y + j * step;
          if ((i == 0 && j == 0) || qx < 0 || qy < 0 || qx >= w || qy >= h) continue;
          const size_t q = static_cast<size_t>(qy) * static_cast<size_t>(w) + static_cast<size_t>(qx);
          const Guide& o = guides[q];
          const float facing = dot(g.normal, o.normal);
          if (o.surface <= 0 || facing < 0.3f) continue;
          const Vec3 between = o.position - g.position;
          const float off = std::max(std::abs(dot(g.normal, between)), std::abs(dot(o.normal, between))) / (kPlaneTolerance + kSlope * length(between));
          // facing^4 along the normals: noise itself tells edges that light has.
          const float f2 = facing * facing, k = kKernel[i + 1] * kKernel[j + 1] * f2 * f2;
          const Lights& other = in[q];
          diffuse.add(other.diffuse, k * falloff(off + difference(own.diffuse, other.diffuse, noise[p].x, noise[q].x, kSigmas)));
          sharp.add(other.sharp, k * falloff(off + difference(own.sharp, other.sharp, noise[p].y, noise[q].y, kSharpSigmas)));
          if (glossy && o.roughness >= kMirrorRoughness && std::abs(g.roughness - o.roughness) <= 0.1f) {
            specular.add(other.specular, k * falloff(off + difference(own.specular, other.specular, noise[p].z, noise[q].z, kSigmas)));
          }
        }
      }
      out[p].diffuse = diffuse.mean(), out[p].sharp = sharp.mean();
      if (glossy) out[p].specular = specular.mean();
    }
  });
  return out;
}

// Kept from zero so that light can be divided by it.
Vec3 divisor(Vec3 albedo) { return max(albedo, Vec3(1e-3f)); }

}  // namespace

Image composed(const FilterInput& input) {
  Image out(input.width, input.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = input.pixels[i].diffuse + input.pixels[i].sharp + input.pixels[i].specular + input.pixels[i].rest;
  return out;
}

Image filtered(const FilterInput& input, int passes) {
  std::vector<Lights> lights(input.pixels.size());
  std::vector<Guide> guides(input.pixels.size());
  parallelFor(lights.size(), 16384, [&](size_t i) {
    const FilterPixel& p = input.pixels[i];
    lights[i] = {{p.diffuse / divisor(p.albedo), p.diffuseVariance}, {p.sharp / divisor(p.albedo), p.sharpVariance}, {p.specular, p.specularVariance}};
    guides[i] = {p.normal, p.surface, p.position, p.roughness};
  });
  for (int k = 0; k < passes; ++k) lights = pass(lights, guides, input.width, input.height, 1 << k, k < kSpecularPasses);
  Image out(input.width, input.height);
  parallelFor(lights.size(), 16384, [&](size_t i) {
    const FilterPixel& p = input.pixels[i];
    // Where the albedo was raised to divide by it, light that no surface reflected is kept.
    out.pixels[i] = (p.surface > 0 ? (lights[i].diffuse.light + lights[i].sharp.light) * divisor(p.albedo) : p.diffuse + p.sharp) + lights[i].specular.light + p.rest;
  });
  return out;
}

}  // namespace roomlight
