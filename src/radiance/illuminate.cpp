#include <limits>
#include <numeric>

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
constexpr int kStepsBetweenLeaps = 6;
constexpr double kLongestLeap = 8;
constexpr double kDark = 1e-4;

// Where a ray from a slot arrives: the slot it sees, and in four bits how much of the light the glass on the way leaves.
struct Link {
  static constexpr uint32_t kNone = (1u << 28) - 1;
  uint32_t packed = kNone;
  Link() = default;
  Link(uint32_t slot, float left) : packed(slot | static_cast<uint32_t>(std::lround(15 * std::clamp(left, 0.0f, 1.0f))) << 28) {}
  uint32_t slot() const { return packed & kNone; }
  bool arrives() const { return slot() != kNone; }
  float left() const { return static_cast<float>(packed >> 28) * (1.0f / 15); }
};

class Illuminator {
 public:
  Illuminator(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceSettings& settings)
      : rays_(rays), lights_(lights), voxels_(voxels), settings_(settings), paths_(rays, voxels, settings.seed), near_(lights, voxels), direct_(voxels.slots.size()), indirect_(voxels.slots.size()) {}

  RadianceField run(const Progress& progress) {
    RadianceField field;
    if (settings_.links > 0) traceLinks(field, progress);
    progress.at(0.5f);
    gatherDirect(field);
    NearLamps::Light near = near_.trace(rays_, paths_, settings_);
    rayCount_ += near.rays;
    for (size_t i = 0; i < near.far.size(); ++i) direct_[i] += near.far[i];
    progress.at(0.8f);
    bounce(field, progress);
    std::vector<Vec3> radiance(voxels_.slots.size());
    field.irradianceLux.resize(voxels_.slots.size());
    parallelFor(radiance.size(), 8192, [&](size_t i) {
      const Vec3 e = direct_[i] + indirect_[i];
      const bool hasNear = !near.near.empty();
      field.irradianceLux[i] = hasNear ? e + near.near[i] : e;
      radiance[i] = voxels_.slots[i].albedo * (hasNear ? e + near.near[i] * near.shown[i] : e) / kPi;
    });
    field.rays = rayCount_;
    buildPyramid(voxels_, radiance, field);
    return field;
  }

 private:
  void traceLinks(RadianceField& field, const Progress& progress) {
    const auto n = static_cast<size_t>(settings_.links);
    links_.resize(voxels_.slots.size() * n);
    SkyGuideBuilder guide(voxels_, lights_.sky());
    const bool sky = lights_.sky().present();
    std::atomic<size_t> done = 0;
    parallelFor(voxels_.bricks.size(), 4, [&](size_t b) {
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
      if (d % 256 == 0) progress.at(0.5f * static_cast<float>(d) / static_cast<float>(voxels_.bricks.size()));
    });
    rayCount_ += links_.size();
    if (sky) field.guide = guide.finish();
  }

  struct Shadow {
    size_t slot;
    Vec3 contribution;
  };

  void gatherDirect(const RadianceField& field) {
    std::atomic<uint64_t> count = 0;
    parallelFor(voxels_.bricks.size(), 4, [&](size_t b) {
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

  // Jacobi iterations of E_i = mean over links of pi L(link), L = rho (E_direct + E) / pi. Every row of the transport matrix
  // sums to at most 1 and rho is below 1, so the gain is below 1 and the series converges.
  void bounce(RadianceField& field, const Progress& progress) {
    const auto n = static_cast<size_t>(settings_.links);
    const size_t slots = voxels_.slots.size();
    if (n == 0) return;
    std::vector<Vec3> reflected(slots), next(slots);  // rho E, i.e. pi times radiance
    double previousDelta = 0, previousQ = 0, deltaAtLeap = std::numeric_limits<double>::infinity();
    for (int k = 0; k < settings_.maxBounces && !progress.stop(); ++k) {
      parallelFor(slots, 8192, [&](size_t i) { reflected[i] = voxels_.slots[i].albedo * (direct_[i] + indirect_[i]); });
      parallelFor(slots, 2048, [&](size_t i) {
        Vec3 sum;
        for (size_t j = i * n; j < (i + 1) * n; ++j) {
          if (links_[j].arrives()) sum += reflected[links_[j].slot()] * links_[j].left();
        }
        next[i] = sum / static_cast<float>(n);
      });
      const double delta = change(next);
      const double q = previousDelta > 0 ? std::min(0.99, delta / previousDelta) : 0.9;
      field.residual = delta * q / (1 - q);
      ++field.bounces;
      const bool done = field.residual <= settings_.residual;
      // Once only the slowest mode is left (light in a bright, nearly closed space) every step shrinks by the same factor, and
      // the rest of the series is known (Lyusternik's acceleration). Checked by the steps that follow.
      if (!done && k % kStepsBetweenLeaps == kStepsBetweenLeaps - 1 && q > 0.7 && std::abs(q - previousQ) < 0.03 && delta < 0.5 * deltaAtLeap) {
        leap(next, static_cast<float>(std::min(kLongestLeap, q / (1 - q))));
        deltaAtLeap = delta;
      }
      previousDelta = delta;
      previousQ = q;
      indirect_.swap(next);
      if (done) break;
    }
  }

  void leap(std::vector<Vec3>& next, float factor) const {
    parallelFor(next.size(), 8192, [&](size_t i) { next[i] = max(Vec3(0), next[i] + (next[i] - indirect_[i]) * factor); });
  }

  // What the iteration changed, as a fraction of the light r of each slot, averaged where there is change: sum a r² / sum a r.
  // So a room counts in full beside a sunlit street that has long converged. What is darker than kDark of the mean hardly
  // counts. Fixed chunks keep the order of the sums, and so the number of iterations, independent of threads.
  double change(const std::vector<Vec3>& next) const {
    const auto sums = [&](auto&& term) {
      const size_t chunks = (next.size() + 65535) / 65536;
      std::vector<std::pair<double, double>> parts(chunks);
      parallelFor(chunks, 1, [&](size_t c) {
        for (size_t i = c * 65536; i < std::min(next.size(), (c + 1) * 65536); ++i) {
          const auto [first, second] = term(i);
          parts[c].first += static_cast<double>(voxels_.slots[i].areaM2) * first;
          parts[c].second += static_cast<double>(voxels_.slots[i].areaM2) * second;
        }
      });
      std::pair<double, double> sum{0, 0};
      for (const auto& p : parts) sum.first += p.first, sum.second += p.second;
      return sum;
    };
    const auto light = [&](size_t i) { return static_cast<double>(luminance(next[i] + direct_[i])); };
    const auto [total, area] = sums([&](size_t i) { return std::pair{light(i), 1.0}; });
    if (!(total > 0)) return 0;
    const double dark = kDark * total / area;
    const auto [squares, fractions] = sums([&](size_t i) {
      const double r = std::abs(static_cast<double>(luminance(next[i] - indirect_[i]))) / (light(i) + dark);
      return std::pair{r * r, r};
    });
    return fractions > 0 ? squares / fractions : 0;
  }

  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceSettings settings_;
  const SlotPaths paths_;
  const NearLamps near_;
  std::vector<Link> links_;
  std::vector<Vec3> direct_, indirect_;
  uint64_t rayCount_ = 0;
};

}  // namespace

size_t RadianceField::bytes() const {
  size_t sum = irradianceLux.size() * sizeof(Vec3) + guide.cdf.size() * sizeof(guide.cdf[0]);
  for (const RadianceLevel& level : levels) {
    sum += level.brickIndex.size() * sizeof(int32_t) + level.bricks.size() * sizeof(Brick) + level.voxels.size() * sizeof(DirectionalVoxel);
  }
  return sum;
}

RadianceField illuminate(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceSettings& settings, const Progress& progress) {
  return Illuminator(rays, lights, voxels, settings).run(progress);
}

}  // namespace roomlight
