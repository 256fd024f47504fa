// What a study compares: scenes, each under several conditions of light, by several techniques. Study files, version 1:
// docs/reference/study.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace roomlight {

struct StudyLight {
  std::string name;  // "daylight", "lamps", "one dim lamp"
  std::filesystem::path lighting;  // lighting file; empty: the scene's own light
  double dimLampLm = 0;  // above 0: instead, one bare lamp before the camera and nothing else (preparation.h)
};

struct StudyScene {
  std::string name;
  std::filesystem::path file;
  std::string camera;  // name or number; empty: the scene's usual one
  std::vector<StudyLight> lights;
  std::filesystem::path walk;  // walk file for frames a second; empty: none
  StudyLight walkLight{};  // of the walk: the first of the plan's, even where not all of them are tried
};

// A technique with settings, tried with twice as many samples a pixel each time until its error settles.
struct StudyTechnique {
  std::string name;  // in tables
  std::string technique;  // of techniques()
  std::string settings = "{}";  // JSON as --settings takes it
  std::string kind = "rival";  // "ours", "rival" or "judge"
  std::string only{};  // "pictures" or "walks"; empty: both
};

struct StudyPlan {
  std::vector<StudyScene> scenes;
  std::vector<StudyTechnique> techniques;
  bool againstPublished = false;  // reports say what the study that roomlight builds on published, and what roomlight
                                  // asks of itself beside it
  // Those that are tried so: "pictures" or "walks".
  std::vector<StudyTechnique> techniquesIn(const std::string& what) const;
};

// Names of what can be measured apart from the rest: "SCENE/LIGHT" of a view, "SCENE/walk" of a walk.
std::string viewName(const StudyScene& scene, const StudyLight& light);
std::string walkName(const StudyScene& scene);
// All that the plan has techniques for.
std::vector<std::string> partsOf(const StudyPlan& plan);

// cone and hybrid, the three rivals with what the study's parameters leave open (docs/reference/study.md), and path.
std::vector<StudyTechnique> usualTechniques();

// Paths in the file are relative to it. Errors: as of every file (json/json_reader.h), a file named in it that is not
// there, a name given twice.
Result<StudyPlan> readStudyFile(const std::filesystem::path& file);

}  // namespace roomlight
