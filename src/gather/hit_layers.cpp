#include "gather/layer_light.h"

#include "base/parallel.h"
#include "base/simd.h"
#include "gather/hit_cache.h"

namespace roomlight {

void HitLayers::take(uint32_t number, const LayerSums& sums, size_t thing) {
  for (size_t l = 0; l < layers_; ++l) {
    sharp(l, number) = sums.get(thing, LayerSums::kSharp, l);
    soft(l, number) = max(Vec3(0), sums.get(thing, LayerSums::kDiffuse, l));
  }
}

void HitLayers::smooth(const RayScene& rays, const HitCache& cells, std::span<const LitHit> samples) {
  parallelFor(layers_, 1, [&](size_t l) {
    std::vector<LitHit> own(samples.begin(), samples.end());
    bool lit = false;
    for (LitHit& hit : own) {
      hit.even = soft(l, hit.number), hit.rare = {};
      lit = lit || !isBlack(hit.even);
    }
    if (!lit) return;
    smoothLight(rays, cells, own);
    for (const LitHit& hit : own) soft(l, hit.number) = hit.even + hit.rare;
  });
}

void HitLayers::addShares(std::span<const LitHit> samples, std::span<const uint32_t> members,
                          std::vector<uint16_t>& out) const {
  std::vector<Vec3> light(layers_);
  Vec3 whole;
  for (size_t l = 0; l < layers_; ++l) {
    for (const uint32_t m : members) light[l] += samples[m].albedo * all(l, samples[m].number);
    whole += light[l];
  }
  const size_t first = out.size();
  out.resize(first + 3 * stride_);
  for (size_t l = 0; l < layers_; ++l) {
    for (int c = 0; c < 3; ++c)
      out[first + static_cast<size_t>(c) * stride_ + l] = toHalf(whole[c] > 0 ? light[l][c] / whole[c] : 0);
  }
}

}  // namespace roomlight
