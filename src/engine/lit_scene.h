// A scene made ready by one technique, to be asked as often as one likes: for meters and for pictures of any camera,
// also while things in it move and lamps are dimmed. What each technique can do, and keeps when something changes, is
// in its row of the registry (engine/technique.h).
#pragma once

#include <limits>
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
struct LightStore;
struct Technique;

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

// A still picture and what is told of it.
struct Picture {
  Image image;  // linear, cd/m²; empty if cancelled before there was one
  Vec3 lightColour;  // see sights.h
  Sights sights;
  std::vector<RenderedLayer> layers;
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
  const Technique& technique() const { return technique_; }
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

  // A still picture with all that the settings ask for (layers, limits, refinement), after lookFrom(camera), of a scene
  // that was lit for stills (LitUse). `seconds` are left for it; infinite without a time limit. Numbers of the
  // technique and its stages go to `stages`. Cancelled, the best so far. Errors: layers that cannot be told apart.
  virtual Result<Picture> still(const Camera& camera, double seconds, Stages& stages) = 0;

  // Follows the scene; suns and sky must be as before unless the technique follows daylight. The same light as of a
  // scene lit anew, up to what bounces leave out (see RadianceSettings::residual, and bouncesAtOnce: what those leave
  // out follows with later calls, also where nothing has changed). Stages "rays", "lights" and those of the technique.
  // Cancelled, it is of no further use.
  void update(const SceneChange& change, Stages& stages);
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
  LitScene(const Technique& technique, const Scene& scene, bool sunApart, Stages& stages)
      : technique_(technique), base_(scene, sunApart, stages) {}
  // With what is seen in it.
  Picture finished(const Camera& camera, Image image, std::vector<RenderedLayer> layers) const;
  // After rays and lights have followed.
  virtual void relight(const SceneChange&, Stages&) {}

 private:
  const Technique& technique_;
  SceneRays base_;
};

// What a lit scene is for.
struct LitUse {
  bool changes = true;  // there will be updates; without them `hybrid` also lights places that its voxels know nothing
                        // of (radiance/hidden_light.h), and looks for lights where they are seen
  std::span<const Camera> cameras = {};  // to be looked from, the first one first; none: light is found for the whole
                                         // scene at once
  bool stills = false;  // LitScene::still will be called, for `cameras` alone where there are any; not with `changes`
  double seconds = std::numeric_limits<double>::infinity();  // for stills: about half of it for light
  const LightStore* store = nullptr;  // for stills that have no limit: where light of technique.sharesLight is shared
};

// Refers to the scene, which must be validated and stay where it is. Errors: an unknown technique, settings out of
// range, layers that the technique or the scene does not have. Null if cancelled.
Result<std::unique_ptr<LitScene>> lightScene(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                             const LitUse& use = {});

}  // namespace roomlight
