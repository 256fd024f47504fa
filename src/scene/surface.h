// Materials at a point: textures read, factors multiplied. One place for path tracer, voxels and cones alike.
#pragma once

#include "base/vec.h"
#include "scene/scene.h"

namespace roomlight {

// Material values at one point of a triangle.
struct MaterialSample {
  Vec3 baseColor;         // linear, 0..1
  float alpha = 1;        // coverage after alphaMode: 1 opaque, Mask is 0 or 1, Blend in between
  float metallic = 0, roughness = 1;
  float transmission = 0; // fraction of the non-specular, non-metallic light that goes straight through
  Vec3 emission;          // luminance in cd/m²
  Vec3 f0;                // specular reflectance at normal incidence
  Vec3 f90;               // and at grazing incidence
  const Material* glazed =
      nullptr;  // the scene's material, where it is a window: reflects as its glazing does, not by f0 and f90
};

// Bilinear look-up with wrapping; result in 0..1, decoded from sRGB to linear when `srgb`. w is alpha (never decoded).
struct Rgba {
  Vec3 rgb;
  float a;
};
Rgba sampleTexture(const Texture& texture, Vec2 uv, bool srgb);
Vec2 transformUv(const TextureRef& ref, Vec2 uv);
// How many texels of a texture lie on a triangle, repeats included.
float texelsOn(const Scene& scene, const Mesh& mesh, uint32_t triangle, const TextureRef& ref);

// Barycentric weights b1, b2 of a triangle's vertices 1 and 2 (b0 = 1 - b1 - b2).
struct TrianglePoint {
  uint32_t triangle;
  float b1, b2;
};

// What the vertices of a mesh give a point, beside place and normal.
struct VertexValues {
  Vec2 uv[2];
  Vec3 color{1, 1, 1};
  float colorAlpha = 1;
};
VertexValues vertexValuesAt(const Mesh& mesh, TrianglePoint p);

MaterialSample materialAt(const Scene& scene, const Mesh& mesh, TrianglePoint p);
MaterialSample materialAt(const Scene& scene, const Material& material, const VertexValues& values);
float alphaByMode(const Material& material, float alpha);  // as blended, cut out, or opaque
float alphaAt(const Scene& scene, const Mesh& mesh, TrianglePoint p);  // only the alpha, cheaper
// The same values all over a mesh: neither textures nor colours of vertices.
bool isUniform(const Material& m, const Mesh& mesh);

// Interpolated shading normal in object space, normal map applied; unit. `geometric` is the unit face normal, used
// where the mesh has no normals.
Vec3 shadingNormalAt(const Scene& scene, const Mesh& mesh, TrianglePoint p, Vec3 geometric);
// The interpolated one alone, in the world, unit, on the side that the unit face normal `geometric` is on.
Vec3 smoothNormalAt(const Mesh& mesh, const Affine& worldFromObject, TrianglePoint p, Vec3 geometric);
// Parts of the former: the map applied to the interpolated normal n, unit, which takes a tangent of any length (zero:
// no map) and the side of the bitangent; and that tangent along +u of a triangle, from its texture coordinates (zero
// where they are degenerate).
bool hasNormalMap(const Material& material, const Mesh& mesh);
Vec3 bumpedNormal(const Scene& scene, const Material& material, Vec3 n, Vec3 tangent, float sign,
                  const VertexValues& values);
Vec3 triangleTangent(const Mesh& mesh, const TextureRef& ref, uint32_t triangle, float& sign);

// Fraction of the light from a uniform hemisphere that the surface reflects in total, per channel; what a diffuse
// voxel of this material must reflect. Light that passes straight through is not in it.
Vec3 bihemisphericalAlbedo(const MaterialSample& m);

// The same surface, matt and reflecting everything: pi times the luminance of what it reflects is its illuminance. What
// light passes through stays as it is, and so do veils' gaps.
MaterialSample whitened(const MaterialSample& m);

// Makes a material a clear window, whatever it was before; what it emits stays.
void glaze(Material& material, const Glazing& glazing);

// Whether light may pass straight through somewhere on surfaces of this material: panes, veils, leaves cut out by a
// mask.
bool letsLightThrough(const Material& m);

// Whether it reflects as a mirror does, so that its light keeps its direction.
bool isPolishedMetal(const Material& m);

// Polished metal and smooth panes.
bool throwsLight(const Material& m);

// Transmittance of a thin pane along a ray that meets it under |cos theta|: base colour times what Fresnel
// reflection on both sides leaves, times `transmission` and what alpha leaves open; of a window what its glazing lets
// through. Zero for an opaque surface.
Vec3 straightTransmittance(const Material& material, const MaterialSample& m, float cosTheta);
// At a point of a mesh: of what has gaps alone only these are looked up.
Vec3 straightTransmittance(const Scene& scene, const Mesh& mesh, TrianglePoint p, float cosTheta);

// The same, known to be nothing at a look at the sample.
inline Vec3 passing(const MaterialSample& m, const Material& material, float cosTheta) {
  return m.transmission <= 0 && m.alpha >= 1 ? Vec3(0) : straightTransmittance(material, m, cosTheta);
}

}  // namespace roomlight
