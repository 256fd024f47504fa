// Frames for walking about, in some tens of milliseconds: points that the frame before saw are projected into the new
// one (after the render cache: Walter et al. 1999), and only pixels to which none came send a ray. What was not seen
// before is lit by what slots know, interpolated, and by a shadow ray to each sun and small lamp. Where there is no
// time for all of them, some are lit and lend their light to those beside them, until a later frame comes to these too.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/image.h"
#include "base/progress.h"
#include "gather/changed_places.h"
#include "gather/light_nodes.h"
#include "gather/sharp_lights.h"
#include "radiance/slot_snapshot.h"
#include "scene/scene_change.h"
#include "trace/camera_rays.h"

namespace roomlight {

// What a frame is made of. The snapshot may be of an earlier state of the scene: `moved` says for instances that have
// moved since where their places were then.
struct QuickScene {
  const RayScene& rays;
  const Lights& lights;
  const SlotSnapshot& light;
  const std::unordered_map<uint32_t, Affine>& moved;
  bool white = false;  // what is seen is whitened (scene/surface.h); the same in all frames until forget()
};

class QuickFrames {
 public:
  struct Count {
    size_t kept = 0, traced = 0, lit = 0,
           lent = 0;  // pixels: as they were, looked at anew, and of these with new light or that of others
    double otherMs = 0, litMs = 0;  // of all threads: of rays and look-ups, of light
    bool leastLight = false;  // as few pixels were lit as may be
  };

  // Linear, cd/m², of a perspective camera; takes about `ms`, more where less cannot be done.
  Image make(const QuickScene& scene, const Camera& camera, int width, int height, double ms,
             const Progress& progress = {});
  const Count& count() const { return count_; }
  // Nothing more would come of another frame of the same camera.
  bool settled() const { return settled_; }

  // The scene is another than in the frame before: what moved, what its shadow may fall or have fallen on, or all that
  // lamps shine on is lit anew.
  void sceneChanged(const SceneChange& change, const Scene& scene);
  // So is the light of slots.
  void lightChanged() { stale_ = true, nodes_->forget(); }
  // A better picture of what the last frame showed: its colours are kept for as long as nothing changes.
  void adopt(const Image& better);
  void forget() { camera_.reset(); }

 private:
  enum State : uint8_t {
    kNone,  // no light yet
    kLent,  // from a pixel beside it, or out of date
    kLit,
    kFine
  };  // of a better picture
  struct Pixel {  // half a cache line
    Vec3 position;
    uint32_t key = kNoHit;  // the instance; of the sky, which lies in the direction `position`, a mark
    Vec3 colour;
    int8_t normalX = 0, normalY = 0, normalZ = 0;
    State state = kNone;
  };
  struct Asked;
  struct Sight;
  class Maker;
  struct Rules;
  void planShares(double ms);
  void forgetNodes();
  void surveyPast(const Maker& maker, const Camera& camera);
  void land(const Camera& camera);

  int width_ = 0, height_ = 0;
  uint32_t frame_ = 0;
  bool stale_ = false, settled_ = false;
  std::optional<Camera> camera_;
  // Of the frame before, if there is one: to its camera's space, and from there to its pixels.
  bool hasPast_ = false;
  int pastWidth_ = 0, pastHeight_ = 0;
  Affine fromWorld_;
  Vec2 pixelScale_;
  std::vector<Pixel> now_, past_;
  bool lands_ = false;
  std::vector<std::atomic<uint64_t>>
      landed_;  // per pixel: distance and number of the pixel before that is seen there now
  ChangedPlaces changed_;
  std::unique_ptr<LightNodes> nodes_ = std::make_unique<LightNodes>();
  // Of so many pixels one is lit: of those without light, and of those that have lent or old light (0: none). Powers of
  // two up to 16, and 64.
  uint32_t everyNew_ = 16, everyOld_ = 0;
  float nodesLux_ = 0;  // usualLux_ when nodes were begun
  float usualLux_ = 0;  // on what is seen, but for its brightest fifth
  std::array<double, 2> otherMs_{};  // per pixel: what all but light costs, all threads together, where pixels look for
                                     // themselves and where those of the frame before land
  double msALight_ = 1e-3;  // per pixel that is lit
  Count count_;
};

}  // namespace roomlight
