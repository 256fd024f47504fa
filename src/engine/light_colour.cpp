#include "engine/sights.h"

#include "trace/camera_rays.h"
#include "trace/surface_point.h"

namespace roomlight {
namespace {

constexpr float kDarkest = 0.03f;    // albedos below this say little of the light
constexpr float kBrightest = 4.0f;   // of the mean; a patch of sun counts as much as this

// A pixel whose surface tells of the light.
struct Card {
  int x, y;
  Vec3 albedo;
};

std::vector<Card> cardsOf(const RayScene& rays, const Camera& camera, int width, int height, int raysASide) {
  const CameraRays cameraRays(camera, width, height);
  std::vector<Card> cards;
  for (int j = 0; j < raysASide; ++j) {
    for (int i = 0; i < raysASide; ++i) {
      const int x = (2 * i + 1) * width / (2 * raysASide), y = (2 * j + 1) * height / (2 * raysASide);
      const Ray ray = cameraRays.seeing(rays, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      if (ray.tMax <= 0) continue;
      const Hit hit = rays.intersect(ray);
      if (!hit.valid()) continue;
      const SurfacePoint s = surfaceAt(rays.scene(), hit, ray.direction);
      const bool tells = isBlack(s.m.emission) && s.m.metallic < 0.5f && s.m.transmission < 0.5f && s.m.alpha > 0.5f &&
                         minComponent(s.m.baseColor) >= kDarkest;
      if (tells) cards.push_back({x, y, s.m.baseColor});
    }
  }
  return cards;
}

}  // namespace

LightColours lightColours(const RayScene& rays, const Camera& camera, const Image& whole,
                          const std::vector<const Image*>& parts, int raysASide) {
  const std::vector<Card> cards = cardsOf(rays, camera, whole.width, whole.height, raysASide);
  double mean = 0;
  for (const Card& c : cards) mean += static_cast<double>(luminance(whole.at(c.x, c.y) / c.albedo));
  LightColours out{{}, std::vector<Vec3>(parts.size())};
  if (!(mean > 0)) return out;
  const float brightest = kBrightest * static_cast<float>(mean / static_cast<double>(cards.size()));
  for (const Card& c : cards) {
    const Vec3 light = whole.at(c.x, c.y) / c.albedo;
    const float weight = std::min(1.0f, brightest / std::max(luminance(light), 1e-20f));
    out.whole += light * weight;
    for (size_t i = 0; i < parts.size(); ++i) out.parts[i] += parts[i]->at(c.x, c.y) / c.albedo * weight;
  }
  const float all = luminance(out.whole);
  for (Vec3& part : out.parts) part = part / all;
  out.whole = out.whole / all;
  return out;
}

Vec3 lightColour(const RayScene& rays, const Camera& camera, const Image& image, int raysASide) {
  return lightColours(rays, camera, image, {}, raysASide).whole;
}

}  // namespace roomlight
