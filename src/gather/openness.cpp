#include "gather/pixel_shader.h"

#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "base/sampling.h"

namespace roomlight {
namespace {

constexpr uint32_t kRaysAPixel = 8;                    // a power of two
constexpr float kLiftPixels = 0.25f;
constexpr float kNearestPixels = 2, kFarthestPixels = 64;  // reaches of rays, on a logarithmic scale
constexpr uint32_t kOpenPass = 0x0be4;                 // other random numbers than light has

}  // namespace

uint64_t findOpenness(const RayScene& rays, const CameraRays& camera, uint64_t seed, FilterInput& sums) {
  std::atomic<uint64_t> count = 0;
  parallelFor(static_cast<size_t>(sums.height), 2, [&](size_t row) {
    const int y = static_cast<int>(row);
    thread_local std::vector<Ray> ways;
    thread_local std::vector<Vec3> left;
    ways.clear();
    for (int x = 0; x < sums.width; ++x) {
      const FilterPixel& pixel = sums.at(x, y);
      if (!(pixel.surface > 0) || isBlack(pixel.normal)) continue;
      const Vec3 p = pixel.position / pixel.surface, n = normalize(pixel.normal);
      const float step = camera.pixelWidthM(x, y, p);
      const PixelSequence sequence(x, y, kOpenPass, seed);
      const Frame frame(n);
      for (uint32_t k = 0; k < kRaysAPixel; ++k) {
        Sampler sampler = sequence.forShading(0, k, kRaysAPixel);
        const Vec3 d = frame.toWorld(sampleCosineHemisphere(sampler.next2()));
        ways.push_back({offsetOrigin(p + n * (kLiftPixels * step), n), d, 0,
                        step * kNearestPixels * std::pow(kFarthestPixels / kNearestPixels, sampler.next1())});
      }
    }
    left.resize(ways.size());
    rays.transmittance(ways, left);
    count += ways.size();
    size_t way = 0;
    for (int x = 0; x < sums.width; ++x) {
      FilterPixel& pixel = sums.at(x, y);
      if (!(pixel.surface > 0) || isBlack(pixel.normal)) continue;
      float open = 0;
      for (uint32_t k = 0; k < kRaysAPixel; ++k) open += luminance(left[way++]);
      pixel.open = open / static_cast<float>(kRaysAPixel);
    }
  });
  return count;
}

}  // namespace roomlight
