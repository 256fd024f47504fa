#include "trace/surface_point.h"

namespace roomlight {
namespace {

// normalize(), and for lengths whose square a float does not hold: normals of triangles in huge or tiny units.
Vec3 unit(Vec3 v) {
  const float l2 = lengthSquared(v);
  return l2 > 1e-30f && l2 < 1e30f ? v / std::sqrt(l2) : normalize(v / maxComponent(abs(v)));
}

}  // namespace

TriangleVertices worldTriangle(const Scene& scene, uint32_t instanceIndex, uint32_t triangle) {
  const Instance& instance = scene.instances[instanceIndex];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const uint32_t* i = &mesh.indices[size_t{3} * triangle];
  const Affine& m = instance.worldFromObject;
  return {m.point(mesh.positions[i[0]]), m.point(mesh.positions[i[1]]), m.point(mesh.positions[i[2]])};
}

MaterialSample materialAt(const Scene& scene, const Hit& hit) {
  return materialAt(scene, scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)], {hit.triangle, hit.b1, hit.b2});
}

SurfacePlace placeAt(const Scene& scene, const Hit& hit, Vec3 direction) {
  const Instance& instance = scene.instances[hit.instance];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const Affine& m = instance.worldFromObject;
  const uint32_t* i = &mesh.indices[size_t{3} * hit.triangle];
  const Vec3 a = mesh.positions[i[0]], b = mesh.positions[i[1]], c = mesh.positions[i[2]];
  SurfacePlace s;
  s.material = &scene.materials[static_cast<size_t>(mesh.material)];
  // Barycentric interpolation of the vertices is closer to the surface than origin + t * direction.
  s.p = m.point(a * (1 - hit.b1 - hit.b2) + b * hit.b1 + c * hit.b2);
  // The cofactor matrix points backwards under a mirroring transform; front is what it is in object space (glTF 2.0, 3.7.4).
  s.ng = unit(m.normal(unit(cross(b - a, c - a)))) * (m.determinant() < 0 ? -1.0f : 1.0f);
  s.front = dot(s.ng, direction) < 0;
  if (!s.front) s.ng = -s.ng;
  return s;
}

SurfacePoint surfaceAt(const Scene& scene, const Hit& hit, Vec3 direction) { return surfaceAt(scene, hit, direction, materialAt(scene, hit)); }

SurfacePoint surfaceAt(const Scene& scene, const Hit& hit, Vec3 direction, const MaterialSample& material) {
  const SurfacePlace place = placeAt(scene, hit, direction);
  const Instance& instance = scene.instances[hit.instance];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const Affine& m = instance.worldFromObject;
  const uint32_t* i = &mesh.indices[size_t{3} * hit.triangle];
  const Vec3 a = mesh.positions[i[0]], b = mesh.positions[i[1]], c = mesh.positions[i[2]];
  const Vec3 objectNormal = unit(cross(b - a, c - a));

  SurfacePoint s;
  s.p = place.p, s.ng = place.ng, s.front = place.front;
  s.m = material;
  s.instance = hit.instance;
  s.triangle = hit.triangle;
  s.material = place.material;
  s.ns = unit(m.normal(shadingNormalAt(scene, mesh, {hit.triangle, hit.b1, hit.b2}, objectNormal)));
  if ((m.determinant() < 0) == s.front) s.ns = -s.ns;
  s.smooth = s.ns;
  s.ns = bentNormal(s.ns, s.ng, direction);
  return s;
}

Vec3 bentNormal(Vec3 ns, Vec3 ng, Vec3 direction) {
  const float away = -dot(ns, direction), l2 = lengthSquared(direction);
  if (away > 0 && away * away >= 1e-4f * l2 && dot(ns, ng) > 0) return ns;
  const float l = std::sqrt(l2);
  const Vec3 d = direction / l;
  const Vec3 sum = ns - d * (0.02f - away / l);
  const Vec3 bent = dot(sum, ng) > 0 && lengthSquared(sum) > 1e-6f ? normalize(sum) : ng;
  return dot(bent, d) > -0.005f ? ng : bent;
}

}  // namespace roomlight
