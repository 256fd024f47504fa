#include "engine/time_plan.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/progress.h"
#include "gather/ray_shader.h"

namespace roomlight {
namespace {

constexpr float kTriedSize = 4;       // voxels that are tried first, in edges of those wanted
constexpr double kGrowth = 1.6;       // light on voxels takes their edge to the power of minus this
constexpr double kLightShare = 0.5;   // of the time, at most
constexpr double kPatience = 1.25;    // of the time that lighting should take: then it is given up
constexpr float kHardlyFiner =
    2.5f;  // voxels not smaller than this, in edges of those wanted, are no gain over those tried
constexpr int kTriedPart = 8;         // of width and height, at most; also the smallest picture
constexpr double kTriedPixels = 500;  // at least
constexpr double kHardlyLarger = 1.3;  // times that: no gain
constexpr double kFilterShare = 0.1;  // of the time of the first pass

}  // namespace

VoxelLight lightVoxelsWithin(double seconds, const TracedScene& scene, const VoxelSettings& voxel,
                             const RadianceSettings& radiance, Stages& stages) {
  const Stopwatch watch;
  const float wanted = chooseVoxelSize(scene.rays.scene(), voxel);
  VoxelSettings tried = voxel;
  tried.voxelSizeM = kTriedSize * wanted;
  VoxelLight light = stages.run("plan", [&](const Progress& p) {
    VoxelLight out;
    out.voxels = voxelise(scene.rays.scene(), tried).voxels;
    out.field = illuminate(scene.rays, scene.lights, out.voxels, radiance, p);
    return out;
  });
  if (stages.cancelled()) return light;
  const double took = watch.seconds(), allowed = kLightShare * seconds - took;
  const float affordable =
      allowed > 0 ? kTriedSize * static_cast<float>(std::pow(took / allowed, 1 / kGrowth)) : kInfinity;
  if (affordable > kHardlyFiner) return light;
  VoxelSettings fine = voxel;
  fine.voxelSizeM = std::max(1.0f, affordable) * wanted;
  VoxelLight finer = lightVoxelsBefore(kPatience * allowed, scene.rays, scene.lights, fine, radiance, stages);
  return finer.field.irradianceLux.empty() ? light : finer;
}

int triedPart(int width, int height) {
  return static_cast<int>(
      std::clamp(std::sqrt(static_cast<double>(width) * height / kTriedPixels), 1.0, static_cast<double>(kTriedPart)));
}

GatheredPicture gatherWithin(double seconds, const TracedScene& scene, const RayShader& shader, const Camera& camera,
                             RayGatherSettings gather, const Progress& progress) {
  const Stopwatch watch;
  const RayGather prepared(scene.rays, scene.lights, shader, camera, gather, progress);
  const double preparing = watch.seconds();
  gather.untilMse = 0, gather.tellsError = false;  // time ends it, and is for the picture
  RayGatherSettings small = withCounts(gather);  // as many rays a pixel as the whole would have
  const int divisor = triedPart(gather.width, gather.height);
  small.width = (gather.width + divisor - 1) / divisor, small.height = (gather.height + divisor - 1) / divisor;
  small.samples = std::min(gather.samples, gather.firstSamples), small.tolerance = 0;
  GatheredPicture tried = prepared.picture(small);
  const double smaller =
      static_cast<double>(gather.width) * gather.height / (static_cast<double>(small.width) * small.height);
  const double took = watch.seconds(), first = (took - preparing) * smaller, left = seconds - took;
  const double part = std::sqrt(std::min(1.0, std::max(0.0, left) / ((1 + kFilterShare) * first)));
  if (progress.stop() || (part < 1 && part < kHardlyLarger / divisor)) return tried;
  const auto shortened = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(part * pixels))); };
  gather.width = shortened(gather.width), gather.height = shortened(gather.height);
  gather.timeLimitS = std::max(1e-3, left - kFilterShare * part * part * first);
  return prepared.picture(gather, progress);
}

Image enlarged(const Image& image, int width, int height) {
  Image out(width, height);
  const auto place = [](int i, int size, int sizeOut, int& low, int& high) {
    const float at =
        std::clamp((static_cast<float>(i) + 0.5f) * static_cast<float>(size) / static_cast<float>(sizeOut) - 0.5f, 0.0f,
                   static_cast<float>(size - 1));
    low = static_cast<int>(at), high = std::min(low + 1, size - 1);
    return at - static_cast<float>(low);
  };
  parallelFor(static_cast<size_t>(height), 8, [&](size_t row) {
    const int y = static_cast<int>(row);
    int x0, x1, y0, y1;
    const float v = place(y, image.height, height, y0, y1);
    for (int x = 0; x < width; ++x) {
      const float u = place(x, image.width, width, x0, x1);
      out.at(x, y) = (image.at(x0, y0) * (1 - u) + image.at(x1, y0) * u) * (1 - v) +
                     (image.at(x0, y1) * (1 - u) + image.at(x1, y1) * u) * v;
    }
  });
  return out;
}

}  // namespace roomlight
