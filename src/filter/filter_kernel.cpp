#include "filter/filter_kernel.h"

#include <algorithm>
#include <type_traits>

#include "filter/filter.h"

// Structs here hold vectors, which those of a size that is known only when the program runs cannot be in: arm64 uses
// NEON.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/filter_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace roomlight {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

constexpr float kKernel[3] = {0.25f, 0.2f, 0.1f};   // of the pixel, of those beside it, of those at its corners
constexpr float kSmooth[3] = {0.25f, 0.125f, 0.0625f};  // the same of levels: hats, twice as wide each
constexpr float kSigmas[kFilterLights] = {
    2, 1, 2.5f,
    0};  // differences within so many standard deviations count as noise; sharp shadows differ where they should
constexpr float kOwnNoise = 0.5f;  // of a pixel's own variance counts at least, so that an outlier is taken for one
constexpr float kPlaneTolerance = 0.02f;  // metres off the tangent plane, and
constexpr float kSlope = 0.5f;  // of the distance between the two points along it
constexpr float kLeastFacing = 0.3f;  // cosine between normals
constexpr float kNoSamples = 1e-6f;  // instead of a weight of zero
constexpr float kUnseen = -1;  // where no pixel has samples yet: like everything
constexpr float kSameRoughness = 0.1f;
constexpr int kFinestSeen = 8;  // pixels: coarser levels of diffuse light no longer tell rare light where it changes
constexpr float kCompany = 2;  // so many around must show the same surface
constexpr float kSameLevel =
    0.125f;  // of the sum of two pixels' diffuse light: rare light spreads where that differs by no more

V load(const float* p) { return hn::LoadU(D(), p); }
V set(float v) { return hn::Set(D(), v); }

struct V3 {
  V x, y, z;

  V3() {}  // written out: one that GCC makes by itself lacks the instruction set of this namespace
  V3(V first, V second, V third) : x(first), y(second), z(third) {}
};
V3 load3(const float* p, ptrdiff_t pitch) { return {load(p), load(p + pitch), load(p + 2 * pitch)}; }
V dot(const V3& a, const V3& b) { return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z))); }
V luminance(const V3& c) { return dot(c, {set(0.2126f), set(0.7152f), set(0.0722f)}); }

// e^-x from 0 to 3 within 0.03; 0 from 8 on.
V falloff(V x) {
  const V a = hn::Max(hn::Zero(D()), hn::NegMulAdd(set(0.125f), x, set(1))), b = hn::Mul(a, a), c = hn::Mul(b, b);
  return hn::Mul(c, c);
}

// What pixels see.
struct Place {
  V3 n, p;
};
Place reflectedAt(const float* pixel, ptrdiff_t pitch) {
  return {load3(pixel + FilterRows::kReflected * pitch, pitch),
          load3(pixel + (FilterRows::kReflected + 3) * pitch, pitch)};
}
Place placeAt(const float* pixel, ptrdiff_t pitch) {
  return {load3(pixel + FilterRows::kNormal * pitch, pitch), load3(pixel + FilterRows::kPosition * pitch, pitch)};
}

// How far two places are off each other's tangent plane, in tolerances. These grow with the distance along the plane,
// so that what hangs before a wall is far from it, however near in the picture.
V offPlane(const Place& a, const Place& b) {
  const V3 between{hn::Sub(b.p.x, a.p.x), hn::Sub(b.p.y, a.p.y), hn::Sub(b.p.z, a.p.z)};
  const V off = hn::Max(hn::Abs(dot(a.n, between)), hn::Abs(dot(b.n, between)));
  const V along = hn::Sqrt(hn::Max(hn::Zero(D()), hn::NegMulAdd(off, off, dot(between, between))));
  return hn::Div(off, hn::MulAdd(set(kSlope), along, set(kPlaneTolerance)));
}

// cosine^4 between normals, 0 where they differ too much: noise itself tells edges that light has.
V likeness(V facing) {
  const V f2 = hn::Mul(facing, facing);
  return hn::IfThenElseZero(hn::Ge(facing, set(kLeastFacing)), hn::Mul(f2, f2));
}

void findNoise(FilterRows& rows, const FilterPass& pass, int light, int y) {
  const D d;
  const int variance = FilterRows::light(light, pass.place[light]) + FilterRows::kVariance;
  const float *above = rows.line(variance, std::max(0, y - 1)), *own = rows.line(variance, y),
              *below = rows.line(variance, std::min(rows.height() - 1, y + 1));
  const ptrdiff_t weights = (FilterRows::kWeight - FilterRows::kVariance) * rows.pitch();
  float* out = rows.line(FilterRows::kNoise + light, y);
  for (ptrdiff_t x = 0; x < rows.width(); x += static_cast<ptrdiff_t>(hn::Lanes(d))) {
    if (light == 1) {
      // Penumbras have noise all over, the edge of a sharp shadow in a line of pixels.
      V least = load(own + x);
      for (const float* line : {above, own, below})
        least = hn::Min(least, hn::Min(hn::Min(load(line + x - 1), load(line + x)), load(line + x + 1)));
      hn::StoreU(least, d, out + x);
      continue;
    }
    V sum = hn::Zero(d), sampled = hn::Zero(d);
    for (const float* line : {above, own, below}) {
      sum = hn::Add(sum, hn::Add(hn::Add(load(line + x - 1), load(line + x)), load(line + x + 1)));
      for (int i = -1; i <= 1; ++i)
        sampled = hn::Add(sampled, hn::IfThenElseZero(hn::Gt(load(line + weights + x + i), hn::Zero(d)), set(1)));
    }
    const V found =
        hn::Max(hn::Mul(sum, hn::Div(set(1), hn::Max(sampled, set(1)))), hn::Mul(load(own + x), set(kOwnNoise)));
    hn::StoreU(hn::Mul(found, set(pass.correlated)), d, out + x);
  }
}

void findSeen(FilterRows& rows, const FilterPass& pass, int light, int y) {
  const D d;
  const ptrdiff_t pitch = rows.pitch(), colour = FilterRows::light(light, pass.place[light]) * pitch;
  const float* row = rows.line(0, y);
  float* out = rows.line(FilterRows::kSeen + light, y);
  for (ptrdiff_t x = 0; x < rows.width(); x += static_cast<ptrdiff_t>(hn::Lanes(d))) {
    const float* here = row + x;
    const ptrdiff_t samples = colour + FilterRows::kWeight * pitch;
    V sum = luminance(load3(here + colour, pitch)), total = load(here + samples);
    if (light == 0) {
      const Place own = placeAt(here, pitch);
      sum = hn::Mul(sum, total);
      for (int j = y > 0 ? -1 : 0; j <= (y + 1 < rows.height() ? 1 : 0); ++j) {
        for (int i = -1; i <= 1; ++i) {
          if (i == 0 && j == 0) continue;
          const float* there = here + j * rows.rowPitch() + i;
          const Place other = placeAt(there, pitch);
          const V weight =
              hn::Mul(load(there + samples), hn::Mul(likeness(dot(own.n, other.n)), falloff(offPlane(own, other))));
          sum = hn::MulAdd(weight, luminance(load3(there + colour, pitch)), sum), total = hn::Add(total, weight);
        }
      }
      sum = hn::Div(sum, hn::Max(total, set(kNoSamples)));
    }
    hn::StoreU(hn::IfThenElse(hn::Gt(total, hn::Zero(d)), sum, set(kUnseen)), d, out + x);
  }
}

void prepare(FilterRows& rows, const FilterPass& pass, int y) {
  for (int k = 0; k < kFilterLights; ++k) {
    if (!pass.filter[k] || k == 3) continue;
    if (k == 0 && pass.levels) {
      if (pass.step <= kFinestSeen) findSeen(rows, pass, k, y);
      continue;
    }
    findNoise(rows, pass, k, y);
    findSeen(rows, pass, k, y);
  }
}

// A weighted mean under way, and the pixel it is for. Pixels weigh by their samples: those that got more were chosen by
// what their first samples found, so that a mean of pixels alike would be too dark (rare bright samples made themselves
// rarer), the mean of all samples is not.
struct Sum {
  V3 own;
  V ownVariance, ownWeight, seen, noise;
  V3 light;
  V variance, total, kernel;
  V open;

  Sum() = default;
  Sum(const V3& c, V v, V w, V s, V n)
      : own(c),
        ownVariance(v),
        ownWeight(w),
        seen(s),
        noise(n),
        total(hn::Mul(w, set(kKernel[0]))),
        kernel(set(kKernel[0])) {
    light = {hn::Mul(c.x, total), hn::Mul(c.y, total), hn::Mul(c.z, total)};
    variance = hn::Mul(v, hn::Mul(total, total));
  }
  // By surfaces alone.
  static Sum ofLevel(const V3& c, V drawn, V w, V openness) {
    Sum s;
    s.own = c, s.ownVariance = drawn, s.ownWeight = w, s.kernel = set(kSmooth[0]), s.total = hn::Mul(w, s.kernel);
    s.light = {hn::Mul(c.x, s.total), hn::Mul(c.y, s.total), hn::Mul(c.z, s.total)},
    s.variance = hn::Mul(drawn, s.total), s.open = hn::Mul(openness, s.total);
    return s;
  }
  void addLevel(const V3& c, V drawn, V openness, V samples, V share) {
    const V weight = hn::Mul(samples, share);
    light = {hn::MulAdd(c.x, weight, light.x), hn::MulAdd(c.y, weight, light.y), hn::MulAdd(c.z, weight, light.z)};
    variance = hn::MulAdd(drawn, weight, variance), open = hn::MulAdd(openness, weight, open);
    total = hn::Add(total, weight), kernel = hn::Add(kernel, share);
  }
  void add(const V3& c, V v, V samples, V share) {
    const V weight = hn::Mul(samples, share);
    light = {hn::MulAdd(c.x, weight, light.x), hn::MulAdd(c.y, weight, light.y), hn::MulAdd(c.z, weight, light.z)};
    variance = hn::MulAdd(v, hn::Mul(weight, weight), variance);
    total = hn::Add(total, weight), kernel = hn::Add(kernel, share);
  }
};

enum Diffuse { kNone, kByNoise, kByLevels };

// Pixels that are filtered together.
struct Centre {
  float* here;
  ptrdiff_t pitch;
  Place own, reflected;
  V roughness;
};

// Pixels as far from all of these.
struct Beside {
  const float* there;
  int off;  // steps
  V facing, kernel, offPlane;
};

template <Diffuse kDiffuse>
HWY_INLINE Sum ownLight(const FilterPass& pass, int k, const Centre& c) {
  const float* at = c.here + FilterRows::light(k, pass.place[k]) * c.pitch;
  if (k == 0 && kDiffuse == kByLevels)
    return Sum::ofLevel(load3(at, c.pitch), load(at + FilterRows::kVariance * c.pitch),
                        load(at + FilterRows::kWeight * c.pitch),
                        load(c.here + FilterRows::open(pass.place[0]) * c.pitch));
  return Sum(load3(at, c.pitch), load(at + FilterRows::kVariance * c.pitch), load(at + FilterRows::kWeight * c.pitch),
             load(c.here + (FilterRows::kSeen + k) * c.pitch), load(c.here + (FilterRows::kNoise + k) * c.pitch));
}

HWY_INLINE void addLevel(const FilterPass& pass, const Centre& c, const Beside& b, Sum& s) {
  const float* at = b.there + FilterRows::light(0, pass.place[0]) * c.pitch;
  s.addLevel(load3(at, c.pitch), load(at + FilterRows::kVariance * c.pitch),
             load(b.there + FilterRows::open(pass.place[0]) * c.pitch), load(at + FilterRows::kWeight * c.pitch),
             hn::Mul(hn::Mul(set(kSmooth[b.off]), b.facing), falloff(b.offPlane)));
}

// Its own noise tells nothing: what other diffuse light there is tells where it changes.
HWY_INLINE void addRare(const FilterPass& pass, const Centre& c, const Beside& b, Sum& s) {
  const D d;
  const V one = load(c.here + FilterRows::kSeen * c.pitch), two = load(b.there + FilterRows::kSeen * c.pitch);
  const V apart =
      hn::Div(hn::Abs(hn::Sub(one, two)),
              hn::MulAdd(set(kSameLevel), hn::Add(hn::Max(one, hn::Zero(d)), hn::Max(two, hn::Zero(d))), set(1e-6f)));
  const V level =
      hn::IfThenElseZero(hn::Ge(hn::Min(one, two), hn::Zero(d)), hn::Mul(apart, apart));  // unseen: like everything
  const float* at = b.there + FilterRows::light(3, pass.place[3]) * c.pitch;
  s.add(load3(at, c.pitch), hn::Zero(d), load(at + FilterRows::kWeight * c.pitch),
        hn::Mul(b.kernel, falloff(hn::Add(b.offPlane, level))));
}

HWY_INLINE void addByNoise(const FilterPass& pass, int k, const Centre& c, const Beside& b, Sum& s) {
  const D d;
  // How far the light of two pixels differs, in units of their noise together: as seen from either, so that as much
  // passes from a bright spot to its surroundings as back.
  const V noise = hn::Sqrt(hn::Add(s.noise, load(b.there + (FilterRows::kNoise + k) * c.pitch)));
  const V seen = load(b.there + (FilterRows::kSeen + k) * c.pitch);
  const V between = hn::IfThenElseZero(hn::Ge(hn::Min(seen, s.seen), hn::Zero(d)), hn::Abs(hn::Sub(seen, s.seen)));
  V apart = b.offPlane, like = b.kernel;
  if (k == 2) {
    const Place reflected = reflectedAt(b.there, c.pitch);
    apart = hn::Max(b.offPlane, offPlane(c.reflected, reflected));
    like = hn::Mul(set(kKernel[b.off]), hn::Min(b.facing, likeness(dot(c.reflected.n, reflected.n))));
  }
  V weight = hn::Mul(like, falloff(hn::Add(apart, hn::Div(between, hn::MulAdd(set(kSigmas[k]), noise, set(1e-6f))))));
  if (k == 2) {
    const V r = load(b.there + FilterRows::kRoughness * c.pitch);
    const auto alike =
        hn::And(hn::Ge(r, set(kMirrorRoughness)), hn::Le(hn::Abs(hn::Sub(r, c.roughness)), set(kSameRoughness)));
    weight = hn::IfThenElseZero(alike, weight);
  }
  const float* at = b.there + FilterRows::light(k, pass.place[k]) * c.pitch;
  s.add(load3(at, c.pitch), load(at + FilterRows::kVariance * c.pitch), load(at + FilterRows::kWeight * c.pitch),
        weight);
}

template <Diffuse kDiffuse>
HWY_INLINE void storeMean(const FilterPass& pass, int k, const Centre& c, const Sum& s) {
  const D d;
  const V inverse = hn::Div(set(1), hn::Max(s.total, set(kNoSamples)));
  const auto kept = hn::Lt(c.roughness, set(k == 2 ? kMirrorRoughness : -1));
  float* at = c.here + FilterRows::light(k, 1 - pass.place[k]) * c.pitch;
  hn::StoreU(hn::IfThenElse(kept, s.own.x, hn::Mul(s.light.x, inverse)), d, at);
  hn::StoreU(hn::IfThenElse(kept, s.own.y, hn::Mul(s.light.y, inverse)), d, at + c.pitch);
  hn::StoreU(hn::IfThenElse(kept, s.own.z, hn::Mul(s.light.z, inverse)), d, at + 2 * c.pitch);
  if (k == 0 && kDiffuse == kByLevels)
    hn::StoreU(hn::Mul(s.open, inverse), d, c.here + FilterRows::open(1 - pass.place[0]) * c.pitch);
  const V spread = k == 0 && kDiffuse == kByLevels ? inverse : hn::Mul(inverse, inverse);
  hn::StoreU(hn::IfThenElse(kept, s.ownVariance, hn::Mul(s.variance, spread)), d, at + FilterRows::kVariance * c.pitch);
  hn::StoreU(hn::IfThenElse(kept, s.ownWeight, hn::Div(s.total, s.kernel)), d, at + FilterRows::kWeight * c.pitch);
}

template <Diffuse kDiffuse, bool kSharp, bool kSpecular, bool kRare>
void filterPixels(FilterRows& rows, const FilterPass& pass, int y) {
  const D d;
  constexpr bool kUsed[kFilterLights] = {kDiffuse != kNone, kSharp, kSpecular, kRare};
  const ptrdiff_t pitch = rows.pitch();
  float* row = rows.line(0, y);
  for (ptrdiff_t x = 0; x < rows.width(); x += static_cast<ptrdiff_t>(hn::Lanes(d))) {
    float* here = row + x;
    const Place own = placeAt(here, pitch);
    const Centre centre{here, pitch, own, kSpecular ? reflectedAt(here, pitch) : own,
                        load(here + FilterRows::kRoughness * pitch)};
    Sum sums[kFilterLights];
    for (int k = 0; k < kFilterLights; ++k) {
      if (kUsed[k]) sums[k] = ownLight<kDiffuse>(pass, k, centre);
    }
    for (int j = -1; j <= 1; ++j) {
      if (y + j * pass.step < 0 || y + j * pass.step >= rows.height()) continue;
      for (int i = -1; i <= 1; ++i) {
        if (i == 0 && j == 0) continue;
        const float* there = here + j * pass.step * rows.rowPitch() + i * pass.step;
        const int off = std::abs(i) + std::abs(j);
        const Place other = placeAt(there, pitch);
        const V facing = likeness(dot(own.n, other.n));
        const Beside beside{there, off, facing, hn::Mul(set(kKernel[off]), facing), offPlane(own, other)};
        for (int k = 0; k < kFilterLights; ++k) {
          if (!kUsed[k]) continue;
          if (k == 0 && kDiffuse == kByLevels) {
            addLevel(pass, centre, beside, sums[k]);
          } else if (k == 3) {
            addRare(pass, centre, beside, sums[k]);
          } else {
            addByNoise(pass, k, centre, beside, sums[k]);
          }
        }
      }
    }
    for (int k = 0; k < kFilterLights; ++k) {
      if (kUsed[k]) storeMean<kDiffuse>(pass, k, centre, sums[k]);
    }
  }
}

// How much of the pixels around shows the same surface, into the line of what is seen.
void takeCompany(FilterRows& rows, int y) {
  const D d;
  const float* row = rows.line(0, y);
  float* out = rows.line(FilterRows::kSeen, y);
  for (ptrdiff_t x = 0; x < rows.width(); x += static_cast<ptrdiff_t>(hn::Lanes(d))) {
    const float* here = row + x;
    const Place own = placeAt(here, rows.pitch());
    V sum = hn::Zero(d);
    for (int j = -kCompanyReach; j <= kCompanyReach; ++j) {
      if (y + j < 0 || y + j >= rows.height()) continue;
      for (int i = -kCompanyReach; i <= kCompanyReach; ++i) {
        if (i == 0 && j == 0) continue;
        const Place other = placeAt(here + j * rows.rowPitch() + i, rows.pitch());
        sum = hn::Add(sum, hn::Mul(likeness(dot(own.n, other.n)), falloff(offPlane(own, other))));
      }
    }
    hn::StoreU(sum, d, out + x);
  }
}

void dropLonely(FilterRows& rows, int y) {
  const D d;
  const float* company = rows.line(FilterRows::kSeen, y);
  for (int c = 0; c < 3; ++c) {
    float* normal = rows.line(FilterRows::kNormal + c, y);
    for (ptrdiff_t x = 0; x < rows.width(); x += static_cast<ptrdiff_t>(hn::Lanes(d)))
      hn::StoreU(hn::IfThenElseZero(hn::Ge(load(company + x), set(kCompany)), load(normal + x)), d, normal + x);
  }
}

void pool(FilterRows& rows, int step, int place, int y) {
  const D d;
  const ptrdiff_t pitch = rows.pitch(), from = FilterRows::pool(place) * pitch,
                  to = FilterRows::pool(1 - place) * pitch;
  float* row = rows.line(0, y);
  for (ptrdiff_t x = 0; x < rows.width(); x += static_cast<ptrdiff_t>(hn::Lanes(d))) {
    float* here = row + x;
    const Place own = placeAt(here, pitch);
    V total = set(kKernel[0]), sums[FilterRows::kPooled];
    for (int q = 0; q < FilterRows::kPooled; ++q) sums[q] = hn::Mul(load(here + from + q * pitch), total);
    for (int j = -1; j <= 1; ++j) {
      if (y + j * step < 0 || y + j * step >= rows.height()) continue;
      for (int i = -1; i <= 1; ++i) {
        if (i == 0 && j == 0) continue;
        const float* there = here + j * step * rows.rowPitch() + i * step;
        const Place other = placeAt(there, pitch);
        const V weight = hn::Mul(set(kKernel[std::abs(i) + std::abs(j)]),
                                 hn::Mul(likeness(dot(own.n, other.n)), falloff(offPlane(own, other))));
        for (int q = 0; q < FilterRows::kPooled; ++q)
          sums[q] = hn::MulAdd(weight, load(there + from + q * pitch), sums[q]);
        total = hn::Add(total, weight);
      }
    }
    for (int q = 0; q < FilterRows::kPooled; ++q) hn::StoreU(hn::Div(sums[q], total), d, here + to + q * pitch);
  }
}

template <Diffuse kDiffuse, bool kRare>
void filterOthers(FilterRows& rows, const FilterPass& pass, int y) {
  if (pass.filter[1])
    return pass.filter[2] ? filterPixels<kDiffuse, true, true, kRare>(rows, pass, y)
                          : filterPixels<kDiffuse, true, false, kRare>(rows, pass, y);
  return pass.filter[2] ? filterPixels<kDiffuse, false, true, kRare>(rows, pass, y)
                        : filterPixels<kDiffuse, false, false, kRare>(rows, pass, y);
}

void filterLights(FilterRows& rows, const FilterPass& pass, int y) {
  if (!pass.filter[0])
    return pass.filter[3] ? filterOthers<kNone, true>(rows, pass, y) : filterOthers<kNone, false>(rows, pass, y);
  if (pass.levels)
    return pass.filter[3] ? filterOthers<kByLevels, true>(rows, pass, y)
                          : filterOthers<kByLevels, false>(rows, pass, y);
  return pass.filter[3] ? filterOthers<kByNoise, true>(rows, pass, y) : filterOthers<kByNoise, false>(rows, pass, y);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace roomlight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace roomlight {
namespace {

HWY_EXPORT(prepare);
HWY_EXPORT(filterLights);
HWY_EXPORT(pool);
HWY_EXPORT(takeCompany);
HWY_EXPORT(dropLonely);
constexpr ptrdiff_t kMostLanes = 16;  // the last vector of a line reaches so far beyond it

}  // namespace

FilterRows::FilterRows(int w, int h, int margin)
    : width_(w),
      height_(h),
      margin_(margin),
      pitch_(w + 2 * ptrdiff_t{margin} + kMostLanes),
      floats_(largeFloats(static_cast<size_t>(pitch_) * kCount * static_cast<size_t>(h))),
      begin_(floats_.get() + margin) {}

void FilterRows::clearMargins(int y) {
  for (int q = 0; q < kCount; ++q) {
    float* at = line(q, y);
    const float value = q >= kLight && q < kKept && (q - kLight) % kParts == kWeight ? 1.0f : 0.0f;
    std::fill(at - margin_, at, value);
    std::fill(at + width_, at - margin_ + pitch_, value);
  }
}

void prepareRow(FilterRows& rows, const FilterPass& pass, int y) {
  HWY_DYNAMIC_DISPATCH(prepare)
  (rows, pass, y);
}
void filterRow(FilterRows& rows, const FilterPass& pass, int y) {
  HWY_DYNAMIC_DISPATCH(filterLights)
  (rows, pass, y);
}
void findCompany(FilterRows& rows, int y) {
  HWY_DYNAMIC_DISPATCH(takeCompany)
  (rows, y);
}
void leaveLonely(FilterRows& rows, int y) {
  HWY_DYNAMIC_DISPATCH(dropLonely)
  (rows, y);
}
void poolRow(FilterRows& rows, int step, int place, int y) {
  HWY_DYNAMIC_DISPATCH(pool)
  (rows, step, place, y);
}

}  // namespace roomlight
#endif
