#include "gather/hit_layers.h"

#include "base/half.h"
#include "base/parallel.h"
#include "base/sorted_keys.h"

namespace roomlight {
namespace {

constexpr int kLevel = 2, kDarkLevel = 4;  // of cells whose samples share what they know; of those who know nothing there

// Light by layers, three channels each.
class Shared {
 public:
  explicit Shared(size_t stride) : stride_(stride), light_(3 * stride) {}
  void add(size_t layer, Vec3 light) {
    for (int c = 0; c < 3; ++c) light_[static_cast<size_t>(c) * stride_ + layer] += light[c];
  }
  void add(const uint16_t* shares, Vec3 light) {
    for (int c = 0; c < 3; ++c) {
      for (size_t l = 0; l < stride_; ++l) light_[static_cast<size_t>(c) * stride_ + l] += light[c] * fromHalf(shares[static_cast<size_t>(c) * stride_ + l]);
    }
  }
  // Of each channel the shares make one, or 0 where it is dark.
  void write(uint16_t* out) const {
    for (size_t c = 0; c < 3; ++c) {
      float sum = 0;
      for (size_t l = 0; l < stride_; ++l) sum += light_[c * stride_ + l];
      for (size_t l = 0; l < stride_; ++l) out[c * stride_ + l] = toHalf(sum > 0 ? light_[c * stride_ + l] / sum : 0);
    }
  }

 private:
  size_t stride_;
  std::vector<float> light_;
};

}  // namespace

void HitLayers::take(uint32_t number, const LayerSums& sums, size_t thing) {
  Shared sharp(stride_), soft(stride_);
  for (size_t l = 0; l < layers_; ++l) {
    sharp.add(l, sums.get(thing, LayerSums::kSharp, l));
    soft.add(l, max(Vec3(0), sums.get(thing, LayerSums::kDiffuse, l) + sums.get(thing, LayerSums::kRare, l)));
  }
  sharp.write(&sharp_[number * size()]), soft.write(&soft_[number * size()]);
}

void HitLayers::share(const HitCache& cells, std::span<const LitHit> samples) {
  std::vector<uint8_t> known(samples.size());
  for (const int level : {kLevel, kDarkLevel}) {
    std::vector<uint64_t> keys(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) keys[i] = cells.keyOf(samples[i].at, level);
    const std::vector<uint32_t> order = sortedBy(keys);
    forRuns(keys, order, [&](size_t begin, size_t end) {
      Shared all(stride_);
      bool lit = false;
      for (size_t k = begin; k < end; ++k) {
        const LitHit& hit = samples[order[k]];
        const Vec3 light = (hit.even + hit.rare) * hit.rays;
        lit = lit || !isBlack(light);
        all.add(&soft_[hit.number * size()], light);
      }
      for (size_t k = begin; k < end; ++k) {
        if (known[order[k]] || !lit) continue;
        all.write(&soft_[samples[order[k]].number * size()]), known[order[k]] = 1;
      }
    });
  }
}

void HitLayers::addShares(std::span<const LitHit> samples, std::span<const uint32_t> members, std::vector<uint16_t>& out) const {
  Shared all(stride_);
  for (const uint32_t m : members) {
    const LitHit& hit = samples[m];
    all.add(&sharp_[hit.number * size()], hit.albedo * hit.sharp);
    all.add(&soft_[hit.number * size()], hit.albedo * (hit.even + hit.rare));
  }
  out.resize(out.size() + size());
  all.write(&out[out.size() - size()]);
}

}  // namespace roomlight
