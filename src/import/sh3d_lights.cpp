#include "import/sh3d_furniture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace roomlight::importers::sh3d {
namespace {

constexpr int kRings = 6, kSectors = 12;
constexpr size_t kBallTriangles = 2 * kSectors * (kRings - 1);
constexpr float kDarkest = 1e-6f;  // a colour below is none
constexpr double kBrightest = 1e12;  // cd/m², of what hardly has an area

// Scaled to luminance 1; black means white, as a source of no colour would be none.
Vec3 hue(uint32_t rgb) {
  const Vec3 c = linearColour(rgb);
  return isBlack(c) ? Vec3(1) : c / luminance(c);
}

double brightness(const LightSource& s) { return static_cast<double>(luminance(linearColour(s.colour))); }

double areaOf(const Mesh& mesh, const Affine& m) {
  double sum = 0;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const Vec3 a = m.point(mesh.positions[mesh.indices[t]]), b = m.point(mesh.positions[mesh.indices[t + 1]]),
               c = m.point(mesh.positions[mesh.indices[t + 2]]);
    sum += 0.5 * static_cast<double>(length(cross(b - a, c - a)));
  }
  return sum;
}

// A ball around the origin; fronts look outwards.
Mesh ball(float radiusM) {
  Mesh mesh;
  for (int i = 0; i <= kRings; ++i) {
    for (int k = 0; k < kSectors; ++k) {
      const double polar = std::numbers::pi * i / kRings, turn = 2 * std::numbers::pi * k / kSectors;
      mesh.positions.push_back(Vec3(static_cast<float>(std::sin(polar) * std::cos(turn)),
                                    static_cast<float>(std::cos(polar)),
                                    static_cast<float>(-std::sin(polar) * std::sin(turn))) *
                               radiusM);
    }
  }
  const auto vertex = [](int i, int k) { return static_cast<uint32_t>(i * kSectors + k % kSectors); };
  for (int i = 0; i < kRings; ++i) {
    for (int k = 0; k < kSectors; ++k) {
      if (i > 0) mesh.indices.insert(mesh.indices.end(), {vertex(i, k), vertex(i + 1, k), vertex(i, k + 1)});
      if (i + 1 < kRings)
        mesh.indices.insert(mesh.indices.end(), {vertex(i, k + 1), vertex(i + 1, k), vertex(i + 1, k + 1)});
    }
  }
  return mesh;
}

float luminanceOf(double fluxLm, double areaM2) {
  return static_cast<float>(std::min(fluxLm / (std::numbers::pi * areaM2), kBrightest));
}

// Lambertian and black, so that the light that falls back on it is not lost or gained twice: flux = pi area luminance.
Material glowing(const std::string& name, Vec3 colour, double fluxLm, double areaM2) {
  Material m;
  m.name = name;
  m.baseColor = {};
  m.metallic = m.specular = 0;
  m.emission = colour * luminanceOf(fluxLm, areaM2);
  return m;
}

Vec3 placeOf(const Home& home, const Piece& p, const LightSource& s) {
  const double x = (s.x - 0.5) * (p.mirrored ? -1 : 1) * p.widthCm, z = (0.5 - s.y) * p.depthCm,
               y = s.z * p.heightCm - p.heightInPlanCm.value_or(p.heightCm) / 2;
  return worldFromPiece(home, p).point(
      {static_cast<float>(x / 100), static_cast<float>(y / 100), static_cast<float>(z / 100)});
}

Lamp pointLamp(const std::string& name, Vec3 at, Vec3 colour, double fluxLm) {
  Lamp lamp;
  lamp.name = name;
  lamp.position = at;
  lamp.intensityCd = colour * static_cast<float>(fluxLm / (4 * std::numbers::pi));
  return lamp;
}

void addSource(const Home& home, const Piece& p, const LightSource& s, double fluxLm, Draft& draft) {
  Scene& scene = draft.scene;
  const Vec3 at = placeOf(home, p, s);
  const double radiusM = s.diameter.value_or(0) * p.widthCm / 200;
  if (radiusM < 1e-4) {
    scene.lamps.push_back(pointLamp(p.name, at, hue(s.colour), fluxLm));
    return;
  }
  draft.effort.make(kBallTriangles, p.place);
  Mesh mesh = ball(static_cast<float>(radiusM));
  mesh.name = p.name + kLightSuffix;
  mesh.material = static_cast<int>(scene.materials.size());
  Affine place;
  place.w = at;
  scene.materials.push_back(glowing(mesh.name, hue(s.colour), fluxLm, areaOf(mesh, place)));
  scene.instances.push_back({mesh.name, static_cast<int>(scene.meshes.size()), draft.object, place});
  scene.meshes.push_back(std::move(mesh));
}

// The named materials glow, wherever the light uses them; returns whether there were any.
bool lightUpMaterials(const Piece& p, size_t firstInstance, double fluxLm, Draft& draft) {
  Scene& scene = draft.scene;
  std::vector<size_t> lit;
  double area = 0;
  for (size_t i = firstInstance; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    const std::string& name = scene.materials[static_cast<size_t>(mesh.material)].name;
    if (std::find(p.lightSourceMaterials.begin(), p.lightSourceMaterials.end(), name) == p.lightSourceMaterials.end())
      continue;
    lit.push_back(i), area += areaOf(mesh, scene.instances[i].worldFromObject);
  }
  if (!(area > 0)) return false;
  std::map<int, int> made;
  for (const size_t i : lit) {
    draft.effort.copy(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)], p.place);
    Mesh mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    const auto [entry, isNew] = made.emplace(mesh.material, static_cast<int>(scene.materials.size()));
    if (isNew) {
      Material m = scene.materials[static_cast<size_t>(mesh.material)];
      const Vec3 colour = luminance(m.baseColor) > kDarkest ? m.baseColor / luminance(m.baseColor) : Vec3(1);
      // Shining to both sides of an open sheet would double its light.
      m.doubleSided = false;
      m.emission = colour * luminanceOf(fluxLm, area);
      m.emissionTexture = {};
      scene.materials.push_back(std::move(m));
    }
    mesh.material = entry->second;
    scene.instances[i].mesh = static_cast<int>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
  }
  return true;
}

}  // namespace

void addLight(const Home& home, const Piece& p, size_t firstInstance, double lumenAtFullPower, Draft& draft) {
  const bool isOff = !(p.power > 0);
  const double fluxLm = (isOff ? Piece().power : p.power) * lumenAtFullPower;
  if (!(fluxLm > 0)) return;
  double whole = 0;
  for (const LightSource& s : p.lightSources) whole += brightness(s);
  for (const LightSource& s : p.lightSources) {
    const double itsLm =
        whole > 0 ? fluxLm * brightness(s) / whole : fluxLm / static_cast<double>(p.lightSources.size());
    if (!isOff) {
      addSource(home, p, s, itsLm, draft);
    } else if (itsLm > 0) {
      draft.offLamps.push_back(pointLamp(p.name, placeOf(home, p, s), hue(s.colour), itsLm));
    }
  }
  if (!p.lightSources.empty() || isOff) return;
  if (!lightUpMaterials(p, firstInstance, fluxLm, draft)) draft.warnings.add("lights without light sources stay dark");
}

}  // namespace roomlight::importers::sh3d
