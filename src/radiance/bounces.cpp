#include "radiance/bounces.h"

#include "base/simd.h"
#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr int kTrial = 12;        // steps
constexpr double kRounding = 6e-4;  // of half floats: steps no larger than this go round in circles
constexpr double kDark = 1e-4;
constexpr double kSmall = 0.01;
constexpr float kAbsorbs = 1e-3f;  // at least, where only the end of the bounces is judged
constexpr size_t kChunk = 4096;    // slots
constexpr float kHeadroom = 1.0f / 4096;  // half floats end at 65504: light may grow by 16 from one step to the next
constexpr size_t kAhead = 32;      // links whose light is on its way from memory

// Three channels and a zero, or a fourth value: what one instruction takes.
struct alignas(16) Padded {
  Padded() = default;
  Padded(Vec3 xyz, float w) : v{xyz.x, xyz.y, xyz.z, w} {}
  explicit Padded(Float4 all) { all.store(v); }
  Float4 load() const { return Float4::load(v); }
  float v[4] = {};
};

// The same as half floats: twice as many stay in the cache.
struct Halves {
  Halves() = default;
  explicit Halves(Float4 all) { toHalf4(min(all, Float4(65504.0f)), v); }
  Float4 load() const { return fromHalf4(v); }
  alignas(8) uint16_t v[4] = {};
};

float luminanceOf(Float4 v) { return dot(v, Float4(0.2126f, 0.7152f, 0.0722f, 0)); }

class Iteration {
 public:
  Iteration(const Voxels& voxels, const Links& links, std::span<const Vec3> direct, std::span<const Vec3> indirect)
      : links_(links),
        surfaces_(direct.size()),
        direct_(direct.size()),
        indirect_(direct.size()),
        other_(direct.size()),
        reflected_(direct.size()),
        next_(direct.size()) {
    parallelFor(surfaces_.size(), 8192, [&](size_t i) {
      const FaceSlot& slot = voxels.slots[i];
      surfaces_[i] = {slot.albedo, slot.areaM2 * std::max(kAbsorbs, 1 - luminance(slot.albedo))};
      direct_[i] = {direct[i], 0}, indirect_[i] = {indirect[i], 0};
    });
    float brightest = 1e-30f;
    for (size_t i = 0; i < direct.size(); ++i) brightest = std::max(brightest, maxComponent(direct[i] + indirect[i]));
    unit_ = brightest * kHeadroom;
    parallelFor(surfaces_.size(), 8192,
                [&](size_t i) { reflected_[i] = reflectedBy(i, direct_[i].load() + indirect_[i].load(), unit_); });
  }

  Bounces run(const RadianceSettings& settings, const Progress& progress) {
    Bounces out;
    Momentum weights;
    double slowest = Momentum::kSlowest, delta = 0, before = 0, beforeThat = 0;
    for (int k = 0; k < settings.maxBounces && !progress.stop(); ++k) {
      out.withMomentum += slowest > 0 ? 1 : 0;
      beforeThat = before, before = delta;
      delta = step(weights.next(slowest > 0));
      if (k > kTrial && delta > beforeThat) slowest = 0;  // modes that are not real: on without momentum
      // A mode l of G shrinks by m with l = (m + momentum / m) / (1 + momentum), those up to `slowest` by
// sqrt(momentum).
      const double momentum = 2 / (1 + std::sqrt(1 - slowest * slowest)) - 1;
      const double m = std::clamp(beforeThat > 0 ? std::sqrt(delta / beforeThat) : 0.9, std::sqrt(momentum), 0.995);
      out.residual = delta * m / (1 - (m + momentum / m) / (1 + momentum));
      ++out.done;
      indirect_.swap(other_);
      if (out.residual <= settings.residual || delta <= kRounding) break;
    }
    return out;
  }

  void result(std::vector<Vec3>& indirect) const {
    parallelFor(indirect_.size(), 8192, [&](size_t i) {
      const auto& v = indirect_[i].v;
      indirect[i] = max(Vec3(0), {v[0], v[1], v[2]});
    });
  }

 private:
  // One step. Returns by how much G changes its light, as a fraction of the light r of each slot, averaged where there
  // is change: sum a r² / sum a r. So a room counts in full beside a sunlit street that has long converged; but what is
  // less than kSmall of all surfaces (the inside of a pipe) counts for less, and areas are those of black surfaces that
  // absorb as much: light between two mirrors hardly ever settles, and hardly matters. What is darker than kDark of the
  // mean of what is lit (`mean_`, of the step before, weighted with the light itself) hardly counts. Fixed chunks keep
  // the order of the sums, and so the number of steps, independent of threads.
  double step(float omega) {
    struct Sums {
      double light = 0, lightSquared = 0, area = 0, squares = 0, fractions = 0;
      Float4 brightest;
    };
    const size_t slots = surfaces_.size();
    const float nextUnit = std::max(unit_, brightest_ * kHeadroom);
    std::vector<Sums> parts((slots + kChunk - 1) / kChunk);
    parallelFor(parts.size(), 1, [&](size_t c) {
      Sums& sum = parts[c];
      for (size_t i = c * kChunk; i < std::min(slots, (c + 1) * kChunk); ++i) {
        const Float4 gathered = gather(i), straight = direct_[i].load(), before = other_[i].load();
        const auto area = static_cast<double>(surfaces_[i].v[3]);
        const auto light = static_cast<double>(std::max(0.0f, luminanceOf(gathered + straight)));
        const double r = static_cast<double>(std::abs(luminanceOf(gathered - indirect_[i].load()))) /
                         (light + kDark * mean_ + 1e-30);
        sum.light += area * light, sum.lightSquared += area * light * light, sum.area += area,
            sum.squares += area * r * r, sum.fractions += area * r;
        const Float4 after = fma(gathered - before, Float4(omega), before);
        other_[i] = Padded(after);
        const Float4 all = straight + after;
        sum.brightest = max(sum.brightest, all);
        next_[i] = reflectedBy(i, all, nextUnit);
      }
    });
    reflected_.swap(next_);
    unit_ = nextUnit;
    Float4 brightest;
    for (const Sums& p : parts) brightest = max(brightest, p.brightest);
    const Padded channels(brightest);
    brightest_ = std::max({channels.v[0], channels.v[1], channels.v[2]});
    Sums sum;
    for (const Sums& p : parts)
      sum.light += p.light, sum.lightSquared += p.lightSquared, sum.area += p.area, sum.squares += p.squares,
          sum.fractions += p.fractions;
    mean_ = sum.light > 0 ? sum.lightSquared / sum.light : 0;
    return sum.fractions > 0 ? std::min(sum.squares / sum.fractions, sum.fractions / (kSmall * sum.area)) : 0;
  }

  Halves reflectedBy(size_t slot, Float4 lux, float unit) const {
    return Halves(surfaces_[slot].load() * lux * Float4(1 / unit));
  }

  Float4 gather(size_t slot) const {
    const size_t first = links_.first[slot], last = links_.first[slot + 1], end = links_.links.size();
    Float4 sum;
    for (size_t j = first; j < last; ++j) {
      if (j + kAhead < end) __builtin_prefetch(&reflected_[links_.links[j + kAhead].slot()]);
      const Link link = links_.links[j];
      sum = fma(reflected_[link.slot()].load(), Float4(link.left()), sum);
    }
    return sum * Float4(unit_ * Link::kUnit / static_cast<float>(std::max<size_t>(1, last - first)));
  }

  const Links& links_;
  std::vector<Padded> surfaces_;  // albedo, and black surface that takes as much, m²
  std::vector<Padded> direct_, indirect_, other_;  // other: the step before, replaced by the step after
  std::vector<Halves> reflected_, next_;  // in unit_: of the light there is, and after this step
  float unit_ = 1, brightest_ = 0;
  double mean_ = 0;
};

}  // namespace

Bounces bounce(const Voxels& voxels, const Links& links, std::span<const Vec3> direct, std::vector<Vec3>& indirect,
               const RadianceSettings& settings, const Progress& progress) {
  Iteration iteration(voxels, links, direct, indirect);
  const Bounces done = iteration.run(settings, progress);
  iteration.result(indirect);
  return done;
}

void smooth(const Links& links, std::vector<Vec3>& perSlot) {
  const std::vector<Vec3> sharp = perSlot;
  parallelFor(perSlot.size(), 4096, [&](size_t s) {
    Vec3 sum = sharp[s];
    for (const uint32_t o : links.kin[s]) sum += sharp[o];
    perSlot[s] = sum / static_cast<float>(kKin + 1);
  });
}

}  // namespace roomlight
