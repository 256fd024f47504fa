#include "import/gltf_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "import/gltf_data.h"

namespace roomlight::importers {
namespace {

// Transforms of nodes and instances.

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

Vec3 vector(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// Columns first; the last row, 0 0 0 1, is not looked at but for a common factor.
Affine fromMatrix(const Json& matrix) {
  if (matrix.size() != 16) matrix.fail("must have 16 numbers");
  double v[16];
  for (size_t i = 0; i < 16; ++i) v[i] = matrix[i].number();
  const double last = v[15] != 0 ? v[15] : 1;
  for (double& value : v) value /= last;
  return {vector(v[0], v[1], v[2]), vector(v[4], v[5], v[6]), vector(v[8], v[9], v[10]), vector(v[12], v[13], v[14])};
}

// translation * rotation * scale; the quaternion need not be of unit length; one of length 0 turns nothing.
Affine composed(Vec3 translation, Quaternion q, Vec3 scale) {
  double size = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(size > 1e-6) || !std::isfinite(size)) q = {0, 0, 0, 1}, size = 1;
  const double x = q.x / size, y = q.y / size, z = q.z / size, w = q.w / size;
  Affine m;
  m.x = vector(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)) * scale.x;
  m.y = vector(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)) * scale.y;
  m.z = vector(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)) * scale.z;
  m.w = translation;
  return m;
}

// A node's matrix, or translation, rotation and scale. Throws Failure.
Affine transformOf(const Json& node) {
  if (const auto matrix = node.find("matrix")) return fromMatrix(*matrix);
  Quaternion q;
  if (const auto rotation = node.find("rotation")) {
    if (rotation->size() != 4) rotation->fail("must have four numbers");
    q = {(*rotation)[0].number(), (*rotation)[1].number(), (*rotation)[2].number(), (*rotation)[3].number()};
  }
  return composed(node.vec3("translation", Vec3(0)), q, node.vec3("scale", Vec3(1)));
}

constexpr int kMaxDepth = 512;
constexpr size_t kMostInstances = 2'000'000;  // of parts of meshes, each of which takes memory

class Walker {
 public:
  Walker(GltfDocument& document, const std::vector<std::vector<int>>& primitivesOfMesh, size_t maxTriangles,
         Scene& scene)
      : document_(document),
        nodes_(document.root().list("nodes")),
        primitivesOfMesh_(primitivesOfMesh),
        maxTriangles_(maxTriangles),
        scene_(scene) {}

  void walk() {
    visited_.resize(nodes_.size());
    const Json root = document_.root(), scenes = root.list("scenes");
    const int chosen = sceneOf(root, scenes);
    if (chosen < 0) {
      walkRoots();
    } else {
      if (scenes.size() > 1) document_.warnings.add("scenes other than the default one are ignored", scenes.size() - 1);
      visitAll(scenes[static_cast<size_t>(chosen)].list("nodes"), {}, 0);
    }
    if (nodes_.size() == 0) placeAllMeshes();
  }

 private:
  // The default scene, or the first that shows something; -1: none does.
  int sceneOf(const Json& root, const Json& scenes) {
    const int named = document_.looseIndex(root, "scene", scenes.size());
    if (named >= 0 && scenes[static_cast<size_t>(named)].list("nodes").size() > 0) return named;
    for (size_t i = 0; i < scenes.size(); ++i) {
      if (scenes[i].list("nodes").size() > 0) return static_cast<int>(i);
    }
    return -1;
  }

  // A file without a scene: every node that is nobody's child.
  void walkRoots() {
    std::vector<bool> isChild(nodes_.size());
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const Json children = nodes_[i].list("children");
      for (size_t k = 0; k < children.size(); ++k) {
        if (const int child = indexOf(children[k]); child >= 0) isChild[static_cast<size_t>(child)] = true;
      }
    }
    for (size_t i = 0; i < nodes_.size(); ++i) {
      if (!isChild[i]) visit(static_cast<int>(i), nodes_[i], {}, 0);
    }
  }

  // A file of meshes without nodes.
  void placeAllMeshes() {
    for (size_t mesh = 0; mesh < primitivesOfMesh_.size(); ++mesh) {
      place(document_.root().list("meshes")[mesh], static_cast<int>(mesh), {});
      document_.warnings.add("meshes that no node places stand at the origin");
    }
  }

  // -1 where there is no such node.
  int indexOf(const Json& use) const {
    const double v = use.number();
    return v >= 0 && v < static_cast<double>(nodes_.size()) ? use.index(nodes_.size()) : -1;
  }

  void visitAll(const Json& uses, const Affine& worldFromParent, int depth) {
    for (size_t i = 0; i < uses.size(); ++i) {
      const int index = indexOf(uses[i]);
      if (index < 0) {
        document_.warnings.add("references to things that do not exist are ignored");
      } else if (visited_[static_cast<size_t>(index)]) {
        document_.warnings.add("nodes with a second parent, or that are their own, keep the first");
      } else {
        visit(index, uses[i], worldFromParent, depth);
      }
    }
  }

  void visit(int index, const Json& use, const Affine& worldFromParent, int depth) {
    visited_[static_cast<size_t>(index)] = true;
    if (depth > kMaxDepth) use.fail(fmt::format("nodes are nested deeper than {} levels", kMaxDepth));
    const Json node = nodes_[static_cast<size_t>(index)];
    if (const auto e = node.extension("KHR_node_visibility"); e && !e->boolean("visible", true)) {
      document_.warnings.add("nodes that the file hides are left out with all below them");
      return;
    }
    const Affine world = worldFromParent * transformOf(node);
    if (!isFinite(world.x) || !isFinite(world.y) || !isFinite(world.z) || !isFinite(world.w))
      node.fail("its transform is too large");
    if (world.determinant() == 0) {
      document_.warnings.mended("nodes scaled to nothing are left out with all below them");
      return;
    }
    placeMesh(node, world);
    const Json cameras = document_.root().list("cameras");
    if (const int camera = document_.looseIndex(node, "camera", cameras.size()); camera >= 0) {
      if (auto read = readGltfCamera(cameras[static_cast<size_t>(camera)], node.name(), world)) {
        scene_.cameras.push_back(std::move(*read));
      } else {
        document_.warnings.add("cameras that see nothing are left out");
      }
    }
    if (const auto e = node.extension("KHR_lights_punctual")) addGltfLight(document_, *e, node.name(), world, scene_);
    addGltfLuminaire(document_, node, world, scene_);
    visitAll(node.list("children"), world, depth + 1);
  }

  void placeMesh(const Json& node, const Affine& world) {
    if (node.find("skin")) document_.warnings.add("skins are ignored, meshes keep their rest pose");
    const int mesh = document_.looseIndex(node, "mesh", primitivesOfMesh_.size());
    if (mesh < 0) return;
    if (const auto e = node.extension("EXT_mesh_gpu_instancing")) {
      for (const Affine& placement : placements(*e)) place(node, mesh, world * placement);
    } else {
      place(node, mesh, world);
    }
  }

  void askForInstances(size_t more, const Json& place) const {
    if (more > kMostInstances - scene_.instances.size())
      place.fail(fmt::format("meshes are placed more than {} times, counted by their primitives", kMostInstances));
  }

  void place(const Json& node, int mesh, const Affine& world) {
    if (world.determinant() == 0 || !isFinite(world.x) || !isFinite(world.y) || !isFinite(world.z) ||
        !isFinite(world.w)) {
      document_.warnings.mended("instances scaled to nothing are left out");
      return;
    }
    const std::vector<int>& primitives = primitivesOfMesh_[static_cast<size_t>(mesh)];
    askForInstances(primitives.size(), node);
    for (const int primitive : primitives) {
      triangles_ += scene_.meshes[static_cast<size_t>(primitive)].triangleCount();
      if (triangles_ > maxTriangles_)
        node.fail(fmt::format("all instances together have more than {} triangles", maxTriangles_));
      scene_.instances.push_back({node.name(), primitive, nextObject_, world});
    }
    ++nextObject_;
  }

  // EXT_mesh_gpu_instancing: any of TRANSLATION, ROTATION and SCALE, of equal count.
  std::vector<Affine> placements(const Json& extension) {
    const Json attributes = extension.at("attributes");
    std::vector<float> values[3];
    const char* names[] = {"TRANSLATION", "ROTATION", "SCALE"};
    const int widths[] = {3, 4, 3};
    std::optional<size_t> count;
    for (int k = 0; k < 3; ++k) {
      const auto use = attributes.find(names[k]);
      if (!use) continue;
      const Accessor accessor = openAccessor(document_, *use);
      if (count.value_or(accessor.count) != accessor.count)
        use->fail(fmt::format("has {} elements, others have {}", accessor.count, *count));
      count = accessor.count;
      document_.budget.spend(accessor.count, use->path());
      askForInstances(accessor.count, *use);
      values[k] = readFloats(accessor, widths[k]);
    }
    std::vector<Affine> out;
    for (size_t i = 0; i < count.value_or(0); ++i) {
      const auto at = [&](size_t k, size_t c, float otherwise) {
        return values[k].empty() ? otherwise : values[k][i * (k == 1 ? 4 : 3) + c];
      };
      const Quaternion q{at(1, 0, 0), at(1, 1, 0), at(1, 2, 0), at(1, 3, 1)};
      out.push_back(composed({at(0, 0, 0), at(0, 1, 0), at(0, 2, 0)}, q, {at(2, 0, 1), at(2, 1, 1), at(2, 2, 1)}));
    }
    return out;
  }

  GltfDocument& document_;
  Json nodes_;
  const std::vector<std::vector<int>>& primitivesOfMesh_;
  size_t maxTriangles_ = 0, triangles_ = 0;
  Scene& scene_;
  std::vector<bool> visited_;
  int nextObject_ = 0;
};

}  // namespace

void addGltfNodes(GltfDocument& document, const std::vector<std::vector<int>>& primitivesOfMesh, size_t maxTriangles,
                  Scene& scene) {
  Walker(document, primitivesOfMesh, maxTriangles, scene).walk();
}

}  // namespace roomlight::importers
