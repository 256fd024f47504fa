#include "trace/surface_point.h"

namespace roomlight {
namespace {

// normalize(), and for lengths whose square a float does not hold: normals of triangles in huge or tiny units.
Vec3 unit(Vec3 v) {
  const float l2 = lengthSquared(v);
  return l2 > 1e-30f && l2 < 1e30f ? v / std::sqrt(l2) : normalize(v / maxComponent(abs(v)));
}

// What place and normals are worked out from.
struct PlacedTriangle {
  PlacedTriangle(const Scene& scene, const Hit& hit)
      : instance(scene.instances[hit.instance]), mesh(scene.meshes[static_cast<size_t>(instance.mesh)]) {
    const uint32_t* i = &mesh.indices[size_t{3} * hit.triangle];
    const Vec3 a = mesh.positions[i[0]], b = mesh.positions[i[1]], c = mesh.positions[i[2]];
    // Barycentric interpolation of the vertices is closer to the surface than origin + t * direction.
    p = instance.worldFromObject.point(a * (1 - hit.b1 - hit.b2) + b * hit.b1 + c * hit.b2);
    objectNormal = unit(cross(b - a, c - a));
    // The cofactor matrix points backwards under a mirroring transform; front is what it is in object space
// (glTF 2.0, 3.7.4).
    mirrors = instance.worldFromObject.determinant() < 0;
  }
  SurfacePlace seenAlong(Vec3 direction, const Scene& scene) const {
    const Vec3 n = unit(instance.worldFromObject.normal(objectNormal)) * (mirrors ? -1.0f : 1.0f);
    const bool front = dot(n, direction) < 0;
    return {p, front ? n : -n, front, &scene.materials[static_cast<size_t>(mesh.material)]};
  }
  const Instance& instance;
  const Mesh& mesh;
  Vec3 p, objectNormal;
  bool mirrors;
};

}  // namespace

TriangleVertices worldTriangle(const Scene& scene, uint32_t instanceIndex, uint32_t triangle) {
  const Instance& instance = scene.instances[instanceIndex];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const uint32_t* i = &mesh.indices[size_t{3} * triangle];
  const Affine& m = instance.worldFromObject;
  return {m.point(mesh.positions[i[0]]), m.point(mesh.positions[i[1]]), m.point(mesh.positions[i[2]])};
}

MaterialSample materialAt(const Scene& scene, const Hit& hit) {
  return materialAt(scene, scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)],
                    {hit.triangle, hit.b1, hit.b2});
}

void prefetchSurfaces(const Scene& scene, std::span<const Hit> hits) {
  const auto meshOf = [&](const Hit& hit) -> const Mesh& {
    return scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)];
  };
  for (const Hit& hit : hits) __builtin_prefetch(&meshOf(hit).indices[size_t{3} * hit.triangle]);
  for (const Hit& hit : hits) {
    const Mesh& mesh = meshOf(hit);
    for (size_t k = 0; k < 3; ++k) {
      const size_t vertex = mesh.indices[size_t{3} * hit.triangle + k];
      __builtin_prefetch(&mesh.positions[vertex]);
      if (!mesh.normals.empty()) __builtin_prefetch(&mesh.normals[vertex]);
      if (!mesh.uv[0].empty()) __builtin_prefetch(&mesh.uv[0][vertex]);
    }
  }
}

SurfacePlace placeAt(const Scene& scene, const Hit& hit, Vec3 direction) {
  return PlacedTriangle(scene, hit).seenAlong(direction, scene);
}

SurfacePoint surfaceAt(const Scene& scene, const Hit& hit, Vec3 direction) {
  return surfaceAt(scene, hit, direction, materialAt(scene, hit));
}

SurfacePoint surfaceAt(const Scene& scene, const Hit& hit, Vec3 direction, const MaterialSample& material) {
  const PlacedTriangle triangle(scene, hit);
  const SurfacePlace place = triangle.seenAlong(direction, scene);
  SurfacePoint s;
  s.p = place.p, s.ng = place.ng, s.front = place.front;
  s.m = material;
  s.instance = hit.instance;
  s.triangle = hit.triangle;
  s.material = place.material;
  s.ns = unit(triangle.instance.worldFromObject.normal(
      shadingNormalAt(scene, triangle.mesh, {hit.triangle, hit.b1, hit.b2}, triangle.objectNormal)));
  if (triangle.mirrors == s.front) s.ns = -s.ns;
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
