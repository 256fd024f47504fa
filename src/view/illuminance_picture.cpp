#include "view/illuminance_picture.h"

#include "base/parallel.h"
#include "trace/camera_rays.h"
#include "trace/surface_point.h"

namespace roomlight::view {
namespace {

float luxAt(const RayScene& rays, const Ray& ray, Vec3 light) {
  const Hit hit = rays.intersect(ray);
  if (!hit.valid()) return -1;
  const SurfacePoint p = surfaceAt(rays.scene(), hit, ray.direction);
  const bool none = !isBlack(p.m.emission) || p.m.transmission > 0 || p.m.alpha < 1 || p.m.glazed;
  return none ? -1 : kPi * luminance(light);
}

}  // namespace

Image illuminancePicture(const RayScene& rays, const Camera& camera, const Image& light) {
  Image out(light.width, light.height);
  const CameraRays view(camera, light.width, light.height);
  parallelFor(static_cast<size_t>(light.height), 4, [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width; ++x)
      out.at(x, y) =
          Vec3(luxAt(rays, view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), light.at(x, y)));
  });
  return out;
}

}  // namespace roomlight::view
