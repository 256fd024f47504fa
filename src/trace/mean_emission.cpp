#include "trace/mean_emission.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "scene/surface.h"

namespace roomlight {
namespace {

constexpr int kBlock = 8;              // texels
constexpr double kOne = 1 << 24;       // of a block's mean, in whole numbers
constexpr float kTexelsPerSample = 4;  // one bilinear look-up sees about four
constexpr size_t kFewestSamples = 8, kMostSamples = 4096, kMostPerMesh = size_t{1} << 22;
constexpr float kLeast = 0.1f;  // of the mean around a triangle, in case its look-ups miss what shines

// First and last texel along one axis that look-ups between two coordinates read. All, where they wrap around.
std::pair<int, int> texelsBetween(float lo, float hi, int size, Wrap wrap) {
  const auto texel = [&](float u) { return std::floor(std::clamp(static_cast<double>(u) * size, -1e8, 1e8) - 0.5); };
  double first = texel(lo) - 1, last = texel(hi) + 2;  // one more for rounding
  if (wrap == Wrap::ClampToEdge) {
    const auto clamped = [&](double t) { return static_cast<int>(std::clamp(t, 0.0, size - 1.0)); };
    return {clamped(first), clamped(last)};
  }
  if (wrap == Wrap::Repeat) {
    const double turns = std::floor(texel(lo) / size) * size;
    first -= turns, last -= turns;
  }
  if (!(first >= 0 && last < size)) return {0, size - 1};
  return {static_cast<int>(first), static_cast<int>(last)};
}

// Means around a triangle, 1 where no texture says otherwise.
float meanAround(const BlockSums* sums, const Mesh& mesh, uint32_t triangle, const TextureRef& ref) {
  if (!sums) return 1;
  Vec2 lo{kInfinity, kInfinity}, hi{-kInfinity, -kInfinity};
  for (size_t k = 0; k < 3; ++k) {
    const Vec2 uv = transformUv(ref, mesh.uv[ref.uvSet][mesh.indices[size_t{3} * triangle + k]]);
    lo = {std::min(lo.x, uv.x), std::min(lo.y, uv.y)}, hi = {std::max(hi.x, uv.x), std::max(hi.y, uv.y)};
  }
  return sums->meanAround(lo, hi);
}

// Mean of look-ups spread evenly over the triangle.
float meanOfSamples(const Scene& scene, const Mesh& mesh, uint32_t triangle, size_t samples) {
  double sum = 0;
  for (size_t i = 0; i < samples; ++i) {
    const float v = 0.6180340f * static_cast<float>(i) + 0.5f;  // golden ratio: even in the square
    const Vec2 b = sampleTriangle({(static_cast<float>(i) + 0.5f) / static_cast<float>(samples), v - std::floor(v)});
    sum += static_cast<double>(luminance(materialAt(scene, mesh, {triangle, b.x, b.y}).emission));
  }
  return static_cast<float>(sum / static_cast<double>(samples));
}

}  // namespace

bool emitsEvenly(const Material& material) {
  return material.emissionTexture.texture < 0 && material.alphaMode == AlphaMode::Opaque;
}

BlockSums::BlockSums(const Texture& texture, Of what)
    : texture_(texture),
      columns_((static_cast<size_t>(texture.width) + kBlock - 1) / kBlock),
      rows_((static_cast<size_t>(texture.height) + kBlock - 1) / kBlock),
      sums_((columns_ + 1) * (rows_ + 1)) {
  const size_t stride = columns_ + 1;
  parallelFor(rows_, 1, [&](size_t y) {
    for (size_t x = 0; x < columns_; ++x) {
      // Where four texels meet a look-up is their mean.
      double sum = 0;
      for (int k = 0; k < kBlock * kBlock / 4; ++k) {
        const size_t tx = x * kBlock + static_cast<size_t>(2 * (k % (kBlock / 2)) + 1),
                     ty = y * kBlock + static_cast<size_t>(2 * (k / (kBlock / 2)) + 1);
        const Rgba value = sampleTexture(texture,
                                         {static_cast<float>(tx) / static_cast<float>(texture.width),
                                          static_cast<float>(ty) / static_cast<float>(texture.height)},
                                         true);
        sum += static_cast<double>(what == Of::Light ? luminance(value.rgb) : value.a);
      }
      sums_[(y + 1) * stride + x + 1] = static_cast<uint64_t>(std::ceil(sum / (kBlock * kBlock / 4) * kOne));
    }
  });
  for (size_t y = 1; y <= rows_; ++y) {
    for (size_t x = 1; x <= columns_; ++x) sums_[y * stride + x] += sums_[y * stride + x - 1];
    for (size_t x = 1; x <= columns_; ++x) sums_[y * stride + x] += sums_[(y - 1) * stride + x];
  }
}

float BlockSums::meanAround(Vec2 lo, Vec2 hi) const {
  const auto [x0, x1] = texelsBetween(lo.x, hi.x, texture_.width, texture_.wrapU);
  const auto [y0, y1] = texelsBetween(lo.y, hi.y, texture_.height, texture_.wrapV);
  const auto left = static_cast<size_t>(x0 / kBlock), right = static_cast<size_t>(x1 / kBlock) + 1;
  const auto top = static_cast<size_t>(y0 / kBlock), bottom = static_cast<size_t>(y1 / kBlock) + 1;
  const auto at = [&](size_t x, size_t y) { return sums_[y * (columns_ + 1) + x]; };
  const uint64_t sum = at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
  return static_cast<float>(static_cast<double>(sum) / kOne / static_cast<double>((right - left) * (bottom - top)));
}

const std::vector<float>& MeanEmission::ofMesh(int mesh) {
  const auto [entry, isNew] = known_.try_emplace(mesh);
  if (isNew) entry->second = compute(scene_.meshes[static_cast<size_t>(mesh)]);
  return entry->second;
}

std::vector<float> MeanEmission::compute(const Mesh& mesh) {
  const Material& material = scene_.materials[static_cast<size_t>(mesh.material)];
  std::vector<float> means(mesh.triangleCount(), luminance(material.emission));
  if (emitsEvenly(material) || means.empty()) return means;
  const TextureRef &emission = material.emissionTexture, &base = material.baseColorTexture;
  const bool holes = material.alphaMode != AlphaMode::Opaque;
  const BlockSums* light = sumsOf(emission, mesh, BlockSums::Of::Light);
  const BlockSums* alpha = holes ? sumsOf(base, mesh, BlockSums::Of::Alpha) : nullptr;
  const size_t most = std::clamp(kMostPerMesh / means.size(), kFewestSamples, kMostSamples);
  parallelFor(means.size(), 64, [&](size_t t) {
    const auto triangle = static_cast<uint32_t>(t);
    const float around = meanAround(light, mesh, triangle, emission) * meanAround(alpha, mesh, triangle, base);
    if (!(around > 0)) return static_cast<void>(means[t] = 0);
    const float texels =
        std::max(texelsOn(scene_, mesh, triangle, emission), holes ? texelsOn(scene_, mesh, triangle, base) : 0);
    const auto samples = static_cast<size_t>(
        std::max(static_cast<float>(kFewestSamples), std::min(static_cast<float>(most), texels / kTexelsPerSample)));
    const float sampled = meanOfSamples(scene_, mesh, triangle, samples);
    means[t] = light || alpha ? std::max(sampled, kLeast * means[t] * around) : sampled;
  });
  return means;
}

const BlockSums* MeanEmission::sumsOf(const TextureRef& ref, const Mesh& mesh, BlockSums::Of what) {
  if (ref.texture < 0 || mesh.uv[ref.uvSet].empty()) return nullptr;
  return &sums_.try_emplace({ref.texture, what}, scene_.textures[static_cast<size_t>(ref.texture)], what).first->second;
}

}  // namespace roomlight
