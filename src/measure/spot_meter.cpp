#include "measure/spot_meter.h"

#include <cmath>

namespace roomlight {
namespace {

constexpr int kPixels = 16;  // a side

}  // namespace

Camera cameraAt(Vec3 position, Vec3 direction, float yFovRad) {
  const Vec3 back = -direction;
  const Vec3 upwards = std::abs(direction.y) < 0.999f ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
  const Vec3 right = normalize(cross(upwards, back));
  Camera camera;
  camera.worldFromCamera = {right, cross(back, right), back, position};
  camera.yFovRad = yFovRad;
  camera.aspect = 1;
  return camera;
}

std::vector<SpotReading> readSpots(const LitScene& lit, std::span<const SpotPlan> plans, const Progress& progress) {
  std::vector<SpotReading> list;
  for (const SpotPlan& plan : plans) {
    if (progress.stop()) break;
    const Image image = lit.picture(
        cameraAt(plan.position, plan.direction, static_cast<float>(plan.angleDeg) * kPi / 180), kPixels, kPixels);
    double sum = 0;
    for (const Vec3& p : image.pixels) sum += static_cast<double>(luminance(p));
    list.push_back({plan, sum / static_cast<double>(std::max<size_t>(1, image.pixels.size()))});
    progress.at(static_cast<float>(list.size()) / static_cast<float>(plans.size()));
  }
  return list;
}

}  // namespace roomlight
