// Wavefront OBJ: v x y z, vt u v, vn x y z; f a/b/c ... with indices from 1, or from -1 backwards; o and g name objects
// and groups, usemtl the material of the faces below, mtllib the file with the materials.
#include "import/obj.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "base/utf8.h"
#include "import/failure.h"
#include "import/file_access.h"
#include "import/grey_material.h"
#include "import/guarded.h"
#include "import/import.h"
#include "import/obj_lines.h"
#include "import/triangles.h"
#include "import/up_axis.h"
#include "import/warnings.h"

namespace roomlight {
namespace importers {
namespace {

constexpr size_t kMostParts = 1'000'000, kLongestName = 256, kEarTestsAByte = 4;

// Which position, texture coordinate and normal; -1: none.
struct Corner {
  int v = -1, vt = -1, vn = -1;
  bool operator==(const Corner&) const = default;
};
struct CornerHash {
  size_t operator()(const Corner& c) const {
    return (static_cast<size_t>(c.v) * 0x9e3779b97f4a7c15u) ^ (static_cast<size_t>(c.vt) * 0xc2b2ae3d27d4eb4fu) ^
           (static_cast<size_t>(c.vn) * 0x165667b19e3779f9u);
  }
};

// The faces of one object that share a material.
struct Part {
  Mesh mesh;
  int object = 0;
  std::unordered_map<Corner, uint32_t, CornerHash> vertices;
};

// What of a file was damaged: faces that had to be left out, by why.
class LostFaces {
 public:
  void add(const char* kind, std::string first) {
    if (total_++ == 0) first_ = std::move(first);
    kinds_.add(std::string("faces ") + kind + " are left out", 1);
  }
  // A file that loses most of its faces is damaged as a whole.
  void finish(size_t kept, Warnings& warnings) const {
    if (total_ > kept) throw Failure(first_);
    warnings.add(kinds_);
  }

 private:
  Warnings kinds_;
  std::string first_;
  size_t total_ = 0;
};

class Builder {
 public:
  Builder(const ObjLines& lines, size_t fileBytes, size_t maxTriangles) : lines_(lines), maxTriangles_(maxTriangles) {
    ears_.testsLeft += kEarTestsAByte * fileBytes;
  }

  void position(std::string_view text) {
    std::array<float, 7> v{};
    const size_t count = numbers(text, v);
    const bool whole = count >= 3 && std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
    positions_.push_back(whole ? Vec3{v[0], v[1], v[2]} : Vec3(std::numeric_limits<float>::quiet_NaN()));
    if (count >= 6 && !coloured_) coloured_ = true, colours_.resize(positions_.size() - 1, Vec3(1));
    if (coloured_) colours_.push_back(count >= 6 ? Vec3{v[3], v[4], v[5]} : Vec3(1));
  }
  void uv(std::string_view text) {
    std::array<float, 3> v{};
    numbers(text, v);
    const bool whole = saysSomething({v[0], v[1]});
    uvs_.push_back(whole ? Vec2{v[0], 1 - v[1]} : Vec2{});
    lostCoordinates_ += whole ? 0 : 1;
  }
  void normal(std::string_view text) {
    std::array<float, 3> v{};
    numbers(text, v);
    normals_.push_back({v[0], v[1], v[2]});
  }

  void face(std::string_view text) {
    corners_.clear(), points_.clear();
    for (std::string_view word = nextWord(text); !word.empty() && word[0] != '#'; word = nextWord(text)) {
      const std::optional<ObjCorner> in = objCorner(word);
      if (!in)
        return lost_.add("with corners that are no numbers",
                         fmt::format("{}: '{}' is not a corner of a face", lines_.place(), printable(word, 30)));
      const int v = resolve(in->v, positions_.size());
      if (v < 0) {
        return lost_.add(
            "of vertices that do not exist",
            fmt::format("{}: vertex {} does not exist, there are {} so far", lines_.place(), in->v, positions_.size()));
      }
      corners_.push_back({v, optional(in->vt, uvs_.size()), optional(in->vn, normals_.size())});
      points_.push_back(positions_[static_cast<size_t>(v)]);
      if (!isFinite(points_.back())) {
        return lost_.add("of vertices that are no finite place",
                         fmt::format("{}: vertex {} is no finite place", lines_.place(), in->v));
      }
    }
    if (corners_.size() < 3) {
      ++shortFaces_;
      return;
    }
    triangles_ += corners_.size() - 2;
    ++faces_;
    if (triangles_ > maxTriangles_)
      fail(lines_.place(), fmt::format("the file has more than {} triangles", maxTriangles_));
    Part& part = currentPart();
    for (const auto& triangle : triangulate(points_, ears_)) {
      for (const uint32_t corner : triangle) part.mesh.indices.push_back(vertexOf(part, corners_[corner]));
    }
  }

  void lineOrPoint() { ++linesAndPoints_; }
  void freeForm() { ++freeForm_; }
  void library(std::string_view name) { libraries_.emplace_back(asUtf8(name)); }
  const std::vector<std::string>& libraries() const { return libraries_; }

  void material(const std::string& name) { materialName_ = name, part_ = nullptr; }
  void object(const std::string& name) { startObject(name), hasObjects_ = true, fileObjectName_ = name; }
  // Groups are parts of objects, except in files that have no objects, and those that Sweet Home 3D knows by their
  // names: they may move apart.
  void group(const std::string& name) {
    if (!hasObjects_ || name.starts_with("sweethome3d_")) {
      startObject(name);
    } else if (objectName_ != fileObjectName_) {
      startObject(fileObjectName_);
    }
  }

  std::vector<std::string> finish(Scene& scene, Warnings& warnings) {
    lost_.finish(faces_, warnings);
    for (Part* part : order_) {
      warnings.mended("triangles without area are left out", dropDegenerate(part->mesh));
      if (part->mesh.indices.empty()) continue;
      takeColours(*part);
      scene.instances.push_back({part->mesh.name, static_cast<int>(scene.meshes.size()), part->object, {}});
      scene.meshes.push_back(std::move(part->mesh));
    }
    warnings.mended("faces with fewer than three corners are ignored", shortFaces_);
    warnings.mended("texture coordinates and normals that do not exist are left out", missingAttributes_);
    warnings.add("faces of many corners are cut from one of them, as there are too many such faces", ears_.fans);
    warnings.add(kLostCoordinates, lostCoordinates_);
    warnings.add("points and lines are ignored", linesAndPoints_);
    warnings.add("curves and free-form surfaces are ignored", freeForm_);
    return materialNames_;
  }

 private:
  // How many there are; those that are no numbers are not finite.
  template <size_t N>
  static size_t numbers(std::string_view text, std::array<float, N>& v) {
    size_t count = 0;
    for (std::string_view word = nextWord(text); !word.empty() && word[0] != '#' && count < N; word = nextWord(text))
      v[count++] = objNumber(word);
    return count;
  }

  // -1: there is none.
  static int resolve(int64_t index, size_t count) {
    const int64_t i = index > 0 ? index - 1 : static_cast<int64_t>(count) + index;
    return index == 0 || i < 0 || i >= static_cast<int64_t>(count) ? -1 : static_cast<int>(i);
  }
  int optional(int64_t index, size_t count) {
    const int i = resolve(index, count);
    if (index != 0 && i < 0) ++missingAttributes_;
    return i;
  }

  // Colours behind the vertices' places, from 0 to 1 or to 255, as a screen shows them.
  void takeColours(Part& part) {
    if (!coloured_) return;
    if (colourScale_ == 0) {
      colourScale_ = 1;
      for (const Vec3 c : colours_) {
        if (maxComponent(c) > 1.001f) colourScale_ = 1 / 255.0f;
      }
    }
    part.mesh.colors.resize(part.mesh.positions.size());
    for (const auto& [corner, vertex] : part.vertices) {
      const Vec3 c = colours_[static_cast<size_t>(corner.v)] * colourScale_;
      part.mesh.colors[vertex] = {linear(c.x), linear(c.y), linear(c.z)};
    }
  }
  static float linear(float srgb) {
    if (!(srgb > 0)) return 0;
    return srgb <= 0.04045f ? srgb / 12.92f : std::min(1.0f, std::pow((srgb + 0.055f) / 1.055f, 2.4f));
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
      if (parts_.size() > kMostParts)
        fail(lines_.place(), fmt::format("the file has more than {} parts of one object and material", kMostParts));
      part_->object = object_;
      part_->mesh.name = printable(objectName_, kLongestName);  // copied for each part
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
    if (corner.vt >= 0 || !mesh.uv[0].empty())
      mesh.uv[0].push_back(corner.vt >= 0 ? uvs_[static_cast<size_t>(corner.vt)] : Vec2{});
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
  size_t maxTriangles_ = 0, triangles_ = 0, faces_ = 0, shortFaces_ = 0, missingAttributes_ = 0, linesAndPoints_ = 0,
         freeForm_ = 0, lostCoordinates_ = 0;
  LostFaces lost_;
  EarBudget ears_;
  std::vector<Vec3> positions_, normals_;
  bool coloured_ = false;
  std::vector<Vec3> colours_;  // of the vertices, in a coloured file
  float colourScale_ = 0;
  std::vector<std::string> libraries_;
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

void readLine(std::string_view line, const ObjLines& lines, Builder& builder) {
  if (line.empty() || line[0] == '#') return;
  if (line.find('\0') != std::string_view::npos) fail(lines.place(), "holds a NUL character; this is no OBJ file");
  const std::string_view word = nextWord(line);
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  if (word == "v") builder.position(line);
  if (word == "vt") builder.uv(line);
  if (word == "vn") builder.normal(line);
  if (word == "f") builder.face(line);
  if (word == "usemtl") builder.material(asUtf8(line));
  if (word == "mtllib") builder.library(line);
  if (word == "o") builder.object(asUtf8(line));
  if (word == "g") builder.group(asUtf8(line));
  if (word == "l" || word == "p") builder.lineOrPoint();
  if (word == "curv" || word == "curv2" || word == "surf") builder.freeForm();
}

}  // namespace

Scene readObj(std::span<const uint8_t> bytes, const ReadCompanion& companions, size_t maxTriangles,
              Warnings& warnings) {
  ObjLines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  Builder builder(lines, bytes.size(), maxTriangles);
  for (std::string_view line; lines.next(line);) readLine(line, lines, builder);
  Scene scene;
  const std::vector<std::string> names = builder.finish(scene, warnings);
  addObjMaterials(companions, builder.libraries(), names, scene, warnings);
  for (const Mesh& mesh : scene.meshes) {
    const auto material = static_cast<size_t>(mesh.material);
    if (!mesh.colors.empty() && names[material].empty()) scene.materials[material].baseColor = Vec3(kWhitePaint);
  }
  return scene;
}

}  // namespace importers

Result<Imported> importObj(const std::filesystem::path& file, const ImportOptions& options) {
  return importers::guarded(file, [&] {
    importers::Warnings warnings;
    Scene scene =
        importers::readObj(importers::readWholeFile(file, ""), importers::companionsAround(file, options.companionRoot),
                           options.maxTriangles, warnings);
    importers::standUpright(scene, options.upAxis, options.metresPerUnit, importers::UpAxis::Y, warnings);
    return importers::importedScene(std::move(scene), warnings, StatedUnit::None);
  });
}

}  // namespace roomlight
