#include "import/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "import/gltf_accessors.h"
#include "import/gltf_draco.h"
#include "import/grey_material.h"
#include "import/triangles.h"

namespace roomlight::importers {
namespace {

// Strips and fans as a list; every second triangle of a strip is turned so that all face the same side.
std::vector<uint32_t> asList(std::vector<uint32_t> in, uint64_t mode, const Json& primitive) {
  if (mode == 4) {
    if (in.size() % 3 != 0) primitive.fail(fmt::format("{} indices make no whole triangles", in.size()));
    return in;
  }
  std::vector<uint32_t> out;
  for (size_t i = 0; i + 2 < in.size(); ++i) {
    const size_t turned = i & 1;
    if (mode == 5) out.insert(out.end(), {in[i], in[i + 1 + turned], in[i + 2 - turned]});
    if (mode == 6) out.insert(out.end(), {in[0], in[i + 1], in[i + 2]});
  }
  return out;
}

// One primitive on its way from accessors or Draco data to a mesh.
class Primitive {
 public:
  Primitive(GltfDocument& document, const Json& json) : document_(document), json_(json), attributes_(json.at("attributes")) {}

  // None where it has no triangles.
  std::optional<Mesh> read() {
    const uint64_t mode = json_.integer("mode", 4, 6);
    if (mode < 4) {
      document_.warnings.add("points and lines are ignored");
      return std::nullopt;
    }
    if (json_.list("targets").size() > 0) document_.warnings.add("morph targets are ignored, meshes keep their base shape");
    if (const auto extension = json_.extension("KHR_draco_mesh_compression")) {
      draco_ = decodeDraco(document_, *extension);
      vertexCount_ = draco_->vertexCount;
      mesh_.indices = std::move(draco_->indices);
    } else {
      readTriangles(mode);
    }
    if (mesh_.indices.empty()) return std::nullopt;
    readVertices();
    checkDirections();
    return std::move(mesh_);
  }

 private:
  void readTriangles(uint64_t mode) {
    const Accessor positions = openAccessor(document_, attributes_.at("POSITION"));
    vertexCount_ = positions.count;
    std::vector<uint32_t> indices;
    if (const auto use = json_.find("indices")) {
      const Accessor accessor = openAccessor(document_, *use);
      document_.budget.spend(accessor.count, use->path());
      indices = readIndices(accessor);
    } else {
      document_.budget.spend(vertexCount_, json_.path());
      indices.resize(vertexCount_);
      for (size_t i = 0; i < vertexCount_; ++i) indices[i] = static_cast<uint32_t>(i);
    }
    if (mode != 4) document_.budget.spend(3 * indices.size(), json_.path());
    for (size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] >= vertexCount_) json_.fail(fmt::format("index {} is {}, but there are only {} vertices", i, indices[i], vertexCount_));
    }
    mesh_.indices = asList(std::move(indices), mode, json_);
    if (mesh_.indices.empty()) return;
    keepUsedVertices();
    document_.budget.spend(selection_.empty() ? vertexCount_ : selection_.size(), json_.path());
  }

  // Many primitives may share one long list of vertices, each using a few of them.
  void keepUsedVertices() {
    if (vertexCount_ <= mesh_.indices.size()) return;
    selection_ = mesh_.indices;
    std::sort(selection_.begin(), selection_.end());
    selection_.erase(std::unique(selection_.begin(), selection_.end()), selection_.end());
    for (uint32_t& index : mesh_.indices) {
      index = static_cast<uint32_t>(std::lower_bound(selection_.begin(), selection_.end(), index) - selection_.begin());
    }
  }

  // The numbers of an attribute, `width` a vertex or as many as it has where `width` is 0; empty: there is none.
  std::vector<float> values(const char* name, int width, int* found = nullptr) {
    const auto use = attributes_.find(name);
    if (!use) return {};
    const Accessor accessor = openAccessor(document_, *use);
    if (draco_) {
      if (const auto it = draco_->attributes.find(name); it != draco_->attributes.end()) return dracoValues(it->second, accessor, width, found);
    }
    if (accessor.count != vertexCount_) use->fail(fmt::format("has {} elements for {} vertices", accessor.count, vertexCount_));
    if (found) *found = accessor.components;
    return readFloats(accessor, width > 0 ? width : accessor.components, selection_);
  }

  std::vector<float> dracoValues(const DracoAttribute& in, const Accessor& accessor, int width, int* found) {
    if (width == 0) width = std::min(in.components, 4);
    if (found) *found = width;
    if (in.components < width) accessor.json.fail(fmt::format("its Draco data have {} components, {} are needed", in.components, width));
    const float scale = accessor.normalized && !in.scaled ? 1 / normalizer(accessor.componentType) : 1;
    std::vector<float> out;
    out.reserve(vertexCount_ * static_cast<size_t>(width));
    for (size_t i = 0; i < vertexCount_; ++i) {
      for (int c = 0; c < width; ++c) out.push_back(in.values[i * static_cast<size_t>(in.components) + static_cast<size_t>(c)] * scale);
    }
    return out;
  }

  static std::vector<Vec3> vectors(const std::vector<float>& in, size_t width) {
    std::vector<Vec3> out;
    out.reserve(in.size() / width);
    for (size_t i = 0; i + 2 < in.size(); i += width) out.push_back({in[i], in[i + 1], in[i + 2]});
    return out;
  }

  void readVertices() {
    mesh_.positions = vectors(values("POSITION", 3), 3);
    if (mesh_.positions.empty() && vertexCount_ > 0) attributes_.fail("'POSITION' is missing");
    mesh_.normals = vectors(values("NORMAL", 3), 3);
    const std::vector<float> tangents = values("TANGENT", 4);
    mesh_.tangents = vectors(tangents, 4);
    for (size_t i = 3; i < tangents.size(); i += 4) mesh_.tangentSigns.push_back(tangents[i] < 0 ? -1.0f : 1.0f);
    const char* sets[] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (size_t set = 0; set < 2; ++set) {
      const std::vector<float> uv = values(sets[set], 2);
      for (size_t i = 0; i + 1 < uv.size(); i += 2) mesh_.uv[set].push_back({uv[i], uv[i + 1]});
    }
    int width = 0;
    const std::vector<float> colours = values("COLOR_0", 0, &width);
    if (colours.empty()) return;
    if (width != 3 && width != 4) attributes_.at("COLOR_0").fail(fmt::format("has {} components, 3 or 4 are needed", width));
    mesh_.colors = vectors(colours, static_cast<size_t>(width));
    for (Vec3& c : mesh_.colors) c = max(min(c, Vec3(1)), Vec3(0));
    for (size_t i = 3; width == 4 && i < colours.size(); i += 4) mesh_.colorAlphas.push_back(std::clamp(colours[i], 0.0f, 1.0f));
  }

  // Unit vectors; false where one has no direction.
  static bool makeUnit(std::vector<Vec3>& directions) {
    for (Vec3& d : directions) {
      const float largest = maxComponent(abs(d));
      if (!(largest > 1e-20f)) return false;
      d = normalize(d / largest);
    }
    return true;
  }

  void checkDirections() {
    if (!makeUnit(mesh_.normals)) {
      document_.warnings.add("normals without a direction: their meshes are shaded flat");
      mesh_.normals.clear();
    }
    if (!makeUnit(mesh_.tangents)) {
      mesh_.tangents.clear();  // derived from the texture coordinates where they are needed
      mesh_.tangentSigns.clear();
    }
  }

  GltfDocument& document_;
  Json json_, attributes_;
  Mesh mesh_;
  size_t vertexCount_ = 0;
  std::vector<uint32_t> selection_;  // of the accessors' elements; empty: all
  std::optional<DracoPrimitive> draco_;
};

}  // namespace

std::vector<std::vector<int>> addGltfMeshes(GltfDocument& document, size_t maxTriangles, Scene& scene) {
  const Json meshes = document.root().list("meshes");
  const size_t materialCount = scene.materials.size();
  std::vector<std::vector<int>> primitivesOfMesh(meshes.size());
  size_t grey = 0, triangles = 0;
  for (size_t i = 0; i < meshes.size(); ++i) {
    const Json primitives = meshes[i].at("primitives");
    for (size_t k = 0; k < primitives.size(); ++k) {
      auto mesh = Primitive(document, primitives[k]).read();
      if (!mesh) continue;
      triangles += mesh->triangleCount();
      if (triangles > maxTriangles) primitives[k].fail(fmt::format("all meshes together have more than {} triangles", maxTriangles));
      dropDegenerate(*mesh);
      if (mesh->indices.empty()) continue;
      mesh->name = meshes[i].name();
      mesh->material = primitives[k].index("material", materialCount);
      if (mesh->material < 0) {
        if (grey++ == 0) scene.materials.push_back(greyMaterial());
        mesh->material = static_cast<int>(materialCount);
      }
      primitivesOfMesh[i].push_back(static_cast<int>(scene.meshes.size()));
      scene.meshes.push_back(std::move(*mesh));
    }
  }
  document.warnings.add("primitives without a material are grey", grey);
  return primitivesOfMesh;
}

}  // namespace roomlight::importers
