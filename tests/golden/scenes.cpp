#include "golden/scenes.h"

#include "support/rooms.h"

namespace roomlight::test {
namespace {

Camera lookAt(Vec3 from, Vec3 to, float yFovRad) {
  const Vec3 back = normalize(from - to), right = normalize(cross({0, 1, 0}, back));
  Camera camera;
  camera.worldFromCamera = {right, cross(back, right), back, from};
  camera.yFovRad = yFovRad;
  return camera;
}

int addColour(Scene& scene, Vec3 albedo) {
  Material m = lambertian(0);
  m.baseColor = albedo;
  return addMaterial(scene, m);
}

// A ball of unit radius about the origin, smooth normals.
Mesh ball(int material, int n) {
  Mesh mesh;
  mesh.material = material;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= 2 * n; ++i) {
      const float theta = kPi * static_cast<float>(j) / static_cast<float>(n),
                  phi = kPi * static_cast<float>(i) / static_cast<float>(n);
      mesh.positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
    }
  }
  mesh.normals = mesh.positions;
  const auto row = static_cast<uint32_t>(2 * n + 1);
  for (uint32_t j = 0; j < static_cast<uint32_t>(n); ++j) {
    for (uint32_t i = 0; i + 1 < row; ++i) {
      const uint32_t a = j * row + i, b = a + row;
      for (const uint32_t k : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(k);
    }
  }
  return mesh;
}

GoldenScene boxes() {
  GoldenScene g{"boxes", {}, lookAt({1.5f, 1.4f, 3.2f}, {1.5f, 1.15f, 0}, 1.0f)};
  Scene& s = g.scene;
  const int white = addColour(s, {0.75f, 0.75f, 0.75f}), red = addColour(s, {0.6f, 0.08f, 0.06f}),
            green = addColour(s, {0.1f, 0.5f, 0.12f});
  addRoom(s, {0, 0, 0}, {3, 2.5f, 3.3f}, {red, green, white, white, white, white});
  addRectangle(s, {1.1f, 2.49f, 1.1f}, {0.8f, 0, 0}, {0, 0, 0.8f}, addMaterial(s, lambertian(0, 900)));
  addBox(s, {1.7f, 0, 1.3f}, {2.4f, 0.7f, 2.0f}, white);
  const size_t first = s.instances.size();
  addBox(s, {-0.35f, 0, -0.35f}, {0.35f, 1.4f, 0.35f}, white);
  const float c = std::cos(0.35f), d = std::sin(0.35f);
  for (size_t i = first; i < s.instances.size(); ++i)
    s.instances[i].worldFromObject = {{c, 0, -d}, {0, 1, 0}, {d, 0, c}, {0.85f, 0, 0.95f}};
  return g;
}

GoldenScene window() {
  GoldenScene g{"window", {}, lookAt({3.6f, 1.5f, 3.1f}, {0.9f, 1.05f, 0.9f}, 1.05f)};
  Scene& s = g.scene;
  const int wall = addColour(s, {0.8f, 0.78f, 0.72f}), wood = addColour(s, {0.45f, 0.3f, 0.18f}),
            ground = addColour(s, {0.2f, 0.22f, 0.16f});
  const float w = 4, h = 2.6f, d = 3.4f;
  addRectangle(s, {0, 0, 0}, {0, 0, d}, {w, 0, 0}, wood);
  addRectangle(s, {0, h, 0}, {w, 0, 0}, {0, 0, d}, wall);
  addRectangle(s, {0, 0, 0}, {w, 0, 0}, {0, h, 0}, wall);
  addRectangle(s, {0, 0, d}, {0, h, 0}, {w, 0, 0}, wall);
  addRectangle(s, {w, 0, 0}, {0, 0, d}, {0, h, 0}, wall);
  // The wall of the window, 20 cm thick: four beams around the opening.
  addBox(s, {-0.2f, 0, 0}, {0, 0.9f, d}, wall);
  addBox(s, {-0.2f, 2.2f, 0}, {0, h, d}, wall);
  addBox(s, {-0.2f, 0.9f, 0}, {0, 2.2f, 0.7f}, wall);
  addBox(s, {-0.2f, 0.9f, 2.5f}, {0, 2.2f, d}, wall);
  addRectangle(s, {-20, -0.3f, -20}, {0, 0, 40}, {40, 0, 0}, ground);
  Material pane;
  pane.metallic = pane.roughness = 0;
  pane.transmission = 1;
  addRectangle(s, {-0.1f, 0.9f, 0.7f}, {0, 1.3f, 0}, {0, 0, 1.8f}, addMaterial(s, pane));
  addBox(s, {1.2f, 0.68f, 0.5f}, {2.0f, 0.74f, 1.9f}, wood);

  // Brighter and whiter towards the horizon, brightest in the west, where the window looks.
  s.sky.image = Image(32, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      const float up = std::cos(kPi * (static_cast<float>(y) + 0.5f) / 16),
                  west = 0.5f + 0.5f * std::cos(2 * kPi * (static_cast<float>(x) - 7.5f) / 32);
      const float l = up < 0 ? 0 : 2500 + 3000 * (1 - up) * (1 - up) + 3000 * west * west;
      s.sky.image.at(x, y) = lerp(Vec3{0.75f, 1, 1.5f}, Vec3{1, 1, 1.05f}, 1 - std::max(up, 0.0f)) * l;
    }
  }
  Sun sun;
  sun.toLight = normalize({-1, 0.75f, -0.2f});
  sun.illuminanceLux = Vec3{1.1f, 1, 0.8f} * 12000;
  sun.halfAngleRad = 0.00465f;
  s.suns.push_back(sun);
  return g;
}

Texture tiles() {
  Texture t;
  t.width = t.height = 8;
  for (int i = 0; i < 64; ++i) {
    const auto v = static_cast<uint8_t>(((i / 32) + (i % 8) / 4) % 2 ? 220 : 120);
    for (const uint8_t c : {v, v, static_cast<uint8_t>(v - 20), static_cast<uint8_t>(255)}) t.rgba.push_back(c);
  }
  return t;
}

GoldenScene lamps() {
  GoldenScene g{"lamps", {}, lookAt({2.2f, 1.5f, 3.0f}, {1.7f, 0.7f, 0.4f}, 1.05f)};
  Scene& s = g.scene;
  const int wall = addColour(s, {0.72f, 0.74f, 0.78f}), ochre = addColour(s, {0.7f, 0.5f, 0.25f});
  s.textures.push_back(tiles());
  Material floor;
  floor.metallic = 0;
  floor.roughness = 0.35f;
  floor.baseColorTexture.texture = 0;
  addRoom(s, {0, 0, 0}, {3.6f, 2.5f, 3.2f}, {ochre, wall, addMaterial(s, floor), wall, wall, wall});
  s.meshes[2].uv[0] = {{0, 0}, {4, 0}, {0, 4}, {4, 4}};

  Material metal;
  metal.baseColor = {0.95f, 0.8f, 0.6f};
  metal.roughness = 0.4f;
  s.meshes.push_back(ball(addMaterial(s, metal), 24));
  s.instances.push_back({"ball",
                         static_cast<int>(s.meshes.size()) - 1,
                         100,
                         {{0.4f, 0, 0}, {0, 0.4f, 0}, {0, 0, 0.4f}, {1.1f, 0.4f, 1.1f}}});
  Material glass;
  glass.baseColor = {0.85f, 0.95f, 0.9f};
  glass.metallic = glass.roughness = 0;
  glass.transmission = 1;
  addBox(s, {2.0f, 0.01f, 0.9f}, {2.6f, 0.9f, 1.4f},
         addMaterial(s, glass));  // not on the floor itself: which of two surfaces in one place a ray finds is chance

  s.lamps.push_back(pointLamp({0.7f, 1.9f, 0.6f}, 40));
  s.lamps.back().intensityCd = Vec3{1.3f, 0.97f, 0.5f} * 40;
  Lamp spot = pointLamp({2.9f, 2.4f, 0.8f}, 250);
  spot.kind = LampKind::Spot;
  spot.direction = normalize({-0.3f, -1, -0.1f});
  spot.innerConeRad = 0.3f, spot.outerConeRad = 0.6f;
  s.lamps.push_back(spot);
  Lamp panel;
  panel.kind = LampKind::Area;
  panel.position = {1.8f, 2.48f, 1.8f};
  panel.up = {0, 0, 1};
  panel.widthM = 1.0f, panel.heightM = 0.5f;
  panel.luminanceCdM2 = Vec3{0.9f, 1, 1.2f} * 200;
  s.lamps.push_back(panel);
  addAreaLampMeshes(s);
  return g;
}

}  // namespace

std::vector<GoldenScene> goldenScenes() { return {boxes(), window(), lamps()}; }

std::vector<std::pair<std::string, Scene>> withOneLightBrighter(const Scene& scene, float factor) {
  std::vector<std::pair<std::string, Scene>> all;
  const auto copy = [&](const std::string& name) -> Scene& { return all.emplace_back(name, scene).second; };
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    if (!isBlack(scene.materials[i].emission)) copy("panel").materials[i].emission *= factor;
  }
  for (size_t i = 0; i < scene.lamps.size(); ++i) {
    if (scene.lamps[i].kind != LampKind::Area) copy("lamp " + std::to_string(i)).lamps[i].intensityCd *= factor;
  }
  for (size_t i = 0; i < scene.suns.size(); ++i) copy("sun").suns[i].illuminanceLux *= factor;
  if (scene.sky.present()) {
    for (Vec3& p : copy("sky").sky.image.pixels) p *= factor;
  }
  return all;
}

}  // namespace roomlight::test
