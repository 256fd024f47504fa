// Homes that are opened for view from files, and the same as `render` lights them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "import/import.h"
#include "import/lighting_file.h"
#include "unit/temporary_folder.h"
#include "view/open_home.h"

namespace roomlight::view {

// A floor, a panel that shines twice, and a lamp of the file's own.
constexpr const char* kHome = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
  "nodes": [{"name": "Floor", "mesh": 0, "scale": [3, 3, 3]}, {"name": "Panel", "mesh": 1, "translation": [0, 2, 0]}, {"name": "Panel", "mesh": 1, "translation": [1, 2, 0]},
            {"name": "Bulb", "translation": [0, 1, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}, {"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]}],
  "materials": [{"name": "Floor"}, {"name": "Glow", "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 100}}}],
  "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 50}]}},
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 0, 1]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA"}]})";

class OpenedFile : public ::testing::Test {
 protected:
  OpenedFile() { write("home.gltf", kHome); }

  void write(const std::string& name, const std::string& text) { roomlight::testing::writeFile(folder_ / name, text); }
  home::OpenWish wishFor(const std::string& lighting, home::LightWish light = home::LightWish::File) const {
    home::OpenWish wish;
    wish.scene = folder_ / "home.gltf", wish.light = light;
    if (!lighting.empty()) wish.lighting = folder_ / lighting;
    return wish;
  }
  ViewHome open(const std::string& lighting, home::LightWish light = home::LightWish::File) {
    Result<OpenedView> opened = view::openHome(wishFor(lighting, light));
    EXPECT_TRUE(opened.ok()) << opened.error();
    return std::move(opened.value().home);
  }
  // The scene as `render --lighting` has it.
  Scene rendered(const std::string& lighting) {
    Scene scene = std::move(importScene(folder_ / "home.gltf", {}).value().scene);
    const Status s = applyLightingFile(folder_ / lighting, scene);
    EXPECT_TRUE(s.ok()) << s.error();
    return scene;
  }
  static Vec3 emissionOf(const Scene& s, size_t i) {
    return s.materials[static_cast<size_t>(s.meshes[static_cast<size_t>(s.instances[i].mesh)].material)].emission;
  }
  static void expectSameLight(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.lamps.size(), b.lamps.size());
    for (size_t i = 0; i < a.lamps.size(); ++i) {
      EXPECT_NEAR(luminance(a.lamps[i].intensityCd), luminance(b.lamps[i].intensityCd),
                  1e-3 * static_cast<double>(luminance(b.lamps[i].intensityCd)) + 1e-6)
          << i;
      EXPECT_NEAR(length(a.lamps[i].position - b.lamps[i].position), 0, 1e-4) << i;
      EXPECT_NEAR(length(a.lamps[i].direction - b.lamps[i].direction), 0, 1e-4) << i;
    }
    for (size_t i = 0; i < b.instances.size(); ++i)
      EXPECT_NEAR(length(emissionOf(a, i) - emissionOf(b, i)), 0, 1e-3) << i;
    ASSERT_EQ(a.suns.size(), b.suns.size());
    for (size_t i = 0; i < a.suns.size(); ++i) EXPECT_NEAR(length(a.suns[i].toLight - b.suns[i].toLight), 0, 1e-4);
  }
  static size_t lampNamed(const ViewHome& home, const std::string& name, size_t number = 0) {
    for (size_t i = 0; i < home.editable.lamps.size(); ++i) {
      if (home.editable.lamps[i].name == name && number-- == 0) return i;
    }
    ADD_FAILURE() << name;
    return 0;
  }
  roomlight::testing::TemporaryFolder folder_;
};

}  // namespace roomlight::view
