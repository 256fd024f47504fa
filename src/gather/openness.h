// How open surfaces are to what lies near: the part of their hemisphere that is free as far as a few to some dozen
// pixels reach. It has little noise where light has much, and contacts, corners and things before walls show in both:
// the filter learns from it where light changes (filter/levels.h).
#pragma once

#include "filter/filter.h"
#include "trace/camera_rays.h"

namespace roomlight {

// Sets FilterPixel::open of what pixels see, from sums over their camera rays. Returns how many rays it took.
uint64_t findOpenness(const RayScene& rays, const CameraRays& camera, uint64_t seed, FilterInput& sums);

}  // namespace roomlight
