// What roomlight leaves of Embree's speed: the same rays through bare Embree calls in a loop here and through RayScene,
// and the rays of the path tracer with all its shading. One thread; each `..Percent` is of the bare rate by processor
// time, measured in turns so that a busy machine disturbs both alike.
#include <random>

#include "base/parallel.h"
#include "base/sampling.h"
#include "home.h"
#include "reference/path_tracer.h"
#include "trace/camera_rays.h"
#include "trace/embree.h"

namespace roomlight::bench {
namespace {

constexpr int kWidth = 480, kHeight = 270;

// The home as one bare Embree scene of opaque triangles.
class BareScene {
 public:
  explicit BareScene(const Scene& scene) : device_(rtcNewDevice(nullptr)), top_(rtcNewScene(device_)) {
    for (const Instance& instance : scene.instances)
      add(scene.meshes[static_cast<size_t>(instance.mesh)], instance.worldFromObject);
    rtcCommitScene(top_);
  }
  ~BareScene() {
    rtcReleaseScene(top_);
    rtcReleaseDevice(device_);
  }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  float trace(const Ray& ray, RayQuery& query) const {
    RTCRayHit r;
    r.ray = {ray.origin.x,
             ray.origin.y,
             ray.origin.z,
             ray.tMin,
             ray.direction.x,
             ray.direction.y,
             ray.direction.z,
             0,
             ray.tMax,
             0xffffffffu,
             0,
             0};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect1(top_, query, &r);
    return r.ray.tfar;
  }

 private:
  void add(const Mesh& mesh, const Affine& transform) {
    if (mesh.triangleCount() == 0) return;
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Vec3*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), mesh.positions.size()));
    std::transform(mesh.positions.begin(), mesh.positions.end(), vertices, [&](Vec3 p) { return transform.point(p); });
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangleCount()));
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    rtcCommitGeometry(g);
    rtcAttachGeometry(top_, g);
    rtcReleaseGeometry(g);
  }

  RTCDevice device_;
  RTCScene top_;
};

std::vector<Ray> primaryRays(const Camera& camera) {
  const CameraRays through(camera, kWidth, kHeight);
  std::vector<Ray> rays;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      rays.push_back(through.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  }
  return rays;
}

// From where the given rays end, in directions like those of diffuse reflection.
std::vector<Ray> bouncedRays(const RayScene& scene, const std::vector<Ray>& from) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Ray> rays;
  for (const Ray& ray : from) {
    const Hit hit = scene.intersect(ray);
    if (!hit.valid()) continue;
    const SurfacePoint p = surfaceAt(scene.scene(), hit, ray.direction);
    const float u = unit(random), v = unit(random);
    rays.push_back({offsetOrigin(p.p, p.ng), Frame(p.ng).toWorld(sampleCosineHemisphere({u, v})), 0, kInfinity});
  }
  return rays;
}

double bareSeconds(const BareScene& bare, const std::vector<Ray>& rays) {
  const double start = cpuSeconds();
  RayQuery query;
  float sum = 0;
  for (const Ray& ray : rays) sum += std::min(bare.trace(ray, query), 1e6f);
  benchmark::DoNotOptimize(sum);
  return cpuSeconds() - start;
}

double ourSeconds(const RayScene& scene, const std::vector<Ray>& rays) {
  const double start = cpuSeconds();
  float sum = 0;
  for (const Ray& ray : rays) sum += std::min(scene.intersect(ray).t, 1e6f);
  benchmark::DoNotOptimize(sum);
  return cpuSeconds() - start;
}

double ourPacketSeconds(const RayScene& scene, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  const double start = cpuSeconds();
  scene.intersect(rays, hits);
  benchmark::DoNotOptimize(hits.data());
  return cpuSeconds() - start;
}

// Counters of one kind of rays: bare rate, and single and eight-wide RayScene in percent of it.
void compareRays(benchmark::State& state, const BareScene& bare, const RayScene& scene, const std::vector<Ray>& rays) {
  double bareS = 0, singleS = 0, packetS = 0;
  for (auto _ : state) {
    bareS += bareSeconds(bare, rays);
    singleS += ourSeconds(scene, rays);
    packetS += ourPacketSeconds(scene, rays);
  }
  const double traced = static_cast<double>(rays.size()) * static_cast<double>(state.iterations());
  state.counters["bareMraysPerS"] = traced / bareS / 1e6;
  state.counters["singlePercent"] = 100 * bareS / singleS;
  state.counters["packetPercent"] = 100 * bareS / packetS;
}

void primary(benchmark::State& state, const Home& home) {
  compareRays(state, BareScene(home.scene), RayScene(home.scene), primaryRays(home.camera));
}

void incoherent(benchmark::State& state, const Home& home) {
  const RayScene scene(home.scene);
  compareRays(state, BareScene(home.scene), scene, bouncedRays(scene, primaryRays(home.camera)));
}

// The path tracer's rays of every kind against bare incoherent rays.
void path(benchmark::State& state, const Home& home) {
  const RayScene scene(home.scene);
  const BareScene bare(home.scene);
  const Lights lights(home.scene);
  const std::vector<Ray> rays = bouncedRays(scene, primaryRays(home.camera));
  PathSettings settings;
  settings.width = kWidth, settings.height = kHeight, settings.samples = 4;
  double bareS = 0, pathS = 0, traced = 0;
  for (auto _ : state) {
    bareS += bareSeconds(bare, rays);
    const double start = cpuSeconds();
    withThreads(1, [&] { traced += static_cast<double>(pathTrace(scene, lights, home.camera, settings).rays); });
    pathS += cpuSeconds() - start;
  }
  const double bareRate = static_cast<double>(rays.size()) * static_cast<double>(state.iterations()) / bareS,
               pathRate = traced / pathS;
  state.counters["bareMraysPerS"] = bareRate / 1e6;
  state.counters["pathMraysPerS"] = pathRate / 1e6;
  state.counters["pathPercent"] = 100 * pathRate / bareRate;
}

}  // namespace
}  // namespace roomlight::bench

int main(int argc, char** argv) {
  using namespace roomlight::bench;
  return runOnHomes(argc, argv, {{"primary", primary}, {"incoherent", incoherent}, {"path", path}});
}
