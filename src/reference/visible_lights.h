// Which lamps and emissive meshes light a place, for paths: before a picture some paths from the camera tell where
// surfaces are seen, and shadow rays from there what part of each light arrives. Kept by cells of space and facing
// (trace/light_parts.h).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trace/camera_rays.h"
#include "trace/light_parts.h"

namespace roomlight {

class VisibleLights {
 public:
  // Refers to the lights. Knows nothing: they are chosen without shadows.
  explicit VisibleLights(const Lights& lights) : lights_(lights) {}
  struct Picture {
    const CameraRays& camera;
    int width, height;  // pixels
  };
  // By `paths` from the camera of a picture. Not where there is no light to choose. Knows nothing as before once
  // `stopped` says so.
  void learn(
      const RayScene& rays, const Picture& picture, size_t paths, uint64_t seed,
      const std::function<bool()>& stopped = [] { return false; });

  // At a surface at p with unit normal n on its seen side: the parts of all lights that arrive. Empty: nothing is known
  // there.
  std::span<const LightPart> partsAt(Vec3 p, Vec3 n) const;
  size_t cellCount() const { return first_.empty() ? 0 : first_.size() - 1; }
  uint64_t rayCount() const { return rayCount_; }

 private:
  struct Place {
    Vec3 p, n;  // clear of its surface; unit
    uint64_t key;
  };
  struct PlacesInCell;
  struct Known {
    uint64_t key = 0;  // 0: empty
    uint32_t cell = 0;
  };
  static uint64_t keyOf(Vec3 p, Vec3 n);
  static void follow(const RayScene& rays, Ray ray, Sampler& sampler, std::vector<Place>& out, uint64_t& rayCount);
  void add(uint64_t key, uint32_t cell);
  void forget() { table_.clear(), first_.clear(), parts_.clear(); }

  const Lights& lights_;
  std::vector<Known> table_;  // a power of two, open addressing
  std::vector<uint32_t> first_;  // of each cell, into parts_; one more at the end
  std::vector<LightPart> parts_;
  uint64_t rayCount_ = 0;
};

}  // namespace roomlight
