#include "import/sh3d_paints.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/surface.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr const char *kPane = "sweethome3d_window_pane", *kMirror = "sweethome3d_window_mirror";
constexpr float kMirrorReflectance = 0.9f;
constexpr Glazing kClearGlass{1, 1.52f, 0.96f};  // 6 mm
constexpr float kSeeThrough = 0.7f;  // opacity up to which an even material of a door or window is its glass

Material pane() {
  Material m;
  m.name = kPane, m.label = "window glass";
  m.metallic = m.roughness = 0;
  m.transmission = 1;
  return m;
}

Material mirror() {
  Material m;
  m.name = kMirror, m.label = "mirror";
  m.baseColor = Vec3(kMirrorReflectance);
  m.roughness = 0;
  return m;
}

bool isSeeThrough(const Material& m) {
  return m.alphaMode == AlphaMode::Blend && m.alpha <= kSeeThrough && m.baseColorTexture.texture < 0 &&
         isBlack(m.emission);
}

}  // namespace

Look Looks::of(const Piece& piece, const std::string& group, int material) {
  const bool isPane = group.starts_with(kPane),
             isMirror = group.starts_with(kMirror) || group.starts_with("sweethome3d_mirror");
  if (isPane || isMirror) {
    const auto [entry, isNew] = made_.emplace(isPane ? kPane : kMirror, static_cast<int>(scene_.materials.size()));
    if (isNew) scene_.materials.push_back(isPane ? pane() : mirror());
    return {entry->second, false};
  }
  const std::string& name = scene_.materials[static_cast<size_t>(material)].name;
  for (const MaterialPaint& m : piece.materials) {
    if ((m.key.empty() ? m.name : m.key) == name) return painted(material, m.paint, m.shininessGiven);
  }
  const Look look = painted(material, piece.paint, piece.shininessGiven);
  if (piece.kind != PieceKind::DoorOrWindow || look.material != material ||
      !isSeeThrough(scene_.materials[static_cast<size_t>(material)]))
    return look;
  const auto [entry, isNew] =
      made_.emplace(fmt::format("glass\n{}", material), static_cast<int>(scene_.materials.size()));
  if (isNew) {
    Material glass = scene_.materials[static_cast<size_t>(material)];
    glaze(glass, kClearGlass);
    scene_.materials.push_back(std::move(glass));
  }
  return {entry->second, false};
}

Look Looks::painted(int material, const Paint& paint, bool shininessGiven) {
  const TextureRef ref = paint.texture ? paints_.reference(*paint.texture) : TextureRef();
  const bool textured = ref.texture >= 0;
  if (!paint.colour && !textured && !shininessGiven) return {material, false};
  std::string key = fmt::format("{}\n{}\n{}\n{}", material, paint.colour ? fmt::format("{:06x}", *paint.colour) : "",
                                ref.texture, shininessGiven ? paint.shininess : -1);
  for (const auto& row : ref.m) key += fmt::format("\n{}\n{}\n{}", row[0], row[1], row[2]);
  const auto [entry, isNew] = made_.emplace(key, static_cast<int>(scene_.materials.size()));
  if (!isNew) return {entry->second, textured};
  Material m = scene_.materials[static_cast<size_t>(material)];
  if (paint.colour || textured) {
    m.baseColor = (paint.colour && !textured ? linearColour(*paint.colour) : Vec3(1)) * kWhiteReflectance;
    m.baseColorTexture = ref;
    m.label = textured ? paint.texture->name : "";
  }
  if (shininessGiven) {
    const Material gloss = paintedMaterial("", {}, paint.shininess);
    m.specular = gloss.specular, m.roughness = gloss.roughness;
  }
  scene_.materials.push_back(std::move(m));
  return {entry->second, textured};
}

Mesh laidBySize(const Mesh& in, const Affine& worldFromMesh) {
  Mesh out;
  out.name = in.name;
  for (size_t t = 0; t + 2 < in.indices.size(); t += 3) {
    Vec3 p[3];
    for (size_t k = 0; k < 3; ++k) p[k] = worldFromMesh.point(in.positions[in.indices[t + k]]);
    const Vec3 n = abs(cross(p[1] - p[0], p[2] - p[0]));
    const int axis = n.y >= n.x && n.y >= n.z ? 1 : n.x >= n.z ? 0 : 2;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t index = in.indices[t + k];
      out.indices.push_back(static_cast<uint32_t>(out.positions.size()));
      out.positions.push_back(in.positions[index]);
      if (!in.normals.empty()) out.normals.push_back(in.normals[index]);
      out.uv[0].push_back(axis == 1 ? Vec2{p[k].x, p[k].z} : axis == 0 ? Vec2{p[k].z, -p[k].y} : Vec2{p[k].x, -p[k].y});
    }
  }
  return out;
}

}  // namespace roomlight::importers::sh3d
