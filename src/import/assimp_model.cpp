#include "import/assimp_model.h"

#include <fmt/format.h>

#include "import/child_process.h"
#include "import/failure.h"

namespace roomlight::importers {
namespace {

constexpr size_t kMaxBytes = size_t{256} << 20;

// A mesh in many places is stored once, and takes memory for each where they are merged. What the reader says of it is
// not believed either.
void checkSize(const ForeignModel& model, size_t maxTriangles) {
  size_t triangles = 0, vertices = 0;
  for (const ForeignInstance& i : model.instances) {
    triangles += model.meshes[i.mesh].triangleCount(), vertices += model.meshes[i.mesh].positions.size();
    if (triangles > maxTriangles) fail("", fmt::format("has more than {} triangles", maxTriangles));
    if (vertices / 3 > maxTriangles) fail("", fmt::format("has more than {} vertices", 3 * maxTriangles));
  }
}

}  // namespace

UpAxis usualUp(AssimpFormat format) {
  return format == AssimpFormat::Collada || format == AssimpFormat::Fbx ? UpAxis::Y : UpAxis::Z;
}

ForeignModel readForeign(std::span<const uint8_t> bytes, AssimpFormat format, bool ignoreUp, size_t maxTriangles) {
  if (bytes.size() > kMaxBytes) fail("", fmt::format("is larger than {} MiB", kMaxBytes >> 20));
  const std::vector<std::string> arguments{extensionOf(format), ignoreUp ? "own" : "stated",
                                           std::to_string(maxTriangles)};
  ForeignModel model = foreignModel(inChildProcess(modelReader(), arguments, bytes));
  checkSize(model, maxTriangles);
  return model;
}

Scene readByAssimp(std::span<const uint8_t> bytes, AssimpFormat format, const ReadCompanion& companions,
                   size_t maxTriangles, Warnings& warnings) {
  ForeignModel model = readForeign(bytes, format, false, maxTriangles);
  const UpAxis up = model.up ? static_cast<UpAxis>(model.up) : usualUp(format);
  Scene scene = sceneOf(std::move(model), companions, warnings);
  turnUpright(scene, up);
  bakeInstances(scene);
  return scene;
}

}  // namespace roomlight::importers
