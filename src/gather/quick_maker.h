// How pixels of one quick frame get what they show (quick_frames.h): what of the frame before comes to them, what their
// rays meet, and light.
#pragma once

#include <bit>
#include <cmath>
#include <span>

#include "base/sampler.h"
#include "gather/quick_frames.h"
#include "radiance/near_lights.h"
#include "trace/emitter_view.h"

namespace roomlight {

struct QuickFrames::Rules {
  static constexpr int kTile = 16;
  static constexpr int kMostPanes = 8;
  static constexpr float kLeastLeft = 1e-2f;  // of light behind panes that is still looked for
  static constexpr float kLeastReflected = 0.02f;
  static constexpr float kFacing = 0.9f;  // cosine between normals of one place
  static constexpr float kLeastCosine = 0.1f;
  static constexpr int kBlock = 4;  // pixels: what is looked at anew together
  static constexpr int kLendWithin = 4;  // pixels: blocks in which light is lent
  static constexpr uint64_t kNothing = ~uint64_t{0};
  static constexpr uint32_t kSky = 0x7fffffffu;  // in place of an instance
  // Whose turn it is among `every` pixels: all of a block of 4x4 come on within 16 frames, of 8x8 within 64, far ones
  // after one another.
  static bool isTurn(int x, int y, uint32_t frame, uint32_t every);
};

// A camera ray on its way through panes.
struct QuickFrames::Sight {
  uint32_t pixel = 0;
  Ray ray;
  Vec3 left{1, 1, 1};  // of what it comes to
  int panes = 0;
  Vec3 panePlace, paneNormal;  // of the first pane, for what it reflects,
  Vec3 reflectance;  // and how much that is
};

// A pixel that is to be lit, with what it sees.
struct QuickFrames::Asked {
  uint32_t pixel;
  Sight sight;
  Hit hit;
  Vec3 p, n;  // n: geometric, towards the eye
  SlotIrradiance received;  // of pixels that are lit, before they are
  bool lit = true;  // else it is lent light
  std::optional<Vec3> old;  // colour it had, and keeps where nobody lends
  bool lent = false;
  Vec3 albedo, rest;  // once it has light: of its Lambertian lobe; all other light of the pixel
  Vec3 diffuse;  // light over albedo
};

class QuickFrames::Maker {
 public:
  Maker(QuickFrames& frames, const QuickScene& scene, const Camera& camera, int width, int height)
      : f_(frames), scene_(scene), rays_(camera, width, height), eye_(camera.worldFromCamera.w) {
    const Scene& s = scene.rays.scene();
    for (const Instance& i : s.instances)
      clear_.push_back(
          letsLightThrough(s.materials[static_cast<size_t>(s.meshes[static_cast<size_t>(i.mesh)].material)]));
    const Ray a = rays_.ray(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)),
              b = rays_.ray(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height) + 1);
    slope_ = length(b.direction - a.direction);
    // Directions are those of the corner and two steps, before they are unit.
    const Ray corner = rays_.ray(0, 0), right = rays_.ray(static_cast<float>(width), 0),
              down = rays_.ray(0, static_cast<float>(height));
    const Vec3 ahead = -camera.worldFromCamera.z;
    const auto onPlane = [&](const Ray& r) { return r.direction / dot(r.direction, ahead); };
    corner_ = onPlane(corner), stepX_ = (onPlane(right) - corner_) / static_cast<float>(width),
    stepY_ = (onPlane(down) - corner_) / static_cast<float>(height);
    coarser_ = slope_ * std::max(1.0f, frames.pastHeight_ > 0
                                           ? static_cast<float>(height) / static_cast<float>(frames.pastHeight_)
                                           : 1.0f);
    const float voxelM = scene.light.voxelSizeM();
    for (size_t i = 0; i < scene.lights.lampCount(); ++i) besideLamps_.emplace_back(scene.lights.lamp(i), voxelM);
    for (const uint32_t i : scene.light.sharpEmissive()) {
      const int32_t e = scene.lights.emitterOf(i);
      if (e < 0) continue;
      const auto index = static_cast<size_t>(e);
      emitters_.push_back({index, isSmall(scene.lights, index, voxelM)
                                      ? LightSurroundings(scene.lights.emitterBounds(index), voxelM)
                                      : LightSurroundings()});
    }
    nearM_ = camera.nearM, cutHeightM_ = camera.cutHeightM;
    anyStale_ = frames.changed_.any();
  }
  void make(int x0, int y0, Count& count, Image& out);
  struct Survey {
    float known = 0;  // share of what is seen that the frame before saw too
    float distanceM = 0;  // to what is seen: the median
    float usualLux = 0;  // on what is seen, but for its brightest fifth: at most; so that dark slots do not hide it
  };
  // From a few rays all over the picture.
  Survey survey() const;

 private:
  // What a pane lets through and reflects under an angle.
  struct Pane {
    const Material* material = nullptr;
    float cosine = 0;
    bool clear = false;
    Vec3 through, reflected;
  };
  struct Spot {  // what a pixel's ray meets first
    Hit hit;
    Vec3 n;
    bool traced = false;  // else it follows from its neighbours
  };
  struct Work {
    std::array<Spot, Rules::kTile * Rules::kTile> spots;
    std::vector<uint32_t> places;
    // Where the frame before lands: pixels that keep what came to them; blocks that something stale may lie in, and
    // those of them that have been looked at anew, a bit each.
    std::array<bool, Rules::kTile * Rules::kTile> kept;
    uint32_t doubted = 0, lookedAt = 0;
    Pane pane, varied;
    std::vector<Sight> sights, on;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Asked> asked;
    struct Shadow {
      uint32_t asked;
      Vec3 diffuse, specular;  // what arrives if nothing is in the way
    };
    std::vector<Shadow> shadows;
    std::vector<Ray> shadowRays;
    std::vector<Vec3> left;
    std::vector<uint32_t> toLight;  // of asked
    std::vector<EmitterView> views;  // of emitters_
    std::array<std::vector<uint32_t>, (Rules::kTile / Rules::kLendWithin) * (Rules::kTile / Rules::kLendWithin)> litOf;
  };
  void trace(int x0, int y0, int x1, int y1, Work& w) const;
  // What a sight's ray meets, with its normal towards the eye.
  struct Met {
    const Hit& hit;
    Vec3 n;
    bool traced;  // the hit's place on its triangle is known
  };
  void see(const Sight& sight, const Met& met, Work& w, Image& out) const;
  void lookAgain(int x0, int y0, Work& w, Count& count) const;
  void doubt(uint32_t pixel, uint32_t key, Vec3 p, Vec3 n, Work& w) const;
  void meet(const Sight& sight, const Met& met, Vec3 p, Work& w, Image& out) const;
  const Pane& paneAt(const Hit& hit, Vec3 n, Vec3 direction, Work& w) const;
  const Pixel* find(uint32_t key, Vec3 p, Vec3 n) const;
  bool knowsSky(Vec3 direction) const;
  void light(Work& w, Count& count, Image& out) const;
  void lightThose(Work& w, Count& count) const;
  SlotIrradiance receivedOrFound(const Asked& a) const;
  Vec3 gatherAround(Vec3 p, Vec3 n) const;
  bool standsFor(const SlotIrradiance& e) const;
  Vec3 arriving(Ray ray, Sampler& sampler) const;
  Vec3 sampleLocal(Vec3 p, Vec3 n, Sampler& sampler) const;
  void shade(uint32_t index, Work& w) const;
  void lookAtEmitters(Work& w) const;
  float shareOutside(const LightSurroundings& around, Vec3 p, Vec3 towards) const;
  void lend(Work& w, Count& count) const;
  void store(const Asked& a, Vec3 colour, State state, Image& out) const;
  void storeSky(const Sight& sight, Vec3 reflected, Image& out) const;
  bool isTurnOf(uint32_t pixel, uint32_t every) const {
    return Rules::isTurn(static_cast<int>(pixel % static_cast<uint32_t>(f_.width_)),
                         static_cast<int>(pixel / static_cast<uint32_t>(f_.width_)), f_.frame_, every);
  }
  bool keep(int x, int y, Image& out) const;
  const Pixel* landedAt(size_t pixel) const {
    const uint64_t from = f_.landed_[pixel].load(std::memory_order_relaxed);
    return from == Rules::kNothing ? nullptr : &f_.past_[static_cast<uint32_t>(from)];
  }
  bool between(int x, int y, const Pixel* a, const Pixel* b, Image& out) const;
  SlotIrradiance receivedAt(uint32_t instance, Vec3 p, Vec3 n) const;
  Vec3 radianceAlong(Ray ray, Vec3 left, bool emitted = true) const;

  struct SharpEmitter {
    size_t index;
    LightSurroundings around;
  };
  QuickFrames& f_;
  const QuickScene& scene_;
  std::vector<LightSurroundings> besideLamps_;
  std::vector<SharpEmitter> emitters_;
  const CameraRays rays_;
  const Vec3 eye_;
  // From the eye; what lies above the camera's cut is not met.
  Ray rayOf(int x, int y) const {
    const Vec3 d = corner_ + stepX_ * (static_cast<float>(x) + 0.5f) + stepY_ * (static_cast<float>(y) + 0.5f);
    Ray ray{eye_, d * (1 / std::sqrt(lengthSquared(d))), nearM_, kInfinity};
    if (cutHeightM_ < kInfinity) cut(ray);
    return ray;
  }
  void cut(Ray& ray) const {
    constexpr float kNowhereM = 1e18f;
    const float downM = eye_.y - cutHeightM_, down = -ray.direction.y;
    if (downM > 0) {
      ray.tMin = down > 0 ? std::max(ray.tMin, downM / down) : kNowhereM;
    } else if (down < 0) {
      ray.tMax = downM / down;
    }
  }
  Vec3 corner_, stepX_, stepY_;
  float nearM_ = 0, cutHeightM_ = kInfinity;
  bool anyStale_ = false;
  float slope_ = 0;  // of a pixel: how far its edges part, per metre of distance
  float coarser_ = 0;  // the same, or that of the frame before where its pixels were larger
  std::vector<uint8_t> clear_;  // a flag an instance: light may pass through
};

}  // namespace roomlight
