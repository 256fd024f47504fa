// Where a study looks: points of its zones, its eyes, and the places whose luminance is compared.
#pragma once

#include "measure/lattice.h"
#include "optimise/study_file.h"
#include "trace/meter.h"
#include "trace/ray_scene.h"

namespace roomlight::optimise {

struct ZonePoints {
  MeterGrid lattice;
  size_t first = 0, count = 0;  // of elements
  size_t leftOut = 0;           // inside things
};

// A place seen by an eye: its luminance is what falls on it times albedo / pi, as if it were matt.
struct SeenPlace {
  Vec3 albedo;
};

struct Meters {
  std::vector<SurfaceElement> elements;  // points of all zones, then eyes, then two places a ratio: task, surround
  std::vector<ZonePoints> zones;
  size_t firstEye = 0, firstSeen = 0;
  std::vector<SeenPlace> seen;  // of elements from firstSeen on
  size_t points() const { return firstEye; }
};

constexpr size_t kMostPoints = 20'000;  // of all zones

// The error names the file's line.
Result<Meters> placeMeters(const StudyFile& study, const RayScene& rays);

}  // namespace roomlight::optimise
