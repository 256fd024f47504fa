#include "engine/sights.h"

#include "trace/camera_rays.h"
#include "trace/surface_point.h"

namespace roomlight {
namespace {

constexpr float kDarkest = 0.03f;    // albedos below this say little of the light
constexpr float kBrightest = 4.0f;   // of the mean; a patch of sun counts as much as this

}  // namespace

Vec3 lightColour(const RayScene& rays, const Camera& camera, const Image& image, int raysASide) {
  const CameraRays cameraRays(camera, image.width, image.height);
  std::vector<Vec3> colours;
  double mean = 0;
  for (int j = 0; j < raysASide; ++j) {
    for (int i = 0; i < raysASide; ++i) {
      const int x = (2 * i + 1) * image.width / (2 * raysASide), y = (2 * j + 1) * image.height / (2 * raysASide);
      const Ray ray = cameraRays.seeing(rays, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      if (ray.tMax <= 0) continue;
      const Hit hit = rays.intersect(ray);
      if (!hit.valid()) continue;
      const SurfacePoint s = surfaceAt(rays.scene(), hit, ray.direction);
      const bool tells = isBlack(s.m.emission) && s.m.metallic < 0.5f && s.m.transmission < 0.5f && s.m.alpha > 0.5f &&
                         minComponent(s.m.baseColor) >= kDarkest;
      if (!tells) continue;
      colours.push_back(image.at(x, y) / s.m.baseColor);
      mean += static_cast<double>(luminance(colours.back()));
    }
  }
  if (!(mean > 0)) return {};
  const float brightest = kBrightest * static_cast<float>(mean / static_cast<double>(colours.size()));
  Vec3 sum;
  for (const Vec3 c : colours) sum += c * std::min(1.0f, brightest / std::max(luminance(c), 1e-20f));
  return sum / luminance(sum);
}

}  // namespace roomlight
