// Any bytes as what a reader's process sends back: nothing in them is believed. A model that is taken is one that all
 // stages can read.
#include "import/failure.h"
#include "import/foreign_lights.h"
#include "import/foreign_model.h"
#include "import/up_axis.h"
#include "fuzz_support.h"
#include "scene/validate.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace roomlight;
  using namespace roomlight::importers;
  try {
    ForeignModel model = foreignModel(Bytes(data, data + size));
    const std::vector<ForeignLight> lights = model.lights;
    Warnings warnings;
    Scene scene = sceneOf(
        std::move(model), [](std::string_view, const std::string&) { return std::optional<Bytes>(); }, warnings);
    addForeignLights(lights, 1, scene, warnings);
    standUpright(scene, std::nullopt, 1, UpAxis::Z, warnings);
    (void)validate(scene);
  } catch (const Failure&) {}
  return 0;
}
