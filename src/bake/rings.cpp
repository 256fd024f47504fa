#include "bake/rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "scene/mesh_vertices.h"
#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr float kLevel = 0.97f;   // cosine between a normal and the vertical: 14°
constexpr float kWider = 4;       // a ring than the one within
constexpr float kAtLeast = 2;     // so many times as wide as the innermost ring is what is cut
constexpr size_t kMostRings = 6;
constexpr float kThin = 0.05f;    // of its width: what is no higher is a ground
constexpr float kOnLine = 1e-6f;  // of the extent: corners so near to a line are on it

struct Rectangle {
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.z)}, high = {std::max(high.x, p.x), std::max(high.y, p.z)};
  }
  float extentM() const { return std::max(high.x - low.x, high.y - low.y); }
  bool has(Vec3 p) const { return p.x >= low.x && p.x <= high.x && p.z >= low.y && p.z <= high.y; }
};

// What of an instance lies level.
struct Ground {
  std::vector<uint8_t> level;  // triangles
  Rectangle extent;
  float highestM = -kInfinity;
};

Ground groundOf(const Scene& scene, uint32_t instance) {
  Ground out;
  const size_t count = scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)].triangleCount();
  for (uint32_t t = 0; t < count; ++t) {
    const TriangleVertices v = worldTriangle(scene, instance, t);
    const Vec3 n = cross(v.b - v.a, v.c - v.a);
    out.level.push_back(std::abs(n.y) > kLevel * length(n));
    if (!out.level.back()) continue;
    for (const Vec3 p : {v.a, v.b, v.c}) out.extent.add(p), out.highestM = std::max(out.highestM, p.y);
  }
  return out;
}

// From the innermost outwards; empty: there is nothing to gain.
std::vector<Rectangle> ringsAround(const Bounds3& things, const Ground& ground) {
  const float shadowM = things.hi.y - ground.highestM;
  if (!(shadowM > 0)) return {};
  const Vec3 middle = things.centre();
  const Vec2 half{things.size().x / 2 + shadowM, things.size().z / 2 + shadowM};
  std::vector<Rectangle> out;
  for (float times = 1; out.size() < kMostRings; times *= kWider) {
    const Rectangle ring{{middle.x - half.x * times, middle.z - half.y * times},
                         {middle.x + half.x * times, middle.z + half.y * times}};
    if (!(ring.extentM() * kAtLeast <= ground.extent.extentM())) break;
    out.push_back(ring);
  }
  return out;
}

bool comesAfter(Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) > std::tie(b.x, b.y, b.z); }

// A mesh cut along lines of one world axis, and what is known of its triangles.
class Cutter {
 public:
  Cutter(Mesh& mesh, const Affine& worldFromObject, std::vector<uint8_t>& level)
      : mesh_(mesh), worldFromObject_(worldFromObject), level_(level) {}

  void cut(int axis, float at, float onLineM) {
    between_.clear();
    const size_t count = mesh_.triangleCount();
    for (size_t t = 0; t < count; ++t) {
      const std::array<uint32_t, 3> corners{mesh_.indices[3 * t], mesh_.indices[3 * t + 1], mesh_.indices[3 * t + 2]};
      std::array<float, 3> beyond;
      for (size_t k = 0; k < 3; ++k) {
        beyond[k] = worldFromObject_.point(mesh_.positions[corners[k]])[axis] - at;
        if (std::abs(beyond[k]) <= onLineM) beyond[k] = 0;
      }
      if (std::any_of(beyond.begin(), beyond.end(), [](float b) { return b < 0; }) &&
          std::any_of(beyond.begin(), beyond.end(), [](float b) { return b > 0; }))
        cutTriangle(t, corners, beyond);
    }
  }

 private:
  void cutTriangle(size_t t, const std::array<uint32_t, 3>& corners, const std::array<float, 3>& beyond) {
    std::vector<uint32_t> below, above;
    for (size_t k = 0; k < 3; ++k) {
      const size_t next = (k + 1) % 3;
      if (beyond[k] <= 0) below.push_back(corners[k]);
      if (beyond[k] >= 0) above.push_back(corners[k]);
      if (beyond[k] * beyond[next] < 0) {
        const uint32_t v = between(corners[k], corners[next], beyond[k], beyond[next]);
        below.push_back(v), above.push_back(v);
      }
    }
    bool first = true;
    for (const std::vector<uint32_t>& polygon : {below, above}) {
      for (size_t k = 1; k + 1 < polygon.size(); ++k, first = false) {
        const std::array<uint32_t, 3> triangle{polygon[0], polygon[k], polygon[k + 1]};
        if (first) {
          std::copy(triangle.begin(), triangle.end(), mesh_.indices.begin() + static_cast<ptrdiff_t>(3 * t));
        } else {
          mesh_.indices.insert(mesh_.indices.end(), triangle.begin(), triangle.end());
          level_.push_back(uint8_t{level_[t]});
        }
      }
    }
  }

  // One for both triangles of an edge; at the same place where these have vertices of their own.
  uint32_t between(uint32_t a, uint32_t b, float beyondA, float beyondB) {
    if (comesAfter(mesh_.positions[a], mesh_.positions[b])) std::swap(a, b), std::swap(beyondA, beyondB);
    const auto [known, isNew] = between_.try_emplace({a, b}, 0);
    if (isNew) known->second = addVertexBetween(mesh_, a, b, beyondA / (beyondA - beyondB));
    return known->second;
  }

  Mesh& mesh_;
  const Affine& worldFromObject_;
  std::vector<uint8_t>& level_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> between_;
};

std::vector<Bounds3> boundsOfInstances(const Scene& scene) {
  std::vector<Bounds3> out;
  for (const Instance& i : scene.instances) out.push_back(instanceBounds(scene, i));
  return out;
}

bool isThing(const Bounds3& bounds, float extentM) { return maxComponent(bounds.size()) < extentM / 2; }

Bounds3 boundsOfThings(const std::vector<Bounds3>& all, float extentM) {
  Bounds3 out;
  for (const Bounds3& bounds : all) {
    if (!bounds.empty() && isThing(bounds, extentM)) out.add(bounds.lo), out.add(bounds.hi);
  }
  return out;
}

std::vector<uint8_t> cutAlong(const std::vector<Rectangle>& rings, Ground ground, Scene& scene, uint32_t instance) {
  const Instance& placed = scene.instances[instance];
  Mesh& mesh = scene.meshes[static_cast<size_t>(placed.mesh)];
  Cutter cutter(mesh, placed.worldFromObject, ground.level);
  const float onLineM = kOnLine * ground.extent.extentM();
  for (const Rectangle& ring : rings) {
    cutter.cut(0, ring.low.x, onLineM), cutter.cut(0, ring.high.x, onLineM);
    cutter.cut(2, ring.low.y, onLineM), cutter.cut(2, ring.high.y, onLineM);
  }
  std::vector<uint8_t> out(mesh.triangleCount(), kNoRing);
  for (uint32_t t = 0; t < out.size(); ++t) {
    if (!ground.level[t]) continue;
    const TriangleVertices v = worldTriangle(scene, instance, t);
    const Vec3 middle = (v.a + v.b + v.c) / 3;
    const auto within = std::find_if(rings.begin(), rings.end(), [&](const Rectangle& r) { return r.has(middle); });
    out[t] = static_cast<uint8_t>(within - rings.begin());
  }
  return out;
}

}  // namespace

float extentLookedAt(const Scene& scene) {
  const std::vector<Bounds3> all = boundsOfInstances(scene);
  Bounds3 whole;
  for (const Bounds3& bounds : all) {
    if (!bounds.empty()) whole.add(bounds.lo), whole.add(bounds.hi);
  }
  if (whole.empty()) return 0;
  const float extentM = maxComponent(whole.size());
  const bool onGround = std::all_of(all.begin(), all.end(), [&](const Bounds3& bounds) {
    return bounds.empty() || isThing(bounds, extentM) ||
           bounds.size().y < kThin * std::max(bounds.size().x, bounds.size().z);
  });
  const Bounds3 things = boundsOfThings(all, extentM);
  return onGround && !things.empty() ? maxComponent(things.size()) : extentM;
}

Rings cutIntoRings(Scene& scene, float wideM) {
  Rings out(scene.meshes.size());
  const std::vector<Bounds3> bounds = boundsOfInstances(scene);
  std::vector<size_t> uses(scene.meshes.size());
  for (const Instance& i : scene.instances) ++uses[static_cast<size_t>(i.mesh)];
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const auto mesh = static_cast<size_t>(scene.instances[i].mesh);
    const Vec3 size = bounds[i].size();
    if (uses[mesh] != 1 || !(std::max(size.x, size.z) > wideM)) continue;
    Ground ground = groundOf(scene, i);
    if (!(ground.extent.extentM() > wideM)) continue;
    const Bounds3 things = boundsOfThings(bounds, ground.extent.extentM());
    if (things.empty()) continue;
    const std::vector<Rectangle> rings = ringsAround(things, ground);
    if (!rings.empty()) out[mesh] = cutAlong(rings, std::move(ground), scene, i);
  }
  return out;
}

}  // namespace roomlight::bake
