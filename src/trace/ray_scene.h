// Ray tracing on a scene: Embree behind one small face. World space throughout.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace roomlight {

class Surfaces;

constexpr uint32_t kNoHit = 0xffffffffu;

struct Ray {
  Vec3 origin, direction;  // direction need not be unit; distances count in its length
  float tMin = 0, tMax = kInfinity;
};

struct Hit {
  uint32_t instance = kNoHit, triangle = 0;
  float b1 = 0, b2 = 0;  // barycentric weights of the triangle's vertices 1 and 2
  float t = kInfinity;
  Vec3 ng;  // along the triangle's normal to either side, world, not unit; of rays' hits only
  bool valid() const { return instance != kNoHit; }
};

// Rays in the order in which they were traced, many at a time, for measuring.
struct RayLog {
  enum class Kind : uint8_t { Nearest, NearestClose, Shadow };
  struct Batch {
    Kind kind;
    size_t first, count;
  };
  std::vector<Ray> rays;
  std::vector<Batch> batches;
};

// A bounding-volume hierarchy over all instances of a scene, which it refers to and must not outlive. Surfaces block
// from both sides; alpha-masked texels are holes; thin glass and alpha-blended surfaces are hit by intersect() and
// attenuate transmittance(). Safe to use from many threads.
class RayScene {
 public:
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // Nearest surface.
  Hit intersect(const Ray& ray) const;
  // The same for many rays without coherence, eight at a time: hits[i] belongs to rays[i].
  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const;
  // The same for rays that stay close together, as those of one pixel do: faster.
  void intersectClose(std::span<const Ray> rays, std::span<Hit> hits) const;
  // What is left of light along the ray per channel: 1 unobstructed, 0 blocked, in between through glass.
  Vec3 transmittance(const Ray& ray) const;
  void transmittance(std::span<const Ray> rays, std::span<Vec3> left) const;

  // Follows the scene, edited where it stands, after these instances moved or got another mesh (one without triangles
  // hides them). What has moved once has a hierarchy of its own from then on, and where it was at first is no longer
  // met: this costs a build of what moves. With meshes shared, in scenes of millions of triangles, the whole is built
  // anew. The same hits, bit for bit, as of a RayScene made anew. No ray may be under way.
  void update(std::span<const uint32_t> changedInstances);

  // From here on, what is traced many rays at a time is added to `log`, by one thread only; null ends that.
  void record(RayLog* log);

  const Scene& scene() const;
  const Bounds3& bounds() const;
  const Surfaces& surfaces() const;  // made at the first call

 private:
  struct State;
  void intersectPackets(std::span<const Ray> rays, std::span<Hit> hits, bool close) const;
  std::unique_ptr<State> state_;
};

// Where a ray that leaves p towards the side of unit normal n starts, clear of the surface at p: moved by a few ulps of
// the coordinates, never by a visible distance (0.1 mm at 10 m from the origin).
inline Vec3 offsetOrigin(Vec3 p, Vec3 n) {
  const float scale = std::max(1.0f, maxComponent(abs(p)));
  return p + n * (1e-5f * scale);
}

}  // namespace roomlight
