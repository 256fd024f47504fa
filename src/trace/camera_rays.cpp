#include "trace/camera_rays.h"

#include "trace/surface_point.h"

namespace roomlight {
namespace {

constexpr float kCornerM = 0.5f;   // thickest walls whose corners do
constexpr float kThickestM = 1;    // of bodies that show a section: rooms whose faces are turned inside out must not
constexpr int kMostFaces = 16;     // met on the way out of a body
constexpr float kApartM = 1e-5f;   // between two faces that are met one after the other
constexpr float kSkinM =
    0.01f;  // thickness of what is set into a face of a body, or lies on it; of two faces in one place only one is met

// How far it is to where more bodies are left than entered, if that is within reach: faces turned along the direction
// less those against it. To enter a skin and leave it is to leave the body that it lies on.
float distanceOut(const RayScene& scene, Vec3 p, Vec3 direction) {
  Ray ray{p, direction, 0, kThickestM};
  int left = 0;
  float entered = -kInfinity;  // where the last body was
  for (int i = 0; i < kMostFaces; ++i) {
    const Hit hit = scene.intersect(ray);
    if (!hit.valid()) return kInfinity;
    const bool enters = placeAt(scene.scene(), hit, direction).front;
    left += enters ? -1 : 1;
    if (left > 0 || (!enters && hit.t - entered <= kSkinM)) return hit.t;
    if (enters) entered = hit.t;
    ray.tMin = hit.t + kApartM;
  }
  return kInfinity;
}

// The part of the ray below the cut. A ray without one begins where nothing is.
Ray cutBelow(Ray ray, float heightM) {
  const float above = ray.origin.y + ray.tMin * ray.direction.y - heightM;
  if (above < 0) {
    if (ray.direction.y > 0) ray.tMax = (heightM - ray.origin.y) / ray.direction.y;
    return ray;
  }
  constexpr float kNowhereM = 1e18f;
  if (!(ray.direction.y < 0)) return {ray.origin + Vec3(0, kNowhereM, 0), ray.direction, 0, kInfinity};
  // From the plane itself: distances along the ray stay short.
  const float t = (heightM - ray.origin.y) / ray.direction.y;
  return {ray.origin + ray.direction * t, ray.direction, 0, kInfinity};
}

}  // namespace

bool seeTheSame(const Camera& a, const Camera& b) {
  return a.worldFromCamera == b.worldFromCamera && a.yFovRad == b.yFovRad && a.aspect == b.aspect &&
         a.nearM == b.nearM && a.projection == b.projection && a.emptyBackdrop == b.emptyBackdrop &&
         a.yMagM == b.yMagM && a.cutHeightM == b.cutHeightM;
}

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : camera_(camera), cameraFromWorld_(inverse(camera.worldFromCamera)), width_(width), height_(height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  halfHeight_ = camera.projection == Projection::Orthographic ? camera.yMagM : std::tan(0.5f * camera.yFovRad);
  if (camera.aspect > 0 && aspect < camera.aspect) halfHeight_ *= camera.aspect / aspect;
  halfWidth_ = halfHeight_ * aspect;
}

// Longitude along x, latitude along y. Each eye of a stereo pair stands where its circle touches the ray's vertical
// plane, so that its rays lie along the tangent (Ishiguro et al. 1992; Anderson et al. 2016, "Jump", section 4).
Ray CameraRays::panoramaRay(float x, float y, float height) const {
  const float longitude = (x / static_cast<float>(width_) - 0.5f) * 2 * kPi;
  float eye = 0;
  if (camera_.projection == Projection::StereoPanorama) {
    const bool upper = y < height;
    eye = (upper ? -0.5f : 0.5f) * kEyeDistanceM;
    y -= upper ? 0 : height;
  }
  const float colatitude = y / height * kPi;
  const float s = std::sin(colatitude);
  const Vec3 direction{s * std::sin(longitude), std::cos(colatitude), -s * std::cos(longitude)},
      right{std::cos(longitude), 0, std::sin(longitude)};
  return {camera_.worldFromCamera.point(right * eye), normalize(camera_.worldFromCamera.vector(direction)),
          camera_.nearM, kInfinity};
}

Ray CameraRays::ray(float x, float y) const {
  const float px = (2 * x / static_cast<float>(width_) - 1) * halfWidth_;
  const float py = (1 - 2 * y / static_cast<float>(height_)) * halfHeight_;
  const Affine& m = camera_.worldFromCamera;
  Ray out;
  switch (camera_.projection) {
    case Projection::Perspective: out = {m.w, normalize(m.vector({px, py, -1})), camera_.nearM, kInfinity}; break;
    case Projection::Orthographic: out = {m.point({px, py, 0}), normalize(m.vector({0, 0, -1})), 0, kInfinity}; break;
    case Projection::Panorama: out = panoramaRay(x, y, static_cast<float>(height_)); break;
    case Projection::StereoPanorama: out = panoramaRay(x, y, 0.5f * static_cast<float>(height_)); break;
  }
  return camera_.cutHeightM < kInfinity ? cutBelow(out, camera_.cutHeightM) : out;
}

Ray CameraRays::seeing(const RayScene& scene, float x, float y) const {
  Ray out = ray(x, y);
  if (sightOf(scene, camera_, out) != Sight::Scene) out.tMax = 0;
  return out;
}

std::optional<Vec2> CameraRays::pixelOf(Vec3 place) const {
  const Vec3 p = cameraFromWorld_.point(place);
  const float w = static_cast<float>(width_), h = static_cast<float>(height_);
  Vec2 at;
  if (wraps()) {
    const float distance = length(p);
    if (!(distance > 0)) return {};
    const float rows = camera_.projection == Projection::StereoPanorama ? 0.5f * h : h;
    at = {(std::atan2(p.x, -p.z) / (2 * kPi) + 0.5f) * w,
          std::acos(std::clamp(p.y / distance, -1.0f, 1.0f)) / kPi * rows};
  } else {
    const float depth = camera_.projection == Projection::Orthographic ? 1 : -p.z;
    if (!(depth > 0)) return {};
    at = {(0.5f + 0.5f * p.x / (depth * halfWidth_)) * w, (0.5f - 0.5f * p.y / (depth * halfHeight_)) * h};
  }
  const bool inside = at.x >= 0 && at.y >= 0 && at.x <= w && at.y <= h;
  return inside ? std::optional(at) : std::nullopt;
}

bool CameraRays::wraps() const {
  return camera_.projection == Projection::Panorama || camera_.projection == Projection::StereoPanorama;
}

double CameraRays::solidAngleSr(int x, int y) const {
  const double w = width_, h = height_;
  if (camera_.projection == Projection::Orthographic) return 0;
  if (camera_.projection == Projection::Perspective) {
    const double px = (2 * (x + 0.5) / w - 1) * static_cast<double>(halfWidth_),
                 py = (1 - 2 * (y + 0.5) / h) * static_cast<double>(halfHeight_);
    const double area = 4 * static_cast<double>(halfWidth_) * static_cast<double>(halfHeight_) / (w * h);
    return area * std::pow(1 + px * px + py * py, -1.5);
  }
  // Exact: the height of a zone times its share of longitudes (Archimedes).
  const double pi = std::acos(-1.0), rows = camera_.projection == Projection::StereoPanorama ? h / 2 : h,
               row = std::fmod(y, rows);
  return (std::cos(pi * row / rows) - std::cos(pi * std::min(rows, row + 1) / rows)) * 2 * pi / w;
}

float CameraRays::pixelWidthM(int x, int y, Vec3 place) const {
  const double sr = solidAngleSr(x, y);
  return sr > 0 ? static_cast<float>(std::sqrt(sr)) * length(place - camera_.worldFromCamera.w) : metresPerPixel();
}

Sight sightOf(const RayScene& scene, const Camera& camera, const Ray& ray) {
  if (camera.cutHeightM < kInfinity &&
      std::abs(ray.origin.y - camera.cutHeightM) < 1e-4f * std::max(1.0f, std::abs(camera.cutHeightM)) &&
      insideBody(scene, ray.origin))
    return Sight::Section;
  return camera.emptyBackdrop && !scene.intersect(ray).valid() ? Sight::Backdrop : Sight::Scene;
}

bool insideBody(const RayScene& scene, Vec3 p) {
  const auto isOut = [](float way) { return way < kInfinity; };
  const Vec3 x(1, 0, 0), z(0, 0, 1);
  const float right = distanceOut(scene, p, x), left = distanceOut(scene, p, -x);
  if (isOut(right) && isOut(left)) return true;
  const float near = distanceOut(scene, p, z),
              far = isOut(near) || isOut(right) || isOut(left) ? distanceOut(scene, p, -z) : kInfinity;
  if (isOut(near) && isOut(far)) return true;
  // Where walls abut, of the end of one and the side of the other only one may be met: at a corner two ways out must
  // do.
  if (std::max(std::min(right, left), std::min(near, far)) > kCornerM) return false;
  const auto meets = [&](Vec3 d) { return scene.intersect({p, d, 0, kInfinity}).valid(); };
  return meets(x) && meets(-x) && meets(z) && meets(-z);
}

}  // namespace roomlight
