#include "reference/visible_lights.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "base/parallel.h"
#include "trace/bsdf.h"
#include "trace/light_parts_learner.h"
#include "trace/surfaces.h"

namespace roomlight {
namespace {

constexpr float kCellM = 0.4f,
                kOffM = 0.137f;  // floors and walls stand on round coordinates, which shall be within cells
constexpr int kMostVertices = 8;
constexpr size_t kPathsAtOnce = 256, kCellsAtOnce = 16, kMostPlaces = 64;  // of a cell
constexpr uint64_t kPathKey = uint64_t{1} << 41,
                   kLookKey = uint64_t{1} << 42;  // other random numbers than those of pixels and light paths

int faceOf(Vec3 n) {
  const Vec3 a = abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 2 * axis + (n[axis] < 0 ? 1 : 0);
}

}  // namespace

uint64_t VisibleLights::keyOf(Vec3 p, Vec3 n) {
  const auto part = [](float x) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor((x + kOffM) / kCellM)) & 0xfffff);
  };
  return (part(p.x) | part(p.y) << 20 | part(p.z) << 40) * 8 + static_cast<uint64_t>(faceOf(n)) + 1;
}

void VisibleLights::add(uint64_t key, uint32_t cell) {
  size_t i = mix64(key) & (table_.size() - 1);
  while (table_[i].key != 0) i = (i + 1) & (table_.size() - 1);
  table_[i] = {key, cell};
}

std::span<const LightPart> VisibleLights::partsAt(Vec3 p, Vec3 n) const {
  if (table_.empty()) return {};
  const uint64_t key = keyOf(p, n);
  for (size_t i = mix64(key) & (table_.size() - 1); table_[i].key != 0; i = (i + 1) & (table_.size() - 1)) {
    if (table_[i].key == key)
      return std::span(parts_).subspan(first_[table_[i].cell], first_[table_[i].cell + 1] - first_[table_[i].cell]);
  }
  return {};
}

// Where it comes to, not what it carries.
void VisibleLights::follow(const RayScene& rays, Ray ray, Sampler& sampler, std::vector<Place>& out,
                           uint64_t& rayCount) {
  for (int k = 0; k < kMostVertices; ++k) {
    const Hit hit = rays.intersect(ray);
    ++rayCount;
    if (!hit.valid()) return;
    const SurfacePoint s = rays.surfaces().at(hit, ray.direction);
    const Bsdf bsdf(s.m, s.ns, s.ng, -ray.direction);
    if (!bsdf.isMirrorOnly()) out.push_back({offsetOrigin(s.p, s.ng), s.ng, keyOf(s.p, s.ng)});
    if ((s.m.alpha < 1 || s.m.transmission > 0) && sampler.fast1() < 0.5f) {
      ray.origin = offsetOrigin(s.p, -s.ng), ray.tMin = 0;
      continue;
    }
    const Vec2 u{sampler.fast1(), sampler.fast1()};
    const BsdfSample next = bsdf.sample(u, sampler.fast1());
    if (!next.valid() || dot(next.wi, s.ng) <= 0 || sampler.fast1() >= maxComponent(next.weight)) return;
    ray = {offsetOrigin(s.p, s.ng), next.wi, 0, kInfinity};
  }
}

// Where paths came to in one cell.
struct VisibleLights::PlacesInCell {
  static constexpr uint32_t kRays = 16, kFewRays = 4;
  std::span<const Place> places;

  size_t size() const { return places.size(); }
  Vec3 position(size_t k) const { return places[k].p; }
  Bounds3 bounds() const {
    Bounds3 out;
    for (const Place& at : places) out.add(at.p);
    return out;
  }
  const Place& draw(uint32_t k, uint32_t n, Sampler& sampler) const {
    return places[(k * places.size() / n + static_cast<size_t>(sampler.fast1() * static_cast<float>(places.size()))) %
                  places.size()];
  }
};

void VisibleLights::learn(const RayScene& rays, const Picture& picture, size_t paths, uint64_t seed,
                          const std::function<bool()>& stopped) {
  const LocalChoice kind{lights_};
  if (kind.count() < 2) return;
  struct Some {
    std::vector<Place> places;
    uint64_t rays = 0;
  };
  std::vector<Some> parts((paths + kPathsAtOnce - 1) / kPathsAtOnce);
  parallelFor(parts.size(), 1, [&](size_t part) {
    if (stopped()) return;
    for (size_t i = part * kPathsAtOnce; i < std::min(paths, (part + 1) * kPathsAtOnce); ++i) {
      Sampler sampler(kPathKey + i, 0, seed);
      const float x = sampler.fast1() * static_cast<float>(picture.width),
                  y = sampler.fast1() * static_cast<float>(picture.height);
      const Ray ray = picture.camera.seeing(rays, x, y);
      if (ray.tMax > 0) follow(rays, ray, sampler, parts[part].places, parts[part].rays);
    }
  });
  std::vector<Place> all;
  for (const Some& some : parts) all.insert(all.end(), some.places.begin(), some.places.end()), rayCount_ += some.rays;
  std::stable_sort(all.begin(), all.end(), [](const Place& a, const Place& b) { return a.key < b.key; });
  std::vector<size_t> first;
  for (size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i].key != all[i - 1].key) first.push_back(i);
  }
  std::vector<std::vector<LightPart>> found(first.size());
  std::atomic<uint64_t> traced = 0;
  parallelFor((first.size() + kCellsAtOnce - 1) / kCellsAtOnce, 1, [&](size_t some) {
    if (stopped()) return;
    withPartsLearner(kind, [&](auto& learner) {
      for (size_t c = some * kCellsAtOnce; c < std::min(first.size(), (some + 1) * kCellsAtOnce); ++c) {
        const size_t end = c + 1 < first.size() ? first[c + 1] : all.size();
        const std::span<const Place> places = std::span(all).subspan(first[c], std::min(kMostPlaces, end - first[c]));
        Sampler sampler(kLookKey + places[0].key, 0, seed);
        traced += learner.look(rays, kind, PlacesInCell{places}, sampler);
        learner.list(found[c]);
      }
    });
  });
  rayCount_ += traced;
  if (stopped()) return forget();
  table_.assign(std::bit_ceil(2 * first.size() + 2), {});
  first_ = {0};
  for (size_t c = 0; c < first.size(); ++c) {
    add(all[first[c]].key, static_cast<uint32_t>(c));
    parts_.insert(parts_.end(), found[c].begin(), found[c].end());
    first_.push_back(static_cast<uint32_t>(parts_.size()));
  }
}

}  // namespace roomlight
