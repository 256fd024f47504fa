#include "radiance/sky_guide.h"

#include "base/parallel.h"
#include "base/sampling.h"

namespace roomlight {
namespace {

constexpr float kUnguidedShare = 0.15f;  // keeps every direction possible
constexpr int kCells = kGuideSize * kGuideSize;
using Cells = std::array<float, kCells>;

int cellOf(Vec3 d) {
  const Vec2 uv = octahedralUv(d);
  const int x = std::clamp(static_cast<int>(uv.x * kGuideSize), 0, kGuideSize - 1);
  const int y = std::clamp(static_cast<int>(uv.y * kGuideSize), 0, kGuideSize - 1);
  return y * kGuideSize + x;
}

// Solid angle per unit of octahedral area around the map's point: |n|³ with n the unnormalised point (its l2 norm).
float octahedralJacobian(Vec2 uv) {
  const float x = std::abs(2 * uv.x - 1), y = std::abs(2 * uv.y - 1);
  Vec3 d{x, y, 1 - x - y};
  if (d.z < 0) d = {1 - y, 1 - x, d.z};
  const float l = length(d);
  return 4 / (l * l * l);
}

void addTo(Cells& out, const Cells& in, float w) {
  for (int i = 0; i < kCells; ++i) out[static_cast<size_t>(i)] += w * in[static_cast<size_t>(i)];
}

// Neighbouring cells get a share, so that a window found by few links is covered to its edges.
Cells blurred(const Cells& in) {
  Cells out{};
  for (int y = 0; y < kGuideSize; ++y) {
    for (int x = 0; x < kGuideSize; ++x) {
      for (int k = 0; k < 9; ++k) {
        const int nx = x + k % 3 - 1, ny = y + k / 3 - 1;
        if (nx < 0 || ny < 0 || nx >= kGuideSize || ny >= kGuideSize) continue;
        out[static_cast<size_t>(y * kGuideSize + x)] += in[static_cast<size_t>(ny * kGuideSize + nx)] * (k == 4 ? 0.5f : 0.0625f);
      }
    }
  }
  return out;
}

}  // namespace

SkyGuideBuilder::SkyGuideBuilder(const Voxels& voxels) : histograms_(voxels.bricks.size(), Cells{}) {}

void SkyGuideBuilder::add(size_t brick, Vec3 direction, float weight) {
  histograms_[brick][static_cast<size_t>(cellOf(direction))] += weight;
}

SkyGuide SkyGuideBuilder::finish(const Voxels& voxels) {
  const size_t count = voxels.bricks.size();
  std::vector<Cells> shared(count, Cells{});
  std::vector<uint8_t> any(count, 0);
  parallelFor(count, 16, [&](size_t b) {
    const Int3 c = voxels.bricks[b].coord;
    for (int k = 0; k < 27; ++k) {
      const int32_t n = voxels.brickAt({c.x + k % 3 - 1, c.y + k / 3 % 3 - 1, c.z + k / 9 - 1});
      if (n >= 0) addTo(shared[b], histograms_[static_cast<size_t>(n)], k == 13 ? 1.0f : 0.1f);
    }
    Cells cells = blurred(shared[b]);
    float sum = 0;
    for (float& v : cells) sum += v, v = sum;
    any[b] = sum > 0;
    if (sum > 0) {
      for (float& v : cells) v /= sum;
    }
    shared[b] = cells;
  });
  SkyGuide guide;
  guide.guideOfBrick.assign(count, -1);
  for (size_t b = 0; b < count; ++b) {
    if (!any[b]) continue;
    guide.guideOfBrick[b] = static_cast<int32_t>(guide.cdf.size());
    guide.cdf.push_back(shared[b]);
  }
  return guide;
}

namespace {

float plainPdf(const SkyDistribution& sky, Vec3 d) { return sky.sampled() ? sky.pdf(d) : 1 / (4 * kPi); }

const Cells* guideAt(const SkyGuide& guide, int32_t brick) {
  if (brick < 0 || guide.guideOfBrick.empty()) return nullptr;
  const int32_t index = guide.guideOfBrick[static_cast<size_t>(brick)];
  return index < 0 ? nullptr : &guide.cdf[static_cast<size_t>(index)];
}

}  // namespace

float pdfSkyGuided(const SkyGuide& guide, int32_t brick, const Lights& lights, Vec3 d) {
  const Cells* cdf = guideAt(guide, brick);
  const float plain = plainPdf(lights.sky(), d);
  if (!cdf) return plain;
  const auto c = static_cast<size_t>(cellOf(d));
  const float share = (*cdf)[c] - (c ? (*cdf)[c - 1] : 0.0f);
  return kUnguidedShare * plain + (1 - kUnguidedShare) * share * kCells / octahedralJacobian(octahedralUv(d));
}

LightSample sampleSkyGuided(const SkyGuide& guide, int32_t brick, const Lights& lights, Vec2 u, float choice) {
  const SkyDistribution& sky = lights.sky();
  const Cells* cdf = guideAt(guide, brick);
  LightSample s;
  if (!cdf || choice < kUnguidedShare) {
    s.wi = sky.sampled() ? sky.sample(u).d : sampleSphere(u);
  } else {
    const float v = (choice - kUnguidedShare) / (1 - kUnguidedShare);
    const auto it = std::upper_bound(cdf->begin(), cdf->end(), v);
    const int c = std::min(static_cast<int>(it - cdf->begin()), kCells - 1);
    s.wi = octahedralDirection({(static_cast<float>(c % kGuideSize) + u.x) / kGuideSize, (static_cast<float>(c / kGuideSize) + u.y) / kGuideSize});
  }
  const float pdf = pdfSkyGuided(guide, brick, lights, s.wi);
  if (!(pdf > 0)) return {};
  s.pdf = pdf;
  s.radiance = sky.radiance(s.wi) / pdf;
  return s;
}

}  // namespace roomlight
