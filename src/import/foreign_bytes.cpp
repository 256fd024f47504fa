// A model on its way out of the process that read it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "import/failure.h"
#include "import/foreign_model.h"

namespace roomlight::importers {
namespace {

constexpr float kFarthest = 1e12f;

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
  void operator()(const std::vector<T>& v) {
    all(v);
  }
  template <class T, class Each>
  void each(const std::vector<T>& v, Each&& one) {
    (*this)(static_cast<uint64_t>(v.size()));
    for (const T& t : v) one(*this, t);
  }

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
  void operator()(std::vector<T>& v) {
    all(v);
  }
  template <class T, class Each>
  void each(std::vector<T>& v, Each&& one) {
    uint64_t count = 0;
    (*this)(count);
    if (count > left()) fail("", "is damaged");
    for (uint64_t i = 0; i < count; ++i) one(*this, v.emplace_back());
  }

 private:
  size_t left() const { return bytes_.size() - at_; }
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
template <class Visit, class Model>
void visitModel(Visit& visit, Model& model) {
  visit.each(model.materials, [](auto& v, auto& m) {
    v(m.name), v(m.diffuse), v(m.specular), v(m.emission), v(m.opacity), v(m.shininess);
    v(m.diffusePicture), v(m.opacityPicture), v(m.emissionPicture), v(m.normalPicture);
  });
  visit.each(model.meshes, [](auto& v, auto& m) {
    v(m.name), v(m.positions), v(m.normals), v(m.colors), v(m.uv[0]), v(m.indices), v(m.material);
  });
  visit.each(model.instances, [](auto& v, auto& i) { v(i.name), v(i.mesh), v(i.object), v(i.modelFromMesh); });
  visit.each(model.pictures, [](auto& v, auto& p) { v(p); });
  visit.each(model.cameras,
             [](auto& v, auto& c) { v(c.name), v(c.position), v(c.direction), v(c.up), v(c.xFovRad), v(c.aspect); });
  visit.each(model.lights, [](auto& v, auto& l) {
    v(l.name), v(l.kind), v(l.position), v(l.direction), v(l.up), v(l.colour), v(l.innerConeRad), v(l.outerConeRad),
        v(l.width), v(l.height);
  });
  visit(model.noTriangles), visit(model.otherLights), visit(model.up), visit(model.metresPerUnit);
}

bool sensible(Vec3 v) { return isFinite(v) && maxComponent(abs(v)) <= kFarthest; }

void checkMesh(Mesh& mesh, size_t materials) {
  const size_t n = mesh.positions.size();
  const auto agrees = [n](size_t size) { return size == 0 || size == n; };
  const bool sizes = agrees(mesh.normals.size()) && agrees(mesh.uv[0].size()) && agrees(mesh.colors.size()) &&
                     mesh.indices.size() % 3 == 0;
  if (!sizes || mesh.material < 0 || static_cast<size_t>(mesh.material) >= materials) fail("", "is damaged");
  for (const uint32_t i : mesh.indices) {
    if (i >= n) fail("", "is damaged");
  }
  for (Vec3& normal : mesh.normals) {
    const float size = length(normal);
    if (!(size > 0 && std::isfinite(size))) {
      mesh.normals.clear();
      break;
    }
    normal = normal / size;
  }
  for (Vec3& c : mesh.colors) {
    for (float* v : {&c.x, &c.y, &c.z}) *v = *v >= 0 ? std::min(*v, 1.0f) : 0;
  }
}

// Unit; `otherwise` where the file's has no length.
Vec3 direction(Vec3 v, Vec3 otherwise) {
  const float size = length(v);
  return size > 1e-20f && std::isfinite(size) ? v / size : otherwise;
}

// What would put things nowhere is left out, the rest stays.
void keepSensible(ForeignModel& model) {
  std::erase_if(model.instances, [&](const ForeignInstance& i) {
    if (i.mesh >= model.meshes.size()) fail("", "is damaged");
    const Affine& m = i.modelFromMesh;
    return !sensible(m.x) || !sensible(m.y) || !sensible(m.z) || !sensible(m.w) || !(std::abs(m.determinant()) > 0);
  });
  std::erase_if(model.cameras, [](const ForeignCamera& c) { return !sensible(c.position); });
  for (ForeignCamera& c : model.cameras)
    c.direction = direction(c.direction, {0, 0, -1}), c.up = direction(c.up, {0, 1, 0});
  std::erase_if(model.lights, [](const ForeignLight& l) {
    return !sensible(l.position) || !isFinite(l.colour) || l.kind > ForeignLightKind::Area;
  });
  for (ForeignLight& l : model.lights) {
    l.direction = direction(l.direction, {0, -1, 0});
    for (float* v : {&l.innerConeRad, &l.outerConeRad, &l.width, &l.height}) *v = *v >= 0 && *v <= kFarthest ? *v : 0;
  }
  if (!(model.metresPerUnit > 0 && model.metresPerUnit <= 1e6f)) model.metresPerUnit = 0;
  if (model.up != 'x' && model.up != 'y' && model.up != 'z') model.up = 0;
}

}  // namespace

Bytes toBytes(const ForeignModel& model) {
  Writer write;
  visitModel(write, model);
  return std::move(write.bytes);
}

ForeignModel foreignModel(const Bytes& bytes) {
  Reader read(bytes);
  ForeignModel model;
  visitModel(read, model);
  for (Mesh& mesh : model.meshes) checkMesh(mesh, model.materials.size());
  keepSensible(model);
  return model;
}

}  // namespace roomlight::importers
