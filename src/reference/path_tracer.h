// The judge: unidirectional path tracing with next-event estimation and multiple importance sampling over all lights,
// Russian roulette without a bounce cap. Sees rays, materials and lights; never a voxel.
#pragma once

#include <memory>
#include <span>

#include "base/image.h"
#include "base/progress.h"
#include "filter/filter.h"
#include "trace/light_layers.h"
#include "trace/lights.h"
#include "trace/meter.h"
#include "trace/ray_scene.h"

namespace roomlight {

struct PathSettings {
  int width = 960, height = 540;
  int samples = 256;       // per pixel, at most
  double timeLimitS = 0;   // stop after this long (after a whole pass); 0: no limit
  double noiseLevel = 0;   // stop when the mean relative standard error over pixels is below this; 0: never
  bool white = false;      // what the camera sees straight, or through panes, is whitened (scene/surface.h)
  bool lightPaths = true;  // also follow light from lamps and small emissive meshes, and connect to where it arrives
  bool caustics = true;    // what polished surfaces throw on what the camera sees starts at its lights
  bool filter = false;  // the picture is filtered (filter/filter.h): for looking at; no reference then
  uint64_t seed = 0;
  std::shared_ptr<const LightLayers> layers;  // lights whose light is kept apart; none: it is not
};

// Path tracing pass by pass: each adds one sample to every pixel. Refers to the rays and lights.
class PathTracer {
 public:
  // Size, light paths and seed of the settings count. With features, what a filter needs is kept as well: 128 B more a
  // pixel.
  PathTracer(const RayScene& rays, const Lights& lights, const Camera& camera, const PathSettings& settings,
             bool features = false);
  ~PathTracer();

  // Reports the fraction of this pass. False: stopped half way, and dropped. The first is stopped only with `firstToo`:
  // there is no picture then.
  bool pass(const Progress& progress = {}, bool firstToo = false);

  int samples() const;  // passes so far
  Image mean() const;  // linear, cd/m²
  Image variance() const;  // of each pixel's mean, per channel; 0 with one sample
  double noise() const;  // mean relative standard error over pixels; infinite with one sample
  uint64_t rays() const;  // traced so far, of every kind
  FilterInput features() const;  // needs features
  std::vector<Image> layers() const;  // of the mean, where the settings have layers: their sum is mean()

 private:
  struct State;
  std::unique_ptr<State> state_;
};

struct PathResult {
  Image image;  // linear, cd/m²
  Image variance;  // of each pixel's mean before filtering, per channel
  std::vector<Image> layers;  // where the settings have them: their sum is `image`
  int samples = 0;  // per pixel, done
  double noise = 0;  // mean relative standard error
  uint64_t rays = 0;  // traced, of every kind
};

PathResult pathTrace(const RayScene& rays, const Lights& lights, const Camera& camera, const PathSettings& settings,
                     const Progress& progress = {});

// Incident light meters: a reading for each element, as readMeters() has it.
std::vector<MeterReading> measureIlluminance(const RayScene& rays, const Lights& lights,
                                             std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                             const Progress& progress = {});
// One, with so many samples.
MeterReading measureIlluminance(const RayScene& rays, const Lights& lights, Vec3 position, Vec3 normal, int samples,
                                uint64_t seed);

}  // namespace roomlight
