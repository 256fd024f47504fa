// What a ray found, ready for shading: position, normals that face the ray, material values.
#pragma once

#include <span>

#include "scene/surface.h"
#include "trace/ray_scene.h"

namespace roomlight {

struct SurfacePoint {
  Vec3 p;              // world
  Vec3 ng;             // unit geometric normal on the side the ray came from
  Vec3 smooth;         // unit shading normal on that side, as the mesh and its normal map have it
  Vec3 ns;             // the same, bent to where the ray sees it from above
  bool front = true;   // the ray met the front (counter-clockwise) side
  uint32_t instance = 0, triangle = 0;
  const Material* material = nullptr;
  MaterialSample m;

  // Luminance emitted towards the ray's origin, cd/m² per channel.
  Vec3 emitted() const { return front || material->doubleSided ? m.emission : Vec3(0); }
};

// The part of it that needs no texture: cheap.
struct SurfacePlace {
  Vec3 p, ng;
  bool front = true;
  const Material* material = nullptr;
};

// `direction` is that of the ray, pointing to the surface.
SurfacePlace placeAt(const Scene& scene, const Hit& hit, Vec3 direction);
SurfacePoint surfaceAt(const Scene& scene, const Hit& hit, Vec3 direction);
// With material values from elsewhere.
SurfacePoint surfaceAt(const Scene& scene, const Hit& hit, Vec3 direction, const MaterialSample& material);
MaterialSample materialAt(const Scene& scene, const Hit& hit);
// Has what these read of triangles fetched into the processor's cache: what many hits need comes at once, not one after
// the other.
void prefetchSurfaces(const Scene& scene, std::span<const Hit> hits);
// A shading normal that a ray sees from behind would reflect into the surface: bent to just above grazing.
Vec3 bentNormal(Vec3 ns, Vec3 ng, Vec3 direction);

// Flux spreads by the true surface, but scattering sees the shading normal (Veach 1997, 5.3): what a path coming the
// other way would find.
inline float shadingCorrection(const SurfacePoint& s, Vec3 wi, Vec3 wo) {
  const float below = std::max(dot(s.ng, wi), 1e-6f) * std::max(dot(s.ns, wo), 1e-6f);
  return std::max(dot(s.ns, wi), 0.0f) * std::max(dot(s.ng, wo), 0.0f) / below;
}

// World positions of a triangle's vertices.
struct TriangleVertices {
  Vec3 a, b, c;
};
TriangleVertices worldTriangle(const Scene& scene, uint32_t instance, uint32_t triangle);

}  // namespace roomlight
