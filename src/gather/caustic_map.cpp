#include "gather/caustic_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/simd.h"
#include "base/sorted_keys.h"

namespace roomlight {
namespace {

constexpr float kSmallestM = 0.01f;  // cells, as wide as the discs of their photons at most
constexpr float kLeastRadiusM = 0.003f;
constexpr size_t kEvery = 16;        // of photons one tells how dense they are
constexpr float kNearest = 16;       // of those within a disc
constexpr uint32_t kCounted = 64;    // of a cell, at most; each stands for as many as there are
constexpr float kFacing = 0.7f;      // cosine between normals of a place and of a photon
constexpr float kFlat = 0.3f;        // of a disc's radius: how far off its plane a place may lie
constexpr float kEvenPart = 0.05f;  // of the smallest disc's radius: within that its light hardly changes
constexpr float kBright = 4;         // times the mean flux: brighter photons are spread wider in proportion

float cellM(int level) { return kSmallestM * static_cast<float>(1 << level); }

float sum(Float8 v) {
  std::array<float, 8> lanes;
  v.store(lanes.data());
  return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

}  // namespace

CausticMap::Runs::Runs(std::span<const uint64_t> keys, std::span<const uint32_t> order) {
  size_t count = 0;
  forRuns(keys, order, [&](size_t, size_t) { ++count; });
  table_.assign(std::bit_ceil(std::max<size_t>(16, 2 * count)), {});
  const size_t mask = table_.size() - 1;
  forRuns(keys, order, [&](size_t begin, size_t end) {
    const uint64_t key = keys[order[begin]];
    size_t i = mix64(key) & mask;
    while (table_[i].end != 0) i = (i + 1) & mask;
    table_[i] = {key, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
  });
}

const CausticMap::Run* CausticMap::Runs::find(uint64_t key) const {
  const size_t mask = table_.size() - 1;
  for (size_t i = mix64(key) & mask; table_[i].end != 0; i = (i + 1) & mask) {
    if (table_[i].key == key) return &table_[i];
  }
  return nullptr;
}

uint64_t CausticMap::keyOf(Vec3 cell, int level) {
  const auto whole = [](float v) { return static_cast<uint64_t>(static_cast<int64_t>(std::floor(v))) & 0xfffff; };
  return whole(cell.x) | whole(cell.y) << 20 | whole(cell.z) << 40 | static_cast<uint64_t>(level) << 60;
}

// The eight that may hold discs of a level around p.
template <class Visit>
void CausticMap::visitCells(Vec3 p, int level, const Runs& runs, const Visit& visit) {
  const Vec3 q = p / cellM(level) - Vec3(0.5f);
  for (int k = 0; k < 8; ++k) {
    if (const Run* run = runs.find(keyOf(
            q + Vec3(static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1), static_cast<float>(k >> 2)), level)))
      visit(*run);
  }
}

// So that about as many others lie within every disc.
std::vector<float> CausticMap::radii(std::span<const CausticPhoton> photons) {
  std::vector<uint64_t> keys;
  const size_t few = (photons.size() + kEvery - 1) / kEvery;
  for (int level = 0; level < kLevels; ++level) {
    for (size_t i = 0; i < few; ++i) keys.push_back(keyOf(photons[i * kEvery].p / cellM(level), level));
  }
  const std::vector<uint32_t> order = sortedBy(keys);
  const Runs runs(keys, order);
  double flux = 0;
  for (const CausticPhoton& photon : photons) flux += static_cast<double>(luminance(photon.fluxLm));
  const float bright = kBright * static_cast<float>(flux / static_cast<double>(photons.size()));
  std::vector<float> out(photons.size());
  parallelFor(photons.size(), 1024, [&](size_t i) {
    const CausticPhoton& own = photons[i];
    float radius = 0;
    for (int level = 0; level < kLevels; ++level) {
      radius = 0.5f * cellM(level);
      float count = 0;
      visitCells(own.p, level, runs, [&](const Run& run) {
        const uint32_t step = (run.end - run.begin + kCounted - 1) / kCounted;
        for (uint32_t k = run.begin; k < run.end; k += step) {
          const CausticPhoton& other = photons[order[k] % few * kEvery];
          const Vec3 d = other.p - own.p;
          count += lengthSquared(d) < radius * radius && std::abs(dot(d, own.n)) < kFlat * radius &&
                           dot(own.n, other.n) > kFacing
                       ? static_cast<float>(step)
                       : 0.0f;
        }
      });
      if (count < kNearest) continue;
      radius *= std::sqrt(kNearest / count);
      break;
    }
    radius *= std::sqrt(std::max(1.0f, luminance(own.fluxLm) / bright));
    out[i] = std::clamp(radius, kLeastRadiusM, 0.5f * cellM(kLevels - 1));
  });
  return out;
}

// Radii of all, those of each layer by their own density: a dim lamp's photons are few.
std::vector<float> CausticMap::radiiByLayer(std::span<const CausticPhoton> photons, const LightLayers& layers) {
  std::vector<uint64_t> keys;
  for (const CausticPhoton& photon : photons) keys.push_back(static_cast<uint64_t>(layerOf(photon, layers) + 1));
  const std::vector<uint32_t> order = sortedBy(keys);
  std::vector<float> out(photons.size());
  forRuns(keys, order, [&](size_t begin, size_t end) {
    std::vector<CausticPhoton> some;
    for (size_t k = begin; k < end; ++k) some.push_back(photons[order[k]]);
    const std::vector<float> own = radii(some);
    for (size_t k = begin; k < end; ++k) out[order[k]] = own[k - begin];
  });
  return out;
}

CausticMap::CausticMap(std::span<const CausticPhoton> photons, const LightLayers* layers) {
  if (photons.empty()) return;
  const std::vector<float> radius = layers ? radiiByLayer(photons, *layers) : radii(photons);
  std::vector<uint64_t> keys(photons.size());
  parallelFor(keys.size(), 4096, [&](size_t i) {
    int level = 0;
    while (level + 1 < kLevels && radius[i] > 0.5f * cellM(level)) ++level;
    keys[i] = keyOf(photons[i].p / cellM(level), level);
  });
  const std::vector<uint32_t> order = sortedBy(keys);
  cells_ = Runs(keys, order);
  for (std::vector<float>* list :
       {&x_, &y_, &z_, &nx_, &ny_, &nz_, &perRadius2_, &lux_[0], &lux_[1], &lux_[2], &from_[0], &from_[1], &from_[2]})
    list->resize(photons.size() + kLanes);
  layer_.resize(layers ? photons.size() + kLanes : 0);
  parallelFor(photons.size(), 4096, [&](size_t k) {
    const CausticPhoton& photon = photons[order[k]];
    if (layers) layer_[k] = static_cast<int8_t>(layerOf(photon, *layers));
    const float r2 = radius[order[k]] * radius[order[k]];
    const Vec3 lux = photon.fluxLm * (2 / (kPi * r2));  // Epanechnikov's kernel: 2 / (pi r²) (1 - d²/r²)
    x_[k] = photon.p.x, y_[k] = photon.p.y, z_[k] = photon.p.z, nx_[k] = photon.n.x, ny_[k] = photon.n.y,
    nz_[k] = photon.n.z;
    perRadius2_[k] = 1 / r2;
    for (int c = 0; c < 3; ++c)
      lux_[static_cast<size_t>(c)][k] = lux[c], from_[static_cast<size_t>(c)][k] = photon.wi[c] * luminance(lux);
  });
  markLevels(photons, radius);
}

void CausticMap::markLevels(std::span<const CausticPhoton> photons, std::span<const float> radius) {
  constexpr int kLargest = kLevels - 1;
  std::vector<uint64_t> keys;  // a cell, and the level in place of its own
  for (size_t i = 0; i < photons.size(); ++i) {
    int level = 0;
    while (level + 1 < kLevels && radius[i] > 0.5f * cellM(level)) ++level;
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner{k & 1 ? radius[i] : -radius[i], k & 2 ? radius[i] : -radius[i], k & 4 ? radius[i] : -radius[i]};
      keys.push_back(keyOf((photons[i].p + corner) / cellM(kLargest), level));
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  levels_ = Runs(keys, sortedBy(keys));
}

size_t CausticMap::bytes() const {
  return x_.size() * 13 * sizeof(float) + layer_.size() + cells_.bytes() + levels_.bytes();
}

// Light of eight photons from the i-th on, with such weights.
void CausticMap::addToLayers(Float8 weight, size_t i, std::span<Vec3> byLayer) const {
  std::array<float, kLanes> w;
  weight.store(w.data());
  for (size_t k = 0; k < kLanes; ++k) {
    if (w[k] > 0 && layer_[i + k] >= 0)
      byLayer[static_cast<size_t>(layer_[i + k])] += Vec3{lux_[0][i + k], lux_[1][i + k], lux_[2][i + k]} * w[k];
  }
}

CausticMap::Light CausticMap::at(Vec3 p, Vec3 n, std::span<Vec3> byLayer) const {
  if (empty()) return {};
  alignas(32) static constexpr std::array<float, 8> kLane{0, 1, 2, 3, 4, 5, 6, 7};
  const Float8 lane = Float8::load(kLane.data()), px(p.x), py(p.y), pz(p.z), qx(n.x), qy(n.y), qz(n.z), one(1), zero(0),
               flat2(kFlat * kFlat), facing(kFacing);
  std::array<Float8, 3> lux, from;
  Float8 most;  // of 1 / r²
  bool any = false;
  for (int level = 0; level < kLevels; ++level) {
    if (!levels_.find(keyOf(p / cellM(kLevels - 1), level))) continue;
    visitCells(p, level, cells_, [&](const Run& run) {
      for (size_t i = run.begin; i < run.end; i += kLanes) {
        const Float8 dx = Float8::load(&x_[i]) - px, dy = Float8::load(&y_[i]) - py, dz = Float8::load(&z_[i]) - pz;
        const Float8 per = Float8::load(&perRadius2_[i]),
                     weight = max(zero, one - fma(dx, dx, fma(dy, dy, dz * dz)) * per);
        const Float8 along = fma(dx, qx, fma(dy, qy, dz * qz)),
                     cosine =
                         fma(Float8::load(&nx_[i]), qx, fma(Float8::load(&ny_[i]), qy, Float8::load(&nz_[i]) * qz));
        const Float8 counts = (zero < weight) & (along * along * per < flat2) & (facing < cosine) &
                              (lane < Float8(static_cast<float>(run.end - i)));
        if (topBits(counts) == 0) continue;
        any = true;
        const Float8 w = weight & counts;
        most = max(most, per & counts);
        if (!byLayer.empty()) addToLayers(w, i, byLayer);
        for (size_t c = 0; c < 3; ++c)
          lux[c] = fma(w, Float8::load(&lux_[c][i]), lux[c]), from[c] = fma(w, Float8::load(&from_[c][i]), from[c]);
      }
    });
  }
  if (!any) return {};
  const Vec3 direction{sum(from[0]), sum(from[1]), sum(from[2])};
  const float metres = length(direction);
  std::array<float, 8> perRadius2;
  most.store(perRadius2.data());
  return {{sum(lux[0]), sum(lux[1]), sum(lux[2])},
          metres > 0 ? direction / metres : n,
          kEvenPart * kEvenPart / *std::max_element(perRadius2.begin(), perRadius2.end())};
}

}  // namespace roomlight
