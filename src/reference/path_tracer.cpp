#include "reference/path_tracer.h"

#include <mutex>

#include "base/clock.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "reference/path_walk.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;
// Light paths a pass; more do not help as much as another pass. Vertices take 128 B each, twice that while they are collected; how
// many a path has, the first pass tells.
constexpr int kMostLightPaths = 1 << 18, kFirstLightPaths = 1 << 14, kPixelsPerLightPath = 16;
constexpr double kMostLightVertices = 1 << 20;

// Running sums per pixel; one pass adds one sample to every pixel.
struct Accumulator {
  Image sum, squares;
};

double meanRelativeError(const Accumulator& a, int samples) {
  if (samples < 2) return kInfinity;
  double error = 0, mean = 0;
  const double n = samples;
  for (size_t i = 0; i < a.sum.pixels.size(); ++i) {
    const double m = luminance(a.sum.pixels[i]) / n, s = luminance(a.squares.pixels[i]) / n;
    error += std::sqrt(std::max(0.0, s - m * m) / (n - 1));
    mean += m;
  }
  return mean > 0 ? error / mean : 0;
}

}  // namespace

PathResult pathTrace(const RayScene& rays, const Lights& lights, const Camera& camera, const PathSettings& settings,
                     const Progress& progress) {
  const int w = settings.width, h = settings.height;
  const CameraRays cameraRays(camera, w, h);
  LightVertices vertices(rays, lights);
  const int lightPaths = std::clamp(w * h / kPixelsPerLightPath, 1024, kMostLightPaths);
  Accumulator a{Image(w, h), Image(w, h)};
  const int tilesX = (w + kTile - 1) / kTile, tilesY = (h + kTile - 1) / kTile;
  std::atomic<uint64_t> rayCount = 0;
  const Stopwatch watch;
  PathResult result;

  while (result.samples < settings.samples) {
    // The picture keeps whole passes only: one that is stopped half way is dropped, but never the first.
    const int pass = result.samples;
    Image fresh(w, h);
    if (settings.lightPaths && lights.lampCount() > 0) {
      const int most = pass == 0 ? kFirstLightPaths : static_cast<int>(kMostLightVertices / std::max(1.0, vertices.perPath()));
      vertices.trace(std::min(lightPaths, std::max(1, most)), static_cast<uint32_t>(pass), settings.seed);
    }
    const PathWalk walk(rays, lights, &vertices);
    std::atomic<int> tilesDone = 0;
    std::mutex reporting;
    parallelFor(static_cast<size_t>(tilesX) * tilesY, 1, [&](size_t tile) {
      if (progress.stop() && pass > 0) return;
      const int x0 = static_cast<int>(tile % tilesX) * kTile, y0 = static_cast<int>(tile / tilesX) * kTile;
      uint64_t count = 0;
      for (int y = y0; y < std::min(h, y0 + kTile); ++y) {
        for (int x = x0; x < std::min(w, x0 + kTile); ++x) {
          Sampler sampler(static_cast<uint64_t>(y) * w + x, static_cast<uint32_t>(pass), settings.seed);
          const Vec2 jitter = sampler.next2();
          fresh.at(x, y) = walk.radiance(cameraRays.ray(static_cast<float>(x) + jitter.x, static_cast<float>(y) + jitter.y), sampler, count);
        }
      }
      rayCount += count;
      const int done = ++tilesDone;
      if (done % 64 == 0 && reporting.try_lock()) {
        const float all = static_cast<float>(pass) + static_cast<float>(done) / static_cast<float>(tilesX * tilesY);
        float fraction = all / static_cast<float>(settings.samples);
        if (settings.timeLimitS > 0) fraction = std::max(fraction, static_cast<float>(watch.seconds() / settings.timeLimitS));
        progress.at(std::min(1.0f, fraction));
        reporting.unlock();
      }
    });
    if (progress.stop() && pass > 0) break;
    parallelFor(fresh.pixels.size(), 65536, [&](size_t i) {
      a.sum.pixels[i] += fresh.pixels[i];
      a.squares.pixels[i] += fresh.pixels[i] * fresh.pixels[i];
    });
    ++result.samples;
    if (progress.stop()) break;
    if (settings.timeLimitS > 0 && watch.seconds() >= settings.timeLimitS) break;
    if (settings.noiseLevel > 0 && result.samples >= 16 && result.samples % 8 == 0 &&
        meanRelativeError(a, result.samples) <= settings.noiseLevel) {
      break;
    }
  }

  const float n = static_cast<float>(result.samples);
  result.image = Image(w, h);
  result.variance = Image(w, h);
  for (size_t i = 0; i < a.sum.pixels.size(); ++i) {
    const Vec3 m = a.sum.pixels[i] / n;
    result.image.pixels[i] = m;
    result.variance.pixels[i] = max(a.squares.pixels[i] / n - m * m, Vec3(0)) / std::max(1.0f, n - 1);
  }
  result.noise = meanRelativeError(a, result.samples);
  result.rays = rayCount + vertices.rayCount();
  return result;
}

MeterReading measureIlluminance(const RayScene& rays, const Lights& lights, Vec3 position, Vec3 normal, int samples, uint64_t seed) {
  const PathWalk walk(rays, lights);
  double sum[3] = {}, squares = 0;
  uint64_t rayCount = 0;
  for (int i = 0; i < samples; ++i) {
    Sampler sampler(0, static_cast<uint32_t>(i), seed);
    const Vec3 e = walk.illuminance(position, normal, sampler, rayCount);
    for (int c = 0; c < 3; ++c) sum[c] += e[c];
    squares += static_cast<double>(luminance(e)) * luminance(e);
  }
  MeterReading reading;
  const double n = samples;
  reading.illuminanceLux = {static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n), static_cast<float>(sum[2] / n)};
  const double mean = luminance(reading.illuminanceLux);
  reading.standardErrorLux = std::sqrt(std::max(0.0, squares / n - mean * mean) / std::max(1.0, n - 1));
  return reading;
}

}  // namespace roomlight
