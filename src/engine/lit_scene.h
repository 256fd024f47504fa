// A scene made ready by one technique, to be asked as often as one likes: for meters and for pictures of any camera,
// also while things in it move and lamps are dimmed. What each keeps when something changes:
//   path    nothing: its rays follow the scene, and every picture is traced anew
//   hybrid  bricks of voxels, links, rays to lights and particles that what moved has nothing to do with
//           (radiance/light_cache.h)
//   cone    the same; its pyramid is built anew
//   vxgi    as hybrid in every level's voxels, and openness of surfaces; its clipmap is filled anew, and stays where it
//           is while the camera stays in one room
//   lpv     surfels and the sky's light on them; maps, injection and propagation are done anew, as in every frame of
//           that method; its grids stay as vxgi's do
//   photon  nothing: photons are sent anew for every picture, to where its camera looks
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "engine/stages.h"
#include "gather/meters.h"
#include "scene/scene_change.h"
#include "trace/lights.h"
#include "trace/meter.h"
#include "trace/ray_scene.h"

namespace roomlight {

class FrameHistory;
class SlotSnapshot;

// One of many pictures of a lit scene, such as frames, or those that are averaged.
struct PictureWish {
  int width = 960, height = 540;
  int samples = 0;  // per pixel; 0: those of the settings the scene was lit with
  std::optional<uint64_t> seed;  // none: that of the settings
  bool white =
      false;  // of what falls on what is seen: pi times the picture is illuminance in lux (scene/surface.h: whitened)
  bool orNothing =
      false;  // once cancelled no picture; else one of few samples. `path` makes its first pass all the same
  // Of frames before, of this scene alone, which is told of what changes; frames of one sample a pixel reuse their
  // light. `path` does not.
  FrameHistory* history = nullptr;
};

// Rays and lights of a scene that is edited where it stands.
class SceneRays {
 public:
  // Refers to the scene. `sunApart`: see Lights. Stages "bvh" and "lights".
  SceneRays(const Scene& scene, bool sunApart, Stages& stages);
  // Stages "rays" and "lights". No ray may be under way.
  void follow(const SceneChange& change, Stages& stages);
  const RayScene& rays() const { return rays_; }
  const Lights& lights() const { return *lights_; }

 private:
  const bool sunApart_;
  RayScene rays_;
  std::optional<Lights> lights_;
};

class LitScene {
 public:
  virtual ~LitScene() = default;
  // What falls on each element.
  virtual std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                                const Progress& progress = {}) const = 0;
  // The same by layers, for scenes that were lit with RenderSettings::layers by technique `hybrid` and have neither sun
  // nor sky; layers() says which is which, and is null for others and for more than kMostLayers.
  virtual LayeredReadings illuminanceInLayers(std::span<const SurfaceElement>, const MeterSettings&,
                                              const Progress& = {}) const {
    return {};
  }
  virtual const LightLayers* layers() const { return nullptr; }
  // Linear, cd/m², with the quality of the settings the scene was lit with.
  Image picture(const Camera& camera, int width, int height, const Progress& progress = {},
                FrameHistory* history = nullptr) const {
    return pictureOf(camera, {width, height, 0, {}, false, false, history}, progress);
  }
  virtual Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress = {}) const = 0;

  // Follows the scene; suns and sky must be as before unless followsDaylight(). The same light as of a scene lit anew,
  // up to what bounces leave out (see RadianceSettings::residual, and bouncesAtOnce: what those leave out follows with
  // later calls, also where nothing has changed). Stages "rays", "lights" and those of the technique. Cancelled, it is
  // of no further use.
  void update(const SceneChange& change, Stages& stages);
  virtual bool followsDaylight() const { return true; }
  // Whether update() has no more to do (see bouncesAtOnce).
  virtual bool settled() const { return true; }
  // What holds light about one place only (vxgi, lpv: finest there) has it where this camera is, if it has left that
  // place.
  virtual void lookFrom(const Camera&, Stages&) {}

  // The light of its slots as it is now, where it has slots, for frames in a few milliseconds (gather/quick_frames.h)
  // while it goes on.
  virtual std::shared_ptr<const SlotSnapshot> snapshot() const { return {}; }

  const RayScene& rays() const { return base_.rays(); }
  const Lights& lights() const { return base_.lights(); }

 protected:
  LitScene(const Scene& scene, bool sunApart, Stages& stages) : base_(scene, sunApart, stages) {}
  // After rays and lights have followed.
  virtual void relight(const SceneChange&, Stages&) {}

 private:
  SceneRays base_;
};

// What a lit scene is for.
struct LitUse {
  bool changes = true;  // there will be updates; without them `hybrid` also lights places that its voxels know nothing
                        // of (radiance/hidden_light.h), and looks for lights where they are seen
  const Camera* camera = nullptr;  // the first to be looked from; none: light is found for the whole scene at once
};

// Refers to the scene, which must be validated and stay where it is. Errors: an unknown technique, settings out of
// range. Null if cancelled.
Result<std::unique_ptr<LitScene>> lightScene(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                             const LitUse& use = {});

}  // namespace roomlight
