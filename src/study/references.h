// Pictures taken as true: two of path with other seeds, bettered in rounds until their noise is small or time is up.
#pragma once

#include "base/image.h"
#include "study/run_store.h"
#include "study/study_tools.h"

namespace roomlight {

struct ReferenceSettings {
  double roundS = 10;         // of each picture and round
  double mostS = 240;         // of both pictures together
  double noiseMse = 0.00002;  // of their mean, by compare's mse: enough
};

struct Reference {
  Image first, second;  // independent and of equal effort
  std::filesystem::path firstFile, secondFile;
  double noiseMse = 0;  // of their mean
  double seconds = 0;
  double samples = 0;   // per pixel, of both
  bool converged = false;  // noiseMse is as small as asked for
};

// Of what there shall be a reference.
struct ReferenceWish {
  StudyRender view;  // what is rendered; technique, samples, seed, time and picture are set by makeReference()
  ReferenceSettings settings;
  RunStore::Key key;  // what the store knows it by
};

// Goes on from what the store holds. `heard` is told the part of the time that is gone.
Result<Reference> makeReference(const ReferenceWish& wish, const RunStore& store, const StudyTools& tools,
                                const StudyProgress& progress, const std::function<void(double)>& heard = {});

}  // namespace roomlight
