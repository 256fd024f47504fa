// What a light meter is asked and what it answers, and how long it goes on sampling.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/vec.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight {

// A small flat piece that light falls on from the side its unit normal points to, such as the dome of an incident
// meter.
struct SurfaceElement {
  Vec3 position, normal{0, 1, 0};
  // Edge of the square around it, m, over which what comes straight from small sources is averaged by techniques whose
  // shadows are sharp, so that their edges are where they are; 0: at the point.
  float footprintM = 0;
  // Unit: light counts by its cosine with this, as a normal map turns a surface; from above the surface alone. Zero:
  // the normal.
  Vec3 turned{};

  Vec3 facing() const { return isBlack(turned) ? normal : turned; }
  // The cosine that light from wi counts by.
  float cosine(Vec3 wi) const { return dot(wi, normal) > 0 ? std::max(0.0f, dot(wi, facing())) : 0; }
};

struct MeterReading {
  Vec3 illuminanceLux;  // luminance(rgb) is the reading
  double standardErrorLux = 0;  // as if samples were independent; stratification makes the real one smaller
};

struct MeterSettings {
  double tolerance = 0.01;  // relative standard error at which a meter is read
  int fewestSamples = 64;  // powers of two
  int mostSamples = 1 << 14;
  uint64_t seed = 0;
  // Whether what comes straight from suns counts; techniques that light surfaces by rays and cones (gather/meters.h)
  // can leave it out.
  bool straightSuns = true;
  // So many elements that follow one another, one at least, are sure together, by their mean error beside their mean:
  // one that has seen nothing rare takes its error for smaller than it is, and stops where another goes on, so that the
  // mean of many is too low. A dark one among bright ones is less sure.
  size_t together = 1;
};

// Light on elements but what comes straight from the sky: that of `count` samples of one of them, from the one numbered
// `first` on, is added to `lux`.
using SampleMeter = std::function<void(size_t element, int first, int count, std::span<Vec3> lux)>;

// Called before every round, with its number and how many samples all meters take in it.
using PrepareMeters = std::function<void(uint32_t round, size_t samples)>;

// Where the light on meters comes from.
struct MeteredLight {
  SampleMeter sample;  // called from many threads
  PrepareMeters prepare = {};  // may be empty
};

// A reading for each element. The sky is sampled here, where it is open (open_sky.h). Every meter takes fewestSamples;
// those that are not yet as certain as the tolerance asks, or as a hundredth of what meters show on average needs, go
// on to twice as many, up to mostSamples. Does not depend on the number of threads. Once `progress` says stop, readings
// are those so far.
std::vector<MeterReading> readMeters(const RayScene& rays, const Lights& lights,
                                     std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                     const MeteredLight& light, const Progress& progress = {});

}  // namespace roomlight
