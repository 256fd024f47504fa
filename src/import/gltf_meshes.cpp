#include "import/gltf_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "import/gltf_data.h"
#include "import/grey_material.h"
#include "import/triangles.h"

namespace roomlight::importers {
namespace {

// Strips and fans as a list; every second triangle of a strip is turned so that all face the same side.
std::vector<uint32_t> asList(std::vector<uint32_t> in, uint64_t mode) {
  if (mode == 4) {
    in.resize(in.size() / 3 * 3);
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

// Leaves out the triangles that have a corner for which `isBroken` holds; returns how many.
template <class IsBroken>
size_t dropTriangles(std::vector<uint32_t>& indices, IsBroken&& isBroken) {
  size_t kept = 0;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    if (isBroken(indices[i]) || isBroken(indices[i + 1]) || isBroken(indices[i + 2])) continue;
    for (size_t k = 0; k < 3; ++k) indices[kept++] = indices[i + k];
  }
  const size_t dropped = (indices.size() - kept) / 3;
  indices.resize(kept);
  return dropped;
}

// One primitive on its way from accessors or Draco data to a mesh.
class Primitive {
 public:
  // Without attributes the primitive itself, which has no POSITION, stands in for them.
  Primitive(GltfDocument& document, const Json& json)
      : document_(document), json_(json), attributes_(json.find("attributes").value_or(json)) {}

  // None where it has no triangles.
  std::optional<Mesh> read() {
    const uint64_t mode = json_.integer("mode", 4, 1 << 20);
    if (mode < 4 || mode > 6) {
      document_.warnings.add(mode < 4 ? "points and lines are ignored" : "primitives of an unknown kind are ignored");
      return std::nullopt;
    }
    if (!attributes_.find("POSITION")) {
      document_.warnings.add("primitives without positions are left out");
      return std::nullopt;
    }
    if (json_.list("targets").size() > 0)
      document_.warnings.add("morph targets are ignored, meshes keep their base shape");
    if (const auto extension = json_.extension("KHR_draco_mesh_compression")) {
      draco_ = decodeDraco(document_, *extension);
      vertexCount_ = draco_->vertexCount;
      mesh_.indices = std::move(draco_->indices);
    } else {
      readTriangles(mode);
    }
    if (mesh_.indices.empty()) return std::nullopt;
    readVertices();
    mendDirections();
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
    if (mode == 4 && indices.size() % 3 != 0)
      document_.warnings.add("indices that make no whole triangle are left out");
    mesh_.indices = asList(std::move(indices), mode);
    const size_t dropped = dropTriangles(mesh_.indices, [&](uint32_t index) { return index >= vertexCount_; });
    document_.warnings.add("triangles with a vertex that does not exist are left out", dropped);
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

  // The numbers of an attribute, `width` a vertex or as many as it has where `width` is 0; empty: there is none that
// fits the vertices.
  std::vector<float> values(const char* name, int width, int* found = nullptr) {
    const auto use = attributes_.find(name);
    if (!use) return {};
    Accessor accessor = openAccessor(document_, *use);
    if (draco_) {
      if (const auto it = draco_->attributes.find(name); it != draco_->attributes.end())
        return dracoValues(it->second, accessor, width, found);
    }
    const bool isPosition = std::string_view(name) == "POSITION";
    if (!isPosition && (accessor.count < vertexCount_ || accessor.components < width)) {
      document_.warnings.add("attributes that do not fit their vertices are left out");
      return {};
    }
    if (accessor.count < vertexCount_)
      use->fail(fmt::format("has {} elements for {} vertices", accessor.count, vertexCount_));
    accessor.count = vertexCount_;
    if (found) *found = accessor.components;
    return readFloats(accessor, width > 0 ? width : accessor.components, selection_);
  }

  std::vector<float> dracoValues(const DracoAttribute& in, const Accessor& accessor, int width, int* found) {
    if (width == 0) width = std::min(in.components, 4);
    if (found) *found = width;
    if (in.components < width)
      accessor.json.fail(fmt::format("its Draco data have {} components, {} are needed", in.components, width));
    const float scale = accessor.normalized && !in.scaled ? 1 / normalizer(accessor.componentType) : 1;
    std::vector<float> out;
    out.reserve(vertexCount_ * static_cast<size_t>(width));
    for (size_t i = 0; i < vertexCount_; ++i) {
      for (int c = 0; c < width; ++c)
        out.push_back(in.values[i * static_cast<size_t>(in.components) + static_cast<size_t>(c)] * scale);
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
    const size_t count = mesh_.positions.size();
    const size_t broken =
        dropTriangles(mesh_.indices, [&](uint32_t i) { return i >= count || !isFinite(mesh_.positions[i]); });
    document_.warnings.add("triangles with a vertex that is no finite number are left out", broken);
    for (Vec3& p : mesh_.positions) {
      if (!isFinite(p)) p = Vec3(0);  // nothing uses it
    }
    mesh_.normals = vectors(values("NORMAL", 3), 3);
    const std::vector<float> tangents = values("TANGENT", 4);
    mesh_.tangents = vectors(tangents, 4);
    for (size_t i = 3; i < tangents.size(); i += 4) mesh_.tangentSigns.push_back(tangents[i] < 0 ? -1.0f : 1.0f);
    const char* sets[] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (size_t set = 0; set < 2; ++set) {
      const std::vector<float> uv = values(sets[set], 2);
      for (size_t i = 0; i + 1 < uv.size(); i += 2) mesh_.uv[set].push_back({uv[i], uv[i + 1]});
    }
    document_.warnings.add(kLostCoordinates, mendCoordinates(mesh_));
    readColours();
  }

  void readColours() {
    int width = 0;
    const std::vector<float> colours = values("COLOR_0", 0, &width);
    if (colours.empty()) return;
    if (width != 3 && width != 4)
      return document_.warnings.add("attributes that do not fit their vertices are left out");
    const auto limited = [](float v) { return std::isfinite(v) ? std::clamp(v, 0.0f, 1.0f) : 1.0f; };
    mesh_.colors = vectors(colours, static_cast<size_t>(width));
    for (Vec3& c : mesh_.colors) c = {limited(c.x), limited(c.y), limited(c.z)};
    for (size_t i = 3; width == 4 && i < colours.size(); i += 4) mesh_.colorAlphas.push_back(limited(colours[i]));
  }

  // False where it has no direction.
  static bool makeUnit(Vec3& d) {
    const float largest = maxComponent(abs(d));
    if (!(largest > 1e-20f) || !std::isfinite(largest) || !isFinite(d)) return false;
    d = normalize(d / largest);
    return true;
  }

  void mendDirections() {
    std::vector<uint32_t> lost;
    for (size_t i = 0; i < mesh_.normals.size(); ++i) {
      if (!makeUnit(mesh_.normals[i])) lost.push_back(static_cast<uint32_t>(i));
    }
    if (!lost.empty()) mendNormals(lost);
    if (!std::all_of(mesh_.tangents.begin(), mesh_.tangents.end(), makeUnit)) {
      mesh_.tangents.clear();  // derived from the texture coordinates where they are needed
      mesh_.tangentSigns.clear();
    }
  }

  // The mean of the triangles about each vertex, by their area.
  void mendNormals(const std::vector<uint32_t>& lost) {
    document_.warnings.mended("normals without a direction are made anew", lost.size());
    std::vector<bool> isLost(mesh_.normals.size());
    for (const uint32_t i : lost) isLost[i] = true, mesh_.normals[i] = Vec3(0);
    for (size_t t = 0; t + 2 < mesh_.indices.size(); t += 3) {
      const uint32_t* corner = &mesh_.indices[t];
      const Vec3 p = mesh_.positions[corner[0]];
      const Vec3 area = cross(mesh_.positions[corner[1]] - p, mesh_.positions[corner[2]] - p);
      for (size_t k = 0; k < 3; ++k) {
        if (isLost[corner[k]] && isFinite(area)) mesh_.normals[corner[k]] += area;
      }
    }
    for (const uint32_t i : lost) {
      if (!makeUnit(mesh_.normals[i])) mesh_.normals[i] = {0, 1, 0};
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
    const Json primitives = meshes[i].list("primitives");
    for (size_t k = 0; k < primitives.size(); ++k) {
      auto mesh = Primitive(document, primitives[k]).read();
      if (!mesh) continue;
      triangles += mesh->triangleCount();
      if (triangles > maxTriangles)
        primitives[k].fail(fmt::format("all meshes together have more than {} triangles", maxTriangles));
      dropDegenerate(*mesh);
      if (mesh->indices.empty()) continue;
      mesh->name = meshes[i].name();
      mesh->material = document.looseIndex(primitives[k], "material", materialCount);
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
