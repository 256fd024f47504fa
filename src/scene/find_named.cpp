#include "scene/find_named.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "base/words.h"

namespace roomlight {
namespace {

using Names = std::vector<std::string>;

// Numbers of those that are or, where none is, begin so, in capital or small letters.
std::vector<size_t> namedAlike(const Names& names, const std::string& wanted) {
  const std::u32string folded = foldedCase(wanted);
  for (const bool whole : {true, false}) {
    std::vector<size_t> found;
    for (size_t i = 0; i < names.size(); ++i) {
      const std::u32string name = foldedCase(names[i]);
      if (whole ? name == folded : name.starts_with(folded)) found.push_back(i);
    }
    if (!found.empty()) return found;
  }
  return {};
}

// With numbers where names alone do not tell.
std::string listed(const Names& names) {
  const std::set<std::string> different(names.begin(), names.end());
  const bool numbered = different.size() < names.size() || different.contains("");
  std::string out;
  for (size_t i = 0; i < names.size(); ++i) {
    out += out.empty() ? "" : ", ";
    if (numbered) out += fmt::format("{} ", i);
    out += fmt::format("'{}'", names[i]);
  }
  return out;
}

// `kind`: what they are, for errors.
Result<size_t> findNamed(const Names& names, const std::string& wanted, const char* kind) {
  const auto named = std::find(names.begin(), names.end(), wanted);
  if (named != names.end()) return static_cast<size_t>(named - names.begin());
  size_t index = 0;
  const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (code == std::errc() && end == wanted.data() + wanted.size() && index < names.size()) return index;
  const std::vector<size_t> alike = namedAlike(names, wanted);
  if (alike.size() == 1) return alike.front();
  if (alike.size() > 1) {
    std::string several;
    for (const size_t i : alike) several += fmt::format("{}'{}'", several.empty() ? "" : ", ", names[i]);
    return Error{fmt::format("{} '{}' may be any of {}", kind, wanted, several)};
  }
  if (const std::string nearest = nearestWord(wanted, names); !nearest.empty())
    return Error{fmt::format("no {} '{}'; did you mean '{}'? There are {}", kind, wanted, nearest, listed(names))};
  return Error{fmt::format("no {} '{}'; there are {}", kind, wanted, listed(names))};
}

template <class Range>
Names namesOf(const Range& things) {
  Names names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

}  // namespace

Result<Camera> findCamera(const Scene& scene, const std::string& wanted) {
  if (wanted.empty()) return defaultCamera(scene);
  if (scene.cameras.empty())
    return Error{fmt::format("no camera '{}': the scene has none; leave --camera out to have one proposed", wanted)};
  const Result<size_t> found = findNamed(namesOf(scene.cameras), wanted, "camera");
  if (!found) return Error{found.error()};
  return scene.cameras[found.value()];
}

Result<size_t> findRoom(std::span<const Room> rooms, const std::string& wanted) {
  if (rooms.empty()) return Error{fmt::format("no room '{}': the scene knows no rooms and none were found", wanted)};
  return findNamed(namesOf(rooms), wanted, "room");
}

}  // namespace roomlight
