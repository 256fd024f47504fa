// One entry for every technique: scene, camera, settings in; picture and what it cost out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/progress.h"
#include "base/result.h"
#include "engine/light_store.h"
#include "engine/settings.h"
#include "engine/sights.h"
#include "scene/scene.h"
#include "trace/light_layers.h"

namespace roomlight {

struct StageStats {
  std::string name;       // "bvh", "voxelise", "illuminate", "gather", "path", ...
  double timeMs = 0;
  double cpuMs = 0;  // of all threads together: cpuMs / timeMs cores were busy
  double peakMemoryMiB = 0;  // of the process, at the end of the stage
};

struct RenderStats {
  std::vector<StageStats> stages;
  std::vector<std::pair<std::string, double>>
      numbers;  // "triangles", "voxels", "voxelSizeM", "rays", "samples", "noise", ...
};

struct RenderedLayer {
  LightLayer light;
  Image image;          // linear, cd/m²
  Vec3 lightColour{};  // what the layer has in that of the whole
};

struct Rendered {
  Image image;        // linear, cd/m²
  Vec3 lightColour;   // of the light on what the picture shows, luminance 1; black where nothing tells
  Sights sights;
  std::vector<RenderedLayer>
      layers;  // with settings.layers: their sum is `image`; lamps first, then emissive meshes, sun and sky
  RenderStats stats;
  bool complete = true;  // false: stopped early, the image is the best so far; empty if there was none yet
};

// What long work tells its caller: the stage's name and the fraction of it done; and, where a technique can tell, the
// error that the picture still has: root mean square relative to a pixel's luminance, and mse of the encoded picture.
struct RenderProgress {
  std::function<void(const std::string& stage, float fraction)> report;
  const std::atomic<bool>* cancelled = nullptr;
  std::function<void(double relativeError, double srgbMse)> estimate;
};

// Pictures of one scene, one after the other: its technique lights the scene (engine/lit_scene.h) with the first, and
// keeps that.
class Renderer {
 public:
  // `cameras`: all that pictures are taken of; none: the first alone. What of the light they do not show is found with
  // fewer rays. `store`: where light is shared with other processes that light the scene for these cameras; it is not
  // used with a time limit. Errors: an unknown technique, settings out of range. `scene` must be validated; it is
  // referred to.
  static Result<Renderer> of(const Scene& scene, const RenderSettings& settings, std::vector<Camera> cameras = {},
                             std::optional<LightStore> store = {});
  Renderer(Renderer&&) noexcept;
  ~Renderer();
  Result<Rendered> picture(const Camera& camera, const RenderProgress& progress = {});

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// One picture. Errors: as Renderer::of.
Result<Rendered> render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                        const RenderProgress& progress = {});

}  // namespace roomlight
