// A room with a light in a shade, and renders of it with and without light paths.
#pragma once

#include "reference/path_tracer.h"
#include "support/rooms.h"

namespace roomlight::test {

// A room of 4 x 3 x 4 m.
inline Scene room(const Material& walls) {
  Scene scene;
  addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, addMaterial(scene, walls)));
  return scene;
}

// A shade of this size in metres, with a pane of thin glass under it and no light.
inline Scene emptyShade(const Material& shade, float size) {
  Scene scene = room(lambertian(0.6f));
  const int s = addMaterial(scene, shade);
  const Vec3 lo{1.6f, 1.8f, 1.2f}, x{size, 0, 0}, y{0, size, 0}, z{0, 0, size};
  addRectangle(scene, lo, y, z, s);
  addRectangle(scene, lo + x, z, y, s);
  addRectangle(scene, lo, x, y, s);
  addRectangle(scene, lo + z, y, x, s);
  addRectangle(scene, lo + y, x, z, s);
  Material glass;
  glass.transmission = 1;
  glass.metallic = 0;
  glass.roughness = 0.4f;
  addRectangle(scene, lo, x, z, addMaterial(scene, glass));
  return scene;
}

// The middle of such a shade in height and depth, at this part of its width.
inline Vec3 inShade(float place, float size) { return Vec3{1.6f, 1.8f, 1.2f} + Vec3{place, 0.5f, 0.5f} * size; }

// With a lamp in it.
inline Scene shadedLamp(const Material& shade, float place = 0.9f, float size = 0.3f) {
  Scene scene = emptyShade(shade, size);
  scene.lamps.push_back(pointLamp(inShade(place, size), 100));
  return scene;
}

inline PathResult render(const Scene& scene, int samples, bool lightPaths, uint64_t seed = 0) {
  const RayScene rays(scene);
  const Lights lights(scene);
  Camera camera;
  camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 1.4f, 3.9f}};
  camera.yFovRad = 1.2f;
  PathSettings settings;
  settings.width = settings.height = 20;
  settings.samples = samples;
  settings.lightPaths = lightPaths;
  settings.seed = seed;
  return pathTrace(rays, lights, camera, settings);
}

// Of the mean luminance.
inline double standardError(const PathResult& result) {
  double sum = 0;
  for (const Vec3 v : result.variance.pixels) sum += luminance(v);
  return std::sqrt(sum) / static_cast<double>(result.variance.pixels.size());
}

}  // namespace roomlight::test
