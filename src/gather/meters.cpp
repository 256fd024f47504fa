#include "gather/meters.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "base/parallel.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr uint64_t kMeterKey = 0x3e7e12;  // other random numbers than pixels have,
constexpr uint64_t kLampKey = 0x3e7e13;   // and for places on lamps
constexpr uint64_t kPlaceKey = 0x3e7e14;  // and for places of a meter's square
constexpr int kBatch = 64;                // samples of a meter in layers at once; what their errors are judged by:
constexpr int kLeastBatch = 4;            // fewer where fewer samples are asked for, four batches of them
constexpr int kPlaces = 2;                // on extended lamps, a batch
constexpr int kSquarePlaces = 16;         // of a meter's square, for lamps that are points
constexpr double kOfStrongest = 0.03;      // of light on a meter: layers weaker than that need not be surer than it

// An ideal white Lambertian surface reflects 1 / pi of what falls on it.
SurfacePoint whitePatch(const SurfaceElement& element) {
  SurfacePoint s;
  s.p = element.position;
  s.ng = s.smooth = element.normal, s.ns = element.facing();
  s.m.baseColor = Vec3(1);
  return s;
}

// A place of the element's square by two random numbers, clear of the surface; its middle, where something is in the
// way.
Vec3 placeWithin(const RayScene& rays, const SurfaceElement& element, Vec2 u) {
  const Vec3 middle = offsetOrigin(element.position, element.normal);
  const Frame frame(element.normal);
  const Vec3 way = (frame.t * (u.x - 0.5f) + frame.b * (u.y - 0.5f)) * element.footprintM;
  const float far = length(way);
  if (!(far > 0) || isBlack(rays.transmittance(Ray{middle, way / far, 0, far}))) return middle;
  return middle + way;
}

// Random numbers of a meter's samples, from one of them on.
struct MeterStream {
  size_t meter;
  int first;
  uint64_t seed;
};

// Samples of one element, ready to be shaded.
struct MeterSamples {
  size_t untraced = 0;  // suns, the last of the sharp lights, that give nothing
  std::vector<Shading> shadings;
  std::vector<Shadow> shadows;
  void take(const RayScene& rays, const SharpLights& sharp, const SurfaceElement& element, const MeterStream& stream,
            int count, bool lampsKnown = false) {
    shadings.clear(), shadows.clear();
    const SurfacePoint s = whitePatch(element);
    Vec3 origin = offsetOrigin(s.p, s.ng);
    for (int k = 0; k < count; ++k) {
      Sampler sampler(mix64(stream.meter + kMeterKey), static_cast<uint32_t>(stream.first + k), stream.seed);
      const auto firstShadow = static_cast<uint32_t>(shadows.size());
      if (element.footprintM > 0 && sharp.count() > untraced)
        origin = placeWithin(rays, element, sampler.forked(kPlaceKey).next2());
      for (size_t i = 0; i < sharp.count(); ++i) {
        const Vec2 u = sampler.next2();
        shadows.push_back(i + untraced < sharp.count() ? sharp.shadow(i, {&origin, 1}, {&u, 1}) : Shadow{});
      }
      shadings.push_back({s, s.ng, sampler, firstShadow, false, 1, true, lampsKnown});
    }
  }
};

// What all layers give one element: means over batches of samples, and how batches differ.
class LayerMeter {
 public:
  explicit LayerMeter(size_t layers) : sum_(layers), squares_(layers) {}
  void add(const std::vector<Vec3>& batchMeans) {
    for (size_t l = 0; l < sum_.size(); ++l) {
      sum_[l] += batchMeans[l];
      const double y = static_cast<double>(luminance(batchMeans[l]));
      squares_[l] += y * y;
    }
    ++batches_;
  }
  Vec3 lux(size_t l) const { return sum_[l] / static_cast<float>(batches_); }
  double error(size_t l) const {
    if (batches_ < 2) return std::numeric_limits<double>::infinity();
    const double n = batches_, mean = static_cast<double>(luminance(lux(l)));
    return std::sqrt(std::max(0.0, squares_[l] / n - mean * mean) / (n - 1));
  }

 private:
  std::vector<Vec3> sum_;
  std::vector<double> squares_;
  int batches_ = 0;
};

// Whether the errors of meters, together, are small enough beside their means.
bool areSure(std::span<const LayerMeter> meters, size_t layers, double tolerance) {
  const auto n = static_cast<double>(meters.size());
  std::vector<double> lux(layers), squares(layers);
  for (const LayerMeter& m : meters) {
    for (size_t l = 0; l < layers; ++l)
      lux[l] += static_cast<double>(luminance(m.lux(l))) / n, squares[l] += m.error(l) * m.error(l) / n;
  }
  const double strongest = layers > 0 ? *std::max_element(lux.begin(), lux.end()) : 0;
  for (size_t l = 0; l < layers; ++l) {
    if (std::sqrt(squares[l]) > tolerance * std::max(lux[l], kOfStrongest * strongest)) return false;
  }
  return true;
}

// Straight from all lamps that are extended, by so many places on each, or from all that are points: each is asked, so
// that no layer has the noise of a choice among them.
void addLamps(const TracedScene& scene, const LightLayers& layers, const SurfaceElement& element, bool extended,
              std::span<const Sampler> places, std::vector<Vec3>& lux) {
  const Lights& lights = scene.lights;
  thread_local std::vector<Ray> shadowRays;
  thread_local std::vector<std::pair<size_t, Vec3>> arrives;
  thread_local std::vector<Vec3> left;
  shadowRays.clear(), arrives.clear();
  Vec3 origin = offsetOrigin(element.position, element.normal), position = element.position;
  for (const Sampler& place : places) {
    if (element.footprintM > 0) position = origin = placeWithin(scene.rays, element, place.forked(kPlaceKey).next2());
    for (size_t i = 0; i < lights.lampCount(); ++i) {
      if (lights.lamp(i).extended != extended) continue;
      const LightSample light = lights.sampleLamp(i, position, place.forked(i).next2());
      const float cosine = light.valid() ? element.cosine(light.wi) : 0;
      if (cosine <= 0) continue;
      shadowRays.push_back(shadowRay(origin, position, light));
      arrives.emplace_back(static_cast<size_t>(layers.ofLamp[i]),
                           light.radiance * (cosine / static_cast<float>(places.size())));
    }
  }
  left.resize(shadowRays.size());
  scene.rays.transmittance(shadowRays, left);
  for (size_t k = 0; k < arrives.size(); ++k) lux[arrives[k].first] += arrives[k].second * left[k];
}

// Adds the means of one batch of all but lamps' direct light.
struct MeterTools {
  const RayScene& rays;
  const SharpLights& sharp;
  const SurfaceShader& shader;
};
void sampleLayers(const MeterTools& tools, const SurfaceElement& element, const MeterStream& stream, int count,
                  std::vector<Vec3>& means) {
  thread_local MeterSamples samples;
  thread_local std::vector<SurfaceLight> light;
  thread_local LayerSums sums;
  samples.take(tools.rays, tools.sharp, element, stream, count, true);
  light.assign(samples.shadings.size(), {});
  sums = LayerSums(means.size(), true);
  sums.resize(samples.shadings.size());
  GatherCounters counters;
  tools.shader.shadeInLayers(samples.shadings, samples.shadows, light, sums, counters);
  for (size_t l = 0; l < means.size(); ++l)
    means[l] +=
        (sums.get(0, LayerSums::kDiffuse, l) + sums.get(0, LayerSums::kSharp, l)) * (kPi / static_cast<float>(count));
}

}  // namespace

std::vector<MeterReading> measureIlluminance(const RayScene& rays, const Lights& lights, const SurfaceShader& shader,
                                             std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                             const Progress& progress) {
  const SharpLights sharp(rays, lights);
  const auto sample = [&](size_t meter, int first, int count, std::span<Vec3> lux) {
    thread_local MeterSamples samples;
    thread_local std::vector<SurfaceLight> light;
    samples.untraced = settings.straightSuns ? 0 : lights.sunCount();
    samples.take(rays, sharp, elements[meter], {meter, first, settings.seed}, count);
    light.assign(samples.shadings.size(), {});
    GatherCounters counters;
    shader.shade(samples.shadings, samples.shadows, light, counters);
    // What differs over a meter's square is no noise: each sample has the mean of it.
    const bool isSquare = elements[meter].footprintM > 0;
    Vec3 mean;
    for (const SurfaceLight& l : light) mean += l.sharp / static_cast<float>(light.size());
    for (size_t k = 0; k < light.size(); ++k)
      lux[k] += (light[k].diffuse + light[k].rare + (isSquare ? mean : light[k].sharp)) * kPi;
  };
  return readMeters(rays, lights, elements, settings, {sample}, progress);
}

LayeredReadings measureInLayers(const RayScene& rays, const Lights& lights, const SurfaceShader& shader,
                                std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                const Progress& progress) {
  const SharpLights sharp(rays, lights);
  LayeredReadings out;
  out.layers = shader.layers()->size();
  out.lux.resize(elements.size() * out.layers), out.standardErrorLux.resize(out.lux.size());
  const int batch = settings.fewestSamples >= kBatch ? kBatch : std::max(kLeastBatch, settings.fewestSamples / 4);
  std::atomic<size_t> done = 0;
  std::mutex reporting;
  const auto lamps = [&](size_t i, bool extended, int firstPlace, int count, std::vector<Vec3>& lux) {
    std::vector<Sampler> places;
    for (int k = 0; k < count; ++k)
      places.emplace_back(mix64(i + kLampKey), static_cast<uint32_t>(firstPlace + k), settings.seed);
    addLamps({rays, lights}, *shader.layers(), elements[i], extended, places, lux);
  };
  const size_t together = settings.together, n = elements.size();
  parallelFor((n + together - 1) / together, 1, [&](size_t group) {
    const size_t begin = group * together, end = std::min(n, begin + together);
    std::vector<LayerMeter> meters(end - begin, LayerMeter(out.layers));
    std::vector<std::vector<Vec3>> steady(end - begin, std::vector<Vec3>(out.layers));
    std::vector<Vec3> means;
    for (size_t i = begin; i < end; ++i)
      lamps(i, false, 0, elements[i].footprintM > 0 ? kSquarePlaces : 1, steady[i - begin]);
    // Whole batches.
    const int fewest = (std::max(settings.fewestSamples, 2 * batch) + batch - 1) / batch * batch;
    for (int first = 0, count = fewest; count <= std::max(settings.mostSamples, fewest) && !progress.stop();
         first = count, count *= 2) {
      for (size_t i = begin; i < end; ++i) {
        for (int at = first; at < count && !progress.stop(); at += batch) {
          means = steady[i - begin];
          if (lights.hasExtendedLamps()) lamps(i, true, at / batch * kPlaces, kPlaces, means);
          sampleLayers({rays, sharp, shader}, elements[i], {i, at, settings.seed}, batch, means);
          meters[i - begin].add(means);
        }
      }
      if (areSure(meters, out.layers, settings.tolerance)) break;
    }
    if (progress.stop()) return;
    for (size_t i = begin; i < end; ++i) {
      for (size_t l = 0; l < out.layers; ++l) {
        out.lux[i * out.layers + l] = meters[i - begin].lux(l);
        out.standardErrorLux[i * out.layers + l] = static_cast<float>(meters[i - begin].error(l));
      }
    }
    const size_t d = done += end - begin;
    if (reporting.try_lock()) {
      progress.at(static_cast<float>(d) / static_cast<float>(n));
      reporting.unlock();
    }
  });
  return out;
}

}  // namespace roomlight
