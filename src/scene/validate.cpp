#include "scene/validate.h"

#include <fmt/format.h>

#include <cmath>

namespace roomlight {
namespace {

bool isFinite(const Affine& a) {
  return roomlight::isFinite(a.x) && roomlight::isFinite(a.y) && roomlight::isFinite(a.z) && roomlight::isFinite(a.w);
}

// A transform and a vertex, each finite, can still meet beyond the range of floats. A box's corners bound all it holds,
// term by term.
bool isFiniteInWorld(const Affine& worldFromObject, const Bounds3& object) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? object.hi.x : object.lo.x, corner & 2 ? object.hi.y : object.lo.y,
                 corner & 4 ? object.hi.z : object.lo.z};
    if (!isFinite(worldFromObject.point(p))) return false;
  }
  return true;
}

bool isLight(Vec3 v) { return isFinite(v) && minComponent(v) >= 0; }

// Beyond it floats have no room for the texture transform.
constexpr float kFarthestCoordinate = 1e12f;
constexpr float kWidestCone = kPi / 2 + 1e-3f;  // with what rounding adds to a right angle

bool isShare(float v) { return v >= 0 && v <= 1; }
bool isUnit(Vec3 v) { return std::abs(lengthSquared(v) - 1) < 1e-3f; }

template <class T>
bool sizeAgrees(const std::vector<T>& v, size_t n) {
  return v.empty() || v.size() == n;
}

// What of the vertices is neither place nor normal.
std::string checkAttributes(const Mesh& mesh) {
  for (size_t set = 0; set < 2; ++set) {
    for (size_t i = 0; i < mesh.uv[set].size(); ++i) {
      const Vec2 uv = mesh.uv[set][i];
      if (!(std::abs(uv.x) <= kFarthestCoordinate && std::abs(uv.y) <= kFarthestCoordinate))
        return fmt::format("texture coordinate {} of set {} is not finite or too large", i, set);
    }
  }
  for (size_t i = 0; i < mesh.colors.size(); ++i) {
    const Vec3 c = mesh.colors[i];
    if (!isShare(c.x) || !isShare(c.y) || !isShare(c.z)) return fmt::format("colour {} is not from 0 to 1", i);
  }
  for (size_t i = 0; i < mesh.colorAlphas.size(); ++i) {
    if (!isShare(mesh.colorAlphas[i])) return fmt::format("alpha {} of the colours is not from 0 to 1", i);
  }
  for (size_t i = 0; i < mesh.tangents.size(); ++i) {
    if (!isFinite(mesh.tangents[i])) return fmt::format("tangent {} is not finite", i);
  }
  for (size_t i = 0; i < mesh.tangentSigns.size(); ++i) {
    if (std::abs(mesh.tangentSigns[i]) != 1) return fmt::format("sign {} of the tangents is neither 1 nor -1", i);
  }
  return {};
}

std::string checkMesh(const Scene& scene, const Mesh& mesh) {
  const size_t n = mesh.positions.size();
  if (mesh.indices.size() % 3 != 0) return "the number of indices is not a multiple of three";
  for (const uint32_t index : mesh.indices) {
    if (index >= n) return fmt::format("index {} is out of range, there are {} vertices", index, n);
  }
  for (size_t i = 0; i < n; ++i) {
    if (!isFinite(mesh.positions[i])) return fmt::format("vertex {} is not a finite position", i);
  }
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    if (!isFinite(mesh.normals[i])) return fmt::format("normal {} is not finite", i);
  }
  if (const std::string what = checkAttributes(mesh); !what.empty()) return what;
  const bool sizes = sizeAgrees(mesh.normals, n) && sizeAgrees(mesh.tangents, n) &&
                     mesh.tangentSigns.size() == mesh.tangents.size() && sizeAgrees(mesh.uv[0], n) &&
                     sizeAgrees(mesh.uv[1], n) && sizeAgrees(mesh.colors, n) && sizeAgrees(mesh.colorAlphas, n);
  if (!sizes) return "vertex attributes differ in length";
  if (mesh.material < 0 || static_cast<size_t>(mesh.material) >= scene.materials.size()) {
    return fmt::format("material {} does not exist", mesh.material);
  }
  return {};
}

std::string checkMaterial(const Scene& scene, const Material& m) {
  if (!isLight(m.emission)) return "emission is negative or not finite";
  if (!isLight(m.baseColor) || !isFinite(m.attenuationColor) || !isFinite(m.specularColor))
    return "a colour is negative or not finite";
  const float numbers[] = {m.alpha,       m.metallic,     m.roughness, m.normalScale,
                           m.alphaCutoff, m.transmission, m.ior,       m.specular};
  for (const float v : numbers) {
    if (!std::isfinite(v)) return "a factor is not finite";
  }
  const Glazing& g = m.glazing;
  const bool saneGlazing = g.panes >= 0 && g.panes <= kMostGlazingPanes && g.ior >= 1 && g.ior <= 4 &&
                           g.internalTransmittance > 0 && g.internalTransmittance <= 1 && m.glazingReflectance >= 0 &&
                           m.glazingReflectance <= 1;
  if (!saneGlazing) return "glazing is out of range";
  const TextureRef* refs[] = {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissionTexture,
                              &m.transmissionTexture};
  for (const TextureRef* ref : refs) {
    if (ref->texture >= static_cast<int>(scene.textures.size()))
      return fmt::format("texture {} does not exist", ref->texture);
    if (ref->uvSet < 0 || ref->uvSet > 1)
      return fmt::format("texture coordinate set {} is not supported, use 0 or 1", ref->uvSet);
    for (const auto& row : ref->m) {
      for (const float v : row) {
        if (!std::isfinite(v)) return "a texture transform is not finite";
      }
    }
  }
  return {};
}

std::string checkLeaves(const Scene& scene) {
  for (size_t i = 0; i < scene.leaves.size(); ++i) {
    const Leaf& l = scene.leaves[i];
    const bool sane = isFinite(l.hinge) && isFinite(l.axis) && isFinite(l.slideM) && std::isfinite(l.turnRad) &&
                      l.atRest >= 0 && l.atRest <= 1;
    if (!sane) return fmt::format("leaf {}: the way that it opens is not finite or out of range", i);
  }
  return {};
}

std::string checkLamp(const Lamp& lamp) {
  if (!isLight(lamp.intensityCd) || !isLight(lamp.luminanceCdM2) || !isFinite(lamp.position) ||
      !isFinite(lamp.direction) || !isFinite(lamp.up))
    return "a value is negative or not finite";
  if (lamp.kind == LampKind::Spot) {
    const bool cones = lamp.innerConeRad >= 0 && lamp.innerConeRad <= lamp.outerConeRad && lamp.outerConeRad > 0 &&
                       lamp.outerConeRad <= kWidestCone;
    if (!cones) return "its cones are not 0 <= inner <= outer <= 90 degrees";
    if (!isUnit(lamp.direction)) return "its direction is no unit vector";
  }
  for (const float v : {lamp.widthM, lamp.heightM, lamp.wattsW}) {
    if (!(v >= 0) || !std::isfinite(v)) return "its size or power is negative or not finite";
  }
  if (!lamp.web) return {};
  if (lamp.kind != LampKind::Point || !isUnit(lamp.direction) || !isUnit(lamp.up) ||
      !(std::abs(dot(lamp.direction, lamp.up)) < 1e-3f))
    return "a web needs a point lamp with its nadir and C0 perpendicular";
  if (!(lamp.web->peakCd > 0) || (lamp.extended && !lamp.web->hasOpening()))
    return "its web has no light or no opening";
  return {};
}

std::string checkLights(const Scene& scene) {
  for (size_t i = 0; i < scene.lamps.size(); ++i) {
    const std::string what = checkLamp(scene.lamps[i]);
    if (!what.empty()) return fmt::format("lamp {} '{}': {}", i, scene.lamps[i].name, what);
  }
  for (size_t i = 0; i < scene.suns.size(); ++i) {
    const Sun& sun = scene.suns[i];
    const auto where = [&] { return fmt::format("sun {} '{}': ", i, sun.name); };
    if (!isLight(sun.illuminanceLux)) return where() + "a value is negative or not finite";
    if (!isUnit(sun.toLight)) return where() + "its direction is no unit vector";
    if (!(sun.halfAngleRad >= 0 && sun.halfAngleRad <= kWidestCone)) return where() + "its disc is not 0 to 90 degrees";
  }
  if (!isLight(scene.sky.luminanceCdM2)) return "sky: luminance is negative or not finite";
  if (!std::isfinite(scene.sky.rotationRad)) return "sky: its rotation is not finite";
  for (const Vec3 pixel : scene.sky.image.pixels) {
    if (!isLight(pixel)) return "sky: the image holds a negative or non-finite value";
  }
  return {};
}

}  // namespace

Status validate(const Scene& scene) {
  for (size_t i = 0; i < scene.textures.size(); ++i) {
    const Texture& t = scene.textures[i];
    const bool sane = t.width > 0 && t.height > 0 &&
                      t.rgba.size() == static_cast<size_t>(t.width) * static_cast<size_t>(t.height) * 4;
    if (!sane) return Error{fmt::format("texture {} '{}': size and texels disagree", i, t.name)};
  }
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string what = checkMaterial(scene, scene.materials[i]);
    if (!what.empty()) return Error{fmt::format("material {} '{}': {}", i, scene.materials[i].name, what)};
  }
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    const std::string what = checkMesh(scene, scene.meshes[i]);
    if (!what.empty()) return Error{fmt::format("mesh {} '{}': {}", i, scene.meshes[i].name, what)};
  }
  std::vector<Bounds3> meshBounds(scene.meshes.size());
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    for (const uint32_t index : scene.meshes[i].indices) meshBounds[i].add(scene.meshes[i].positions[index]);
  }
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto where = [&] { return fmt::format("instance {} '{}': ", i, instance.name); };
    if (instance.mesh < 0 || static_cast<size_t>(instance.mesh) >= scene.meshes.size())
      return Error{where() + "its mesh does not exist"};
    if (instance.leaf < -1 || instance.leaf >= static_cast<int>(scene.leaves.size()))
      return Error{where() + "its leaf does not exist"};
    if (!isFinite(instance.worldFromObject)) return Error{where() + "its transform is not finite"};
    if (instance.worldFromObject.determinant() == 0)
      return Error{where() + "its transform flattens it, so it cannot be placed"};
    const Bounds3& bounds = meshBounds[static_cast<size_t>(instance.mesh)];
    if (!bounds.empty() && !isFiniteInWorld(instance.worldFromObject, bounds)) {
      return Error{where() + "its bounds in the world are not finite; its transform times its vertices is too large"};
    }
  }
  for (const auto check : {checkLeaves, checkLights}) {
    const std::string what = check(scene);
    if (!what.empty()) return Error{what};
  }
  if (scene.triangleCount() == 0) return Error{"there is no triangle to light"};
  return Ok{};
}

}  // namespace roomlight
