// Technique `cone`: cones walk the light in voxels, as in the published study.
#include "engine/settings.h"
#include "engine/technique.h"
#include "engine/voxel_scene.h"
#include "gather/cone_gather.h"

namespace roomlight {
namespace {

class ConeScene final : public VoxelScene<ConeShader, ConeGatherSettings> {
 public:
  ConeScene(const Scene& scene, const RenderSettings& settings, const LitUse& use, Stages& stages)
      : VoxelScene(kConeTechnique, scene, stageOf(settings, settings.cone), stages) {
    RadianceSettings radiance = settings.radiance;
    radiance.seed = settings.seed;
    // Pictures of the study's method know voxels alone; its meters also what lies beside them.
    radiance.still = !use.changes && !use.stills;
    LitUse whole = use;
    whole.seconds = std::numeric_limits<double>::infinity();  // a time limit is the gather's
    light(settings.voxel, radiance, whole, stages);
  }
  Result<Picture> still(const Camera& camera, double seconds, Stages& stages) override {
    const ConeGatherSettings use = within(seconds, gatherSettings());
    GatheredPicture result = stages.run(
        "gather", [&](const Progress& p) { return gatherPicture(rays(), lights(), *shader(), camera, use, p); });
    tellNumbers(voxels(), field(), result, stages);
    stages.number("cones", static_cast<double>(result.cones));
    return finished(camera, std::move(result.image), {});
  }
};

Result<std::unique_ptr<LitScene>> light(const Scene& scene, const RenderSettings& settings, const LitUse& use,
                                        Stages& stages) {
  return std::unique_ptr<LitScene>(std::make_unique<ConeScene>(scene, settings, use, stages));
}

}  // namespace

const Technique kConeTechnique{
    .name = technique::kCone,
    .about = "light cached in voxels, gathered by cones: fast",
    .role = TechniqueRole::Published,
    .followsDaylight = true,
    .keepsWhatStands = true,
    .hasSnapshots = true,
    .sharesLight = true,
    .meters = {.allowedPercent = 10, .ofSum = true, .isValidated = true, .places = 181, .worstPercent = 0.88},
    .light = light,
};

}  // namespace roomlight
