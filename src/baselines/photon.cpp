#include "baselines/photon.h"

#include "base/sampling.h"
#include "trace/camera_rays.h"

namespace roomlight {

ImportonStart importonsFrom(const Camera& camera, int width, int height) {
  return [rays = CameraRays(camera, width, height), width, height](uint32_t, Sampler& sampler) {
    const Vec2 u = sampler.next2();
    return rays.ray(u.x * static_cast<float>(width), u.y * static_cast<float>(height));
  };
}

ImportonStart importonsFrom(std::span<const SurfaceElement> elements) {
  return [elements](uint32_t index, Sampler& sampler) {
    const SurfaceElement& e = elements[index % elements.size()];
    return Ray{offsetOrigin(e.position, e.normal), Frame(e.normal).toWorld(sampleCosineHemisphere(sampler.next2())), 0,
               kInfinity};
  };
}

GatheredPicture gatherPhotons(const RayScene& rays, const Lights& lights, const PhotonLight& light,
                              const Camera& camera, const PhotonSettings& settings, const Progress& progress) {
  return gatherPicture(rays, lights, PhotonShader(rays, lights, light, settings), camera, settings, progress);
}

}  // namespace roomlight
