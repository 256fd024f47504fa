#include "bake/seen_sides.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>

#include "bake/watchers.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"
#include "home/rooms.h"
#include "trace/light_layers.h"
#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr float kEyesApartM = 0.6f;
constexpr float kHeightsM[] = {0.5f, 1.1f, 1.65f};  // a child or someone lying, sitting, standing
constexpr int kSurfaces = 12;                       // along one ray
constexpr float kGrazing = 0.01f;  // cosine: rays along a surface slip through the edges of what is closed
constexpr float kSamePlaceM = 0.0003f;  // of two surfaces so near to each other one is seen
constexpr size_t kFewEyes = 6;  // that see each other, and no others of their room: they are shut in
constexpr size_t kAskedEyes = 8;  // of those shut in: whether it is the inside of a thing
constexpr uint32_t kAskedRays = 32;  // of each

bool letsThrough(const Material& m) {
  return m.alphaMode != AlphaMode::Opaque || m.transmission > 0 || m.glazing.panes > 0;
}

Vec2 lowest(const Room& room) {
  Vec2 low = room.floor.front();
  for (const Vec2 p : room.floor) low = {std::min(low.x, p.x), std::min(low.y, p.y)};
  return low;
}

Vec2 highest(const Room& room) {
  Vec2 high = room.floor.front();
  for (const Vec2 p : room.floor) high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  return high;
}

// Places of one room where an eye could be, each with those beside, below and above it.
class EyeGrid {
 public:
  EyeGrid(const RayScene& rays, const Room& room) : rays_(rays) {
    const Vec2 low = lowest(room), high = highest(room);
    const auto steps = [](float length) { return static_cast<int>(std::min(length / kEyesApartM, 1e4f)); };
    for (int i = 0; i <= steps(high.x - low.x); ++i) {
      for (int j = 0; j <= steps(high.y - low.y); ++j) {
        for (size_t h = 0; h < std::size(kHeightsM); ++h) {
          const Vec3 eye{low.x + (static_cast<float>(i) + 0.5f) * kEyesApartM, room.elevationM + kHeightsM[h],
                         low.y + (static_cast<float>(j) + 0.5f) * kEyesApartM};
          if (home::isIn(room, eye)) eyes_[{i, j, static_cast<int>(h)}] = {eye, -1};
        }
      }
    }
  }
  // Those with a way to many others: one inside a wardrobe has none. Nor do those in a large hollow block count.
  void addOpen(std::vector<Vec3>& out) {
    std::vector<std::vector<Vec3>> regions;
    for (auto& [place, eye] : eyes_) {
      if (eye.region < 0) fill(place, static_cast<int>(regions.size())), regions.emplace_back();
      regions[static_cast<size_t>(eye.region)].push_back(eye.position);
    }
    size_t most = 0;
    for (const auto& region : regions) most = std::max(most, region.size());
    for (auto& region : regions) {
      if (region.size() <= std::min(kFewEyes, eyes_.size() / 2) || (region.size() < most && isInsideOfThing(region)))
        region.clear();
    }
    for (const auto& [place, eye] : eyes_) {
      if (!regions[static_cast<size_t>(eye.region)].empty()) out.push_back(eye.position);
    }
  }

 private:
  using Place = std::array<int, 3>;
  struct Eye {
    Vec3 position;
    int region;
  };
  void fill(const Place& first, int region) {
    std::vector<Place> ring{first};
    eyes_[first].region = region;
    for (size_t k = 0; k < ring.size(); ++k) {
      const Place at = ring[k];
      for (size_t axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          Place next = at;
          next[axis] += step;
          const auto beside = eyes_.find(next);
          if (beside == eyes_.end() || beside->second.region >= 0) continue;
          const Vec3 from = eyes_[at].position;
          if (rays_.intersect({from, beside->second.position - from, 0, 1}).valid()) continue;
          beside->second.region = region, ring.push_back(next);
        }
      }
    }
  }

  // Whether eyes see backs of surfaces more than all else: walls of a room turn their faces to it.
  bool isInsideOfThing(std::span<const Vec3> eyes) const {
    uint32_t backs = 0, rays = 0;
    for (size_t k = 0; k < kAskedEyes; ++k) {
      const Vec3 eye = eyes[k * eyes.size() / kAskedEyes];
      for (uint32_t i = 0; i < kAskedRays; ++i, ++rays) {
        Sampler sampler(k, i, 1);
        const Ray ray{eye, sampleSphere(sampler.next2())};
        const Hit hit = rays_.intersect(ray);
        backs += hit.valid() && meetsBack(rays_.scene(), hit, ray.direction);
      }
    }
    return 2 * backs > rays;
  }

  const RayScene& rays_;
  std::map<Place, Eye> eyes_;
};

class Look {
 public:
  Look(const RayScene& rays, std::span<const Vec3> eyes, SeenSides& seen) : rays_(rays), eyes_(eyes), seen_(seen) {}

  void around(size_t count) {
    const size_t recorded = std::min(count, kRecordedRays);
    std::vector<Watchers::Sighting> sightings(recorded * kOfRay);
    parallelFor(count, 1024, [&](size_t i) {
      const size_t eye = i % eyes_.size();
      Sampler sampler(eye, static_cast<uint32_t>(i / eyes_.size()), 0);
      size_t k = 0;
      along({eyes_[eye], sampleSphere(sampler.next2())}, [&](const Hit& hit, Vec3 p, bool back) {
        seen_.mark(hit.instance, hit.triangle, back);
        if (i < recorded) sightings[i * kOfRay + k++ % kOfRay] = {Watchers::cellOf(p), static_cast<uint32_t>(eye)};
        return true;
      });
    });
    std::erase_if(sightings, [](const Watchers::Sighting& s) { return s.cell == 0; });
    watchers_ = Watchers(std::move(sightings));
  }

  void again() {
    const Scene& scene = rays_.scene();
    const SeenSides met = seen_;  // what others find meanwhile does not count
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
      const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
      parallelFor(mesh.triangleCount(), 256, [&](size_t t) {
        const auto triangle = static_cast<uint32_t>(t);
        for (const bool back : {false, true}) {
          if (!met.seen(i, triangle, back) && watched(i, triangle, back)) seen_.mark(i, triangle, back);
        }
      });
    }
  }

 private:
  // `meets(hit, place, back)` of each surface along a ray, as long as it says to go on.
  template <class Meets>
  void along(Ray ray, Meets&& meets) const {
    for (int k = 0; k < kSurfaces; ++k) {
      const Hit hit = rays_.intersect(ray);
      if (!hit.valid()) return;
      const SurfacePlace place = placeAt(rays_.scene(), hit, ray.direction);
      if (!meets(hit, place.p, meetsBack(rays_.scene(), hit, ray.direction)) || !letsThrough(*place.material)) return;
      ray.origin = offsetOrigin(place.p, -place.ng);
    }
  }

  bool watched(uint32_t instance, uint32_t triangle, bool back) const {
    const TriangleVertices v = worldTriangle(rays_.scene(), instance, triangle);
    const Vec3 normal = cross(v.b - v.a, v.c - v.a) * (back ? -1.0f : 1.0f);
    Sampler sampler(triangle, 0, instance);
    int found = 0, covered = 0;
    for (const uint32_t eye : watchers_.of((v.a + v.b + v.c) / 3)) {
      const Vec2 b = sampleTriangle(sampler.next2());
      const Vec3 target = v.a + (v.b - v.a) * b.x + (v.c - v.a) * b.y, way = target - eyes_[eye];
      if (!(dot(way, normal) < -kGrazing * length(way) * length(normal))) continue;
      along({eyes_[eye], normalize(way)}, [&](const Hit& hit, Vec3 p, bool) {
        const bool same = hit.instance == instance && hit.triangle == triangle;
        found += same;
        covered += !same && length(p - target) < kSamePlaceM && !(hit.instance == instance && touch(v, hit));
        return !same;
      });
      if (found > 1 && covered == 0) return true;
    }
    return found > covered;
  }

  bool touch(const TriangleVertices& v, const Hit& hit) const {
    const TriangleVertices w = worldTriangle(rays_.scene(), hit.instance, hit.triangle);
    for (const Vec3 a : {v.a, v.b, v.c}) {
      for (const Vec3 b : {w.a, w.b, w.c}) {
        if (a == b) return true;
      }
    }
    return false;
  }

  static constexpr size_t kOfRay = 2, kRecordedRays = size_t{1} << 21;  // sightings: the last ones of each ray
  const RayScene& rays_;
  const std::span<const Vec3> eyes_;
  SeenSides& seen_;
  Watchers watchers_{{}};
};

}  // namespace

SeenSides::SeenSides(const Scene& scene) {
  size_t count = 0;
  for (const Instance& instance : scene.instances) {
    first_.push_back(count);
    count += scene.meshes[static_cast<size_t>(instance.mesh)].triangleCount();
  }
  sides_.resize(count);
}

void SeenSides::mark(uint32_t instance, uint32_t triangle, bool back) {
  std::atomic_ref(sides_[first_[instance] + triangle])
      .fetch_or(static_cast<uint8_t>(back ? 2 : 1), std::memory_order_relaxed);
}

bool meetsBack(const Scene& scene, const Hit& hit, Vec3 direction) {
  const TriangleVertices v = worldTriangle(scene, hit.instance, hit.triangle);
  return dot(cross(v.b - v.a, v.c - v.a), direction) > 0;
}

std::vector<Camera> camerasInside(const Scene& scene) {
  std::vector<Camera> out;
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const Camera& c = scene.cameras[i];
    const bool own = static_cast<int>(i) == scene.cameraInUse && c.cutHeightM == kInfinity;
    const bool inside = scene.rooms.empty() || roomAt(scene, c.worldFromCamera.w) >= 0;
    if (c.projection == Projection::Perspective && (inside || own)) out.push_back(c);
  }
  return out;
}

size_t cameraInUse(const Scene& scene, const std::vector<Camera>& cameras) {
  if (scene.cameras.empty()) return 0;
  const Camera& own = scene.cameras[static_cast<size_t>(scene.cameraInUse)];
  const auto found = std::find_if(cameras.begin(), cameras.end(), [&](const Camera& c) {
    return c.name == own.name && c.worldFromCamera == own.worldFromCamera;
  });
  return found == cameras.end() ? 0 : static_cast<size_t>(found - cameras.begin());
}

std::vector<Vec3> eyesIn(const RayScene& rays) {
  std::vector<Vec3> eyes;
  for (const Camera& camera : camerasInside(rays.scene())) eyes.push_back(camera.worldFromCamera.w);
  for (const Room& room : rays.scene().rooms) {
    if (!room.floor.empty()) EyeGrid(rays, room).addOpen(eyes);
  }
  return eyes;
}

SeenSides seenFrom(const RayScene& rays, std::span<const Vec3> eyes, size_t count) {
  SeenSides seen(rays.scene());
  if (eyes.empty()) return seen;
  Look look(rays, eyes, seen);
  look.around(count);
  look.again();
  return seen;
}

}  // namespace roomlight::bake
