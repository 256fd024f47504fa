#include "gather/meters.h"

namespace roomlight {
namespace {

constexpr uint64_t kMeterKey = 0x3e7e12;  // other random numbers than pixels have

// An ideal white Lambertian surface reflects 1 / pi of what falls on it.
SurfacePoint whitePatch(const SurfaceElement& element) {
  SurfacePoint s;
  s.p = element.position;
  s.ng = s.smooth = s.ns = element.normal;
  s.m.baseColor = Vec3(1);
  return s;
}

}  // namespace

std::vector<MeterReading> measureIlluminance(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, std::span<const SurfaceElement> elements,
                                             const MeterSettings& settings, const Progress& progress) {
  const SharpLights sharp(rays, lights);
  const auto sample = [&](size_t meter, int first, int count, std::span<Vec3> lux) {
    thread_local std::vector<Shading> shadings;
    thread_local std::vector<Shadow> shadows;
    thread_local std::vector<SurfaceLight> light;
    shadings.clear(), shadows.clear();
    const SurfacePoint s = whitePatch(elements[meter]);
    const Vec3 origin = offsetOrigin(s.p, s.ng);
    for (int k = 0; k < count; ++k) {
      Sampler sampler(mix64(meter + kMeterKey), static_cast<uint32_t>(first + k), settings.seed);
      const auto firstShadow = static_cast<uint32_t>(shadows.size());
      for (size_t i = 0; i < sharp.count(); ++i) {
        const Vec2 u = sampler.next2();
        shadows.push_back(sharp.shadow(i, {&origin, 1}, {&u, 1}));
      }
      shadings.push_back({s, s.ng, sampler, firstShadow, false, 1, true});
    }
    light.assign(shadings.size(), {});
    GatherCounters counters;
    shader.shade(shadings, shadows, light, counters);
    for (size_t k = 0; k < light.size(); ++k) lux[k] += (light[k].diffuse + light[k].sharp) * kPi;
  };
  return readMeters(rays, lights, elements, settings, sample, progress);
}

}  // namespace roomlight
