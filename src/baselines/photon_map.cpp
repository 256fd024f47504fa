#include "baselines/photon_map.h"

#include <cmath>

#include "base/parallel.h"
#include "base/simd.h"

namespace roomlight {
namespace {

constexpr size_t kLargestLeaf = 16;
constexpr int kExponentBias = 128;

uint32_t packFlux(Vec3 flux) {
  const float largest = maxComponent(flux);
  if (!(largest > 1e-30f)) return 0;
  int exponent = 0;
  std::frexp(largest, &exponent);
  // The mantissa that would round up to 256 takes the next exponent.
  if (largest * std::ldexp(1.0f, 8 - exponent) >= 255.5f) ++exponent;
  const float scale = std::ldexp(1.0f, 8 - exponent);
  const auto part = [&](float v) { return static_cast<uint32_t>(std::lround(std::max(0.0f, v) * scale)); };
  return part(flux.x) | part(flux.y) << 8 | part(flux.z) << 16 |
         static_cast<uint32_t>(std::clamp(exponent + kExponentBias, 1, 255)) << 24;
}

Vec3 unpackFlux(uint32_t v) {
  if (v >> 24 == 0) return {};
  const float scale = std::ldexp(1.0f, static_cast<int>(v >> 24) - kExponentBias - 8);
  return Vec3(static_cast<float>(v & 255), static_cast<float>(v >> 8 & 255), static_cast<float>(v >> 16 & 255)) * scale;
}

uint16_t packDirection(Vec3 d) {
  const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  float u = d.x / sum, v = d.y / sum;
  if (d.z < 0) {
    const float uu = u;
    u = (1 - std::abs(v)) * std::copysign(1.0f, uu);
    v = (1 - std::abs(uu)) * std::copysign(1.0f, v);
  }
  const auto byte = [](float f) { return static_cast<uint32_t>(std::lround(127 * std::clamp(f, -1.0f, 1.0f)) + 127); };
  return static_cast<uint16_t>(byte(u) | byte(v) << 8);
}

Vec3 unpackDirection(uint16_t packed) {
  const float u = static_cast<float>((packed & 255) - 127) / 127, v = static_cast<float>((packed >> 8) - 127) / 127;
  Vec3 d(u, v, 1 - std::abs(u) - std::abs(v));
  const float fold = std::max(-d.z, 0.0f);
  d.x -= std::copysign(fold, d.x), d.y -= std::copysign(fold, d.y);
  return normalize(d);
}

struct Place {
  Vec3 p;
  uint32_t index;
};

int longestAxis(const Place* begin, const Place* end) {
  Bounds3 bounds;
  for (const Place* i = begin; i < end; ++i) bounds.add(i->p);
  const Vec3 size = bounds.size();
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

}  // namespace

// Level by level: every node finds its median by itself. Ties go by number, so that the order is one alone.
PhotonMap::PhotonMap(std::span<const Photon> photons, std::vector<uint32_t>* order) {
  const size_t n = photons.size();
  std::vector<Place> places(n);
  for (size_t i = 0; i < n; ++i) places[i] = {photons[i].p, static_cast<uint32_t>(i)};
  while ((n >> levels_) + 1 > kLargestLeaf) ++levels_;
  nodes_.resize((size_t{1} << levels_) - 1);
  std::vector<uint32_t> borders{0, static_cast<uint32_t>(n)};
  for (int level = 0; level < levels_; ++level) {
    const size_t count = size_t{1} << level;
    std::vector<uint32_t> next(2 * count + 1);
    parallelFor(count, 1, [&](size_t k) {
      const uint32_t begin = borders[k], end = borders[k + 1], middle = begin + (end - begin) / 2;
      Place* const first = places.data();
      const int axis = longestAxis(first + begin, first + end);
      std::nth_element(first + begin, first + middle, first + end, [axis](const Place& a, const Place& b) {
        return a.p[axis] < b.p[axis] || (a.p[axis] == b.p[axis] && a.index < b.index);
      });
      nodes_[count - 1 + k] = {places[middle].p[axis], axis};
      next[2 * k] = begin, next[2 * k + 1] = middle;
    });
    next.back() = static_cast<uint32_t>(n);
    borders = std::move(next);
  }
  for (std::vector<float>* coordinates : {&x_, &y_, &z_}) coordinates->reserve(n + kLanes);
  rest_.reserve(n);
  for (const Place& place : places) {
    const Photon& photon = photons[place.index];
    x_.push_back(photon.p.x), y_.push_back(photon.p.y), z_.push_back(photon.p.z);
    rest_.push_back({packFlux(photon.fluxLm), packDirection(photon.wi), packDirection(photon.n)});
    if (order) order->push_back(place.index);
  }
  for (std::vector<float>* coordinates : {&x_, &y_, &z_}) coordinates->resize(n + kLanes);
}

Vec3 PhotonMap::fluxLm(size_t i) const { return unpackFlux(rest_[i].flux); }
Vec3 PhotonMap::direction(size_t i) const { return unpackDirection(rest_[i].wi); }
Vec3 PhotonMap::normal(size_t i) const { return unpackDirection(rest_[i].n); }

void PhotonMap::distances(const PhotonQuery& q, size_t first, float* out) const {
  const Float8 dx = Float8::load(&x_[first]) - Float8(q.p.x);
  const Float8 dy = Float8::load(&y_[first]) - Float8(q.p.y);
  const Float8 dz = Float8::load(&z_[first]) - Float8(q.p.z);
  const Float8 along = fma(dx, Float8(q.n.x), fma(dy, Float8(q.n.y), dz * Float8(q.n.z)));
  const Float8 d2 = fma(dx, dx, fma(dy, dy, dz * dz));
  fma(along * along, Float8(q.flatness * q.flatness - 1), d2).store(out);
}

void PhotonMap::nearest(const PhotonQuery& q, size_t k, std::vector<NearPhoton>& out) const {
  nearest(q, k, out, [](uint32_t, Vec3) { return true; });
}

}  // namespace roomlight
