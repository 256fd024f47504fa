// A frame of a camera that moves on: pixels that see what the frame before saw keep its light, and of them a few in
// turn find more.
#pragma once

#include <optional>
#include <vector>

#include "filter/filter.h"
#include "gather/changed_places.h"
#include "gather/picture.h"
#include "trace/camera_rays.h"
#include "trace/traced_scene.h"

namespace roomlight {

// How frames of a camera that moves on reuse the light of frames before.
struct FrameSettings {
  bool reuse = true;        // of light of frames before
  int every = 4;  // of so many pixels with a history one is lit anew in a frame; the next lower power of two counts
  int everyStill = 4;  // the same once camera and scene stand still; with a new camera ray each
  int everyStale = 4;  // the same of those whose history is out of date
  float mostEstimates = 32;  // that a history counts for: it forgets what is older
  float smoothEstimates = 8;  // below, pixels keep light that was filtered once with their neighbours'; 0: none do
  float staleEstimates = 0.02f;  // that it counts for where light has changed
  int everyVeil = 4;  // of pixels of veils and mirrors, whose parts are not told apart; and
  float mostOfVeil = 4;  // estimates that their histories count for while the camera moves
  float mostWhileMoving = 8;  // where something moves, but elsewhere
  double quickMs = 0;  // 0: none of this; else frames of a walk are those of quick_frames.h, in about so many
                       // milliseconds, of techniques with light in slots
  float nearM = 0.5f;  // of what moved: light has changed there
};

// What the pixels of a frame have learned about light, for the next frame of a camera that moves on: where the geometry
// allows it counts as estimates that a pixel already has (reprojection: Nehab et al. 2007, Scherzer et al. 2007; with
// variances: Schied et al. 2017). Light that a pixel found, without the colour of what reflects it.
struct PastLight {
  Vec3 position, normal;  // of the surface, where its light was found
  uint32_t instance = kNoHit;  // kNoHit: none
  bool whole = false;  // of several surfaces, of which this is the first: their light is in the pixel's FilterPixel
  uint32_t pixel = 0;  // that found it
  float estimates = 0, glossy = 0;  // how many are in its means; 0: none
  Vec3 irradiance, sharp;  // diffuse and sharp light over albedo, cd/m²
  Vec3 specular;
  Vec3 variance;  // of the means' luminance: irradiance, sharp, specular
};

// A surface that a camera ray comes to, perhaps through panes or reflected by one.
struct SeenSurface {
  Vec3 position, normal, wo;  // wo: unit, towards where the ray came from last
  uint32_t instance;
  bool whole;
  float roughness;  // of what reflects towards the eye, itself or a pane before it; below 0: what it reflects stays
                    // where it is, an image in a pane
  Vec3 place;  // where it seems to be: `position`, or its image in a pane
};

// Mean of two of one surface, each by as many estimates as it has.
PastLight together(const PastLight& before, const PastLight& now);

class FrameHistory {
 public:
  explicit FrameHistory(const FrameSettings& settings = {}) : settings_(settings) {}
  const FrameSettings& settings() const { return settings_; }
  // The scene is other than in the frame before.
  void sceneChanged(const SceneChange& change, const Scene& scene);
  void forget();

  // From here on the frame before is what was made last, and pixels are to be made. `filled` says what they are once
  // they are.
  void begin(const Camera& camera, int width, int height, const Lights& lights);
  uint32_t frame() const { return frame_; }
  uint32_t framesStill() const { return framesStill_; }
  bool still() const { return still_; }  // the camera is where it was
  // Nothing else has changed either: all pixels are what they were, may stay so, and are means over camera rays.
  bool settled() const { return settled_; }
  // What was known of a surface, at the place where pixel (x, y) sees it now; estimates 0: nothing.
  PastLight find(int x, int y, const SeenSurface& seen) const;
  PastLight& light(size_t pixel) { return now_[pixel]; }
  const PastLight& light(size_t pixel) const { return now_[pixel]; }
  FilterPixel& pixel(size_t i) { return pixels_->pixels[i]; }
  const FilterPixel& pixelBefore(size_t i) const { return settled_ ? pixels_->pixels[i] : pixelsBefore_->pixels[i]; }
  const FilterInput& pixels() const { return *pixels_; }
  // `smooth`: irradiance after a first pass of the filter, which pixels of few estimates keep for theirs; may be empty.
  // `stale`: whether pixels are left whose light is out of date.
  void end(const std::vector<Vec3>& smooth, bool stale);

 private:
  float medianDistanceM() const;

  const FrameSettings settings_;
  uint32_t frame_ = 0, framesStill_ = 0;
  int width_ = 0, height_ = 0;
  bool still_ = false, settled_ = false, stale_ = false;
  std::optional<Camera> camera_;
  std::optional<CameraRays> before_;  // of the frame before
  Vec3 eye_, beforeEye_;
  float pixelSlope_ = 0, pixelM_ = 0;  // of a pixel: how far its edges part, per metre of distance, and besides
  std::vector<PastLight> past_, now_;
  std::optional<FilterInput> pixels_, pixelsBefore_;
  ChangedPlaces changed_;
};

// Linear, cd/m². One camera ray a pixel, whatever the settings say of samples; the history is of frames of this scene
// and shader's technique.
Image gatherFrame(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
                  const PictureSettings& settings, FrameHistory& history, const Progress& progress);

// A frame, where there is a history and one sample a pixel is asked for; else a picture.
Image gatherView(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
                 const PictureSettings& settings, FrameHistory* history, const Progress& progress);

}  // namespace roomlight
