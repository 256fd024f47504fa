#include "reference/path_tracer.h"

#include <mutex>

#include "base/clock.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"
#include "trace/bsdf.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;
// Paths longer than this are not physics but a loop between perfect mirrors; at albedo 0.95 the chance to get here is e-13.
constexpr int kLongestPath = 4096;

struct PathState {
  Ray ray;
  Vec3 throughput{1, 1, 1};
  Vec3 lastPoint;          // where the ray was scattered last, for the density of light sampling there
  float lastPdf = 0;       // density of the BSDF sample that gave the ray; 0: camera or mirror, emission counts in full
};

class Tracer {
 public:
  Tracer(const RayScene& rays, const Lights& lights) : rays_(rays), lights_(lights), scene_(rays.scene()) {}

  Vec3 radiance(const Ray& ray, Sampler& sampler, uint64_t& rayCount) const {
    return follow({ray, Vec3(1), {}, 0}, sampler, rayCount);
  }

  // Illuminance on a surface element: pi times what an ideal white Lambertian patch there would reflect.
  Vec3 illuminance(Vec3 p, Vec3 n, Sampler& sampler, uint64_t& rayCount) const {
    SurfacePoint s;
    s.p = p;
    s.ng = s.ns = n;
    s.m.baseColor = Vec3(1);
    const Bsdf bsdf(s.m, n, n, n);
    Vec3 sum = direct(s, bsdf, sampler, rayCount);
    const BsdfSample next = bsdf.sample(sampler.next2(), sampler.next1());
    if (next.valid()) sum += follow({{offsetOrigin(p, n), next.wi, 0, kInfinity}, next.weight, p, next.pdf}, sampler, rayCount);
    return sum * kPi;
  }

 private:
  Vec3 follow(PathState path, Sampler& sampler, uint64_t& rayCount) const {
    Vec3 sum;
    int scattered = 0;
    for (int length = 0; length < kLongestPath; ++length) {
      const Hit hit = rays_.intersect(path.ray);
      ++rayCount;
      if (!hit.valid()) {
        sum += path.throughput * escaped(path);
        break;
      }
      const SurfacePoint s = surfaceAt(scene_, hit, path.ray.direction);
      if (const Vec3 emitted = s.emitted(); !isBlack(emitted)) {
        const float w = path.lastPdf > 0 ? misWeight(path.lastPdf, lights_.pdfLocal(path.lastPoint, s)) : 1;
        sum += path.throughput * emitted * w;
      }
      const Bsdf bsdf(s.m, s.ns, s.ng, -path.ray.direction);
      if (passThrough(path, s, bsdf, sampler)) continue;
      sum += path.throughput * direct(s, bsdf, sampler, rayCount);

      const BsdfSample next = bsdf.sample(sampler.next2(), sampler.next1());
      if (!next.valid() || dot(next.wi, s.ng) <= 0) break;
      path.throughput *= next.weight;
      path.lastPdf = next.mirror ? 0 : next.pdf;
      path.lastPoint = s.p;
      path.ray = {offsetOrigin(s.p, s.ng), next.wi, 0, kInfinity};
      if (!survives(path, ++scattered, sampler)) break;
    }
    return sum;
  }

  // Sky and sun discs along a ray that left the scene, weighted against having sampled them directly.
  Vec3 escaped(const PathState& path) const {
    const Vec3 d = path.ray.direction;
    Vec3 sum;
    if (lights_.sky().present()) {
      const float w = path.lastPdf > 0 && lights_.sky().sampled() ? misWeight(path.lastPdf, lights_.sky().pdf(d)) : 1;
      sum += lights_.sky().radiance(d) * w;
    }
    for (size_t i = 0; i < lights_.sunCount(); ++i) {
      float pdf;
      const Vec3 disc = lights_.sunDisc(i, d, pdf);
      if (pdf > 0) sum += disc * (path.lastPdf > 0 ? misWeight(path.lastPdf, pdf) : 1);
    }
    return sum;
  }

  // Thin glass and blended alpha: with a chance equal to what goes straight through, the ray goes on as if nothing had
  // scattered it, so light sampling at the last point (which sees through glass too) keeps its weights.
  bool passThrough(PathState& path, const SurfacePoint& s, const Bsdf& bsdf, Sampler& sampler) const {
    if (s.m.alpha >= 1 && s.m.transmission <= 0) return false;
    const Vec3 through = straightTransmittance(*s.material, s.m, -dot(s.ns, path.ray.direction));
    const float t = luminance(through), r = luminance(bsdf.albedo()) * s.m.alpha;
    const float chance = t + r > 0 ? t / (t + r) : 1;
    if (sampler.next1() < chance) {
      path.throughput *= through / chance;
      path.ray.origin = offsetOrigin(s.p, -s.ng);
      path.ray.tMin = 0;
      return true;
    }
    path.throughput *= s.m.alpha / (1 - chance);
    return false;
  }

  Vec3 contribution(const SurfacePoint& s, const Bsdf& bsdf, const LightSample& light, uint64_t& rayCount) const {
    if (!light.valid()) return {};
    Vec3 f = bsdf.evaluate(light.wi);
    if (isBlack(f)) return {};
    if (light.pdf > 0) f *= misWeight(light.pdf, bsdf.pdf(light.wi));
    const float tMax = light.distance < kInfinity ? light.distance * (1 - 1e-4f) : kInfinity;
    ++rayCount;
    return f * light.radiance * rays_.transmittance({offsetOrigin(s.p, s.ng), light.wi, 0, tMax});
  }

  Vec3 direct(const SurfacePoint& s, const Bsdf& bsdf, Sampler& sampler, uint64_t& rayCount) const {
    Vec3 sum;
    if (lights_.hasLocal()) {
      const Vec2 u = sampler.next2();
      sum += contribution(s, bsdf, lights_.sampleLocal(s.p, u, sampler.next1()), rayCount);
    }
    for (size_t i = 0; i < lights_.sunCount(); ++i) {
      sum += contribution(s, bsdf, lights_.sampleSun(i, sampler.next2()), rayCount);
    }
    if (lights_.sky().sampled()) sum += contribution(s, bsdf, lights_.sampleSky(sampler.next2()), rayCount);
    return sum;
  }

  // Russian roulette by throughput from the third scattering on.
  static bool survives(PathState& path, int scattered, Sampler& sampler) {
    const float best = maxComponent(path.throughput);
    if (!(best > 0)) return false;
    if (scattered < 3) return true;
    const float q = std::min(best, 0.98f);
    if (sampler.next1() >= q) return false;
    path.throughput *= 1 / q;
    return true;
  }

  const RayScene& rays_;
  const Lights& lights_;
  const Scene& scene_;
};

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
  const Tracer tracer(rays, lights);
  Accumulator a{Image(w, h), Image(w, h)};
  const int tilesX = (w + kTile - 1) / kTile, tilesY = (h + kTile - 1) / kTile;
  std::atomic<uint64_t> rayCount = 0;
  const Stopwatch watch;
  PathResult result;

  while (result.samples < settings.samples) {
    // The picture keeps whole passes only: one that is stopped half way is dropped, but never the first.
    const int pass = result.samples;
    Image fresh(w, h);
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
          fresh.at(x, y) = tracer.radiance(cameraRays.ray(static_cast<float>(x) + jitter.x, static_cast<float>(y) + jitter.y), sampler, count);
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
  result.rays = rayCount;
  return result;
}

MeterReading measureIlluminance(const RayScene& rays, const Lights& lights, Vec3 position, Vec3 normal, int samples, uint64_t seed) {
  const Tracer tracer(rays, lights);
  double sum[3] = {}, squares = 0;
  uint64_t rayCount = 0;
  for (int i = 0; i < samples; ++i) {
    Sampler sampler(0, static_cast<uint32_t>(i), seed);
    const Vec3 e = tracer.illuminance(position, normal, sampler, rayCount);
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
