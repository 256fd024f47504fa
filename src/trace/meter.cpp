#include "trace/meter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/sampler.h"
#include "trace/open_sky.h"

namespace roomlight {
namespace {

constexpr int kAtOnce = 256;      // samples in one call
constexpr double kOfMean = 0.01;
constexpr uint64_t kSkySeed = 0x5c1;  // other random numbers than the rest has

// Sums over samples of one meter.
class Sums {
 public:
  void add(Vec3 lux) {
    const double l = static_cast<double>(luminance(lux));
    r_ += static_cast<double>(lux.x), g_ += static_cast<double>(lux.y), b_ += static_cast<double>(lux.z),
        squares_ += l * l;
    ++count_;
  }
  void add(const Sums& sums) {
    r_ += sums.r_, g_ += sums.g_, b_ += sums.b_, squares_ += sums.squares_;
    count_ += sums.count_;
  }
  MeterReading reading() const;

 private:
  double r_ = 0, g_ = 0, b_ = 0, squares_ = 0;  // squares_: of luminance
  int count_ = 0;
};

MeterReading Sums::reading() const {
  const double n = std::max(1, count_);
  MeterReading out;
  out.illuminanceLux = {static_cast<float>(r_ / n), static_cast<float>(g_ / n), static_cast<float>(b_ / n)};
  const double mean = static_cast<double>(luminance(out.illuminanceLux));
  out.standardErrorLux = std::sqrt(std::max(0.0, squares_ / n - mean * mean) / std::max(1.0, n - 1));
  return out;
}

// Whether the error of meters, together, is small enough beside their mean, or beside `darkLux`.
bool areSure(std::span<const Sums> meters, double tolerance, double darkLux) {
  double lux = 0, squares = 0;
  for (const Sums& s : meters) {
    const MeterReading m = s.reading();
    lux += static_cast<double>(luminance(m.illuminanceLux)), squares += m.standardErrorLux * m.standardErrorLux;
  }
  const auto n = static_cast<double>(meters.size());
  return std::sqrt(squares / n) <= tolerance * std::max(lux / n, darkLux);
}

struct Batch {
  size_t meter;
  int first, count;
  Sums sums;
};

double meanLux(const std::vector<Sums>& all) {
  double sum = 0;
  for (const Sums& s : all) sum += static_cast<double>(luminance(s.reading().illuminanceLux));
  return sum / static_cast<double>(all.size());
}

// What comes straight from the sky.
void lightBySky(const RayScene& rays, const OpenSky& sky, const SurfaceElement& element, const Batch& batch,
                uint64_t seed, std::span<Vec3> lux) {
  const Vec3 origin = offsetOrigin(element.position, element.normal);
  std::vector<Ray> shadows;
  std::vector<Vec3> left(lux.size());
  for (size_t i = 0; i < lux.size(); ++i) {
    Sampler sampler(batch.meter, static_cast<uint32_t>(batch.first) + static_cast<uint32_t>(i), seed + kSkySeed);
    const LightSample light = sky.sample(sampler.next2());
    shadows.push_back({origin, light.wi, 0, kInfinity});
    lux[i] = light.radiance * element.cosine(light.wi);
  }
  rays.transmittance(shadows, left);
  for (size_t i = 0; i < lux.size(); ++i) lux[i] *= left[i];
}

}  // namespace

std::vector<MeterReading> readMeters(const RayScene& rays, const Lights& lights,
                                     std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                     const MeteredLight& light, const Progress& progress) {
  const size_t n = elements.size();
  std::vector<std::optional<OpenSky>> skies(lights.sky().present() ? n : 0);
  parallelFor(skies.size(), 8, [&](size_t i) { skies[i].emplace(rays, lights, elements[i], settings.seed + i); });
  std::vector<Sums> sums(n);
  std::vector<size_t> open(n);
  for (size_t i = 0; i < n; ++i) open[i] = i;
  uint32_t round = 0;
  for (int done = 0, count = settings.fewestSamples; !open.empty() && count <= settings.mostSamples;
       done = count, count *= 2) {
    if (light.prepare) light.prepare(round++, open.size() * static_cast<size_t>(count - done));
    std::vector<Batch> batches;
    for (const size_t i : open) {
      for (int first = done; first < count; first += kAtOnce)
        batches.push_back({i, first, std::min(kAtOnce, count - first), {}});
    }
    parallelFor(batches.size(), 1, [&](size_t b) {
      if (progress.stop()) return;
      Batch& batch = batches[b];
      std::vector<Vec3> lux(static_cast<size_t>(batch.count));
      if (!skies.empty()) lightBySky(rays, *skies[batch.meter], elements[batch.meter], batch, settings.seed, lux);
      light.sample(batch.meter, batch.first, batch.count, lux);
      for (const Vec3& l : lux) batch.sums.add(l);
    });
    for (const Batch& b : batches) sums[b.meter].add(b.sums);
    if (progress.stop()) break;
    const double dark = kOfMean * meanLux(sums);
    std::vector<bool> sure((n + settings.together - 1) / settings.together);
    for (size_t g = 0; g < sure.size(); ++g) {
      const size_t first = g * settings.together, last = std::min(n, first + settings.together);
      sure[g] = areSure(std::span(sums).subspan(first, last - first), settings.tolerance, dark);
    }
    std::erase_if(open, [&](size_t i) { return sure[i / settings.together]; });
    progress.at(1 - static_cast<float>(open.size()) / static_cast<float>(n));
  }
  std::vector<MeterReading> out;
  for (const Sums& s : sums) out.push_back(s.reading());
  return out;
}

}  // namespace roomlight
