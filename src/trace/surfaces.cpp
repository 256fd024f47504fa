#include "trace/surfaces.h"

namespace roomlight {
namespace {

Vec3 unit(Vec3 v) { return normalize(v / maxComponent(abs(v))); }

template <class T>
T interpolate(const T values[3], const Hit& hit) {
  return values[0] * (1 - hit.b1 - hit.b2) + values[1] * hit.b1 + values[2] * hit.b2;
}

// Takes normals as Affine::normal() does, to the front even where the transform mirrors, and without under- or
// overflow.
Affine worldFromNormal(const Affine& m) {
  const Vec3 x = cross(m.y, m.z), y = cross(m.z, m.x), z = cross(m.x, m.y);
  const float scale = (m.determinant() < 0 ? -1.0f : 1.0f) /
                      std::max({maxComponent(abs(x)), maxComponent(abs(y)), maxComponent(abs(z))});
  return {x * scale, y * scale, z * scale, {}};
}

}  // namespace

Surfaces::Surfaces(const Scene& scene) : scene_(scene) {
  size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    firstOfMesh_.push_back(count);
    count += mesh.triangleCount();
  }
  triangles_.reserve(count);
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    for (uint32_t t = 0; t < mesh.triangleCount(); ++t) triangles_.push_back(record(mesh, material, t));
  }
  for (const Instance& instance : scene.instances) placed_.push_back(placed(instance));
}

void Surfaces::update(std::span<const uint32_t> changedInstances) {
  for (const uint32_t i : changedInstances) placed_[i] = placed(scene_.instances[i]);
}

Surfaces::Placed Surfaces::placed(const Instance& instance) const {
  const auto index = static_cast<size_t>(instance.mesh);
  Placed p;
  p.mesh = &scene_.meshes[index];
  p.material = &scene_.materials[static_cast<size_t>(p.mesh->material)];
  p.firstTriangle = firstOfMesh_[index];
  p.worldFromObject = instance.worldFromObject;
  p.worldFromNormal = worldFromNormal(instance.worldFromObject);
  p.plain = p.mesh->uv[1].empty() && p.mesh->colors.empty() && p.mesh->colorAlphas.empty();
  p.bumped = hasNormalMap(*p.material, *p.mesh);
  return p;
}

Surfaces::Triangle Surfaces::record(const Mesh& mesh, const Material& material, uint32_t triangle) const {
  const uint32_t* i = &mesh.indices[size_t{3} * triangle];
  Triangle t{};
  t.a = mesh.positions[i[0]], t.b = mesh.positions[i[1]], t.c = mesh.positions[i[2]];
  t.ng = unit(cross(t.b - t.a, t.c - t.a));
  for (int k = 0; k < 3; ++k) {
    if (!mesh.uv[0].empty()) t.uv[k] = mesh.uv[0][i[k]];
    t.normal[k] = mesh.normals.empty() ? t.ng : mesh.normals[i[k]];
  }
  if (hasNormalMap(material, mesh) && mesh.tangents.empty())
    t.tangent = triangleTangent(mesh, material.normalTexture, triangle, t.tangentSign);
  return t;
}

SurfacePoint Surfaces::at(const Hit& hit, Vec3 direction) const {
  const Placed& placed = placed_[hit.instance];
  const Triangle& t = triangles_[placed.firstTriangle + hit.triangle];
  VertexValues values;
  if (placed.plain) {
    values.uv[0] = interpolate(t.uv, hit);
  } else {
    values = vertexValuesAt(*placed.mesh, {hit.triangle, hit.b1, hit.b2});
  }
  SurfacePoint s;
  const Vec3 corners[3] = {t.a, t.b, t.c};
  s.p = placed.worldFromObject.point(interpolate(corners, hit));
  s.ng = normalize(placed.worldFromNormal.vector(t.ng));
  s.front = dot(s.ng, direction) < 0;
  s.smooth = normalize(placed.worldFromNormal.vector(shadingNormal(placed, t, hit, values)));
  if (!s.front) s.ng = -s.ng, s.smooth = -s.smooth;
  s.ns = bentNormal(s.smooth, s.ng, direction);
  s.instance = hit.instance;
  s.triangle = hit.triangle;
  s.material = placed.material;
  s.m = materialAt(scene_, *placed.material, values);
  return s;
}

Vec3 Surfaces::shadingNormal(const Placed& placed, const Triangle& t, const Hit& hit,
                             const VertexValues& values) const {
  if (placed.bumped && !placed.mesh->tangents.empty())
    return shadingNormalAt(scene_, *placed.mesh, {hit.triangle, hit.b1, hit.b2}, t.ng);
  const Vec3 sum = interpolate(t.normal, hit);
  const float l = length(sum);
  const Vec3 n = l > 1e-6f ? sum / l : t.ng;
  return placed.bumped ? bumpedNormal(scene_, *placed.material, n, t.tangent, t.tangentSign, values) : n;
}

}  // namespace roomlight
