#include "engine/technique.h"

#include <fmt/format.h>

#include <algorithm>

namespace roomlight {
namespace {

const Technique* const kTechniques[] = {&kHybridTechnique, &kConeTechnique,   &kVxgiTechnique,
                                        &kLpvTechnique,    &kPhotonTechnique, &kPathTechnique};

std::string joined(const std::vector<std::string>& names, const char* between) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : between) + name;
  return out;
}

}  // namespace

std::span<const Technique* const> techniques() { return kTechniques; }

const Technique* findTechnique(const std::string& name) {
  const auto found =
      std::find_if(std::begin(kTechniques), std::end(kTechniques), [&](const Technique* t) { return name == t->name; });
  return found == std::end(kTechniques) ? nullptr : *found;
}

Result<const Technique*> techniqueNamed(const std::string& name) {
  if (const Technique* found = findTechnique(name)) return found;
  std::vector<std::string> names;
  for (const Technique* t : kTechniques) names.emplace_back(t->name);
  return Error{fmt::format("unknown technique '{}'; there are {}", name, joined(names, ", "))};
}

std::vector<std::pair<std::string, std::string>> describedTechniques() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Technique* t : kTechniques) list.emplace_back(t->name, t->about);
  return list;
}

std::string techniquesWith(bool Technique::*capability) {
  std::vector<std::string> names;
  for (const Technique* t : kTechniques) {
    if (t->*capability) names.emplace_back(t->name);
  }
  return joined(names, " or ");
}

}  // namespace roomlight
