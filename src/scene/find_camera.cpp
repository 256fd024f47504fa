#include "scene/find_camera.h"

#include <fmt/format.h>

#include <charconv>

namespace roomlight {

Result<Camera> findCamera(const Scene& scene, const std::string& wanted) {
  if (wanted.empty()) return defaultCamera(scene);
  std::string names;
  for (const Camera& c : scene.cameras) {
    if (c.name == wanted) return c;
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", c.name);
  }
  size_t index = 0;
  const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (code == std::errc() && end == wanted.data() + wanted.size() && index < scene.cameras.size()) return scene.cameras[index];
  if (scene.cameras.empty()) return Error{fmt::format("no camera '{}': the scene has none; leave --camera out to have one proposed", wanted)};
  return Error{fmt::format("no camera '{}'; there are {}", wanted, names)};
}

}  // namespace roomlight
