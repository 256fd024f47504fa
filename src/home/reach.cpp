#include "home/cameras.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sampling.h"
#include "scene/surface.h"
#include "trace/camera_rays.h"

namespace roomlight::home {
namespace {

constexpr int kAcross = 128, kDown = 72;  // paths
constexpr int kBounces = 4, kMostPanes = 8;
constexpr int kCells = 64;                // along the longest side
constexpr float kLeastCellM = 1;
constexpr float kHomeM = 25;              // smaller scenes are left whole
constexpr double kMostKept = 1.0 / 3;     // of the surfaces

// Cells of a grid over the scene.
class Cells {
 public:
  explicit Cells(const Bounds3& bounds) : low_(bounds.lo) {
    const Vec3 size = bounds.size();
    cellM_ = std::max(kLeastCellM, maxComponent(size) / kCells);
    for (int k = 0; k < 3; ++k) dims_[k] = 1 + static_cast<int>(size[k] / cellM_);
    marked_.assign(static_cast<size_t>(dims_[0]) * static_cast<size_t>(dims_[1]) * static_cast<size_t>(dims_[2]), 0);
  }
  size_t at(Vec3 p) const { return index(along(p, 0), along(p, 1), along(p, 2)); }
  void mark(size_t cell) { marked_[cell] = 1; }
  void widen() {
    const std::vector<uint8_t> before = marked_;
    for (int z = 0; z < dims_[2]; ++z) {
      for (int y = 0; y < dims_[1]; ++y) {
        for (int x = 0; x < dims_[0]; ++x) {
          if (before[index(x, y, z)]) markAround(x, y, z);
        }
      }
    }
  }
  bool any(const Bounds3& b) const {
    for (int z = along(b.lo, 2); z <= along(b.hi, 2); ++z) {
      for (int y = along(b.lo, 1); y <= along(b.hi, 1); ++y) {
        for (int x = along(b.lo, 0); x <= along(b.hi, 0); ++x) {
          if (marked_[index(x, y, z)]) return true;
        }
      }
    }
    return false;
  }

 private:
  int along(Vec3 p, int axis) const {
    return std::clamp(static_cast<int>((p[axis] - low_[axis]) / cellM_), 0, dims_[axis] - 1);
  }
  size_t index(int x, int y, int z) const {
    return (static_cast<size_t>(z) * static_cast<size_t>(dims_[1]) + static_cast<size_t>(y)) *
               static_cast<size_t>(dims_[0]) +
           static_cast<size_t>(x);
  }
  void markAround(int x, int y, int z) {
    for (int k = std::max(0, z - 1); k <= std::min(dims_[2] - 1, z + 1); ++k) {
      for (int j = std::max(0, y - 1); j <= std::min(dims_[1] - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(dims_[0] - 1, x + 1); ++i) marked_[index(i, j, k)] = 1;
      }
    }
  }

  Vec3 low_;
  float cellM_ = 1;
  int dims_[3] = {1, 1, 1};
  std::vector<uint8_t> marked_;
};

// What a ray meets, panes on the way included; the last place is where light is stopped.
struct Trace {
  std::vector<Vec3> places;
  std::optional<Vec3> normal;  // there, towards the ray; none: the ray left the scene
};
Trace follow(const RayScene& rays, Ray ray) {
  Trace trace;
  for (int i = 0; i <= kMostPanes; ++i) {
    const Hit hit = rays.intersect(ray);
    if (!hit.valid()) return trace;
    const Vec3 p = ray.origin + ray.direction * hit.t, n = normalize(dot(hit.ng, ray.direction) > 0 ? -hit.ng : hit.ng);
    trace.places.push_back(p);
    const Scene& scene = rays.scene();
    if (!letsLightThrough(scene.materials[static_cast<size_t>(
            scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)].material)])) {
      trace.normal = n;
      return trace;
    }
    ray.origin = offsetOrigin(p, -n);
  }
  return trace;
}

// Where lamps and shining things are: from each place of a path one of them is looked for.
std::vector<Vec3> lightsOf(const Scene& scene) {
  std::vector<Vec3> lights;
  for (const Lamp& lamp : scene.lamps) lights.push_back(lamp.position);
  for (const Instance& i : scene.instances) {
    if (!isBlack(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)].emission))
      lights.push_back(instanceBounds(scene, i).centre());
  }
  return lights;
}

void lookFor(const RayScene& rays, Vec3 from, Vec3 light, std::vector<Vec3>& places) {
  const Hit hit = rays.intersect({from, light - from, 0, 0.98f});
  places.push_back(hit.valid() ? from + (light - from) * hit.t : light);
}

void tracePath(const RayScene& rays, const std::vector<Vec3>& lights, const Ray& first, Rng& random,
               std::vector<Vec3>& places) {
  Ray ray = first;
  for (int bounce = 0; bounce <= kBounces; ++bounce) {
    const Trace met = follow(rays, ray);
    places.insert(places.end(), met.places.begin(), met.places.end());
    if (!met.normal) return;
    const Vec3 from = offsetOrigin(met.places.back(), *met.normal);
    for (const Sun& sun : rays.scene().suns) {
      if (dot(sun.toLight, *met.normal) <= 0) continue;
      const Trace toSun = follow(rays, {from, sun.toLight, 0, kInfinity});
      places.insert(places.end(), toSun.places.begin(), toSun.places.end());
    }
    if (!lights.empty())
      lookFor(rays, from,
              lights[std::min(lights.size() - 1,
                              static_cast<size_t>(random.uniform() * static_cast<float>(lights.size())))],
              places);
    ray = {from, Frame(*met.normal).toWorld(sampleCosineHemisphere(random.uniform2())), 0, kInfinity};
  }
}

void markReached(const RayScene& rays, const Camera& camera, Cells& cells) {
  const CameraRays through(camera, kAcross, kDown);
  const std::vector<Vec3> lights = lightsOf(rays.scene());
  std::vector<std::vector<Vec3>> rows(kDown);
  parallelFor(rows.size(), 1, [&](size_t y) {
    for (int x = 0; x < kAcross; ++x) {
      Rng random(y * kAcross + static_cast<size_t>(x), 0, 0);
      tracePath(rays, lights,
                through.ray(static_cast<float>(x) + random.uniform(), static_cast<float>(y) + random.uniform()), random,
                rows[y]);
    }
  });
  for (const auto& row : rows) {
    for (const Vec3 p : row) cells.mark(cells.at(p));
  }
  cells.mark(cells.at(camera.worldFromCamera.w));
}

struct Kept {
  std::vector<uint32_t> triangles;
  double keptM2 = 0, allM2 = 0;
};

Kept keptOf(const Scene& scene, const Instance& instance, const Cells& cells) {
  Kept kept;
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    Bounds3 b;
    Vec3 c[3];
    for (uint32_t k = 0; k < 3; ++k)
      b.add(c[k] = instance.worldFromObject.point(mesh.positions[mesh.indices[3 * t + k]]));
    const double m2 = 0.5 * static_cast<double>(length(cross(c[1] - c[0], c[2] - c[0])));
    kept.allM2 += m2;
    if (!cells.any(b)) continue;
    kept.keptM2 += m2;
    kept.triangles.push_back(t);
  }
  return kept;
}

std::vector<Kept> keptOf(const Scene& scene, Cells cells) {
  cells.widen();
  std::vector<Kept> kept(scene.instances.size());
  parallelFor(kept.size(), 1, [&](size_t i) { kept[i] = keptOf(scene, scene.instances[i], cells); });
  return kept;
}

bool areMost(const std::vector<Kept>& kept) {
  double keptM2 = 0, allM2 = 0;
  for (const Kept& k : kept) keptM2 += k.keptM2, allM2 += k.allM2;
  return keptM2 > kMostKept * allM2;
}

template <class T>
void pick(std::vector<T>& values, const std::vector<uint32_t>& vertices) {
  if (values.empty()) return;
  std::vector<T> picked;
  picked.reserve(vertices.size());
  for (const uint32_t v : vertices) picked.push_back(values[v]);
  values = std::move(picked);
}

// Of these triangles, and the vertices that they need.
Mesh partOf(const Mesh& mesh, const std::vector<uint32_t>& triangles) {
  Mesh part = mesh;
  std::vector<uint32_t> vertices, renamed(mesh.positions.size(), kNoHit);
  part.indices.clear();
  for (const uint32_t t : triangles) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = mesh.indices[3 * t + k];
      if (renamed[v] == kNoHit) renamed[v] = static_cast<uint32_t>(vertices.size()), vertices.push_back(v);
      part.indices.push_back(renamed[v]);
    }
  }
  pick(part.positions, vertices), pick(part.normals, vertices), pick(part.tangents, vertices),
      pick(part.tangentSigns, vertices);
  pick(part.uv[0], vertices), pick(part.uv[1], vertices), pick(part.colors, vertices), pick(part.colorAlphas, vertices);
  return part;
}

}  // namespace

std::optional<Scene> withinReach(const RayScene& rays, std::span<const Camera> cameras) {
  const Scene& scene = rays.scene();
  if (maxComponent(rays.bounds().size()) < kHomeM) return std::nullopt;
  Cells cells(rays.bounds());
  std::vector<Kept> kept;
  for (size_t i = 0; i < cameras.size(); ++i) {
    markReached(rays, cameras[i], cells);
    // Of many cameras the first ones may tell: others only add to what they reach.
    if (!std::has_single_bit(i + 1) && i + 1 < cameras.size()) continue;
    kept = keptOf(scene, cells);
    if (areMost(kept)) return std::nullopt;
  }
  cells.widen();

  Scene out;
  out.materials = scene.materials, out.textures = scene.textures, out.leaves = scene.leaves;
  out.suns = scene.suns, out.sky = scene.sky, out.rooms = scene.rooms;
  out.cameras = scene.cameras, out.cameraInUse = scene.cameraInUse;
  for (const Lamp& lamp : scene.lamps) {
    if (cells.any({lamp.position, lamp.position})) out.lamps.push_back(lamp);
  }
  std::vector<int> whole(scene.meshes.size(), -1);  // meshes that are kept whole, in the new scene
  for (size_t i = 0; i < kept.size(); ++i) {
    if (kept[i].triangles.empty()) continue;
    Instance instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    const bool all = kept[i].triangles.size() == mesh.triangleCount();
    int& known = whole[static_cast<size_t>(instance.mesh)];
    if (!all || known < 0) {
      out.meshes.push_back(all ? mesh : partOf(mesh, kept[i].triangles));
      if (all) known = static_cast<int>(out.meshes.size()) - 1;
    }
    instance.mesh = all ? known : static_cast<int>(out.meshes.size()) - 1;
    out.instances.push_back(std::move(instance));
  }
  return out;
}

}  // namespace roomlight::home
