#include "radiance/sky_guide.h"

#include <algorithm>

#include "base/parallel.h"
#include "radiance/slot_lookup.h"

namespace roomlight {
namespace {

constexpr float kUnguidedShare = 0.1f;  // keeps every direction possible
constexpr int kX = SkyDistribution::kBlocksX, kY = SkyDistribution::kBlocksY, kBlocks = SkyDistribution::kBlocks;
using Cdf = std::array<float, kBlocks>;

float shareOf(const Cdf& cdf, int block) {
  const auto b = static_cast<size_t>(block);
  return cdf[b] - (b ? cdf[b - 1] : 0.0f);
}

}  // namespace

SkyGuideBuilder::SkyGuideBuilder(const Voxels& voxels, const SkyDistribution& sky) : voxels_(voxels), sky_(sky), blocks_(voxels.bricks.size()) {}

void SkyGuideBuilder::add(size_t brick, int face, Vec3 direction, float open) {
  std::unique_ptr<Blocks>& blocks = blocks_[brick][static_cast<size_t>(face)];
  if (!blocks) blocks = std::make_unique<Blocks>();
  Tries& t = (*blocks)[static_cast<size_t>(sky_.blockOf(direction))];
  t.open += open;
  t.tried += 1;
}

// A brick's own tries, and some weight to those of its neighbours.
SkyGuideBuilder::Blocks SkyGuideBuilder::around(size_t brick, size_t face) const {
  Blocks sum{};
  const Int3 c = voxels_.bricks[brick].coord;
  for (int k = 0; k < 27; ++k) {
    const int32_t n = voxels_.brickAt({c.x + k % 3 - 1, c.y + k / 3 % 3 - 1, c.z + k / 9 - 1});
    if (n < 0 || !blocks_[static_cast<size_t>(n)][face]) continue;
    const Blocks& from = *blocks_[static_cast<size_t>(n)][face];
    const float w = k == 13 ? 1.0f : 0.1f;
    for (size_t i = 0; i < kBlocks; ++i) {
      sum[i].open += w * from[i].open;
      sum[i].tried += w * from[i].tried;
    }
  }
  return sum;
}

// Light of each block times the share of it that came through. Neighbouring blocks count a little, so that a window found by
// few links is covered to its edges. False where no sky was seen.
bool SkyGuideBuilder::density(const Blocks& tries, Cdf& cdf) const {
  float running = 0;
  for (int i = 0; i < kBlocks; ++i) {
    float open = 0, tried = 0.5f;
    const int x = i % kX, y = i / kX;
    for (int k = 0; k < 9; ++k) {
      const int ny = y + k / 3 - 1;
      if (ny < 0 || ny >= kY) continue;
      const Tries& t = tries[static_cast<size_t>(ny * kX + (x + k % 3 - 1 + kX) % kX)];
      const float w = k == 4 ? 1.0f : 0.15f;
      open += w * t.open;
      tried += w * t.tried;
    }
    running += sky_.blockShare(i) * open / tried;
    cdf[static_cast<size_t>(i)] = running;
  }
  if (!(running > 0)) return false;
  for (float& v : cdf) v /= running;
  return true;
}

SkyGuide SkyGuideBuilder::finish(const Progress& progress) const {
  const size_t count = voxels_.bricks.size();
  std::vector<std::array<std::unique_ptr<Cdf>, 6>> found(count);
  parallelFor(count, 16, [&](size_t b) {
    if (progress.stop()) return;
    Cdf cdf;
    for (size_t face = 0; face < 6; ++face) {
      if (blocks_[b][face] && density(around(b, face), cdf)) found[b][face] = std::make_unique<Cdf>(cdf);
    }
  });
  SkyGuide guide;
  guide.guideOfBrick.resize(count);
  for (size_t b = 0; b < count; ++b) {
    for (size_t face = 0; face < 6; ++face) {
      guide.guideOfBrick[b][face] = found[b][face] ? static_cast<int32_t>(guide.cdf.size()) : -1;
      if (found[b][face]) guide.cdf.push_back(*found[b][face]);
    }
  }
  return guide;
}

SkyGuide carriedGuide(const SkyGuide& before, const SkyGuide& fresh, const Carried& carried) {
  SkyGuide out;
  out.guideOfBrick.resize(carried.oldBrick.size());
  for (size_t b = 0; b < out.guideOfBrick.size(); ++b) {
    const SkyGuide& from = carried.keeps(b) ? before : fresh;
    const auto& guides = from.guideOfBrick[carried.keeps(b) ? static_cast<size_t>(carried.oldBrick[b]) : b];
    for (size_t face = 0; face < 6; ++face) {
      out.guideOfBrick[b][face] = guides[face] < 0 ? -1 : static_cast<int32_t>(out.cdf.size());
      if (guides[face] >= 0) out.cdf.push_back(from.cdf[static_cast<size_t>(guides[face])]);
    }
  }
  return out;
}

int32_t guideAt(const SkyGuide& guides, const Voxels& voxels, Vec3 p, Vec3 n) {
  if (guides.guideOfBrick.empty()) return -1;
  const int32_t b = brickAtSurface(voxels, p, n);
  return b < 0 ? -1 : guides.guideOfBrick[static_cast<size_t>(b)][static_cast<size_t>(dominantFace(n))];
}

namespace {

float pdfAt(const SkyGuide& guides, int32_t guide, const SkyDistribution& sky, Vec2 uv) {
  const float plain = sky.pdfAt(uv);
  if (guide < 0) return plain;
  const int block = sky.blockAt(uv);
  const float share = sky.blockShare(block);
  return share > 0 ? plain * (kUnguidedShare + (1 - kUnguidedShare) * shareOf(guides.cdf[static_cast<size_t>(guide)], block) / share) : plain;
}

}  // namespace

float pdfSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec3 d) { return pdfAt(guides, guide, lights.sky(), lights.sky().toUv(d)); }

LightSample sampleSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec2 u, float choice) {
  const SkyDistribution& sky = lights.sky();
  SkyDistribution::Sample found;
  if (guide < 0 || choice < kUnguidedShare) {
    found = sky.sample(u);
  } else {
    const Cdf& cdf = guides.cdf[static_cast<size_t>(guide)];
    const float v = (choice - kUnguidedShare) / (1 - kUnguidedShare);
    const auto it = std::upper_bound(cdf.begin(), cdf.end(), v);
    found = sky.sampleBlock(std::min(static_cast<int>(it - cdf.begin()), kBlocks - 1), u);
  }
  const float pdf = pdfAt(guides, guide, sky, found.uv);
  if (!(pdf > 0)) return {};
  LightSample s;
  s.wi = found.d;
  s.pdf = pdf;
  s.radiance = sky.radianceAt(found.uv) / pdf;
  return s;
}

}  // namespace roomlight
