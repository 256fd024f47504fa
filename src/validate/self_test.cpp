#include "validate/self_test.h"

#include <cmath>
#include <numbers>

#include "engine/render.h"
#include "scene/primitives.h"

namespace roomlight {
namespace {

constexpr float kHalfEdgeM = 2, kAlbedo = 0.5f, kFluxLm = 1000;
constexpr int kSide = 256, kPathSamples = 32;  // pixels
constexpr double kMostSeconds = 30;

double meanLuminance(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += static_cast<double>(luminance(image.at(x, y)));
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

double samplesOf(const RenderStats& stats) {
  for (const auto& [name, value] : stats.numbers) {
    if (name == "samples") return value;
  }
  return 0;
}

}  // namespace

KnownPicture knownPicture() {
  KnownPicture out;
  const float e = kHalfEdgeM;
  const int grey = addMaterial(out.scene, lambertian(kAlbedo));
  addRoom(out.scene, {-e, -e, -e}, {e, e, e}, std::vector<int>(6, grey));
  out.scene.lamps.push_back(pointLamp({0, 0, 0}, kFluxLm / (4 * kPi)));
  out.camera.worldFromCamera = looking({0, 0, 0}, {0, -1, 0});
  out.camera.projection = Projection::Orthographic;
  out.camera.yMagM = e;
  const double area = 6 * 4 * double{e} * e;
  out.meanCdM2 = kAlbedo / std::numbers::pi * kFluxLm / ((1 - kAlbedo) * area);
  return out;
}

Result<SelfTest> selfTest(const std::string& technique, double allowedPercent, const Progress& progress) {
  const KnownPicture known = knownPicture();
  RenderSettings settings;
  settings.technique = technique;
  settings.width = settings.height = kSide;
  if (technique == technique::kPath) settings.samples = kPathSamples, settings.timeLimitS = kMostSeconds;
  RenderProgress stages;
  stages.report = [&](const std::string&, float fraction) { progress.at(fraction); };
  stages.cancelled = progress.cancelled;
  const Stopwatch watch;
  const Result<Rendered> rendered = render(known.scene, known.camera, settings, stages);
  if (!rendered) return Error{rendered.error()};
  SelfTest out;
  out.technique = technique;
  out.seconds = watch.seconds();
  out.expectedCdM2 = known.meanCdM2;
  out.complete = rendered.value().complete;
  if (!out.complete) return out;
  out.meanCdM2 = meanLuminance(rendered.value().image);
  out.errorPercent = 100 * (out.meanCdM2 / out.expectedCdM2 - 1);
  out.pass = std::abs(out.errorPercent) <= allowedPercent;
  out.samplesPerSecond = samplesOf(rendered.value().stats) * kSide * kSide / out.seconds;
  return out;
}

}  // namespace roomlight
