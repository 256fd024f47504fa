#include "gather/cone_gather.h"

#include <mutex>

#include "base/clock.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "gather/cone_shader.h"
#include "gather/filter.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;

struct Rectangle {
  int x0, y0, x1, y1;
};

Rectangle tileAt(size_t index, int width, int height) {
  const int tilesX = (width + kTile - 1) / kTile, x = static_cast<int>(index) % tilesX * kTile, y = static_cast<int>(index) / tilesX * kTile;
  return {x, y, std::min(width, x + kTile), std::min(height, y + kTile)};
}

// Sums over the samples of a picture.
class Accumulation {
 public:
  Accumulation(int width, int height) : layers_(width, height), occlusion_(width, height), sampled_(layers_.pixels.size()) {}

  void add(size_t pixel, const ConeSample& s) {
    FilterPixel& p = layers_.pixels[pixel];
    p.diffuse += s.diffuse;
    p.albedo += s.albedo;
    p.specular += s.specular;
    p.rest += s.rest;
    const float d = luminance(s.diffuse), g = luminance(s.specular);
    p.diffuseVariance += d * d;
    p.specularVariance += g * g;
    if (s.surface) {
      p.normal += s.normal;
      p.position += s.position;
      p.roughness += s.roughness;
      p.surface += 1;
    }
    occlusion_.pixels[pixel] += Vec3(s.occlusion);
    ++sampled_[pixel];
  }

  // Means, and of the squares the variance of the mean.
  FilterInput means() const {
    FilterInput out = layers_;
    parallelFor(out.pixels.size(), 4096, [&](size_t i) {
      FilterPixel& p = out.pixels[i];
      const float n = static_cast<float>(std::max(1u, sampled_[i])), inverse = 1 / n;
      p.diffuse *= inverse, p.albedo *= inverse, p.specular *= inverse, p.rest *= inverse;
      const auto variance = [&](float squares, Vec3 mean) { return std::max(0.0f, squares * inverse - luminance(mean) * luminance(mean)) / std::max(1.0f, n - 1); };
      p.diffuseVariance = variance(p.diffuseVariance, p.diffuse);
      p.specularVariance = variance(p.specularVariance, p.specular);
      if (p.surface > 0) {
        p.normal = length(p.normal) > 0 ? normalize(p.normal) : p.normal;
        p.position *= 1 / p.surface;
        p.roughness *= 1 / p.surface;
      }
      p.surface *= inverse;
    });
    return out;
  }

  Image occlusion() const {
    Image out = occlusion_;
    for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] *= 1 / static_cast<float>(std::max(1u, sampled_[i]));
    return out;
  }

 private:
  FilterInput layers_;
  Image occlusion_;
  std::vector<uint32_t> sampled_;
};

}  // namespace

ConeResult gatherCones(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
                       const Camera& camera, const GatherSettings& settings, const Progress& progress) {
  const int w = settings.width, h = settings.height;
  const CameraRays cameraRays(camera, w, h);
  const ConeShader shader(rays, lights, voxels, field, settings);
  ConeResult result;
  Accumulation sums(w, h);
  const size_t tiles = static_cast<size_t>((w + kTile - 1) / kTile) * static_cast<size_t>((h + kTile - 1) / kTile);
  std::atomic<uint64_t> rayCount = 0, coneCount = 0;
  std::mutex reporting;
  const Stopwatch watch;
  while (result.samples < settings.samples) {
    const int pass = result.samples;
    std::atomic<size_t> tilesDone = 0;
    parallelFor(tiles, 1, [&](size_t tile) {
      if (progress.stop() && pass > 0) return;
      const Rectangle r = tileAt(tile, w, h);
      ConeCounters count;
      for (int y = r.y0; y < r.y1; ++y) {
        for (int x = r.x0; x < r.x1; ++x) {
          const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x);
          Sampler sampler(pixel, static_cast<uint32_t>(pass), settings.seed);
          const Vec2 jitter = sampler.next2();
          sums.add(pixel, shader.sample(cameraRays.ray(static_cast<float>(x) + jitter.x, static_cast<float>(y) + jitter.y), sampler, count));
        }
      }
      rayCount += count.rays;
      coneCount += count.cones;
      const size_t done = ++tilesDone;
      if (done % 64 == 0 && reporting.try_lock()) {
        progress.at((static_cast<float>(pass) + static_cast<float>(done) / static_cast<float>(tiles)) / static_cast<float>(settings.samples));
        reporting.unlock();
      }
    });
    ++result.samples;
    if (progress.stop() || (settings.timeLimitS > 0 && watch.seconds() >= settings.timeLimitS)) break;
  }
  const FilterInput means = sums.means();
  result.image = settings.filterPasses > 0 ? filtered(means, settings.filterPasses) : composed(means);
  result.occlusion = sums.occlusion();
  result.rays = rayCount;
  result.cones = coneCount;
  return result;
}

}  // namespace roomlight
