// Light on many places, found chunk by chunk, so that what an interrupted run has found is there for the next.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bake/kept_light.h"
#include "engine/stages.h"
#include "trace/meter.h"

namespace roomlight::bake {

// What is read at the places of one light.
struct MeterChunks {
  std::span<const SurfaceElement> places;
  size_t numbersAPlace = 4;
  std::string inputs;  // a hash of all that readings depend on beside the places
  const KeptLight& kept;
  MeterSettings meters;

  using Measure =
      std::function<std::vector<float>(std::span<const SurfaceElement>, const MeterSettings&, const Progress&)>;
  using Take = std::function<void(size_t firstPlace, std::span<const float> numbers)>;
  // Hands on the numbers of all places in order, measured or kept. False once `progress` says stop.
  bool read(const Measure& measure, const Take& take, const Progress& progress) const;
};

}  // namespace roomlight::bake
