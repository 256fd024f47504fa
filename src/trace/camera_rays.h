// Rays through the pixels of a camera: the one place that knows projections and cuts.
#pragma once

#include <optional>

#include "scene/scene.h"
#include "trace/ray_scene.h"

namespace roomlight {

constexpr float kEyeDistanceM = 0.064f;  // of stereo panoramas: the mean of grown-ups is 63 mm

// Whether two cameras take the same picture, whatever they are called.
bool seeTheSame(const Camera& a, const Camera& b);

// The angle or height that a camera states holds when the picture is at least as wide as the author's aspect; a
// narrower picture keeps the width instead, so that nothing the author framed is lost. Panoramas fill any picture.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);

  // Through picture coordinates (x, y) in pixels from the top left corner; unit direction. Begins below the camera's
// cut and ends there.
  Ray ray(float x, float y) const;
  // The same, or a ray of tMax 0 where the camera sees no light: in the section of a body that is cut, or past
  // everything with an empty backdrop. Costs rays for cameras that cut or have such a backdrop, else nothing.
  Ray seeing(const RayScene& scene, float x, float y) const;

  // Where in the picture, in pixels, a place would be seen if nothing stood before it; of a stereo pair in the upper
  // half, as from between the eyes. None outside.
  std::optional<Vec2> pixelOf(Vec3 place) const;
  // Whether a ray through that pixel meets the place: not of stereo pairs.
  bool hasExactPixels() const { return camera_.projection != Projection::StereoPanorama; }

  // Whether the picture's left and right edges are neighbours.
  bool wraps() const;
  // Width of a pixel in the scene; orthographic cameras only.
  float metresPerPixel() const { return 2 * halfHeight_ / static_cast<float>(height_); }
  // Width of a pixel at a place that it sees, m.
  float pixelWidthM(int x, int y, Vec3 place) const;
  // Solid angle of a pixel seen from the camera, sr; 0 for orthographic ones.
  double solidAngleSr(int x, int y) const;

 private:
  Ray panoramaRay(float x, float y, float height) const;

  Camera camera_;
  Affine cameraFromWorld_;
  int width_, height_;
  float halfWidth_ = 1, halfHeight_ = 1;
};

// What a ray of CameraRays comes to.
enum class Sight : uint8_t {
  Scene,     // light: of a surface, or of the sky
  Section,   // a body that the camera's cut went through
  Backdrop,  // nothing, where the backdrop is empty
};
Sight sightOf(const RayScene& scene, const Camera& camera, const Ray& ray);

// Whether p lies in a wall, a board, a pane: something with faces turned away from p on both sides along x or z, within
// a metre, or in a corner of walls, with such faces within half a metre along both.
bool insideBody(const RayScene& scene, Vec3 p);

}  // namespace roomlight
