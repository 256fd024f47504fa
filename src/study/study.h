// The comparison of techniques: error and time of each on every scene and light, against references of path.
#pragma once

#include "study/curves.h"
#include "study/references.h"
#include "study/run_store.h"
#include "study/study_plan.h"
#include "study/study_tools.h"

namespace roomlight {

// A picture of some other program, with the seconds it took.
struct ExternalPicture {
  std::string name, scene, light;  // scene and light: of which picture; empty: of every one
  std::filesystem::path file;
  double seconds = 0;
};

struct StudySettings {
  int width = 640, height = 360;
  int runs = 3;            // of every point of a curve, in turn with those of others; medians count
  double mostSeconds = 60;  // a point that would take longer is left out
  int mostSamples = 4096;  // per pixel
  int walkWidth = 960, walkHeight = 540;
  int walkFrames = 12;     // of a walk, the first in a row
  ReferenceSettings reference;
  std::vector<ExternalPicture> externals;
  std::string program;     // what tells this build from others: what other builds measured does not count
};

struct StudyExternal {
  std::string name;
  double seconds = 0, mse = 0, mseBeyondNoise = 0, flip = 0, meanErrorPercent = 0;
  std::string picture;  // in the study's folder
};

// One scene in one light.
struct StudyCase {
  std::string scene, light, lighting;
  std::filesystem::path first, second;  // references
  double noiseMse = 0, referenceS = 0, referenceSamples = 0;
  bool referenceConverged = false;
  std::vector<StudyCurve> curves;  // in the plan's order
  std::vector<StudyExternal> externals;
};

struct StudyFrames {
  std::string scene, light, technique, kind;
  std::vector<WalkCost> runs;
  WalkCost cost;       // their median
  std::string failed;  // why there are no (more) runs; empty: nothing went wrong
};

struct StudyResults {
  std::vector<StudyCase> cases;
  std::vector<StudyFrames> frames;
  std::vector<std::string> remarks;  // what went wrong on the way; one line each
  bool complete = true;              // false: stopped early
  bool againstPublished = false;     // as the plan has it
};

// Neither a view nor a frame of a walk.
bool nothingMeasured(const StudyResults& results);

// Pictures and what was measured lie in `store`; what it already holds is not measured again. `soFar` is called after
// every case. A technique that fails has its reason in its curve; a scene and light without a reference, and an
// external picture that cannot be compared, is left out, with a remark. Views have references only where there is
// something to be compared: a technique for pictures, or an external one.
Result<StudyResults> runStudy(const StudyPlan& plan, const StudySettings& settings, const RunStore& store,
                              const StudyTools& tools, const StudyProgress& progress = {},
                              const std::function<void(const StudyResults&)>& soFar = {});

}  // namespace roomlight
