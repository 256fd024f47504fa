#include "scene/mesh_vertices.h"

namespace roomlight {
namespace {

template <class Visit>
void forEachAttribute(Mesh& mesh, const Visit& visit) {
  visit(mesh.positions), visit(mesh.normals), visit(mesh.tangents), visit(mesh.tangentSigns);
  visit(mesh.uv[0]), visit(mesh.uv[1]), visit(mesh.colors), visit(mesh.colorAlphas);
}

void makeUnit(std::vector<Vec3>& directions, Vec3 instead) {
  if (directions.empty()) return;
  Vec3& last = directions.back();
  last = length(last) > 0 ? normalize(last) : instead;
}

}  // namespace

uint32_t repeatVertex(Mesh& mesh, uint32_t vertex) {
  forEachAttribute(mesh, [&](auto& values) {
    if (values.empty()) return;
    const auto value = values[vertex];
    values.push_back(value);
  });
  return static_cast<uint32_t>(mesh.positions.size() - 1);
}

uint32_t addVertexBetween(Mesh& mesh, uint32_t from, uint32_t to, float share) {
  forEachAttribute(mesh, [&](auto& values) {
    if (values.empty()) return;
    const auto value = values[from] * (1 - share) + values[to] * share;
    values.push_back(value);
  });
  makeUnit(mesh.normals, mesh.normals.empty() ? Vec3() : mesh.normals[from]);
  makeUnit(mesh.tangents, mesh.tangents.empty() ? Vec3() : mesh.tangents[from]);
  if (!mesh.tangentSigns.empty()) mesh.tangentSigns.back() = mesh.tangentSigns[from];
  return static_cast<uint32_t>(mesh.positions.size() - 1);
}

}  // namespace roomlight
