#include "still/cameras.h"

#include <algorithm>

#include "engine/technique.h"
#include "home/cameras.h"
#include "scene/find_named.h"
#include "trace/camera_rays.h"
#include "trace/ray_scene.h"

namespace roomlight {
namespace {

bool isAmong(const std::vector<Camera>& cameras, const Camera& camera) {
  return std::any_of(cameras.begin(), cameras.end(),
                     [&](const Camera& c) { return c.name == camera.name && seeTheSame(c, camera); });
}

}  // namespace

bool meansAllCameras(const std::vector<std::string>& cameras) {
  return std::find(cameras.begin(), cameras.end(), kAllCameras) != cameras.end();
}

Result<std::vector<Camera>> camerasNamed(const std::vector<std::string>& names, const Scene& scene) {
  if (meansAllCameras(names) &&
      std::none_of(scene.cameras.begin(), scene.cameras.end(), [](const Camera& c) { return c.name == kAllCameras; })) {
    return scene.cameras.empty() ? std::vector<Camera>{defaultCamera(scene)} : scene.cameras;
  }
  std::vector<Camera> out;
  for (const std::string& name : names.empty() ? std::vector<std::string>{""} : names) {
    const Result<Camera> camera = findCamera(scene, name);
    if (!camera) return Error{camera.error()};
    if (!isAmong(out, camera.value())) out.push_back(camera.value());
  }
  return out;
}

Result<std::vector<Viewed>> viewsOf(const std::vector<std::string>& names, const home::OpenedHome& opened,
                                    const RenderSettings& settings, const ViewWish& wish) {
  const Scene& scene = opened.scene;
  const Result<std::vector<Camera>> cameras = camerasNamed(names, scene);
  if (!cameras) return Error{cameras.error()};
  std::vector<Viewed> out;
  for (const Camera& camera : cameras.value()) {
    const Result<Viewed> viewed = makeView(scene, scene.rooms, camera, !names.empty() || opened.placed(),
                                           {settings.width, settings.height}, wish);
    if (!viewed) return Error{viewed.error()};
    out.push_back(viewed.value());
  }
  return out;
}

void takePhotoWish(const PhotoWish& photo, bool sizeIsSaid, bool qualityIsSaid, RenderSettings& s) {
  if (!sizeIsSaid) s.width = photo.widthPx, s.height = photo.heightPx;
  if (qualityIsSaid) return;
  const float voxelSizeM = s.voxel.voxelSizeM;
  applyQuality(photo.quality < 2 ? "draft" : photo.quality == 2 ? "good" : "best", s);
  s.voxel.voxelSizeM = voxelSizeM;
}

bool isElsewhere(const ViewWish& wish) {
  return wish.eye || !wish.room.empty() || wish.view == View::Top || wish.view == View::Plan;
}

std::optional<Scene> partInReach(const Scene& scene, const RenderSettings& settings, const std::vector<Camera>& cameras,
                                 const std::vector<Camera>& lightFor) {
  if (findTechnique(settings.technique)->role == TechniqueRole::Judge || settings.layers) return std::nullopt;
  const auto seesAll = [](const Camera& c) {
    return c.projection == Projection::Orthographic || c.cutHeightM < kInfinity;
  };
  if (std::any_of(lightFor.begin(), lightFor.end(), seesAll) ||
      !std::all_of(cameras.begin(), cameras.end(), [&](const Camera& c) { return isAmong(lightFor, c); }))
    return std::nullopt;
  return home::withinReach(RayScene(scene), lightFor);
}

}  // namespace roomlight
