#include "voxel/bricks.h"

namespace roomlight {
namespace {

constexpr float kTexelsPerSample = 4;  // one bilinear look-up sees about four
constexpr float kMostSamplesPerArea = 16;  // per voxel²: a small piece counts for little in its voxel

Shade shadeAt(const Scene& scene, const Mesh& mesh, TrianglePoint p) {
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const MaterialSample m = materialAt(scene, mesh, p);
  Shade s;
  s.coverage = std::clamp(1 - luminance(straightTransmittance(material, m, 1)), 0.0f, 1.0f);
  s.albedo = min(bihemisphericalAlbedo(m), Vec3(1));
  // Light that goes straight through is not absorbed: a pane's small opaque share reflects what the whole pane does.
  if (s.coverage > 0 && s.coverage < 1 && m.alpha >= 1) s.albedo = min(s.albedo / s.coverage, Vec3(1));
  s.emission = m.emission;
  if (s.coverage > 0) s.emission = s.emission / s.coverage;  // of the part that blocks light, which alone counts
  return s;
}

TrianglePoint barycentric(const LatticeTriangle& t, uint32_t triangle, Vec3 p) {
  const Vec3 e1 = t.b - t.a, e2 = t.c - t.a, d = p - t.a;
  const float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), p1 = dot(d, e1), p2 = dot(d, e2);
  const float det = d11 * d22 - d12 * d12;
  if (!(det > 0)) return {triangle, 1 / 3.f, 1 / 3.f};
  return {triangle, std::clamp((d22 * p1 - d12 * p2) / det, 0.0f, 1.0f),
          std::clamp((d11 * p2 - d12 * p1) / det, 0.0f, 1.0f)};
}

// Point of a convex polygon for (u, v) in the unit square: uniform in (u, v) is uniform over its area.
Vec3 pointOf(const Polygon& polygon, float area, float u, float v) {
  float left = u * area;
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const Vec3 a = polygon.v[0], b = polygon.v[static_cast<size_t>(i)], c = polygon.v[static_cast<size_t>(i) + 1];
    const float part = 0.5f * length(cross(b - a, c - a));
    if (left > part && i + 2 < polygon.count) {
      left -= part;
      continue;
    }
    // The square root makes the share between a and the far edge uniform.
    const float s = std::sqrt(part > 0 ? std::clamp(left / part, 0.0f, 1.0f) : 0.5f);
    return a + (b - a) * (s * (1 - v)) + (c - a) * (s * v);
  }
  return polygon.v[0];
}

}  // namespace

TriangleShader::TriangleShader(const Scene& scene, const Mesh& mesh, uint32_t triangle, const LatticeTriangle& lattice)
    : scene_(scene), mesh_(mesh), lattice_(lattice), triangle_(triangle) {
  const Material& m = scene.materials[static_cast<size_t>(mesh.material)];
  uniform_ = mesh.colors.empty() && mesh.colorAlphas.empty();
  float texels = 0;
  for (const TextureRef* ref :
       {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissionTexture, &m.transmissionTexture}) {
    if (ref->texture < 0) continue;
    uniform_ = false;
    texels = std::max(texels, texelsOn(scene, mesh, triangle, *ref));
  }
  texelsPerArea_ = texels / lattice.area;
  if (uniform_) shade_ = shadeAt(scene, mesh, {triangle, 1 / 3.f, 1 / 3.f});
}

Shade TriangleShader::at(Vec3 p) const { return shadeAt(scene_, mesh_, barycentric(lattice_, triangle_, p)); }

Shade TriangleShader::operator()(const Polygon& piece) const {
  if (uniform_) return shade_;
  const AreaCentroid g = areaOf(piece);
  const float wanted = g.area * std::min(texelsPerArea_ / kTexelsPerSample, kMostSamplesPerArea);
  if (!(wanted > 1)) return at(g.centroid);
  const int samples = static_cast<int>(std::ceil(wanted));
  Shade mean{Vec3(0), Vec3(0), 0};
  for (int i = 0; i < samples; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
    const float v = 0.6180340f * static_cast<float>(i) + 0.5f;  // golden ratio: even in the square
    const Shade s = at(pointOf(piece, g.area, u, v - std::floor(v)));
    mean.albedo += s.albedo * s.coverage, mean.emission += s.emission * s.coverage, mean.coverage += s.coverage;
  }
  if (mean.coverage > 0) mean.albedo = mean.albedo / mean.coverage, mean.emission = mean.emission / mean.coverage;
  mean.coverage /= static_cast<float>(samples);
  return mean;
}

}  // namespace roomlight
