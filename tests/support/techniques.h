// Names of techniques for tests, as the registry has them. What it must say of each is in
// unit/engine/technique_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "engine/technique.h"

namespace roomlight::test {

// Of which `holds` is true, the default first.
template <class Holds>
std::vector<std::string> techniquesWhere(const Holds& holds) {
  std::vector<std::string> names;
  for (const Technique* t : techniques()) {
    if (holds(*t)) names.emplace_back(t->name);
  }
  return names;
}
inline std::vector<std::string> allTechniques() {
  return techniquesWhere([](const Technique&) { return true; });
}
inline std::vector<std::string> techniquesThatCan(bool Technique::*capability) {
  return techniquesWhere([&](const Technique& t) { return t.*capability; });
}
// Which walk: all but the judge.
inline std::vector<std::string> walkingTechniques() {
  return techniquesWhere([](const Technique& t) { return t.role != TechniqueRole::Judge; });
}
// Whose meters are held to known light.
inline std::vector<std::string> validatedTechniques() {
  return techniquesWhere([](const Technique& t) { return t.meters.isValidated; });
}
// And at each place, not only over a whole case.
inline std::vector<std::string> preciseTechniques() {
  return techniquesWhere([](const Technique& t) { return t.meters.isValidated && !t.meters.ofSum; });
}

}  // namespace roomlight::test
