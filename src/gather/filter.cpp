#include "gather/filter.h"

#include <cmath>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kKernel[3] = {0.25f, 0.5f, 0.25f};
constexpr float kLuminanceSigmas = 3;      // differences within so many standard deviations count as noise
constexpr float kNormalPower = 48;
constexpr float kPlaneTolerance = 0.01f;   // distance from the tangent plane, of the distance between the two points' pixels
constexpr float kMirrorRoughness = 0.08f;  // reflections below this are pictures, not light

struct Value {
  Vec3 light;
  float variance = 0;
};
using Plane = std::vector<Value>;

// A 3 x 3 mean: the variance of single pixels is itself noise, and an outlier would judge itself by its own.
float smoothVariance(const Plane& plane, int w, int h, int x, int y) {
  float sum = 0, weight = 0;
  for (int j = std::max(0, y - 1); j <= std::min(h - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(w - 1, x + 1); ++i) {
      const float k = kKernel[j - y + 1] * kKernel[i - x + 1];
      sum += k * plane[static_cast<size_t>(j) * static_cast<size_t>(w) + static_cast<size_t>(i)].variance;
      weight += k;
    }
  }
  return sum / weight;
}

// How much q's light may stand for p's, by what is seen at the two pixels.
float likeness(const FilterPixel& p, const FilterPixel& q) {
  if (q.surface <= 0) return 0;
  const float facing = dot(p.normal, q.normal);
  if (facing <= 0) return 0;
  const Vec3 between = q.position - p.position;
  const float far = length(between), off = std::max(std::abs(dot(p.normal, between)), std::abs(dot(q.normal, between)));
  return std::pow(facing, kNormalPower) * std::exp(-off / (kPlaneTolerance + 0.1f * far));
}

template <class Weight>
Plane pass(const Plane& in, int w, int h, int step, const Weight& weight) {
  Plane out(in.size());
  parallelFor(static_cast<size_t>(h), 4, [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < w; ++x) {
      const size_t p = row * static_cast<size_t>(w) + static_cast<size_t>(x);
      const float deviation = kLuminanceSigmas * std::sqrt(smoothVariance(in, w, h, x, y)) + 1e-6f, own = luminance(in[p].light);
      Vec3 sum = in[p].light * kKernel[1] * kKernel[1];
      float total = kKernel[1] * kKernel[1], variance = in[p].variance * total * total;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const int qx = x + i * step, qy = y + j * step;
          if ((i == 0 && j == 0) || qx < 0 || qy < 0 || qx >= w || qy >= h) continue;
          const size_t q = static_cast<size_t>(qy) * static_cast<size_t>(w) + static_cast<size_t>(qx);
          const float k = kKernel[i + 1] * kKernel[j + 1] * weight(p, q) * std::exp(-std::abs(luminance(in[q].light) - own) / deviation);
          sum += in[q].light * k;
          variance += in[q].variance * k * k;
          total += k;
        }
      }
      out[p] = {sum / total, variance / (total * total)};
    }
  });
  return out;
}

Plane irradiance(const FilterInput& input) {
  Plane plane(input.pixels.size());
  for (size_t i = 0; i < plane.size(); ++i) {
    const FilterPixel& p = input.pixels[i];
    const Vec3 a = max(p.albedo, Vec3(1e-3f));
    const float l = std::max(luminance(p.albedo), 1e-3f);
    plane[i] = {p.diffuse / a, p.diffuseVariance / (l * l)};
  }
  return plane;
}

Plane reflections(const FilterInput& input) {
  Plane plane(input.pixels.size());
  for (size_t i = 0; i < plane.size(); ++i) plane[i] = {input.pixels[i].specular, input.pixels[i].specularVariance};
  return plane;
}

}  // namespace

Image composed(const FilterInput& input) {
  Image out(input.width, input.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = input.pixels[i].diffuse + input.pixels[i].specular + input.pixels[i].rest;
  return out;
}

Image filtered(const FilterInput& input, int passes) {
  const auto& pixels = input.pixels;
  Plane diffuse = irradiance(input), specular = reflections(input);
  const auto byShape = [&](size_t p, size_t q) { return pixels[p].surface > 0 ? likeness(pixels[p], pixels[q]) : 0.0f; };
  const auto byGloss = [&](size_t p, size_t q) {
    const float a = pixels[p].roughness, b = pixels[q].roughness;
    if (a < kMirrorRoughness || b < kMirrorRoughness || std::abs(a - b) > 0.1f) return 0.0f;
    return byShape(p, q);
  };
  for (int k = 0; k < passes; ++k) {
    diffuse = pass(diffuse, input.width, input.height, 1 << k, byShape);
    if (k < 3) specular = pass(specular, input.width, input.height, 1 << k, byGloss);
  }
  Image out(input.width, input.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    const FilterPixel& p = pixels[i];
    // Where the albedo was cut to stay divisible, the light itself is kept.
    const Vec3 a = max(p.albedo, Vec3(1e-3f));
    out.pixels[i] = (p.surface > 0 ? diffuse[i].light * a : p.diffuse) + specular[i].light + p.rest;
  }
  return out;
}

}  // namespace roomlight
