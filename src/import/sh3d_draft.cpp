#include "import/sh3d_draft.h"

#include "import/triangles.h"

namespace roomlight::importers::sh3d {

void Surfaces::triangle(int material, SurfaceCorner a, SurfaceCorner b, SurfaceCorner c, Vec3 front) {
  effort_.make(1, place_);
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

std::vector<PlanTriangle> Surfaces::cut(const PlanArea& area) const {
  ask(mostTrianglesOf(area));
  return trianglesOf(area);
}

void Surfaces::unite(PlanArea& area, const PlanArea& more) {
  if (more.empty()) return;
  if (!area.empty()) effort_.spendOn(area, more, place_);
  area = area.empty() ? more : united(area, more);
}

PlanArea Surfaces::without(const PlanArea& area, const PlanArea& holes) {
  effort_.spendOn(area, holes, place_);
  return subtracted(area, holes);
}

void Surfaces::finish(const Draft& draft, const std::string& name, const std::string& label) {
  Scene& scene = draft.scene;
  for (auto& [material, mesh] : meshes_) {
    dropDegenerate(mesh);
    if (mesh.indices.empty()) continue;
    mesh.name = name, mesh.material = material;
    scene.instances.push_back({name, static_cast<int>(scene.meshes.size()), draft.object, {}, -1, label});
    scene.meshes.push_back(std::move(mesh));
  }
  meshes_.clear();
}

}  // namespace roomlight::importers::sh3d
