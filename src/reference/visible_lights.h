// Which lamps and emissive meshes light a place, for paths: before a picture some paths from the camera tell where surfaces are seen, and shadow rays from there what part of
// each light arrives. Kept by cells of space and facing (after Vévoda, Kondapaneni & Křivánek 2018, "Bayesian online regression for adaptive direct illumination sampling"; learned once, so
// that it does not depend on threads).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trace/camera_rays.h"
#include "trace/light_looks.h"
#include "trace/lights.h"

namespace roomlight {

class VisibleLights {
 public:
  // Refers to the lights. Knows nothing: they are chosen without shadows.
  explicit VisibleLights(const Lights& lights) : lights_(lights) {}
  // By `paths` from the camera of a picture of w x h pixels. Not where there are too few lights to choose, or too many for cells to list. Knows nothing as before once `stopped` says so.
  void learn(
      const RayScene& rays, const CameraRays& camera, int w, int h, size_t paths, uint64_t seed, const std::function<bool()>& stopped = [] { return false; });

  // At a surface at p with unit normal n on its seen side: the part of each light that arrives, as Lights::sampleLocal wants it. Empty: nothing is known there.
  std::span<const float> partsAt(Vec3 p, Vec3 n) const;
  size_t cellCount() const { return lightCount() > 0 ? part_.size() / lightCount() : 0; }
  uint64_t rayCount() const { return rayCount_; }

 private:
  struct Place {
    Vec3 p, n;  // clear of its surface; unit
    uint64_t key;
  };
  struct Known {
    uint64_t key = 0;  // 0: empty
    int32_t cell = -1;
  };
  static uint64_t keyOf(Vec3 p, Vec3 n);
  size_t lightCount() const { return lights_.lampCount() + lights_.emitterCount(); }  // lamps come first
  float importance(size_t light, Vec3 p) const;
  LightSample sampleOne(size_t light, Vec3 p, Vec2 u, float choice) const;
  static void follow(const RayScene& rays, Ray ray, Sampler& sampler, std::vector<Place>& out, uint64_t& rayCount);
  size_t look(const RayScene& rays, std::span<const Place> places, uint64_t seed, std::span<float> part) const;
  void add(uint64_t key, int32_t cell);

  const Lights& lights_;
  std::vector<Known> table_;  // a power of two, open addressing
  std::vector<float> part_;   // of each cell and light, of what it could give without shadows
  uint64_t rayCount_ = 0;
};

}  // namespace roomlight
