#include "engine/sights.h"

#include "base/parallel.h"

namespace roomlight {

Sights sightsOf(const RayScene& rays, const Camera& camera, int width, int height) {
  if (!(camera.cutHeightM < kInfinity) && !camera.emptyBackdrop) return {};
  constexpr int kSteps = 4;
  const CameraRays cameraRays(camera, width, height);
  const size_t w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  const auto look = [&](size_t x, size_t y, float u, float v) {
    return sightOf(rays, camera, cameraRays.ray(static_cast<float>(x) + u, static_cast<float>(y) + v));
  };
  std::vector<Sight> centre(w * h);
  parallelFor(h, 1, [&](size_t y) {
    for (size_t x = 0; x < w; ++x) centre[y * w + x] = look(x, y, 0.5f, 0.5f);
  });
  Sights out{std::vector<float>(w * h), std::vector<float>(w * h)};
  parallelFor(h, 1, [&](size_t y) {
    for (size_t x = 0; x < w; ++x) {
      const Sight own = centre[y * w + x];
      bool alike = true;
      for (size_t j = y > 0 ? y - 1 : 0; j < std::min(h, y + 2); ++j) {
        for (size_t i = x > 0 ? x - 1 : 0; i < std::min(w, x + 2); ++i) alike &= centre[j * w + i] == own;
      }
      float counts[3] = {};
      for (int k = 0; k < (alike ? 1 : kSteps * kSteps); ++k) {
        const Sight s = alike ? own
                              : look(x, y, (static_cast<float>(k % kSteps) + 0.5f) / kSteps,
                                     (static_cast<float>(k / kSteps) + 0.5f) / kSteps);
        counts[static_cast<size_t>(s)] += alike ? 1 : 1.0f / (kSteps * kSteps);
      }
      out.section[y * w + x] = counts[static_cast<size_t>(Sight::Section)];
      out.backdrop[y * w + x] = counts[static_cast<size_t>(Sight::Backdrop)];
    }
  });
  return out;
}

Image unmixed(const Image& light, const Sights& sights) {
  if (sights.section.empty()) return light;
  Image out = light;
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    const float rest = 1 - sights.section[i] - sights.backdrop[i];
    out.pixels[i] = rest > 0 ? light.pixels[i] / rest : Vec3();
  }
  return out;
}

Image drawn(const Image& encoded, const Sights& sights, Vec3 section, std::optional<Vec3> backdrop) {
  if (sights.section.empty()) return encoded;
  Image out = encoded;
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    const float cut = sights.section[i], nothing = sights.backdrop[i], solid = 1 - nothing;
    const Vec3 inside = encoded.pixels[i] * (solid - cut) + section * cut;
    out.pixels[i] = backdrop ? inside + *backdrop * nothing : solid > 0 ? inside / solid : Vec3(1);
  }
  return out;
}

}  // namespace roomlight
