// What the sun lights, found by more places than links would find by chance, and the first bounce off it.
#pragma once

#include <span>
#include <vector>

#include "radiance/bright_patches.h"
#include "radiance/links.h"
#include "radiance/slot_paths.h"
#include "trace/ray_scene.h"
#include "trace/traced_scene.h"

namespace roomlight {

// Places that the scene's only sun lights, with the flux they reflect, Lambertian. `sunLux`:
// per slot, known by few rays; of flat surfaces that fill their voxel it becomes known by 16, by 4 where all around is
// lit alike.
std::vector<GlowPoint> sunPlaces(const TracedScene& scene, const SlotSampling& slots, const Links& links,
                                 std::span<Vec3> sunLux, uint64_t& rayCount);

// lx per slot that arrives from the patches, whose slots reflect `reflectedLx`: by samples of them and along links,
// which share it by multiple importance sampling.
std::vector<Vec3> lightFrom(const BrightPatches& patches, const RayScene& rays, const SlotSampling& slots,
                            const Links& links, std::span<const Vec3> reflectedLx, uint64_t& rayCount);

}  // namespace roomlight
