// The registry of techniques. A technique is a class derived from LitScene and a row that says what it can do, both in
// one file technique_NAME.cpp; render, meters, walks, view, studies, validation and help texts read the rows.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/lit_scene.h"

namespace roomlight {

enum class TechniqueRole {
  Own,        // roomlight's
  Published,  // the published study's method
  Rival,      // what that study compares it with
  Judge,      // exact up to noise: what the others are measured against
};

// Of readings by meters where the light is known (docs/measured/validation.md).
struct MeterAccuracy {
  double allowedPercent = 3;  // off
  bool ofSum = false;         // allowed of the sum over a case, not at each place
  bool isValidated = false;   // among those that `roomlight validate` takes if none is named
  int places = 0;             // measured: closed forms and CIE 171:2006; 0: not
  double worstPercent = 0;    // the largest error there, of its size
  // Beside the judge in a furnished flat, in the worse of two lights: what 95 of 100 meters are within, and the error
  // of their mean. 0: not measured.
  double furnishedWithinPercent = 0, furnishedMeanPercent = 0;
};

struct Technique {
  const char* name;  // of options, settings, messages
  const char* about;  // one line
  TechniqueRole role;

  // What it can do.
  bool layers = false;  // RenderSettings::layers: the light of each lamp, sun and sky apart
  bool followsDaylight = false;  // LitScene::update follows suns and sky; else the scene is lit anew
  bool keepsWhatStands = false;  // update() keeps light that a change has nothing to do with; else all is done anew
  bool hasSnapshots = false;  // LitScene::snapshot, for frames in a few milliseconds
  bool fillsTimeLimit = false;  // a time limit is kept whole, and what time is left makes the picture better
  bool sharesLight = false;  // LitUse::store: processes find the light of stills once for all of them
  bool refinesToTruth = false;  // the mean of its pictures of one view comes to the judge's

  MeterAccuracy meters;
  Result<std::unique_ptr<LitScene>> (*light)(const Scene& scene, const RenderSettings& settings, const LitUse& use,
                                             Stages& stages);
};

// The default first.
std::span<const Technique* const> techniques();
// Null where no technique has this name.
const Technique* findTechnique(const std::string& name);
// Errors: an unknown name; the line lists those there are.
Result<const Technique*> techniqueNamed(const std::string& name);
// Names and what they are, for help texts and lists, the default first.
std::vector<std::pair<std::string, std::string>> describedTechniques();
// "hybrid or path", of those that have a capability.
std::string techniquesWith(bool Technique::*capability);

extern const Technique kHybridTechnique, kConeTechnique, kVxgiTechnique, kLpvTechnique, kPhotonTechnique,
    kPathTechnique;

}  // namespace roomlight
