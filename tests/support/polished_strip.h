// A floor on which a strip of polished metal throws light: the closed form is the light of the image behind it, times
// what it reflects, inside the image of its outline; nothing outside.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/image.h"
#include "support/rooms.h"
#include "trace/camera_rays.h"

namespace roomlight::test {

// Places on a floor of albedo .02, above which a strip of polished metal stands that throws light down on it: x from
// 0.15 to 1.35 m, z from -0.6 to 0.6 m.
struct Strip {
  static constexpr int kPixels = 96;
  static constexpr float kHeightM = 3, kHalfM = 0.6f, kMiddleX = 0.75f, kReflectance = 0.9f;
  static constexpr float kLow = 0.5f, kHigh = 1.0f, kHalfWidthM = 0.4f;  // the strip, in the plane x = 0

  Scene scene;
  explicit Strip(bool mirror, bool pane = false) {
    const int dark = addMaterial(scene, lambertian(0.02f));
    addRectangle(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, dark);
    Material metal;
    metal.metallic = 1, metal.roughness = 0.02f, metal.baseColor = Vec3(kReflectance);
    if (mirror)
      addRectangle(scene, {0, kLow, kHalfWidthM}, {0, 0, -2 * kHalfWidthM}, {0, kHigh - kLow, 0},
                   addMaterial(scene, metal));
    Material glass;
    glass.metallic = 0, glass.roughness = 0, glass.transmission = 1;
    if (pane) addRectangle(scene, {-4, 0.3f, -4}, {0, 0, 8}, {8, 0, 0}, addMaterial(scene, glass));
  }
  static Camera camera() {
    Camera camera;
    camera.worldFromCamera = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {kMiddleX, kHeightM, 0}};
    camera.yFovRad = 2 * std::atan(kHalfM / kHeightM);
    return camera;
  }
  static bool isFloor(Vec3 p) { return std::abs(p.x - kMiddleX) < kHalfM && std::abs(p.z) < kHalfM; }
  // How far inside the strip the straight line from `image`, a light's place behind its plane, to p crosses that;
// negative: outside, by so much on the floor.
  static float inside(Vec3 image, Vec3 p) {
    const float t = -image.x / (p.x - image.x), y = image.y + (p.y - image.y) * t, z = image.z + (p.z - image.z) * t;
    return std::min({y - kLow, kHigh - y, kHalfWidthM - std::abs(z)});
  }
};

struct Thrown {
  const char* name;
  bool pane;
  void (*light)(Scene&);
  Vec3 image;         // of the light behind the strip's plane
  bool isSun = false;
};
inline void PrintTo(const Thrown& t, std::ostream* out) { *out << t.name; }

inline const Vec3 kLampPlace{1.6f, 1.7f, 0.15f}, kMirroredLamp{-1.6f, 1.7f, 0.15f};
inline const Vec3 kSunward = normalize(Vec3{1, 1, 0.1f});

inline std::vector<Thrown> thrown() {
  const auto sun = [](Scene& scene, float halfAngleRad) {
    Sun s;
    s.toLight = kSunward, s.illuminanceLux = Vec3(50'000), s.halfAngleRad = halfAngleRad;
    scene.suns = {s};
  };
  static const auto addSun = sun;
  const Vec3 farAway = Vec3{-kSunward.x, kSunward.y, kSunward.z} * 1e4f;
  const auto lamp = [](Scene& scene) { scene.lamps.push_back(pointLamp(kLampPlace, 100)); };
  return {{"point sun", false, [](Scene& s) { addSun(s, 0); }, farAway, true},
          {"sun", false, [](Scene& s) { addSun(s, 0.0046f); }, farAway, true},
          {"sun behind a pane", true, [](Scene& s) { addSun(s, 0.0046f); }, farAway, true},
          {"point lamp", false, lamp, kMirroredLamp},
          {"bulb", false, [](Scene& s) { addSphere(s, kLampPlace, 0.02f, addMaterial(s, lambertian(0, 100'000))); },
           kMirroredLamp},
          {"two lamps", false,
           [](Scene& s) {
             for (int k = 0; k < 2; ++k) s.lamps.push_back(pointLamp(kLampPlace, 50));
           },
           kMirroredLamp}};
}

// Of the direct light on the floor: what the strip adds to it.
struct ThrownLight {
  double mean = 0, expected = 0;  // over the image of the strip's outline
  double spread = 0;              // root mean square, relative, over its pixels
  double beside = 0;              // mean of what is added elsewhere, either way

  // From pictures with and without the strip.
  ThrownLight(const Thrown& thrown, const Camera& camera, const Image& lit, const Image& plain) {
    const CameraRays rays(camera, lit.width, lit.height);
    double inside = 0, outside = 0;
    for (int y = 0; y < lit.height; ++y) {
      for (int x = 0; x < lit.width; ++x) {
        const Ray ray = rays.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        const Vec3 p = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
        if (ray.direction.y > -0.1f || !Strip::isFloor(p)) continue;
        const size_t i = static_cast<size_t>(y) * static_cast<size_t>(lit.width) + static_cast<size_t>(x);
        const double more = static_cast<double>(luminance(lit.pixels[i]) / luminance(plain.pixels[i])) - 1,
                     form = addedAt(p, thrown);
        const float depth = Strip::inside(thrown.image, p);
        if (depth > 0.03f) {
          mean += more, expected += form, spread += (more / form - 1) * (more / form - 1), inside += 1;
        } else if (depth < -0.03f) {
          beside += std::abs(more), outside += 1;
        }
      }
    }
    mean /= inside, expected /= inside, spread = std::sqrt(spread / inside), beside /= outside;
  }

 private:
  static double addedAt(Vec3 p, const Thrown& thrown) {
    const auto lux = [&](Vec3 from) { return static_cast<double>(from.y / std::pow(length(from - p), 3.0f)); };
    const Vec3 light{-thrown.image.x, thrown.image.y, thrown.image.z};
    return static_cast<double>(Strip::kReflectance) * (thrown.isSun ? 1 : lux(thrown.image) / lux(light));
  }
};

}  // namespace roomlight::test
