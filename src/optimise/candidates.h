// Where lamps may go in a home, and every lamp that could hang there.
#pragma once

#include "measure/lattice.h"
#include "optimise/study_file.h"
#include "trace/ray_scene.h"

namespace roomlight::optimise {

struct Place {
  std::string name;  // "Living ceiling 3"
  size_t rule = 0;   // of StudyFile::places
  Vec3 mount, away;  // on the ceiling, wall or top; unit, into the room
};

// One luminaire at one place with one aim: what light is computed for once.
struct Candidate {
  size_t place = 0, luminaire = 0;
  Vec3 position, direction;  // of its light
  std::string aim;
};

// What a design can choose for a place: a candidate in one of its colours.
struct LampOption {
  size_t candidate = 0;
  double kelvin = 3000;
};

struct Candidates {
  std::vector<Place> places;             // each with an option at least
  std::vector<Candidate> candidates;
  std::vector<LampOption> options;       // those of a place follow one another
  std::vector<size_t> firstOption;       // per place, and the end
  std::vector<std::vector<uint32_t>> conflicts;  // per place: those too near for lamps at both
  size_t inThings = 0, tooNear = 0;  // places left out: inside things; nearer to something than a luminaire is large
};

constexpr size_t kMostCandidates = 2000;

// The error names the file's line. Costs some ten rays a place.
Result<Candidates> findCandidates(const StudyFile& study, const RayScene& rays);

}  // namespace roomlight::optimise
