// What a light meter is asked and what it answers, and how long it goes on sampling.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/progress.h"
#include "base/vec.h"

namespace roomlight {

// A small flat piece that light falls on from the side its unit normal points to, such as the dome of an incident meter.
struct SurfaceElement {
  Vec3 position, normal{0, 1, 0};
};

struct MeterReading {
  Vec3 illuminanceLux;          // luminance(rgb) is the reading
  double standardErrorLux = 0;  // as if samples were independent; stratification makes the real one smaller
};

struct MeterSettings {
  double tolerance = 0.01;  // relative standard error at which a meter is read
  int fewestSamples = 64;   // powers of two
  int mostSamples = 1 << 14;
  uint64_t seed = 0;
};

// Sums over samples of one meter.
class MeterSums {
 public:
  void add(Vec3 lux);
  void add(const MeterSums& sums);
  MeterReading reading() const;

 private:
  double r_ = 0, g_ = 0, b_ = 0, squares_ = 0;  // squares_: of luminance
  int count_ = 0;
};

// A reading for each of `meters`, from sample(meter, first, count): `count` samples from the one numbered `first` on, called from many threads.
// Every meter takes fewestSamples; those that are not yet as certain as the tolerance asks, or as a hundredth of what meters show on average
// needs, go on to twice as many, up to mostSamples. Does not depend on the number of threads. Once `progress` says stop, readings are those so far.
std::vector<MeterReading> readMeters(size_t meters, const MeterSettings& settings, const std::function<MeterSums(size_t meter, int first, int count)>& sample,
                                     const Progress& progress = {});

}  // namespace roomlight
