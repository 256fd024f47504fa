#include "scene/find_camera.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

#include "base/words.h"

namespace roomlight {
namespace {

// Cameras whose names are or, where none is, begin so, in capital or small letters.
std::vector<const Camera*> namedAlike(const std::vector<Camera>& cameras, const std::string& wanted) {
  const std::u32string folded = foldedCase(wanted);
  for (const bool whole : {true, false}) {
    std::vector<const Camera*> found;
    for (const Camera& c : cameras) {
      const std::u32string name = foldedCase(c.name);
      if (whole ? name == folded : name.starts_with(folded)) found.push_back(&c);
    }
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace

Result<Camera> findCamera(const Scene& scene, const std::string& wanted) {
  if (wanted.empty()) return defaultCamera(scene);
  const auto named =
      std::find_if(scene.cameras.begin(), scene.cameras.end(), [&](const Camera& c) { return c.name == wanted; });
  if (named != scene.cameras.end()) return *named;
  size_t index = 0;
  const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (code == std::errc() && end == wanted.data() + wanted.size() && index < scene.cameras.size())
    return scene.cameras[index];
  const std::vector<const Camera*> alike = namedAlike(scene.cameras, wanted);
  if (alike.size() == 1) return *alike.front();
  if (alike.size() > 1) {
    std::string several;
    for (const Camera* c : alike) several += fmt::format("{}'{}'", several.empty() ? "" : ", ", c->name);
    return Error{fmt::format("camera '{}' may be any of {}", wanted, several)};
  }
  if (scene.cameras.empty())
    return Error{fmt::format("no camera '{}': the scene has none; leave --camera out to have one proposed", wanted)};
  std::vector<std::string> names;
  std::string listed;
  for (const Camera& c : scene.cameras)
    names.push_back(c.name), listed += fmt::format("{}'{}'", listed.empty() ? "" : ", ", c.name);
  if (const std::string nearest = nearestWord(wanted, names); !nearest.empty())
    return Error{fmt::format("no camera '{}'; did you mean '{}'? There are {}", wanted, nearest, listed)};
  return Error{fmt::format("no camera '{}'; there are {}", wanted, listed)};
}

}  // namespace roomlight
