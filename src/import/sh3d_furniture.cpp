#include "import/sh3d_furniture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "import/failure.h"
#include "import/grey_material.h"
#include "import/sh3d_draft.h"
#include "import/sh3d_paints.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr float kFlat = 1e-7f;  // extents below are none; in the model's unit
constexpr size_t kMostParts = 4'000'000, kMostFinds = 50'000'000;
constexpr int kHideEdges = 2;   // of modelFlags: materials that draw edges are not shown

Affine turnedX(double a) {
  const float c = static_cast<float>(std::cos(a)), s = static_cast<float>(std::sin(a));
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}, {}};
}
Affine turnedY(double a) {
  const float c = static_cast<float>(std::cos(a)), s = static_cast<float>(std::sin(a));
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {}};
}
Affine turnedZ(double a) {
  const float c = static_cast<float>(std::cos(a)), s = static_cast<float>(std::sin(a));
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}, {}};
}
Affine scaled(Vec3 s) { return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}}; }
Affine moved(Vec3 by) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, by}; }

float cm(double v) { return static_cast<float>(v / 100); }

Affine fromRows(const std::array<double, 9>& m) {
  const auto column = [&](size_t i) {
    return Vec3(static_cast<float>(m[i]), static_cast<float>(m[i + 3]), static_cast<float>(m[i + 6]));
  };
  return {column(0), column(1), column(2), {}};
}
Affine fromRows(const std::array<double, 12>& m) {
  const auto column = [&](size_t i) {
    return Vec3(static_cast<float>(m[i]), static_cast<float>(m[i + 4]), static_cast<float>(m[i + 8]));
  };
  return {column(0), column(1), column(2), column(3)};
}

Bounds3 boundsThrough(const Affine& m, const std::vector<const Mesh*>& meshes, const std::vector<Affine>& posed) {
  Bounds3 b;
  for (size_t i = 0; i < meshes.size(); ++i) {
    const Affine all = m * posed[i];
    for (const uint32_t index : meshes[i]->indices) b.add(all.point(meshes[i]->positions[index]));
  }
  return b;
}

std::vector<Affine> poses(const Piece& piece, const std::vector<const Mesh*>& meshes, Warnings& warnings) {
  std::vector<Affine> out(meshes.size());
  for (const Transformation& t : piece.transformations) {
    bool moved = false;
    for (size_t i = 0; i < meshes.size(); ++i) {
      if (moves(t.name, meshes[i]->name)) out[i] = fromRows(t.rows) * out[i], moved = true;
    }
    if (!moved) warnings.mended("transformations of parts that the model does not name are left out");
  }
  return out;
}

void addBox(const Home& home, const Piece& p, int material, Draft& draft) {
  const Affine m = worldFromPiece(home, p);
  const Vec3 half{cm(p.widthCm) / 2, cm(p.heightCm) / 2, cm(p.depthCm) / 2};
  Surfaces surfaces(draft.effort, p.place);
  surfaces.ask(12);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto corner = [&](float a, float b) {
        Vec3 q;
        q[axis] = sign * half[axis], q[u] = a * half[u], q[v] = b * half[v];
        return SurfaceCorner{m.point(q), {q[u], q[v]}};
      };
      Vec3 front;
      front[axis] = sign;
      surfaces.quad(material, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, m.vector(front));
    }
  }
  surfaces.finish(draft, p.name);
}

class Placer {
 public:
  Placer(const Home& home, const Models& models, Paints& paints, size_t maxTriangles, Draft& draft)
      : home_(home),
        models_(models),
        looks_(paints, draft.scene),
        paints_(paints),
        maxTriangles_(maxTriangles),
        draft_(draft),
        scene_(draft.scene),
        warnings_(draft.warnings) {}

  void place(const Piece& p) {
    const Model* model = p.model.empty() ? nullptr : models_.find(p.model);
    if (!model) return standIn(p);
    askFor(p, *model);
    std::vector<const Mesh*> meshes;
    for (const Mesh& mesh : model->meshes) meshes.push_back(&mesh);
    const std::vector<Affine> posed = poses(p, meshes, warnings_);
    const Affine worldFrom = worldFromModel(home_, p, meshes, posed);
    if (!(std::abs(worldFrom.determinant()) > 0)) {
      warnings_.mended("pieces without height, width or depth are left out");
      return;
    }
    const std::vector<int> leaves = leavesOf(p, meshes, posed, worldFrom);
    for (size_t i = 0; i < model->meshes.size(); ++i) {
      if ((p.modelFlags & kHideEdges) && isEdge(model->meshes[i])) continue;
      const Affine m = worldFrom * posed[i];
      if (!(std::abs(m.determinant()) > 0)) continue;
      scene_.instances.push_back({p.name, meshWithLook(p, i, model->meshes[i], m), draft_.object, m, leaves[i]});
    }
  }

 private:
  // Before anything is worked out for the piece: its triangles and parts, and what has to be found among the parts.
  void askFor(const Piece& p, const Model& model) {
    for (const Mesh& mesh : model.meshes) triangles_ += mesh.triangleCount();
    if (triangles_ > maxTriangles_) fail(p.place, fmt::format("the home has more than {} triangles", maxTriangles_));
    parts_ += model.meshes.size();
    if (parts_ > kMostParts) fail(p.place, fmt::format("the furniture up to here has more than {} parts", kMostParts));
    finds_ += model.meshes.size() * (p.transformations.size() + p.materials.size() + p.lightSourceMaterials.size());
    if (finds_ > kMostFinds)
      fail(p.place, "the furniture up to here has more transformations and materials than that of any home");
  }

  // Lights hang on rails to be set higher or lower: that would part their bodies from their sources.
  std::vector<int> leavesOf(const Piece& p, const std::vector<const Mesh*>& meshes, const std::vector<Affine>& posed,
                            const Affine& worldFrom) {
    if (p.kind == PieceKind::Light) return std::vector<int>(meshes.size(), -1);
    return findLeaves(meshes, posed, worldFrom, worldFromPiece(home_, p).z, scene_);
  }

  bool isEdge(const Mesh& mesh) const {
    return scene_.materials[static_cast<size_t>(mesh.material)].name.starts_with("edge_color");
  }

  void standIn(const Piece& p) {
    if (p.kind != PieceKind::Furniture) {
      warnings_.add("doors, windows and lights whose model is missing are not drawn");
      return;
    }
    warnings_.add("furniture whose model is missing stands as a box");
    const bool painted = p.paint.colour || p.paint.texture;
    Paint grey;
    grey.colour = 0xcccccc;
    addBox(home_, p, paints_.material(painted ? p.paint : grey, "furniture"), draft_);
  }

  // Pieces that look the same share their meshes; a texture laid by size needs coordinates of its own.
  int meshWithLook(const Piece& p, size_t i, const Mesh& mesh, const Affine& worldFrom) {
    const Look look = looks_.of(p, mesh.name, mesh.material);
    if (!look.layBySize) {
      const auto [entry, isNew] =
          shared_.try_emplace({p.model, i, look.material}, static_cast<int>(scene_.meshes.size()));
      if (isNew) {
        draft_.effort.copy(mesh, p.place);
        scene_.meshes.push_back(mesh);
        scene_.meshes.back().material = look.material;
      }
      return entry->second;
    }
    draft_.effort.copy(2 * mesh.indices.size(), p.place);  // no corner is shared
    scene_.meshes.push_back(laidBySize(mesh, worldFrom));
    scene_.meshes.back().material = look.material;
    return static_cast<int>(scene_.meshes.size()) - 1;
  }

  const Home& home_;
  const Models& models_;
  Looks looks_;
  Paints& paints_;
  size_t maxTriangles_, triangles_ = 0, parts_ = 0, finds_ = 0;
  Draft& draft_;
  Scene& scene_;
  Warnings& warnings_;
  std::map<std::tuple<std::string, size_t, int>, int> shared_;
};

}  // namespace

Affine worldFromPiece(const Home& home, const Piece& p) {
  const double height = p.heightInPlanCm.value_or(p.heightCm);
  return moved(toWorld(p.centre, elevationOf(home, p.level) + p.elevationCm + height / 2)) * turnedY(-p.angleRad);
}

Affine worldFromModel(const Home& home, const Piece& p, const std::vector<const Mesh*>& meshes,
                      const std::vector<Affine>& posed) {
  const Affine turned = fromRows(p.modelRotation);
  const Bounds3 b = boundsThrough(turned, meshes, posed);
  const Vec3 size = b.size();
  const auto factor = [](double wantedCm, float extent) {
    return extent > kFlat ? cm(wantedCm) / extent : cm(wantedCm);
  };
  const Vec3 scale{factor(p.widthCm, size.x) * (p.mirrored ? -1.0f : 1.0f), factor(p.heightCm, size.y),
                   factor(p.depthCm, size.z)};
  Affine m = scaled(scale) * moved(-b.centre()) * turned;
  double height = p.heightCm;
  if (p.pitchRad != 0 || p.rollRad != 0) {
    m = (p.pitchRad != 0 ? turnedX(-p.pitchRad) : turnedZ(-p.rollRad)) * m;
    const Bounds3 tilted = boundsThrough(m, meshes, posed);
    m = moved(-tilted.centre()) * m;
    height = static_cast<double>(tilted.size().y) * 100;  // what the file says of it is for the plan
  }
  return moved(toWorld(p.centre, elevationOf(home, p.level) + p.elevationCm + height / 2)) * turnedY(-p.angleRad) * m;
}

void addFurniture(const Home& home, const Models& models, Paints& paints, const ImportOptions& options, Draft& draft) {
  Placer placer(home, models, paints, options.maxTriangles, draft);
  for (const Piece& p : home.pieces) {
    if (!isShown(home, p.level)) continue;
    const size_t firstInstance = draft.scene.instances.size();
    placer.place(p);
    if (p.kind == PieceKind::Light) addLight(home, p, firstInstance, options.lumenAtFullPower, draft);
    ++draft.object;
  }
}

}  // namespace roomlight::importers::sh3d
