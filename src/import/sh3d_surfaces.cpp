#include "import/sh3d_surfaces.h"

#include "import/triangles.h"

namespace roomlight::importers::sh3d {

void Surfaces::triangle(int material, SurfaceCorner a, SurfaceCorner b, SurfaceCorner c, Vec3 front) {
  if (dot(cross(b.position - a.position, c.position - a.position), front) < 0) std::swap(b, c);
  Mesh& mesh = meshes_[material];
  for (const SurfaceCorner& corner : {a, b, c}) {
    mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(corner.position);
    mesh.uv[0].push_back(corner.uv);
  }
}

void Surfaces::quad(int material, const SurfaceCorner (&corners)[4], Vec3 front) {
  triangle(material, corners[0], corners[1], corners[2], front);
  triangle(material, corners[0], corners[2], corners[3], front);
}

void Surfaces::finish(Scene& scene, const std::string& name, int object) {
  for (auto& [material, mesh] : meshes_) {
    dropDegenerate(mesh);
    if (mesh.indices.empty()) continue;
    mesh.name = name, mesh.material = material;
    scene.instances.push_back({name, static_cast<int>(scene.meshes.size()), object, {}});
    scene.meshes.push_back(std::move(mesh));
  }
  meshes_.clear();
}

}  // namespace roomlight::importers::sh3d
