// Wavefront OBJ: v x y z, vt u v, vn x y z; f a/b/c ... with indices from 1, or from -1 backwards; o and g name objects
// and groups, usemtl the material of the faces below, mtllib the file with the materials.
#include "import/obj.h"

#include <fmt/format.h>

#include <istream>
#include <map>
#include <unordered_map>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "import/failure.h"
#include "import/guarded.h"
#include "import/import.h"
#include "import/obj_lines.h"
#include "import/obj_materials.h"
#include "import/polygon.h"
#include "import/triangles.h"
#include "import/warnings.h"

namespace roomlight {
namespace importers {
namespace {

// Which position, texture coordinate and normal; -1: none.
struct Corner {
  int v = -1, vt = -1, vn = -1;
  bool operator==(const Corner&) const = default;
};
struct CornerHash {
  size_t operator()(const Corner& c) const {
    return (static_cast<size_t>(c.v) * 0x9e3779b97f4a7c15u) ^ (static_cast<size_t>(c.vt) * 0xc2b2ae3d27d4eb4fu) ^ (static_cast<size_t>(c.vn) * 0x165667b19e3779f9u);
  }
};

// The faces of one object that share a material.
struct Part {
  Mesh mesh;
  int object = 0;
  std::unordered_map<Corner, uint32_t, CornerHash> vertices;
};

class Builder {
 public:
  Builder(const ObjLines& lines, size_t maxTriangles) : lines_(lines), maxTriangles_(maxTriangles) {}

  void position(Vec3 p) { positions_.push_back(p); }
  void uv(Vec2 t) { uvs_.push_back({t.x, 1 - t.y}); }
  void normal(Vec3 n) { normals_.push_back(n); }

  void face(const tinyobj::index_t* corners, int count) {
    if (count < 3) {
      ++shortFaces_;
      return;
    }
    triangles_ += static_cast<size_t>(count - 2);
    if (triangles_ > maxTriangles_) fail(lines_.place(), fmt::format("the file has more than {} triangles", maxTriangles_));
    corners_.clear(), points_.clear();
    for (int i = 0; i < count; ++i) {
      const tinyobj::index_t& in = corners[i];
      if (in.vertex_index == 0) fail(lines_.place(), "a corner of the face has no vertex");
      corners_.push_back({resolve(in.vertex_index, positions_.size(), "vertex"), resolve(in.texcoord_index, uvs_.size(), "texture coordinate"),
                          resolve(in.normal_index, normals_.size(), "normal")});
      points_.push_back(positions_[static_cast<size_t>(corners_.back().v)]);
    }
    Part& part = currentPart();
    for (const auto& triangle : triangulate(points_)) {
      for (const uint32_t corner : triangle) part.mesh.indices.push_back(vertexOf(part, corners_[corner]));
    }
  }

  void material(const std::string& name) { materialName_ = name, part_ = nullptr; }
  void object(const std::string& name) { startObject(name), hasObjects_ = true, fileObjectName_ = name; }
  // Groups are parts of objects, except in files that have no objects, and those that Sweet Home 3D knows by their names: they may move apart.
  void group(const std::string& name) {
    if (!hasObjects_ || name.starts_with("sweethome3d_")) {
      startObject(name);
    } else if (objectName_ != fileObjectName_) {
      startObject(fileObjectName_);
    }
  }

  std::vector<std::string> finish(Scene& scene, Warnings& warnings) {
    for (Part* part : order_) {
      dropDegenerate(part->mesh);
      if (part->mesh.indices.empty()) continue;
      scene.instances.push_back({part->mesh.name, static_cast<int>(scene.meshes.size()), part->object, {}});
      scene.meshes.push_back(std::move(part->mesh));
    }
    warnings.add("faces with fewer than three corners are ignored", shortFaces_);
    warnings.add("points and lines are ignored", lines_.linesAndPoints());
    warnings.add("curves and free-form surfaces are ignored", lines_.freeForm());
    return materialNames_;
  }

 private:
  int resolve(int index, size_t count, const char* what) const {
    if (index == 0) return -1;
    const int64_t i = index > 0 ? int64_t{index} - 1 : static_cast<int64_t>(count) + index;
    if (i < 0 || i >= static_cast<int64_t>(count)) fail(lines_.place(), fmt::format("{} {} does not exist, there are {} so far", what, index, count));
    return static_cast<int>(i);
  }

  void startObject(const std::string& name) {
    const auto [entry, isNew] = objects_.emplace(name, static_cast<int>(objects_.size()));
    object_ = entry->second, objectName_ = name, part_ = nullptr;
  }

  Part& currentPart() {
    if (part_) return *part_;
    if (objects_.empty()) startObject("");
    const auto [material, isNewMaterial] = materials_.emplace(materialName_, static_cast<int>(materialNames_.size()));
    if (isNewMaterial) materialNames_.push_back(materialName_);
    const auto [entry, isNew] = parts_.try_emplace({object_, material->second});
    part_ = &entry->second;
    if (isNew) {
      part_->object = object_;
      part_->mesh.name = objectName_;
      part_->mesh.material = material->second;
      order_.push_back(part_);
    }
    return *part_;
  }

  // A vertex a distinct corner. Normals and texture coordinates that only some corners have: flat shading, (0, 0).
  uint32_t vertexOf(Part& part, const Corner& corner) {
    Mesh& mesh = part.mesh;
    const auto [entry, isNew] = part.vertices.emplace(corner, static_cast<uint32_t>(mesh.positions.size()));
    if (!isNew) return entry->second;
    const size_t n = mesh.positions.size();
    mesh.positions.push_back(positions_[static_cast<size_t>(corner.v)]);
    if (corner.vt >= 0) mesh.uv[0].resize(n);
    if (corner.vt >= 0 || !mesh.uv[0].empty()) mesh.uv[0].push_back(corner.vt >= 0 ? uvs_[static_cast<size_t>(corner.vt)] : Vec2{});
    const Vec3 normal = corner.vn >= 0 ? normals_[static_cast<size_t>(corner.vn)] : Vec3();
    const float size = length(normal);
    if (size > 0 && std::isfinite(size) && mesh.normals.size() == n) {
      mesh.normals.push_back(normal / size);
    } else {
      mesh.normals.clear();
    }
    return entry->second;
  }

  const ObjLines& lines_;
  size_t maxTriangles_ = 0, triangles_ = 0, shortFaces_ = 0;
  std::vector<Vec3> positions_, normals_;
  std::vector<Vec2> uvs_;
  std::map<std::string, int> objects_, materials_;
  std::vector<std::string> materialNames_;
  std::map<std::pair<int, int>, Part> parts_;  // of object and material
  std::vector<Part*> order_;
  std::string materialName_, objectName_;
  std::string fileObjectName_;  // of the last `o`
  int object_ = 0;
  bool hasObjects_ = false;
  Part* part_ = nullptr;
  std::vector<Corner> corners_;
  std::vector<Vec3> points_;
};

tinyobj::callback_t callbacks() {
  tinyobj::callback_t c;
  c.vertex_cb = [](void* data, float x, float y, float z, float) { static_cast<Builder*>(data)->position({x, y, z}); };
  c.normal_cb = [](void* data, float x, float y, float z) { static_cast<Builder*>(data)->normal({x, y, z}); };
  c.texcoord_cb = [](void* data, float u, float v, float) { static_cast<Builder*>(data)->uv({u, v}); };
  c.index_cb = [](void* data, tinyobj::index_t* corners, int count) { static_cast<Builder*>(data)->face(corners, count); };
  c.usemtl_cb = [](void* data, const char* name, int) { static_cast<Builder*>(data)->material(name); };
  c.object_cb = [](void* data, const char* name) { static_cast<Builder*>(data)->object(name); };
  c.group_cb = [](void* data, const char** names, int count) {
    std::string name;
    for (int i = 0; i < count; ++i) name += (i > 0 ? " " : "") + std::string(names[i]);
    static_cast<Builder*>(data)->group(name);
  };
  return c;
}

}  // namespace

Scene readObj(std::span<const uint8_t> bytes, const ReadCompanion& companions, size_t maxTriangles, Warnings& warnings) {
  ObjLines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::istream in(&lines);
  Builder builder(lines, maxTriangles);
  std::string ignored;
  tinyobj::LoadObjWithCallback(in, callbacks(), &builder, nullptr, &ignored, &ignored);
  if (!lines.failure().empty()) throw Failure(lines.failure());
  Scene scene;
  const std::vector<std::string> names = builder.finish(scene, warnings);
  addObjMaterials(companions, lines.libraries(), names, scene, warnings);
  return scene;
}

}  // namespace importers

Result<Imported> importObj(const std::filesystem::path& file, const ImportOptions& options) {
  return importers::guarded(file, [&] {
    importers::Warnings warnings;
    Scene scene = importers::readObj(importers::readWholeFile(file, ""), importers::companionsIn(file.parent_path()), options.maxTriangles, warnings);
    return Imported{std::move(scene), warnings.lines()};
  });
}

}  // namespace roomlight
