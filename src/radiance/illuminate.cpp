#include <immintrin.h>

#include <atomic>
#include <mutex>

#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"
#include "radiance/attenuation.h"
#include "radiance/near_lamps.h"
#include "radiance/pyramid.h"
#include "radiance/radiance_field.h"
#include "radiance/sky_guide.h"
#include "radiance/slot_paths.h"

namespace roomlight {
namespace {

constexpr int kSkySamples = 8;
constexpr double kSlowest = 0.8;  // mode of light that Chebyshev's iteration is fastest for
constexpr int kTrial = 12;        // steps
constexpr double kDark = 1e-4;
constexpr double kSmall = 0.01;
constexpr float kAbsorbs = 1e-3f;  // at least, where only the end of the bounces is judged
constexpr float kUnseen = 1e12f;  // cd/m²: of glow that no voxel shows, so that points take all of it
constexpr size_t kChunk = 4096;  // slots

// Where a ray from a slot arrives: the slot it sees, and in four bits how much of the light the glass on the way leaves. Nothing
// comes along a ray that arrives nowhere.
class Link {
 public:
  static constexpr float kUnit = 1.0f / 15;
  Link() = default;
  Link(uint32_t slot, float left) : packed_(slot | static_cast<uint32_t>(std::lround(15 * std::clamp(left, 0.0f, 1.0f))) << 28) {}
  uint32_t slot() const { return packed_ & ((1u << 28) - 1); }
  __m128 left() const { return _mm_cvtepi32_ps(_mm_srli_epi32(_mm_set1_epi32(static_cast<int>(packed_)), 28)); }  // in kUnit

 private:
  uint32_t packed_ = 0;
};

struct alignas(16) Padded {
  float v[4];
};

class Illuminator {
 public:
  Illuminator(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceSettings& settings, const Progress& progress)
      : rays_(rays), lights_(lights), voxels_(voxels), settings_(settings), progress_(progress), paths_(rays, voxels, settings.seed, progress), near_(lights, voxels, paths_), direct_(voxels.slots.size()), indirect_(voxels.slots.size()) {}

  RadianceField run() {
    RadianceField field;
    if (settings_.links > 0) traceLinks(field);
    progress_.at(0.5f);
    gatherDirect(field);
    NearLamps::Light near = near_.trace(rays_, paths_, settings_, progress_);
    rayCount_ += near.rays;
    for (size_t i = 0; i < near.far.size(); ++i) direct_[i] += near.far[i];
    progress_.at(0.8f);
    bounce(field);
    field.rays = rayCount_;
    if (progress_.stop()) return field;
    std::vector<Vec3> radiance(voxels_.slots.size()), glow(near.near.size());
    field.irradianceLux.resize(voxels_.slots.size());
    field.glowShare.resize(near.near.size());
    parallelFor(radiance.size(), 8192, [&](size_t i) {
      const Vec3 e = direct_[i] + indirect_[i];
      field.irradianceLux[i] = e;
      radiance[i] = voxels_.slots[i].albedo * e / kPi;
      if (glow.empty()) return;
      field.irradianceLux[i] += near.near[i];
      field.glowShare[i] = luminance(near.near[i]) / std::max(luminance(field.irradianceLux[i]), 1e-30f);
      glow[i] = voxels_.slots[i].albedo * near.near[i] / kPi;
    });
    for (GlowPoint& g : near.points) g.radianceCdM2 = g.slot < 0 ? kUnseen : luminance(glow[static_cast<size_t>(g.slot)]);
    field.glow = LampGlow(std::move(near.points), voxels_.voxelSizeM);
    buildPyramid(voxels_, radiance, glow, field);
    return field;
  }

 private:
  void traceLinks(RadianceField& field) {
    const auto n = static_cast<size_t>(settings_.links);
    links_.resize(voxels_.slots.size() * n);
    SkyGuideBuilder guide(voxels_, lights_.sky());
    const bool sky = lights_.sky().present();
    std::atomic<size_t> done = 0;
    std::mutex reporting;
    parallelFor(voxels_.bricks.size(), 4, [&](size_t b) {
      if (progress_.stop()) return;
      const auto [first, last] = paths_.slotsOfBrick(b);
      std::vector<Ray> rays;
      std::vector<Hit> hits;
      for (size_t s = first; s < last; ++s) {
        const FaceSlot& slot = voxels_.slots[s];
        const Frame frame(slot.normal);
        rays.clear();
        for (uint32_t i = 0; i < n; ++i) {
          Sampler sampler(s, i, settings_.seed);
          const Vec3 d = frame.toWorld(sampleCosineHemisphere(sampler.next2()));
          rays.push_back({paths_.point(s, i), d, 0, kInfinity});
        }
        hits.resize(n);
        rays_.intersect(rays, hits);
        for (size_t i = 0; i < n; ++i) {
          Sampler sampler(s, static_cast<uint32_t>(i), settings_.seed + 5);
          const Arrival end = paths_.follow(rays[i], hits[i], sampler);
          if (end.slot >= 0) links_[s * n + i] = {static_cast<uint32_t>(end.slot), luminance(end.left)};
          if (sky) guide.add(b, slot.face, rays[i].direction, end.escaped ? luminance(end.left) : 0.0f);
        }
      }
      const size_t d = ++done;
      if (d % 256 == 0 && reporting.try_lock()) {
        progress_.at(0.5f * static_cast<float>(d) / static_cast<float>(voxels_.bricks.size()));
        reporting.unlock();
      }
    });
    if (progress_.stop()) return;
    rayCount_ += links_.size();
    if (sky) field.guide = guide.finish(progress_);
  }

  struct Shadow {
    size_t slot;
    Vec3 contribution;
  };

  void gatherDirect(const RadianceField& field) {
    std::atomic<uint64_t> count = 0;
    parallelFor(voxels_.bricks.size(), 4, [&](size_t b) {
      if (progress_.stop()) return;
      const auto [first, last] = paths_.slotsOfBrick(b);
      std::vector<Ray> rays;
      std::vector<Shadow> shadows;
      std::vector<Vec3> left;
      for (size_t s = first; s < last; ++s) collectShadowRays(field, b, s, rays, shadows);
      left.resize(rays.size());
      rays_.transmittance(rays, left);
      for (size_t i = 0; i < rays.size(); ++i) direct_[shadows[i].slot] += shadows[i].contribution * left[i];
      count += rays.size();
    });
    rayCount_ += count;
  }

  void collectShadowRays(const RadianceField& field, size_t brick, size_t s, std::vector<Ray>& rays, std::vector<Shadow>& shadows) const {
    const FaceSlot& slot = voxels_.slots[s];
    const Frame frame(slot.normal);
    const auto add = [&](const LightSample& light, Vec3 p, float weight) {
      if (!light.valid()) return;
      const float a = attenuation(settings_.attenuation, slot.normal, light.wi);
      if (a <= 0 || dot(light.wi, slot.normal) <= 0) return;
      const float tMax = light.distance < kInfinity ? light.distance * (1 - 1e-4f) : kInfinity;
      rays.push_back({p, light.wi, 0, tMax});
      shadows.push_back({s, light.radiance * (a * weight)});
    };
    const auto lamps = static_cast<int>(lights_.lampCount());
    const int perDelta = lamps > 0 ? std::clamp(settings_.directSamples / lamps, 1, 4) : 1;
    for (int k = 0; k < perDelta; ++k) {
      Sampler sampler(s, static_cast<uint32_t>(k), settings_.seed + 1);
      for (size_t i = 0; i < lights_.lampCount(); ++i) {
        if (near_.isNear(i, s)) continue;
        const Vec3 p = paths_.point(s, static_cast<size_t>(k));
        add(lights_.sampleLamp(i, p), p, 1.0f / static_cast<float>(perDelta));
      }
    }
    for (uint32_t k = 0; k < 4; ++k) {
      Sampler sampler(s, k, settings_.seed + 2);
      for (size_t i = 0; i < lights_.sunCount(); ++i) {
        const Vec3 p = paths_.point(s, static_cast<size_t>(k));
        add(lights_.sampleSun(i, sampler.next2()), p, 0.25f);
      }
    }
    if (lights_.hasEmitters()) {
      for (int k = 0; k < settings_.directSamples; ++k) {
        Sampler sampler(s, static_cast<uint32_t>(k), settings_.seed + 3);
        const Vec3 p = paths_.point(s, static_cast<size_t>(k));
        const Vec2 u = sampler.next2();
        add(lights_.sampleEmitters(p, u, sampler.next1()), p, 1.0f / static_cast<float>(settings_.directSamples));
      }
    }
    const int32_t guide = field.guide.guideOfBrick.empty() ? -1 : field.guide.guideOfBrick[brick][slot.face];
    if (guide >= 0) {
      for (uint32_t k = 0; k < kSkySamples; ++k) {
        Sampler sampler(s, k, settings_.seed + 4);
        const Vec3 p = paths_.point(s, static_cast<size_t>(k));
        const Vec2 u = sampler.next2();
        add(sampleSkyGuided(field.guide, guide, lights_, u, sampler.next1()), p, 1.0f / kSkySamples);
      }
    }
  }

  // Solves E = G (direct + E), where G is the mean over links of rho E. Every row of G sums to at most 1 and rho is below 1, so
  // its modes shrink; they are nearly real, because transport is reciprocal. Chebyshev's iteration uses that: each step goes on
  // along the one before.
  void bounce(RadianceField& field) {
    if (settings_.links == 0) return;
    std::vector<Padded> reflected(voxels_.slots.size());
    std::vector<Vec3> other(voxels_.slots.size());  // the step before, replaced by the step after
    double slowest = kSlowest, omega = 1, mean = 0, delta = 0, before = 0, beforeThat = 0;
    for (int k = 0; k < settings_.maxBounces && !progress_.stop(); ++k) {
      if (k > 0) omega = 1 / (1 - slowest * slowest * omega / (k == 1 ? 2 : 4));
      beforeThat = before, before = delta;
      delta = step(static_cast<float>(omega), reflected, other, mean);
      if (k > kTrial && delta > beforeThat) slowest = 0;  // modes that are not real: on without momentum
      // A mode l of G shrinks by m with l = (m + momentum / m) / (1 + momentum), those up to `slowest` by sqrt(momentum).
      const double momentum = 2 / (1 + std::sqrt(1 - slowest * slowest)) - 1;
      const double m = std::clamp(beforeThat > 0 ? std::sqrt(delta / beforeThat) : 0.9, std::sqrt(momentum), 0.995);
      field.residual = delta * m / (1 - (m + momentum / m) / (1 + momentum));
      ++field.bounces;
      indirect_.swap(other);
      if (field.residual <= settings_.residual) break;
    }
    parallelFor(indirect_.size(), 8192, [&](size_t i) { indirect_[i] = max(Vec3(0), indirect_[i]); });
  }

  // One step. Returns by how much G changes its light, as a fraction of the light r of each slot, averaged where there is change:
  // sum a r² / sum a r. So a room counts in full beside a sunlit street that has long converged; but what is less than kSmall of all
  // surfaces (the inside of a pipe) counts for less, and areas are those of black surfaces that absorb as much: light between two
  // mirrors hardly ever settles, and hardly matters. What is darker than kDark of the mean of what is lit (`mean`, of the step before,
  // weighted with the light itself) hardly counts. Fixed chunks keep the order of the sums, and so the number of
  // steps, independent of threads.
  double step(float omega, std::vector<Padded>& reflected, std::vector<Vec3>& other, double& mean) const {
    struct Sums {
      double light = 0, lightSquared = 0, area = 0, squares = 0, fractions = 0;
    };
    const size_t slots = voxels_.slots.size();
    const auto n = static_cast<size_t>(settings_.links);
    parallelFor(slots, 8192, [&](size_t i) {
      const Vec3 r = voxels_.slots[i].albedo * (direct_[i] + indirect_[i]);
      reflected[i] = {{r.x, r.y, r.z, 0}};
    });
    std::vector<Sums> parts((slots + kChunk - 1) / kChunk);
    parallelFor(parts.size(), 1, [&](size_t c) {
      Sums& sum = parts[c];
      for (size_t i = c * kChunk; i < std::min(slots, (c + 1) * kChunk); ++i) {
        const Vec3 gathered = gather(&links_[i * n], n, reflected);
        const double area = static_cast<double>(voxels_.slots[i].areaM2 * std::max(kAbsorbs, 1 - luminance(voxels_.slots[i].albedo)));
        const double light = std::max(0.0, static_cast<double>(luminance(gathered + direct_[i])));
        const double r = std::abs(static_cast<double>(luminance(gathered - indirect_[i]))) / (light + kDark * mean + 1e-30);
        sum.light += area * light, sum.lightSquared += area * light * light, sum.area += area, sum.squares += area * r * r, sum.fractions += area * r;
        other[i] += (gathered - other[i]) * omega;
      }
    });
    Sums sum;
    for (const Sums& p : parts) sum.light += p.light, sum.lightSquared += p.lightSquared, sum.area += p.area, sum.squares += p.squares, sum.fractions += p.fractions;
    mean = sum.light > 0 ? sum.lightSquared / sum.light : 0;
    return sum.fractions > 0 ? std::min(sum.squares / sum.fractions, sum.fractions / (kSmall * sum.area)) : 0;
  }

  static Vec3 gather(const Link* links, size_t n, const std::vector<Padded>& reflected) {
    __m128 sum = _mm_setzero_ps();
    for (size_t j = 0; j < n; ++j) sum = _mm_fmadd_ps(_mm_load_ps(reflected[links[j].slot()].v), links[j].left(), sum);
    Padded out;
    _mm_store_ps(out.v, _mm_mul_ps(sum, _mm_set1_ps(Link::kUnit / static_cast<float>(n))));
    return {out.v[0], out.v[1], out.v[2]};
  }

  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceSettings settings_;
  const Progress& progress_;
  const SlotPaths paths_;
  const NearLamps near_;
  std::vector<Link> links_;
  std::vector<Vec3> direct_, indirect_;
  uint64_t rayCount_ = 0;
};

}  // namespace

size_t RadianceField::bytes() const {
  size_t sum = irradianceLux.size() * sizeof(Vec3) + guide.cdf.size() * sizeof(guide.cdf[0]) + glow.bytes() + glowShare.size() * sizeof(float);
  for (const RadianceLevel& level : levels) {
    sum += level.brickIndex.size() * sizeof(int32_t) + level.bricks.size() * sizeof(Brick) + level.planes.size() * (sizeof(DirectionalPlanes) + sizeof(DirectionalLight));
  }
  return sum;
}

RadianceField illuminate(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceSettings& settings, const Progress& progress) {
  return Illuminator(rays, lights, voxels, settings, progress).run();
}

}  // namespace roomlight
