// The cameras of still pictures of an opened home, and what of the home they need.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/settings.h"
#include "engine/views.h"
#include "home/open_home.h"

namespace roomlight {

// A name that stands for every camera of the home, unless one is called so.
constexpr const char* kAllCameras = "all";
// Whether one of the names means every camera.
bool meansAllCameras(const std::vector<std::string>& cameras);

// The cameras with these names, each once; the default one where none is named. Errors: an unknown name.
Result<std::vector<Camera>> camerasNamed(const std::vector<std::string>& names, const Scene& scene);

// Those cameras, and the views from there that are wished. `settings`: of a usual picture's size.
Result<std::vector<Viewed>> viewsOf(const std::vector<std::string>& names, const home::OpenedHome& opened,
                                    const RenderSettings& settings, const ViewWish& wish);

// What a Sweet Home 3D home says of its photo, where nobody else says how large and how well: its first two qualities
// are without ray tracing, the last is for keeping.
void takePhotoWish(const PhotoWish& photo, bool sizeIsSaid, bool qualityIsSaid, RenderSettings& settings);

// A picture that is taken from elsewhere than where a camera stands.
bool isElsewhere(const ViewWish& wish);

// Of large scenes the part whose light comes to the cameras that it is found for; none: all of it. The reference sees
// everything, layers name every lamp, and plans see all rooms. Who takes a picture from elsewhere than light is found
// for needs the whole.
std::optional<Scene> partInReach(const Scene& scene, const RenderSettings& settings, const std::vector<Camera>& cameras,
                                 const std::vector<Camera>& lightFor);

}  // namespace roomlight
