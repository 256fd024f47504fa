#include "radiance/sky_guide.h"

#include <algorithm>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kUnguidedShare = 0.1f;  // keeps every direction possible
constexpr int kX = SkyDistribution::kBlocksX, kY = SkyDistribution::kBlocksY, kBlocks = SkyDistribution::kBlocks;
using Cdf = SkyGuide::Cdf;

float shareOf(const Cdf& cdf, int block) {
  const auto b = static_cast<size_t>(block);
  return cdf.blocks[b] - (b ? cdf.blocks[b - 1] : 0.0f);
}

// How many of them are not above v; they rise.
template <int kCount>
int countUpTo(const float* ends, float v) {
  int n = 0;
  for (int i = 0; i < kCount; ++i) n += ends[i] <= v;
  return n;
}

// The block in whose share v in [0, 1) falls.
int blockFor(const Cdf& cdf, float v) {
  const int row = std::min(countUpTo<kY>(cdf.rows.data(), v), kY - 1);
  return row * kX + std::min(countUpTo<kX>(&cdf.blocks[static_cast<size_t>(row * kX)], v), kX - 1);
}

}  // namespace

SkyGuideBuilder::SkyGuideBuilder(const Voxels& voxels, const SkyDistribution& sky)
    : voxels_(voxels), sky_(sky), blocks_(voxels.bricks.size()) {}

void SkyGuideBuilder::add(size_t brick, int face, Vec3 direction, float open) {
  std::unique_ptr<Blocks>& blocks = blocks_[brick][static_cast<size_t>(face)];
  if (!blocks) blocks = std::make_unique<Blocks>();
  Tries& t = (*blocks)[static_cast<size_t>(sky_.blockOf(direction))];
  t.open += open;
  t.tried += 1;
}

// A brick's own tries, and some weight to those of its neighbours.
SkyGuideBuilder::Blocks SkyGuideBuilder::around(size_t brick, size_t face, float ownWeight) const {
  Blocks sum{};
  const Int3 c = voxels_.bricks[brick].coord;
  for (int k = 0; k < 27; ++k) {
    const int32_t n = voxels_.brickAt({c.x + k % 3 - 1, c.y + k / 3 % 3 - 1, c.z + k / 9 - 1});
    if (n < 0 || !blocks_[static_cast<size_t>(n)][face]) continue;
    const Blocks& from = *blocks_[static_cast<size_t>(n)][face];
    const float w = k == 13 ? ownWeight : 0.1f;
    for (size_t i = 0; i < kBlocks; ++i) {
      sum[i].open += w * from[i].open;
      sum[i].tried += w * from[i].tried;
    }
  }
  return sum;
}

// Light of each block times the share of it that came through. Neighbouring blocks count a little, so that a window
// found by few links is covered to its edges. False where no sky was seen.
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
    cdf.blocks[static_cast<size_t>(i)] = running;
  }
  if (!(running > 0)) return false;
  for (float& v : cdf.blocks) v /= running;
  for (size_t y = 0; y < cdf.rows.size(); ++y) cdf.rows[y] = cdf.blocks[(y + 1) * kX - 1];
  return true;
}

SkyGuide SkyGuideBuilder::finish(const Progress& progress) const { return finish(1, progress); }

SkyGuide SkyGuideBuilder::finishOfOthers(const Progress& progress) const { return finish(0, progress); }

SkyGuide SkyGuideBuilder::finish(float ownWeight, const Progress& progress) const {
  const size_t count = voxels_.bricks.size();
  std::vector<std::array<std::unique_ptr<Cdf>, 6>> found(count);
  parallelFor(count, 16, [&](size_t b) {
    if (progress.stop()) return;
    Cdf cdf;
    for (size_t face = 0; face < 6; ++face) {
      if (blocks_[b][face] && density(around(b, face, ownWeight), cdf)) found[b][face] = std::make_unique<Cdf>(cdf);
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

SkyGuide keptGuide(const SkyGuide& before, const SkyGuide& fresh, const SlotRemap& remap) {
  SkyGuide out;
  out.guideOfBrick.resize(remap.oldBrick.size());
  for (size_t b = 0; b < out.guideOfBrick.size(); ++b) {
    const SkyGuide& from = remap.keeps(b) ? before : fresh;
    const auto& guides = from.guideOfBrick[remap.keeps(b) ? static_cast<size_t>(remap.oldBrick[b]) : b];
    for (size_t face = 0; face < 6; ++face) {
      out.guideOfBrick[b][face] = guides[face] < 0 ? -1 : static_cast<int32_t>(out.cdf.size());
      if (guides[face] >= 0) out.cdf.push_back(from.cdf[static_cast<size_t>(guides[face])]);
    }
  }
  return out;
}

int32_t guideAt(const SkyGuide& guides, const Voxels& voxels, Vec3 p, Vec3 n) {
  return guides.guideOfBrick.empty() ? -1 : guideOfSide(guides, brickSideAt(voxels, p, n));
}

namespace {

// From that of the sky alone.
float guidedPdf(const SkyGuide& guides, int32_t guide, const SkyDistribution& sky, Vec2 uv, float plain) {
  if (guide < 0) return plain;
  const int block = sky.blockAt(uv);
  const float share = sky.blockShare(block);
  return share > 0 ? plain * (kUnguidedShare +
                              (1 - kUnguidedShare) * shareOf(guides.cdf[static_cast<size_t>(guide)], block) / share)
                   : plain;
}

}  // namespace

float pdfSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec2 uv) {
  return guidedPdf(guides, guide, lights.sky(), uv, lights.sky().pdfAt(uv));
}

SkyDistribution::Sample drawSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec2 u,
                                      float choice) {
  const SkyDistribution& sky = lights.sky();
  SkyDistribution::Sample found;
  if (guide < 0 || choice < kUnguidedShare) {
    found = sky.sample(u);
  } else {
    found = sky.sampleBlock(
        blockFor(guides.cdf[static_cast<size_t>(guide)], (choice - kUnguidedShare) / (1 - kUnguidedShare)), u);
  }
  sky.prefetch(found.uv);
  found.pdf = guidedPdf(guides, guide, sky, found.uv, found.pdf);
  return found;
}

LightSample skyLight(const Lights& lights, const SkyDistribution::Sample& drawn) {
  if (!(drawn.pdf > 0)) return {};
  LightSample s;
  s.wi = drawn.d;
  s.pdf = drawn.pdf;
  s.radiance = lights.sky().radianceAt(drawn.uv) / drawn.pdf;
  return s;
}

LightSample sampleSkyGuided(const SkyGuide& guides, int32_t guide, const Lights& lights, Vec2 u, float choice) {
  return skyLight(lights, drawSkyGuided(guides, guide, lights, u, choice));
}

}  // namespace roomlight
