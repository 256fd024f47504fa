// Rays through the pixels of a camera.
#pragma once

#include "scene/scene.h"
#include "trace/ray_scene.h"

namespace roomlight {

class CameraRays {
 public:
  // The camera's vertical angle holds when the picture is at least as wide as the author's aspect; a narrower picture
  // keeps the horizontal angle instead, so that nothing the author framed is lost.
  CameraRays(const Camera& camera, int width, int height) : camera_(camera), width_(width), height_(height) {
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    halfHeight_ = camera.orthographic ? camera.yMagM : std::tan(0.5f * camera.yFovRad);
    if (camera.aspect > 0 && aspect < camera.aspect) halfHeight_ *= camera.aspect / aspect;
    halfWidth_ = halfHeight_ * aspect;
  }
  // Through picture coordinates (x, y) in pixels from the top left corner; unit direction.
  Ray ray(float x, float y) const {
    const float px = (2 * x / static_cast<float>(width_) - 1) * halfWidth_;
    const float py = (1 - 2 * y / static_cast<float>(height_)) * halfHeight_;
    const Affine& m = camera_.worldFromCamera;
    if (camera_.orthographic) return {m.point({px, py, 0}), normalize(m.vector({0, 0, -1})), 0, kInfinity};
    return {m.w, normalize(m.vector({px, py, -1})), camera_.nearM, kInfinity};
  }
  // Angle that one pixel subtends at the picture's centre, radians (perspective).
  float pixelAngleRad() const { return 2 * halfHeight_ / static_cast<float>(height_); }

 private:
  Camera camera_;
  int width_, height_;
  float halfWidth_ = 1, halfHeight_ = 1;
};

}  // namespace roomlight
