// What polished surfaces throw on what the camera sees, by paths that start at the lights: their last vertex is seen in
// one pixel, to which its light is added (light tracing; Dutré, Lafortune & Willems 1993, Veach 1997, 10.2). Paths from
// the camera find such light by chance only, and that of a point-like lamp in a perfect mirror never.
#pragma once

#include <memory>
#include <vector>

#include "trace/camera_rays.h"
#include "trace/caustic_photons.h"

namespace roomlight {

class CausticSplats {
 public:
  struct View {
    const CameraRays& camera;
    int width, height;  // pixels
    bool white;  // as in PathSettings
    const LightLayers* layers;  // null: light is not told apart
  };
  // Light that the diffuse lobe of a surface reflects which the camera sees straight, or through panes.
  struct Splat {
    uint32_t pixel;
    int32_t layer;  // -1: none
    Vec3 light;  // cd/m², of the pixel's mean
  };

  // Knows nothing: paths from the camera bring all light.
  CausticSplats() = default;
  // Refers to all of these. Costs some 100,000 rays where surfaces throw light.
  CausticSplats(const TracedScene& scene, const View& view, uint64_t seed);

  // Whether its light is to be left out of paths (PathWalk).
  bool any() const { return photons_ && photons_->any(); }
  // Right in the mean in every round; rounds are independent. The same for any number of threads.
  std::vector<Splat> trace(uint32_t round);
  uint64_t rayCount() const { return rayCount_ + (photons_ ? photons_->rayCount() : 0); }

 private:
  std::vector<Vec3> seenPlaces(uint64_t seed);
  struct Connection;
  bool connect(const CausticPhoton& photon, Connection& out) const;

  std::unique_ptr<TracedScene> scene_;
  std::unique_ptr<View> view_;
  std::unique_ptr<CausticPhotons> photons_;
  uint64_t rayCount_ = 0;
};

}  // namespace roomlight
