#include "reference/path_tracer.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/sampler.h"
#include "reference/caustic_splats.h"
#include "reference/path_walk.h"
#include "reference/pixel_sums.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;
// Light paths a pass; more do not help as much as another pass. Vertices take 128 B each, twice that while they are
// collected; how many a path has, the first pass tells.
constexpr int kMostLightPaths = 1 << 18, kFirstLightPaths = 1 << 14, kPixelsPerLightPath = 16;
constexpr double kMostLightVertices = 1 << 20;
// Of meters; each round of samples has its own. All meters of a round share them, so what they are off by shows in no
// spread of samples: as many as samples, that it stays below theirs.
constexpr size_t kFewestLightPaths = 1024, kMostMeterLightPaths = 1 << 17;

// From the camera, to where lights are looked for before the picture.
constexpr int kPixelsPerLearningPath = 16;
constexpr size_t kFewestLearningPaths = 1024, kMostLearningPaths = 1 << 15;

constexpr int kFilterPasses = 5;

// Of a pixel, running: in double, for a reference of millions of samples would stand still in float.
struct PixelSum {
  std::array<double, 3> all{}, squares{};
  void add(Vec3 v) {
    for (int c = 0; c < 3; ++c) {
      const double x = v[c];
      all[static_cast<size_t>(c)] += x, squares[static_cast<size_t>(c)] += x * x;
    }
  }
  Vec3 mean(double n) const {
    return {static_cast<float>(all[0] / n), static_cast<float>(all[1] / n), static_cast<float>(all[2] / n)};
  }
  // Of the mean of n samples.
  Vec3 variance(double n) const {
    Vec3 out;
    for (int c = 0; c < 3; ++c) {
      const double m = all[static_cast<size_t>(c)] / n, s = squares[static_cast<size_t>(c)] / n;
      out[c] = static_cast<float>(std::max(0.0, s - m * m) / std::max(1.0, n - 1));
    }
    return out;
  }
};

double luminance(const std::array<double, 3>& rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

}  // namespace

struct PathTracer::State {
  State(const RayScene& r, const Lights& l, const Camera& c, const PathSettings& s, bool withFeatures)
      : rays(r),
        lights(l),
        cameraRays(c, s.width, s.height),
        settings(s),
        vertices(r, l),
        visible(l),
        sums(static_cast<size_t>(s.width) * static_cast<size_t>(s.height)),
        pixels(withFeatures ? sums.size() : 0),
        layerSums(s.layers ? sums.size() * s.layers->size() : 0) {}

  const RayScene& rays;
  const Lights& lights;
  CameraRays cameraRays;
  PathSettings settings;
  LightVertices vertices;
  VisibleLights visible;
  CausticSplats caustics;
  std::vector<PixelSum> sums;  // per pixel
  std::vector<PixelSums> pixels;
  std::vector<Vec3> layerSums;  // per pixel, of each layer
  int samples = 0;
  std::atomic<uint64_t> rayCount = 0;

  void learnLights(const std::function<bool()>& stopped) {
    if (samples > 0 || visible.cellCount() > 0) return;
    const size_t paths = std::clamp(static_cast<size_t>(settings.width * settings.height / kPixelsPerLearningPath),
                                    kFewestLearningPaths, kMostLearningPaths);
    visible.learn(rays, {cameraRays, settings.width, settings.height}, paths, settings.seed, stopped);
  }
  void findCaustics() {
    if (samples > 0 || !settings.caustics) return;
    caustics = CausticSplats({rays, lights},
                             {cameraRays, settings.width, settings.height, settings.white, settings.layers.get()},
                             settings.seed);
  }
  // Adds what polished surfaces throw, of one pass.
  void addCaustics(Image& fresh, std::vector<FilterPixel>& seen) {
    const size_t layerCount = settings.layers ? settings.layers->size() : 0;
    for (const CausticSplats::Splat& splat : caustics.trace(static_cast<uint32_t>(samples))) {
      fresh.pixels[splat.pixel] += splat.light;
      if (!seen.empty()) seen[splat.pixel].sharp += splat.light;
      if (layerCount > 0 && splat.layer >= 0)
        layerSums[splat.pixel * layerCount + static_cast<size_t>(splat.layer)] += splat.light;
    }
  }
  void traceLightPaths() {
    if (!settings.lightPaths || !vertices.lightRays().any()) return;
    const int paths = std::clamp(settings.width * settings.height / kPixelsPerLightPath, 1024, kMostLightPaths);
    const int most =
        samples == 0 ? kFirstLightPaths : static_cast<int>(kMostLightVertices / std::max(1.0, vertices.perPath()));
    vertices.trace(std::min(paths, std::max(1, most)), static_cast<uint32_t>(samples), settings.seed);
  }
};

PathTracer::PathTracer(const RayScene& rays, const Lights& lights, const Camera& camera, const PathSettings& settings,
                       bool features)
    : state_(std::make_unique<State>(rays, lights, camera, settings, features)) {}
PathTracer::~PathTracer() = default;

bool PathTracer::pass(const Progress& progress, bool firstToo) {
  State& st = *state_;
  const auto stopped = [&] { return progress.stop() && (firstToo || st.samples > 0); };
  if (stopped()) return false;
  const int w = st.settings.width, h = st.settings.height;
  // Whole passes only are kept.
  Image fresh(w, h);
  std::vector<FilterPixel> seen(st.pixels.size());
  st.learnLights(stopped);
  st.findCaustics();
  st.traceLightPaths();
  const PathWalk walk(st.rays, st.lights, st.visible, &st.vertices, st.settings.white, st.caustics.any());
  const int tilesX = (w + kTile - 1) / kTile, tilesY = (h + kTile - 1) / kTile;
  std::atomic<int> tilesDone = 0;
  std::mutex reporting;
  parallelFor(static_cast<size_t>(tilesX) * tilesY, 1, [&](size_t tile) {
    if (stopped()) return;
    const int x0 = static_cast<int>(tile % tilesX) * kTile, y0 = static_cast<int>(tile / tilesX) * kTile;
    uint64_t count = 0;
    for (int y = y0; y < std::min(h, y0 + kTile); ++y) {
      for (int x = x0; x < std::min(w, x0 + kTile); ++x) {
        const uint64_t pixel = static_cast<uint64_t>(y) * w + x;
        Sampler sampler(pixel, static_cast<uint32_t>(st.samples), st.settings.seed);
        const Vec2 jitter = sampler.next2();
        const Ray ray =
            st.cameraRays.seeing(st.rays, static_cast<float>(x) + jitter.x, static_cast<float>(y) + jitter.y);
        if (ray.tMax <= 0) continue;  // sees no light
        const size_t layerCount = st.settings.layers ? st.settings.layers->size() : 0;
        std::optional<PathLayers> layers;
        if (layerCount > 0)
          layers.emplace(
              PathLayers{*st.settings.layers, std::span(st.layerSums).subspan(pixel * layerCount, layerCount)});
        PathLayers* apart = layers ? &*layers : nullptr;
        fresh.at(x, y) = seen.empty() ? walk.radiance(ray, sampler, count, apart)
                                      : walk.radiance(ray, sampler, count, seen[pixel], apart);
      }
    }
    st.rayCount += count;
    const int done = ++tilesDone;
    if (done % 64 == 0 && reporting.try_lock()) {
      progress.at(static_cast<float>(done) / static_cast<float>(tilesX * tilesY));
      reporting.unlock();
    }
  });
  if (stopped()) return false;
  st.addCaustics(fresh, seen);
  parallelFor(fresh.pixels.size(), 65536, [&](size_t i) { st.sums[i].add(fresh.pixels[i]); });
  parallelFor(seen.size(), 16384, [&](size_t i) { st.pixels[i].add(seen[i]); });
  ++st.samples;
  return true;
}

int PathTracer::samples() const { return state_->samples; }
uint64_t PathTracer::rays() const {
  return state_->rayCount + state_->vertices.rayCount() + state_->visible.rayCount() + state_->caustics.rayCount();
}

Image PathTracer::mean() const {
  Image out(state_->settings.width, state_->settings.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = state_->sums[i].mean(samples());
  return out;
}

Image PathTracer::variance() const {
  Image out(state_->settings.width, state_->settings.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = state_->sums[i].variance(samples());
  return out;
}

double PathTracer::noise() const {
  if (samples() < 2) return kInfinity;
  double error = 0, mean = 0;
  const double n = samples();
  for (const PixelSum& sum : state_->sums) {
    const double m = luminance(sum.all) / n, s = luminance(sum.squares) / n;
    error += std::sqrt(std::max(0.0, s - m * m) / (n - 1));
    mean += m;
  }
  return mean > 0 ? error / mean : 0;
}

// Scaled to the mean, for a pass that was dropped has left some of its light here.
std::vector<Image> PathTracer::layers() const {
  const Image whole = mean();
  const size_t count = state_->settings.layers ? state_->settings.layers->size() : 0;
  std::vector<Image> out(count, Image(whole.width, whole.height));
  parallelFor(whole.pixels.size(), 4096, [&](size_t i) {
    const std::span<const Vec3> parts = std::span(state_->layerSums).subspan(i * count, count);
    Vec3 sum;
    for (const Vec3& p : parts) sum += p;
    const Vec3 scale = whole.pixels[i] / max(sum, Vec3(1e-30f));
    for (size_t l = 0; l < count; ++l) out[l].pixels[i] = parts[l] * scale;
  });
  return out;
}

FilterInput PathTracer::features() const {
  FilterInput out(state_->settings.width, state_->settings.height);
  out.wraps = state_->cameraRays.wraps();
  parallelFor(state_->pixels.size(), 16384, [&](size_t i) { out.pixels[i] = state_->pixels[i].mean(samples()); });
  return out;
}

PathResult pathTrace(const RayScene& rays, const Lights& lights, const Camera& camera, const PathSettings& settings,
                     const Progress& progress) {
  PathTracer tracer(rays, lights, camera, settings, settings.filter);
  const Stopwatch watch;
  Progress inner;
  inner.cancelled = progress.cancelled;
  if (progress.report) {
    inner.report = [&](float done) {
      float fraction = (static_cast<float>(tracer.samples()) + done) / static_cast<float>(settings.samples);
      if (settings.timeLimitS > 0)
        fraction = std::max(fraction, static_cast<float>(watch.seconds() / settings.timeLimitS));
      progress.at(std::min(1.0f, fraction));
    };
  }
  while (tracer.samples() < settings.samples) {
    if (!tracer.pass(inner) || progress.stop()) break;
    if (settings.timeLimitS > 0 && watch.seconds() >= settings.timeLimitS) break;
    if (settings.noiseLevel > 0 && tracer.samples() >= 16 && tracer.samples() % 8 == 0 &&
        tracer.noise() <= settings.noiseLevel)
      break;
  }
  return {settings.filter ? filtered(tracer.features(), kFilterPasses) : tracer.mean(),
          tracer.variance(),
          tracer.layers(),
          tracer.samples(),
          tracer.noise(),
          tracer.rays()};
}

std::vector<MeterReading> measureIlluminance(const RayScene& rays, const Lights& lights,
                                             std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                             const Progress& progress) {
  LightVertices vertices(rays, lights);
  const VisibleLights visible(lights);
  const auto prepare = [&](uint32_t round, size_t samples) {
    if (vertices.lightRays().any())
      vertices.trace(static_cast<int>(std::clamp<size_t>(samples, kFewestLightPaths, kMostMeterLightPaths)), round,
                     settings.seed);
  };
  const auto sample = [&](size_t meter, int first, int count, std::span<Vec3> lux) {
    const PathWalk walk(rays, lights, visible, &vertices);
    uint64_t rayCount = 0;
    for (int i = 0; i < count; ++i) {
      Sampler sampler(meter, static_cast<uint32_t>(first + i), settings.seed);
      lux[static_cast<size_t>(i)] +=
          walk.illuminanceButSky(elements[meter].position, elements[meter].normal, sampler, rayCount);
    }
  };
  return readMeters(rays, lights, elements, settings, {sample, prepare}, progress);
}

MeterReading measureIlluminance(const RayScene& rays, const Lights& lights, Vec3 position, Vec3 normal, int samples,
                                uint64_t seed) {
  const SurfaceElement element{position, normal};
  return measureIlluminance(rays, lights, {&element, 1}, {0, samples, samples, seed}).front();
}

}  // namespace roomlight
