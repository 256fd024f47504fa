#include "radiance/bounces.h"

#include <cassert>

#include "base/parallel.h"
#include "base/simd.h"

namespace roomlight {
namespace {

constexpr float kBrightest = 4096;  // of direct light in half floats, which end at 65504: light may grow by 16
constexpr size_t kAhead = 16;       // links whose light is on its way from memory

// Three channels of all lights.
struct Floats {
  Float8 c[3];
};
struct alignas(16) Halves {
  uint16_t v[3][kLayersAtOnce] = {};
  Floats load() const {
    Floats out;
    for (int i = 0; i < 3; ++i) out.c[i] = fromHalf8(v[i]);
    return out;
  }
  void store(int channel, Float8 value) { toHalf8(max(min(value, Float8(65504.0f)), Float8(-65504.0f)), v[channel]); }
};

class Iteration {
 public:
  Iteration(const Voxels& voxels, const Links& links, std::span<const std::vector<Vec3>> direct)
      : voxels_(voxels),
        links_(links),
        direct_(voxels.slots.size()),
        indirect_(voxels.slots.size()),
        other_(voxels.slots.size()),
        reflected_(voxels.slots.size()),
        next_(voxels.slots.size()) {
    for (size_t k = 0; k < direct.size(); ++k) {
      float brightest = 0;
      for (const Vec3& v : direct[k]) brightest = std::max(brightest, maxComponent(v));
      perUnit_[k] = brightest > 0 ? kBrightest / brightest : 0;
    }
    parallelFor(direct_.size(), 8192, [&](size_t s) {
      for (size_t k = 0; k < direct.size(); ++k) {
        for (int c = 0; c < 3; ++c) direct_[s].v[c][k] = toHalf(direct[k][s][c] * perUnit_[k]);
      }
      reflect(s, direct_[s].load(), reflected_[s]);
    });
  }

  void step(float omega) {
    parallelFor(direct_.size(), 4096, [&](size_t s) {
      const Floats gathered = gather(s), straight = direct_[s].load(), before = other_[s].load();
      Floats all;
      for (int c = 0; c < 3; ++c) {
        const Float8 after = fma(gathered.c[c] - before.c[c], Float8(omega), before.c[c]);
        other_[s].store(c, after);
        all.c[c] = straight.c[c] + after;
      }
      reflect(s, all, next_[s]);
    });
    reflected_.swap(next_);
    indirect_.swap(other_);
  }

  void result(std::span<std::vector<Vec3>> indirect) const {
    for (std::vector<Vec3>& light : indirect) light.resize(indirect_.size());
    parallelFor(indirect_.size(), 8192, [&](size_t s) {
      for (size_t k = 0; k < indirect.size(); ++k) {
        const float unit = perUnit_[k] > 0 ? 1 / perUnit_[k] : 0;
        for (int c = 0; c < 3; ++c) indirect[k][s][c] = std::max(0.0f, fromHalf(indirect_[s].v[c][k])) * unit;
      }
    });
  }

 private:
  void reflect(size_t slot, const Floats& lux, Halves& out) const {
    for (int c = 0; c < 3; ++c) out.store(c, lux.c[c] * Float8(voxels_.slots[slot].albedo[c]));
  }

  Floats gather(size_t slot) const {
    const size_t first = links_.first[slot], last = links_.first[slot + 1], end = links_.links.size();
    Floats sum;
    for (size_t j = first; j < last; ++j) {
      if (j + kAhead < end) __builtin_prefetch(&reflected_[links_.links[j + kAhead].slot()]);
      const Link link = links_.links[j];
      const Float8 left(link.left());
      const Floats light = reflected_[link.slot()].load();
      for (int c = 0; c < 3; ++c) sum.c[c] = fma(light.c[c], left, sum.c[c]);
    }
    const Float8 share(Link::kUnit / static_cast<float>(std::max<size_t>(1, last - first)));
    for (Float8& c : sum.c) c = c * share;
    return sum;
  }

  const Voxels& voxels_;
  const Links& links_;
  std::array<float, kLayersAtOnce> perUnit_{};
  std::vector<Halves> direct_, indirect_, other_;  // other: the step before, replaced by the step after
  std::vector<Halves> reflected_, next_;
};

}  // namespace

void bounceLayers(const Voxels& voxels, const Links& links, std::span<const std::vector<Vec3>> direct,
                  std::span<std::vector<Vec3>> indirect, const Bounces& like, const Progress& progress) {
  assert(direct.size() <= kLayersAtOnce && indirect.size() == direct.size());
  Iteration iteration(voxels, links, direct);
  Momentum momentum;
  for (int k = 0; k < like.done && !progress.stop(); ++k) iteration.step(momentum.next(k < like.withMomentum));
  iteration.result(indirect);
}

}  // namespace roomlight
