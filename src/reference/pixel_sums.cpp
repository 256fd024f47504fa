#include "reference/pixel_sums.h"

#include <cmath>

namespace roomlight {
namespace {

// Variance of a mean of n light samples over a mean of n albedos, from the sums over both: that of a ratio, by how
// samples deviate from the mean ratio.
float ratioVariance(float light, float albedo, float light2, float lightAlbedo, float albedo2, float n) {
  const float a = std::max(albedo, 1e-3f * n), ratio = light / a;
  if (n < 2) return ratio * ratio;
  return std::max(0.0f, light2 - 2 * ratio * lightAlbedo + ratio * ratio * albedo2) * n / ((n - 1) * a * a);
}

}  // namespace

void PixelSums::add(const FilterPixel& s) {
  const float d = luminance(s.diffuse), h = luminance(s.sharp), g = luminance(s.specular), a = luminance(s.albedo);
  diffuse2_ += d * d, diffuseAlbedo_ += d * a, sharp2_ += h * h, sharpAlbedo_ += h * a, specular2_ += g * g,
      albedo2_ += a * a;
  sum_.diffuse += s.diffuse, sum_.sharp += s.sharp, sum_.albedo += s.albedo, sum_.specular += s.specular,
      sum_.rest += s.rest;
  sum_.normal += s.normal, sum_.position += s.position, sum_.roughness += s.roughness, sum_.surface += s.surface;
}

FilterPixel PixelSums::mean(int samples) const {
  const float n = static_cast<float>(samples), inverse = 1 / n, albedo = luminance(sum_.albedo),
              g = luminance(sum_.specular);
  FilterPixel p = sum_;
  p.diffuse *= inverse, p.sharp *= inverse, p.albedo *= inverse, p.specular *= inverse, p.rest *= inverse;
  p.diffuseVariance = ratioVariance(luminance(sum_.diffuse), albedo, diffuse2_, diffuseAlbedo_, albedo2_, n);
  p.sharpVariance = ratioVariance(luminance(sum_.sharp), albedo, sharp2_, sharpAlbedo_, albedo2_, n);
  p.specularVariance = n < 2 ? g * g : std::max(0.0f, specular2_ - g * g * inverse) / (n * (n - 1));
  if (p.surface > 0) {
    p.normal = length(p.normal) > 0 ? normalize(p.normal) : p.normal;
    p.position *= 1 / p.surface, p.roughness *= 1 / p.surface;
  }
  p.surface *= inverse;
  return p;
}

}  // namespace roomlight
