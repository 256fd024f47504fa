// Where the camera rays of all pixels lie: one well-distributed set, shifted at random from pixel to pixel.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "base/sampler.h"
#include "gather/picture.h"
#include "gather/pixel_shader.h"
#include "trace/camera_rays.h"

namespace roomlight {

class PixelRays {
 public:
  PixelRays(const RayScene& scene, const Camera& camera, const PictureSettings& settings)
      : scene_(scene), rays_(camera, settings.width, settings.height), seed_(settings.seed), width_(settings.width) {
    for (int s = 0; s < settings.samples; ++s) places_.push_back(Sampler(0, static_cast<uint32_t>(s), seed_).next2());
  }
  // Rays first, first + 1, .. of a pixel.
  std::span<const Ray> at(int x, int y, size_t first, size_t count, std::array<Ray, kRaysAtOnce>& out) const {
    for (size_t i = 0; i < count; ++i) out[i] = ray(x, y, first + i);
    return std::span(out).first(count);
  }
  Ray ray(int x, int y, size_t i) const {
    const uint64_t bits = mix64((static_cast<uint64_t>(y) * static_cast<uint64_t>(width_) + static_cast<uint64_t>(x)) *
                                    0x9e3779b97f4a7c15ull +
                                seed_);
    const Vec2 u =
        places_[i] + Vec2{static_cast<float>(bits >> 40) * 0x1p-24f, static_cast<float>(bits & 0xffffffu) * 0x1p-24f};
    return rays_.seeing(scene_, static_cast<float>(x) + u.x - std::floor(u.x),
                        static_cast<float>(y) + u.y - std::floor(u.y));
  }
  const CameraRays& camera() const { return rays_; }

 private:
  const RayScene& scene_;
  CameraRays rays_;
  uint64_t seed_;
  int width_;
  std::vector<Vec2> places_;
};

}  // namespace roomlight
