#include "view/point.h"

#include <algorithm>
#include <cmath>

#include "measure/measure.h"
#include "scene/shown_names.h"
#include "trace/camera_rays.h"
#include "trace/surface_point.h"

namespace roomlight::view {
namespace {

constexpr float kLampPixels = 12;
constexpr double kTolerance = 0.01;
constexpr int kFewest = 256, kMost = 4096;
constexpr int kSpotPixels = 8, kSpotSamples = 4;
constexpr float kSpotRad = kPi / 540;

template <class List, class Holds>
int numberOf(const List& list, Holds&& holds) {
  const auto found = std::find_if(list.begin(), list.end(), holds);
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

bool isSeen(const RayScene& rays, Vec3 eye, Vec3 place) {
  const Vec3 way = place - eye;
  return !isBlack(rays.transmittance({eye, way, 0, 0.999f}));
}

// `pixel`: where the pointer is in the picture.
int bodilessLampAt(const EditableHome& home, const HomeState& state, const RayScene& rays, const Pointer& pointer,
                   Vec2 pixel) {
  const CameraRays view(pointer.camera, pointer.size.first, pointer.size.second);
  int best = -1;
  float nearest = kLampPixels * static_cast<float>(pointer.size.second) / std::max(1.0f, pointer.viewportHeightPx);
  for (size_t k = 0; k < home.lamps.size(); ++k) {
    if (!home.lamps[k].instances.empty()) continue;
    const Vec3 place = positionOf(home, k, state);
    const std::optional<Vec2> at = view.pixelOf(place);
    if (!at) continue;
    const float distance = std::hypot(at->x - pixel.x, at->y - pixel.y);
    if (distance < nearest && isSeen(rays, view.ray(at->x, at->y).origin, place))
      best = static_cast<int>(k), nearest = distance;
  }
  return best;
}

}  // namespace

std::optional<PickedPoint> pickAt(const EditableHome& home, const HomeState& state, const RayScene& rays,
                                  const Pointer& pointer) {
  const Vec2 pixel{pointer.x * static_cast<float>(pointer.size.first),
                   pointer.y * static_cast<float>(pointer.size.second)};
  const Ray ray = CameraRays(pointer.camera, pointer.size.first, pointer.size.second).ray(pixel.x, pixel.y);
  const Vec3 eye = pointer.camera.worldFromCamera.w;
  const Hit hit = rays.intersect(ray);
  const int lamp = bodilessLampAt(home, state, rays, pointer, pixel);
  PickedPoint out;
  if (!hit.valid()) {
    if (lamp < 0) return {};
    out.point = positionOf(home, static_cast<size_t>(lamp), state), out.normal = -ray.direction;
    out.distanceM = length(out.point - eye), out.lamp = lamp;
    return out;
  }
  const SurfacePoint p = surfaceAt(rays.scene(), hit, ray.direction);
  out.point = p.p, out.normal = p.ng, out.distanceM = length(p.p - eye), out.material = shownMaterialName(*p.material);
  out.cutHeightM = pointer.camera.cutHeightM;
  out.object = numberOf(home.objects, [&](const EditableObject& o) {
    return !o.lampBody &&
           std::any_of(o.parts.begin(), o.parts.end(), [&](const auto& part) { return part.instance == hit.instance; });
  });
  out.lamp = lamp >= 0 ? lamp : numberOf(home.lamps, [&](const EditableLamp& l) {
    return std::find(l.instances.begin(), l.instances.end(), hit.instance) != l.instances.end();
  });
  return out;
}

std::optional<Metered> meterAt(const LitScene& lit, const PickedPoint& at, Vec3 eye, const std::atomic<bool>& stop) {
  const SurfaceElement element{at.point, at.normal};
  MeterSettings settings;
  settings.tolerance = kTolerance, settings.fewestSamples = kFewest, settings.mostSamples = kMost;
  const std::vector<MeterReading> readings = lit.illuminance({&element, 1}, settings, {{}, &stop});
  Camera camera = cameraAt(eye, normalize(at.point - eye), kSpotRad);
  camera.cutHeightM = at.cutHeightM;
  const Image spot = lit.pictureOf(camera, {kSpotPixels, kSpotPixels, kSpotSamples, {}}, {{}, &stop});
  if (stop || readings.empty() || spot.pixels.empty()) return {};
  Metered out;
  out.illuminanceLux = static_cast<double>(luminance(readings[0].illuminanceLux)),
  out.standardErrorLux = readings[0].standardErrorLux;
  for (const Vec3& p : spot.pixels)
    out.luminanceCdM2 += static_cast<double>(luminance(p)) / static_cast<double>(spot.pixels.size());
  return out;
}

}  // namespace roomlight::view
