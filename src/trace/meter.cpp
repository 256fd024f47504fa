#include "trace/meter.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr int kAtOnce = 256;      // samples in one call
constexpr double kOfMean = 0.01;

struct Batch {
  size_t meter;
  int first, count;
  MeterSums sums;
};

double meanLux(const std::vector<MeterSums>& all) {
  double sum = 0;
  for (const MeterSums& s : all) sum += static_cast<double>(luminance(s.reading().illuminanceLux));
  return sum / static_cast<double>(all.size());
}

}  // namespace

void MeterSums::add(Vec3 lux) {
  const double l = static_cast<double>(luminance(lux));
  r_ += static_cast<double>(lux.x), g_ += static_cast<double>(lux.y), b_ += static_cast<double>(lux.z), squares_ += l * l;
  ++count_;
}

void MeterSums::add(const MeterSums& sums) {
  r_ += sums.r_, g_ += sums.g_, b_ += sums.b_, squares_ += sums.squares_;
  count_ += sums.count_;
}

MeterReading MeterSums::reading() const {
  const double n = std::max(1, count_);
  MeterReading out;
  out.illuminanceLux = {static_cast<float>(r_ / n), static_cast<float>(g_ / n), static_cast<float>(b_ / n)};
  const double mean = static_cast<double>(luminance(out.illuminanceLux));
  out.standardErrorLux = std::sqrt(std::max(0.0, squares_ / n - mean * mean) / std::max(1.0, n - 1));
  return out;
}

std::vector<MeterReading> readMeters(size_t meters, const MeterSettings& settings, const std::function<MeterSums(size_t, int, int)>& sample, const Progress& progress) {
  std::vector<MeterSums> sums(meters);
  std::vector<size_t> open(meters);
  for (size_t i = 0; i < meters; ++i) open[i] = i;
  for (int done = 0, count = settings.fewestSamples; !open.empty() && count <= settings.mostSamples; done = count, count *= 2) {
    std::vector<Batch> batches;
    for (const size_t i : open) {
      for (int first = done; first < count; first += kAtOnce) batches.push_back({i, first, std::min(kAtOnce, count - first), {}});
    }
    parallelFor(batches.size(), 1, [&](size_t b) {
      if (!progress.stop()) batches[b].sums = sample(batches[b].meter, batches[b].first, batches[b].count);
    });
    for (const Batch& b : batches) sums[b.meter].add(b.sums);
    if (progress.stop()) break;
    const double dark = kOfMean * meanLux(sums);
    std::erase_if(open, [&](size_t i) {
      const MeterReading m = sums[i].reading();
      return m.standardErrorLux <= settings.tolerance * std::max(static_cast<double>(luminance(m.illuminanceLux)), dark);
    });
    progress.at(1 - static_cast<float>(open.size()) / static_cast<float>(meters));
  }
  std::vector<MeterReading> out;
  for (const MeterSums& s : sums) out.push_back(s.reading());
  return out;
}

}  // namespace roomlight
