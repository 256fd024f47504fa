#include "import/foreign_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <type_traits>

#include "import/failure.h"
#include "import/obj_textures.h"
#include "import/triangles.h"

namespace roomlight::importers {
namespace {

constexpr float kBrightest = 1e12f;

template <class T>
constexpr bool kPlain = std::is_trivially_copyable_v<T>;

class Writer {
 public:
  template <class T>
  void operator()(const T& v) {
    static_assert(kPlain<T>);
    append(&v, sizeof(v));
  }
  void operator()(const std::string& s) { all(s); }
  template <class T>
  void operator()(const std::vector<T>& v) { all(v); }

  Bytes bytes;

 private:
  template <class Array>
  void all(const Array& v) {
    (*this)(static_cast<uint64_t>(v.size()));
    append(v.data(), v.size() * sizeof(*v.data()));
  }
  void append(const void* from, size_t count) {
    const auto* p = static_cast<const uint8_t*>(from);
    bytes.insert(bytes.end(), p, p + count);
  }
};

class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& v) {
    static_assert(kPlain<T>);
    take(&v, sizeof(v));
  }
  void operator()(std::string& s) { all(s); }
  template <class T>
  void operator()(std::vector<T>& v) { all(v); }

  size_t left() const { return bytes_.size() - at_; }

 private:
  template <class Array>
  void all(Array& v) {
    uint64_t count = 0;
    (*this)(count);
    if (count > left() / sizeof(*v.data())) fail("", "is damaged");
    v.resize(static_cast<size_t>(count));
    take(v.data(), v.size() * sizeof(*v.data()));
  }
  void take(void* to, size_t count) {
    if (count > left()) fail("", "is damaged");
    if (count > 0) std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
  }

  const Bytes& bytes_;
  size_t at_ = 0;
};

// One list of fields for both ways.
template <class Visit, class M>
void visitMaterial(Visit& visit, M& m) {
  visit(m.name), visit(m.diffuse), visit(m.specular), visit(m.emission), visit(m.opacity), visit(m.shininess);
  visit(m.diffusePicture), visit(m.opacityPicture), visit(m.emissionPicture);
}
template <class Visit, class M>
void visitMesh(Visit& visit, M& m) {
  visit(m.name), visit(m.positions), visit(m.normals), visit(m.uv[0]), visit(m.indices), visit(m.material);
}

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void checkMesh(Mesh& mesh, size_t materials) {
  const size_t n = mesh.positions.size();
  const bool sizes = (mesh.normals.empty() || mesh.normals.size() == n) && (mesh.uv[0].empty() || mesh.uv[0].size() == n) && mesh.indices.size() % 3 == 0;
  if (!sizes || mesh.material < 0 || static_cast<size_t>(mesh.material) >= materials) fail("", "is damaged");
  for (const uint32_t i : mesh.indices) {
    if (i >= n) fail("", "is damaged");
  }
  for (const Vec3 p : mesh.positions) {
    if (!finite(p) || maxComponent(abs(p)) > 1e12f) fail("", "holds a vertex that is no finite place");
  }
  for (Vec3& normal : mesh.normals) {
    const float size = length(normal);
    if (!(size > 0 && std::isfinite(size))) {
      mesh.normals.clear();
      break;
    }
    normal = normal / size;
  }
  for (Vec2& t : mesh.uv[0]) {
    if (!std::isfinite(t.x) || !std::isfinite(t.y)) t = {};
  }
}

float limited(float v, float high) { return std::isfinite(v) ? std::clamp(v, 0.0f, high) : 0.0f; }
Vec3 limited(Vec3 v, float high) { return {limited(v.x, high), limited(v.y, high), limited(v.z, high)}; }

Material converted(const ForeignMaterial& in, ObjTextures& textures, Scene& scene) {
  Material m;
  m.name = in.name;
  m.doubleSided = true;
  m.metallic = 0;
  m.baseColorTexture.texture = textures.colourWithAlpha(in.diffusePicture, in.opacityPicture, Wrap::Repeat, scene);
  // A picture stands in the place of the colour.
  m.baseColor = m.baseColorTexture.texture >= 0 ? Vec3(1) : limited(in.diffuse, 1);
  m.alpha = limited(in.opacity, 1);
  m.alphaMode = m.alpha < 1 || !in.opacityPicture.empty() ? AlphaMode::Blend : AlphaMode::Opaque;
  m.emission = limited(in.emission, kBrightest);
  m.emissionTexture.texture = textures.colourWithAlpha(in.emissionPicture, "", Wrap::Repeat, scene);
  if (m.emissionTexture.texture >= 0 && isBlack(m.emission)) m.emission = Vec3(1);
  if (isBlack(limited(in.specular, 1))) m.specular = 0;
  // Phong's exponent as GGX: alpha^2 = 2 / (n + 2) (Walter et al. 2007), alpha = roughness^2.
  m.roughness = std::pow(2 / (limited(in.shininess, 1e6f) + 2), 0.25f);
  return m;
}

}  // namespace

Bytes toBytes(const ForeignModel& model) {
  Writer write;
  write(static_cast<uint64_t>(model.noTriangles)), write(static_cast<uint64_t>(model.materials.size())), write(static_cast<uint64_t>(model.meshes.size()));
  for (const ForeignMaterial& m : model.materials) visitMaterial(write, m);
  for (const Mesh& m : model.meshes) visitMesh(write, m);
  return std::move(write.bytes);
}

ForeignModel foreignModel(const Bytes& bytes) {
  Reader read(bytes);
  ForeignModel model;
  uint64_t noTriangles = 0, materials = 0, meshes = 0;
  read(noTriangles), read(materials), read(meshes);
  if (materials > read.left() || meshes > read.left()) fail("", "is damaged");
  model.noTriangles = static_cast<size_t>(noTriangles);
  for (uint64_t i = 0; i < materials; ++i) visitMaterial(read, model.materials.emplace_back());
  for (uint64_t i = 0; i < meshes; ++i) visitMesh(read, model.meshes.emplace_back());
  for (Mesh& mesh : model.meshes) checkMesh(mesh, model.materials.size());
  return model;
}

Scene sceneOf(ForeignModel model, const ReadCompanion& companions, Warnings& warnings) {
  std::set<std::string> names;
  for (const ForeignMaterial& m : model.materials) {
    for (const std::string* name : {&m.diffusePicture, &m.opacityPicture, &m.emissionPicture}) {
      if (!name->empty()) names.insert(*name);
    }
  }
  Scene scene;
  ObjTextures textures(companions, names, warnings);
  for (const ForeignMaterial& m : model.materials) scene.materials.push_back(converted(m, textures, scene));
  for (Mesh& mesh : model.meshes) {
    dropDegenerate(mesh);
    if (mesh.indices.empty()) continue;
    scene.instances.push_back({mesh.name, static_cast<int>(scene.meshes.size()), static_cast<int>(scene.meshes.size()), {}});
    scene.meshes.push_back(std::move(mesh));
  }
  warnings.add("points and lines are ignored", model.noTriangles);
  return scene;
}

}  // namespace roomlight::importers
