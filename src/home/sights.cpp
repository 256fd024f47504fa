#include "home/cameras.h"

#include <algorithm>
#include <cmath>

#include "base/sampling.h"
#include "home/rooms.h"
#include "trace/camera_rays.h"

namespace roomlight::home {
namespace {

constexpr double kMostlyRoom =
    0.4;  // of what is seen lies in rooms: seen through a window from outside, all around it is half
constexpr int kAcross = 32, kDown = 18;
constexpr int kAround = 64;
constexpr double kClosedIn = 0.85;

}  // namespace

double Sights::share(float nearM, float farM) const {
  const auto count = std::count_if(surfaces.begin(), surfaces.end(),
                                   [&](const Seen& s) { return s.distanceM >= nearM && s.distanceM <= farM; });
  return rays > 0 ? static_cast<double>(count) / static_cast<double>(rays) : 0;
}

Sights sightsOf(const RayScene& rays, const Camera& camera) {
  const CameraRays cameraRays(camera, kAcross, kDown);
  Sights sights;
  sights.rays = kAcross * kDown;
  for (int y = 0; y < kDown; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      const Ray ray = cameraRays.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Hit hit = rays.intersect(ray);
      if (!hit.valid()) continue;
      const Vec3 n = normalize(dot(hit.ng, ray.direction) > 0 ? -hit.ng : hit.ng);
      sights.surfaces.push_back({ray.origin + ray.direction * hit.t, n, hit.t * length(ray.direction)});
    }
  }
  return sights;
}

bool isIndoors(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera, const Sights& sights) {
  const auto inRoom = [&](const Seen& s) {
    return std::any_of(rooms.begin(), rooms.end(), [&](const Room& r) { return isIn(r, s.p + s.n * 0.05f); });
  };
  const auto& seen = sights.surfaces;
  if (!seen.empty() && static_cast<double>(std::count_if(seen.begin(), seen.end(), inRoom)) >
                           kMostlyRoom * static_cast<double>(seen.size()))
    return true;
  int met = 0;
  for (int i = 0; i < kAround; ++i) {
    const Vec3 d = sampleSphere(latticePoint(i, kAround));
    met += rays.intersect({camera.worldFromCamera.w, d, 0, kInfinity}).valid() ? 1 : 0;
  }
  return met > kClosedIn * kAround;
}

}  // namespace roomlight::home
