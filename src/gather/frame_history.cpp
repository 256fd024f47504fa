#include "gather/frame.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kFacing = 0.9f;      // cosine between normals of one place
constexpr float kFootprints = 1.5f;  // how far off it may be, in pixels; and
constexpr float kOffPlane = 0.25f;    // of that off the tangent plane
constexpr float kLeastCosine = 0.1f;  // of pixels' footprints on slanted surfaces
constexpr float
    kLobe = 2,
    kSlackRad = 0.02f;  // how far a view may turn until nothing is left of a reflection: times GGX's alpha, and besides

// Few estimates that differ tell little of how far their mean is off: what the first was thought to be off counts with
// the others.
float varianceOf(float before, float n, float now, float m, float apart) {
  return (before * n * n + now * m * m * std::max(0.0f, 1 - n) + apart * apart * n * m / (n + m)) / ((n + m) * (n + m));
}

}  // namespace

PastLight together(const PastLight& before, const PastLight& now) {
  if (!(before.estimates > 0)) return now;
  PastLight out = now;
  const float n = before.estimates, m = now.estimates, share = m / (n + m);
  const auto mean = [](Vec3 a, Vec3 b, float s) { return a + (b - a) * s; };
  out.position = mean(before.position, now.position, share);
  out.irradiance = mean(before.irradiance, now.irradiance, share), out.sharp = mean(before.sharp, now.sharp, share);
  out.variance.x = varianceOf(before.variance.x, n, now.variance.x, m, luminance(now.irradiance - before.irradiance));
  out.variance.y = varianceOf(before.variance.y, n, now.variance.y, m, luminance(now.sharp - before.sharp));
  out.estimates = n + m;
  const float g = before.glossy, k = now.glossy;
  out.specular = mean(before.specular, now.specular, k / (g + k));
  out.variance.z = varianceOf(before.variance.z, g, now.variance.z, k, luminance(now.specular - before.specular));
  out.glossy = g + k;
  return out;
}

void FrameHistory::sceneChanged(const SceneChange& change, const Scene& scene) {
  changed_.add(change, scene, [&](std::vector<Bounds3>& seen) {
    for (const PastLight& l : now_) {
      if (l.instance < seen.size()) seen[l.instance].add(l.position);
    }
  });
}

void FrameHistory::forget() { camera_.reset(); }

// Of what the frame before saw, from its eye.
float FrameHistory::medianDistanceM() const {
  constexpr size_t kEvery = 61;
  std::vector<float> distances;
  for (size_t i = 0; i < now_.size(); i += kEvery) {
    if (now_[i].instance != kNoHit) distances.push_back(length(now_[i].position - eye_));
  }
  if (distances.empty()) return kInfinity;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

void FrameHistory::begin(const Camera& camera, int width, int height, const Lights& lights) {
  changed_.lightBy(lights);
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  if (!camera_ || width != width_ || height != height_) {
    width_ = width, height_ = height;
    past_.assign(pixels, {}), now_.assign(pixels, {});
    pixels_.emplace(width, height), pixelsBefore_.emplace(width, height);
    camera_.reset();
  }
  still_ = camera_ && seeTheSame(*camera_, camera);
  if (camera_ && !still_ && hasJumped(length(camera.worldFromCamera.w - eye_), medianDistanceM())) camera_.reset();
  settled_ = still_ && !changed_.lightsChanged() && !changed_.anyMoved() && !stale_;
  framesStill_ = settled_ ? framesStill_ + 1 : 0;
  if (!settled_) {
    past_.swap(now_);
    std::swap(pixels_, pixelsBefore_);
  }
  before_.reset();
  if (camera_) before_.emplace(*camera_, width, height), beforeEye_ = camera_->worldFromCamera.w;
  camera_ = camera;
  const CameraRays rays(camera, width, height);
  pixels_->wraps = rays.wraps();
  const Ray a = rays.ray(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)),
            b = rays.ray(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height) + 1);
  pixelSlope_ = length(b.direction - a.direction),
  pixelM_ = camera.projection == Projection::Orthographic ? length(b.origin - a.origin) : 0;
  eye_ = camera.worldFromCamera.w;
}

PastLight FrameHistory::find(int x, int y, const SeenSurface& seen) const {
  if (!before_ || changed_.hasMoved(seen.instance)) return {};
  const float cosine = std::max(kLeastCosine, std::abs(dot(seen.normal, seen.wo)));
  const float footprint = kFootprints * (pixelM_ + pixelSlope_ * length(seen.place - eye_));
  const std::vector<PastLight>& known = settled_ ? now_ : past_;
  const PastLight* best = nullptr;
  float nearest = footprint * footprint / (cosine * cosine);
  const auto look = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= width_ || j >= height_) return;
    const PastLight& l = known[static_cast<size_t>(j) * static_cast<size_t>(width_) + static_cast<size_t>(i)];
    if (l.instance != seen.instance || l.whole != seen.whole || !(l.estimates > 0) ||
        dot(l.normal, seen.normal) < kFacing)
      return;
    const Vec3 between = l.position - seen.position;
    const float d2 = lengthSquared(between);
    if (d2 >= nearest || std::abs(dot(between, seen.normal)) > kOffPlane * footprint) return;
    nearest = d2, best = &l;
  };
  if (still_) {
    look(x, y);
  } else {
    const std::optional<Vec2> at = before_->pixelOf(seen.place);
    if (!at) return {};
    const int i = static_cast<int>(std::floor(at->x - 0.5f)), j = static_cast<int>(std::floor(at->y - 0.5f));
    for (int dy = 0; dy < 2; ++dy) {
      for (int dx = 0; dx < 2; ++dx) look(i + dx, j + dy);
    }
  }
  if (!best) return {};
  PastLight out = *best;
  out.pixel = static_cast<uint32_t>(best - known.data());
  if (!still_ && seen.roughness >= 0) {
    const float turned = length(normalize(beforeEye_ - seen.place) - normalize(eye_ - seen.place));
    out.glossy *= std::max(0.0f, 1 - turned / (kLobe * seen.roughness * seen.roughness + kSlackRad));
  }
  float most = changed_.anyMoved() ? settings_.mostWhileMoving : settings_.mostEstimates;
  if (seen.whole && !still_) most = std::min(most, settings_.mostOfVeil);
  if (changed_.concern(out.position, settings_.nearM)) {
    most = settings_.staleEstimates;
    // What is out of date must not look different from what is not, or the filter would keep them apart.
    const float l = luminance(out.irradiance), s = luminance(out.sharp), r = luminance(out.specular);
    out.variance = max(out.variance, {l * l, s * s, r * r});
  }
  out.estimates = std::min(out.estimates, most), out.glossy = std::min(out.glossy, most);
  return out;
}

void FrameHistory::end(const std::vector<Vec3>& smooth, bool stale) {
  stale_ = stale;

  if (!settled_)
    parallelFor(smooth.size(), 4096, [&](size_t i) {
      if (now_[i].instance != kNoHit && !now_[i].whole && now_[i].estimates < settings_.smoothEstimates &&
          pixels_->pixels[i].surface > 0)
        now_[i].irradiance = smooth[i];
    });
  changed_.forget();
  ++frame_;
}

}  // namespace roomlight
