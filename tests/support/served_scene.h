// A small home for tests of sessions and servers, and how roughly it is lit there.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/settings.h"
#include "support/rooms.h"
#include "view/sun_by_date.h"

namespace roomlight::testing {

// A room with a lamp, a shining panel, a box and a camera that looks at the box.
inline Scene servedScene() {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f)),
            wood = test::addMaterial(scene, test::lambertian(0.4f));
  const int shining = test::addMaterial(scene, test::lambertian(0, 300));
  scene.materials[static_cast<size_t>(wood)].name = "Wood";
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 5}, std::vector<int>(6, white));
  const auto first = static_cast<uint32_t>(scene.instances.size());
  test::addBox(scene, {1.5f, 0, 1}, {2.5f, 0.7f, 2}, wood);
  for (uint32_t i = first; i < scene.instances.size(); ++i)
    scene.instances[i].object = scene.instances[first].object, scene.instances[i].name = "Box";
  test::addRectangle(scene, {0.5f, 2.55f, 2}, {0.5f, 0, 0}, {0, 0, 0.5f}, shining);
  scene.instances.back().name = "Panel";
  scene.lamps = {test::pointLamp({2, 2.2f, 2.5f}, 200)};
  scene.lamps[0].name = "Pendant";
  Camera camera;
  camera.name = "Door";
  camera.worldFromCamera = looking({2, 1.6f, 4.6f}, {0, -0.45f, -1});
  scene.cameras.push_back(camera);
  return scene;
}

// Under a clear sky at noon in summer.
inline view::ViewHome underTheSun(std::string name, Scene scene) {
  const auto sun = view::sunOfDaylight(
      {{"sky", "clear"}, {"latitude", 48}, {"longitude", 11}, {"time", "2026-06-21T13:00+02:00"}}, {});
  view::SunLight light = sun->at(sun->atStart).value();
  scene.suns = light.suns, scene.sky = *light.sky;
  view::ViewHome home(std::move(name), std::move(scene));
  home.sun = sun;
  return home;
}

inline RenderSettings servedSettings() {
  RenderSettings s;
  s.voxel.voxelSizeM = 0.25f;
  s.radiance.links = 4, s.radiance.directSamples = 4;
  s.vxgi.resolution = 32, s.vxgi.levels = 2;
  s.lpv.cells = 16, s.lpv.coarseCells = 0, s.lpv.mapSize = 64;
  s.photon.photons = 20000, s.photon.causticPhotons = 0, s.photon.importons = 1000;
  return s;
}

}  // namespace roomlight::testing
