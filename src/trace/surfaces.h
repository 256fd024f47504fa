// What surfaceAt() needs of a triangle in one record: two cache lines fetched at once instead of a chain of look-ups in
// indices, positions, normals and coordinates. For who meets triangles all over the scene, as paths do.
#pragma once

#include <span>
#include <vector>

#include "trace/surface_point.h"

namespace roomlight {

class Surfaces {
 public:
  // Refers to the scene. 128 B a triangle of every mesh.
  explicit Surfaces(const Scene& scene);

  // Follows the scene, edited where it stands, after these instances moved or got another mesh.
  void update(std::span<const uint32_t> changedInstances);

  // The same as surfaceAt(scene, hit, direction).
  SurfacePoint at(const Hit& hit, Vec3 direction) const;

 private:
  struct alignas(64) Triangle {  // object space
    Vec3 a, b, c;
    Vec3 ng;  // unit
    Vec2 uv[3];  // set 0
    Vec3 normal[3];
    Vec3 tangent;  // for the normal map, where the mesh has no tangents
    float tangentSign;
  };
  struct Placed {  // an instance
    const Mesh* mesh = nullptr;
    const Material* material = nullptr;
    size_t firstTriangle = 0;
    Affine worldFromObject, worldFromNormal;
    bool plain = true;  // no vertex values but set 0 of the texture coordinates
    bool bumped = false;  // by a normal map
  };
  Placed placed(const Instance& instance) const;
  Triangle record(const Mesh& mesh, const Material& material, uint32_t triangle) const;
  Vec3 shadingNormal(const Placed& placed, const Triangle& t, const Hit& hit, const VertexValues& values) const;

  const Scene& scene_;
  std::vector<Triangle> triangles_;  // of every mesh in turn
  std::vector<size_t> firstOfMesh_;
  std::vector<Placed> placed_;
};

}  // namespace roomlight
