#include "radiance/bounces.h"

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr double kSlowest = 0.8;  // mode of light that Chebyshev's iteration is fastest for
constexpr int kTrial = 12;        // steps
constexpr double kDark = 1e-4;
constexpr double kSmall = 0.01;
constexpr float kAbsorbs = 1e-3f;  // at least, where only the end of the bounces is judged
constexpr size_t kChunk = 4096;    // slots
constexpr size_t kAhead = 32;      // links whose light is on its way from memory

struct alignas(16) Padded {
  float v[4];
};

class Iteration {
 public:
  Iteration(const Voxels& voxels, const Links& links, std::span<const Vec3> direct, std::vector<Vec3>& indirect)
      : links_(links), direct_(direct), indirect_(indirect), surfaces_(voxels.slots.size()), reflected_(voxels.slots.size()), other_(voxels.slots.size()) {
    parallelFor(surfaces_.size(), 8192, [&](size_t i) {
      const FaceSlot& slot = voxels.slots[i];
      surfaces_[i] = {slot.albedo, slot.areaM2 * std::max(kAbsorbs, 1 - luminance(slot.albedo))};
    });
  }

  Bounces run(const RadianceSettings& settings, const Progress& progress) {
    Bounces out;
    double slowest = kSlowest, omega = 1, delta = 0, before = 0, beforeThat = 0;
    for (int k = 0; k < settings.maxBounces && !progress.stop(); ++k) {
      if (k > 0) omega = 1 / (1 - slowest * slowest * omega / (k == 1 ? 2 : 4));
      beforeThat = before, before = delta;
      delta = step(static_cast<float>(omega));
      if (k > kTrial && delta > beforeThat) slowest = 0;  // modes that are not real: on without momentum
      // A mode l of G shrinks by m with l = (m + momentum / m) / (1 + momentum), those up to `slowest` by sqrt(momentum).
      const double momentum = 2 / (1 + std::sqrt(1 - slowest * slowest)) - 1;
      const double m = std::clamp(beforeThat > 0 ? std::sqrt(delta / beforeThat) : 0.9, std::sqrt(momentum), 0.995);
      out.residual = delta * m / (1 - (m + momentum / m) / (1 + momentum));
      ++out.done;
      indirect_.swap(other_);
      if (out.residual <= settings.residual) break;
    }
    parallelFor(indirect_.size(), 8192, [&](size_t i) { indirect_[i] = max(Vec3(0), indirect_[i]); });
    return out;
  }

 private:
  // One step. Returns by how much G changes its light, as a fraction of the light r of each slot, averaged where there is change:
  // sum a r² / sum a r. So a room counts in full beside a sunlit street that has long converged; but what is less than kSmall of all
  // surfaces (the inside of a pipe) counts for less, and areas are those of black surfaces that absorb as much: light between two
  // mirrors hardly ever settles, and hardly matters. What is darker than kDark of the mean of what is lit (`mean_`, of the step before,
  // weighted with the light itself) hardly counts. Fixed chunks keep the order of the sums, and so the number of
  // steps, independent of threads.
  double step(float omega) {
    struct Sums {
      double light = 0, lightSquared = 0, area = 0, squares = 0, fractions = 0;
    };
    const size_t slots = surfaces_.size();
    parallelFor(slots, 8192, [&](size_t i) {
      const Vec3 r = surfaces_[i].albedo * (direct_[i] + indirect_[i]);
      reflected_[i] = {{r.x, r.y, r.z, 0}};
    });
    std::vector<Sums> parts((slots + kChunk - 1) / kChunk);
    parallelFor(parts.size(), 1, [&](size_t c) {
      Sums& sum = parts[c];
      for (size_t i = c * kChunk; i < std::min(slots, (c + 1) * kChunk); ++i) {
        const Vec3 gathered = gather(i);
        const double area = static_cast<double>(surfaces_[i].absorbingM2);
        const double light = std::max(0.0, static_cast<double>(luminance(gathered + direct_[i])));
        const double r = std::abs(static_cast<double>(luminance(gathered - indirect_[i]))) / (light + kDark * mean_ + 1e-30);
        sum.light += area * light, sum.lightSquared += area * light * light, sum.area += area, sum.squares += area * r * r, sum.fractions += area * r;
        other_[i] += (gathered - other_[i]) * omega;
      }
    });
    Sums sum;
    for (const Sums& p : parts) sum.light += p.light, sum.lightSquared += p.lightSquared, sum.area += p.area, sum.squares += p.squares, sum.fractions += p.fractions;
    mean_ = sum.light > 0 ? sum.lightSquared / sum.light : 0;
    return sum.fractions > 0 ? std::min(sum.squares / sum.fractions, sum.fractions / (kSmall * sum.area)) : 0;
  }

  Vec3 gather(size_t slot) const {
    const size_t first = links_.first[slot], last = links_.first[slot + 1], end = links_.links.size();
    __m128 sum = _mm_setzero_ps();
    for (size_t j = first; j < last; ++j) {
      if (j + kAhead < end) __builtin_prefetch(&reflected_[links_.links[j + kAhead].slot()]);
      const Link link = links_.links[j];
      sum = _mm_fmadd_ps(_mm_load_ps(reflected_[link.slot()].v), link.left(), sum);
    }
    Padded out;
    _mm_store_ps(out.v, _mm_mul_ps(sum, _mm_set1_ps(Link::kUnit / static_cast<float>(std::max<size_t>(1, last - first)))));
    return {out.v[0], out.v[1], out.v[2]};
  }

  // What a step asks of a slot: a quarter of its record.
  struct Surface {
    Vec3 albedo;
    float absorbingM2;  // black surface that takes as much
  };
  const Links& links_;
  const std::span<const Vec3> direct_;
  std::vector<Vec3>& indirect_;
  std::vector<Surface> surfaces_;
  std::vector<Padded> reflected_;
  std::vector<Vec3> other_;  // the step before, replaced by the step after
  double mean_ = 0;
};

}  // namespace

Bounces bounce(const Voxels& voxels, const Links& links, std::span<const Vec3> direct, std::vector<Vec3>& indirect, const RadianceSettings& settings,
               const Progress& progress) {
  return Iteration(voxels, links, direct, indirect).run(settings, progress);
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
