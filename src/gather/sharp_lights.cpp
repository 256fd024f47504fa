#include "gather/sharp_lights.h"

#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr size_t kAllLamps = 8;  // up to this many lamps each casts its own shadow

}  // namespace

Vec3 skyAlong(const Lights& lights, Vec3 direction) {
  return lights.sky().present() ? lights.sky().radiance(direction) : Vec3(0);
}

Vec3 background(const Lights& lights, Vec3 direction) {
  Vec3 sum = skyAlong(lights, direction);
  for (size_t i = 0; i < lights.sunCount(); ++i) {
    float pdf;
    sum += lights.sunDisc(i, direction, pdf);
  }
  return sum;
}

SharpLights::SharpLights(const RayScene& rays, const Lights& lights)
    : rays_(rays),
      lights_(lights),
      lamps_(lights.lampCount() <= kAllLamps && !lights.hasExtendedLamps() ? lights.lampCount() : 0) {}

LightSample SharpLights::sample(size_t light, Vec3 p, Vec2 u) const {
  return light < lamps_ ? lights_.sampleLamp(light, p, u) : lights_.sampleSun(light - lamps_, u);
}

Shadow SharpLights::shadow(size_t light, std::span<const Vec3> points, std::span<const Vec2> u) const {
  std::array<Ray, kMostPoints> rays;
  std::array<Vec3, kMostPoints> left;
  const size_t n = points.size();
  for (size_t i = 0; i < n; ++i) rays[i] = shadowRay(points[i], points[i], sample(light, points[i], u[i]));
  rays_.transmittance(std::span(rays).first(n), std::span(left).first(n));
  Shadow out;
  for (size_t i = 0; i < n; ++i) out.left += left[i] / static_cast<float>(n);
  for (size_t i = 0; i < n; ++i) {
    const float off = luminance(left[i]) - luminance(out.left);
    out.variance += off * off / static_cast<float>(n * std::max<size_t>(1, n - 1));
  }
  return out;
}

}  // namespace roomlight
