#include "gather/frame.h"

#include <algorithm>
#include <bit>

#include "base/parallel.h"
#include "gather/pixel_rays.h"
#include "trace/bsdf.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;
constexpr size_t kTilesAtOnce = 2;
constexpr float kFewGlossy = 0.25f, kGlossyShare = 0.04f;  // estimates of reflected light that are too few, where it is so much of the whole

// Kept from zero so that light can be divided by it, as the filter has it.
Vec3 divisor(Vec3 albedo) { return max(albedo, Vec3(1e-3f)); }

// A pixel that is to be lit anew.
struct Asked {
  uint32_t pixel;
  PastLight past;
};

PastLight lightOf(const FilterPixel& p, uint32_t instance) {
  PastLight out;
  out.position = p.position, out.normal = p.normal, out.instance = instance;
  out.estimates = p.weight * p.diffuseShare, out.glossy = p.weight * p.specularShare;
  out.irradiance = p.diffuse / divisor(p.albedo), out.sharp = p.sharp / divisor(p.albedo), out.specular = p.specular;
  out.variance = {p.diffuseVariance, p.sharpVariance, p.specularVariance};
  return out;
}

void setLight(const PastLight& l, FilterPixel& p) {
  p.diffuse = l.irradiance * divisor(p.albedo), p.sharp = l.sharp * divisor(p.albedo), p.specular = l.specular;
  p.diffuseVariance = l.variance.x, p.sharpVariance = l.variance.y, p.specularVariance = l.variance.z;
  p.weight = l.estimates, p.diffuseShare = 1, p.specularShare = l.glossy / l.estimates;
}

FilterPixel meanOfWholes(const FilterPixel& a, float n, const FilterPixel& b) {
  const float m = b.weight, s = m / (n + m);
  const auto mean = [s](auto x, auto y) { return x + (y - x) * s; };
  const auto variance = [&](float x, float y) { return (x * n * n + y * m * m) / ((n + m) * (n + m)); };
  FilterPixel out = b;
  out.diffuse = mean(a.diffuse, b.diffuse), out.sharp = mean(a.sharp, b.sharp), out.specular = mean(a.specular, b.specular), out.rest = mean(a.rest, b.rest);
  out.albedo = mean(a.albedo, b.albedo);
  out.diffuseVariance = variance(a.diffuseVariance, b.diffuseVariance), out.sharpVariance = variance(a.sharpVariance, b.sharpVariance);
  out.specularVariance = variance(a.specularVariance, b.specularVariance);
  out.weight = n + m;
  return out;
}

class FrameMaker {
 public:
  FrameMaker(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, const Camera& camera, const PictureSettings& settings, FrameHistory& history)
      : rays_(rays), lights_(lights), shader_(shader), settings_(settings), history_(history), pixelRays_(rays, camera, settings), pixelShader_(rays, lights, settings) {
    const Scene& scene = rays.scene();
    for (const Instance& i : scene.instances) opaque_.push_back(!letsLightThrough(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)]));
  }
  void make(int x0, int y0, GatherCounters& count) const;
  bool wraps() const { return pixelRays_.camera().wraps(); }

 private:
  void see(int x, int y, const Ray& ray, const Hit& hit, std::vector<Asked>& asked) const;
  void light(std::span<const Asked> asked, GatherCounters& count) const;
  bool isTurn(uint32_t pixel, int every) const;

  const RayScene& rays_;
  const Lights& lights_;
  const SurfaceShader& shader_;
  const PictureSettings& settings_;
  FrameHistory& history_;
  const PixelRays pixelRays_;
  const PixelShader pixelShader_;
  std::vector<uint8_t> opaque_;  // a flag an instance
};

bool FrameMaker::isTurn(uint32_t pixel, int every) const {
  const auto w = static_cast<uint32_t>(settings_.width);
  return PixelSequence(static_cast<int>(pixel % w), static_cast<int>(pixel / w), 4 * history_.frame(), settings_.seed, std::bit_floor(static_cast<uint32_t>(every))).gathers();
}

// Keeps what is known of a pixel, or asks for light.
void FrameMaker::see(int x, int y, const Ray& ray, const Hit& hit, std::vector<Asked>& asked) const {
  const auto pixel = static_cast<uint32_t>(y * settings_.width + x);
  const FrameSettings& use = history_.settings();
  FilterPixel& p = history_.pixels().pixels[pixel];
  PastLight& now = history_.light(pixel);
  now = {};
  if (!hit.valid()) {
    p = {};
    p.rest = ray.tMax > 0 ? background(lights_, ray.direction) : Vec3(0);
    return;
  }
  const auto ask = [&](const PastLight& past) { asked.push_back({pixel, past}); };
  const auto whole = [&] {
    now = history_.findWhole(pixel);
    if (!(now.estimates > 0) || isTurn(pixel, use.every)) ask(now);
  };
  if (!opaque_[hit.instance]) return whole();
  const MaterialSample m = materialAt(rays_.scene(), hit);
  if (isMirror(m, false)) return whole();
  const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction, m);
  const PastLight past = history_.find(x, y, {s.p, s.ns, -ray.direction, hit.instance, m.roughness});
  const float specular = luminance(past.specular);
  now.instance = hit.instance;
  if (!(past.estimates > 0) || isTurn(pixel, past.estimates < 1 ? use.everyStale : use.every)) return ask(past);
  const Bsdf bsdf(m, s.ns, s.ng, -ray.direction);
  p = {};
  p.albedo = bsdf.diffuseAlbedo();
  if (past.glossy < kFewGlossy && specular > kGlossyShare * (luminance((past.irradiance + past.sharp) * p.albedo) + specular)) return ask(past);
  p.rest = s.emitted();
  p.normal = s.ns, p.position = s.p, p.roughness = m.roughness, p.surface = 1;
  now = past;
  setLight(now, p);
}

void FrameMaker::light(std::span<const Asked> asked, GatherCounters& count) const {
  thread_local TileWork work;
  thread_local std::vector<SurfaceLight> found;
  std::array<FilterPixel, kTile * kTile> sums;
  std::array<PixelCount, kTile * kTile> counts;
  std::array<Ray, kRaysAtOnce> some;
  const int w = settings_.width;
  work.clear();
  for (size_t i = 0; i < asked.size(); ++i) {
    const int x = static_cast<int>(asked[i].pixel) % w, y = static_cast<int>(asked[i].pixel) / w;
    sums[i] = {}, counts[i] = {};
    const PixelSequence sequence(x, y, 4 * history_.frame(), settings_.seed, std::bit_floor(static_cast<uint32_t>(asked[i].past.estimates >= 1 ? history_.settings().every : 1)));
    pixelShader_.see(pixelRays_.at(x, y, 0, 1, some), sequence, {&sums[i], &counts[i], asked[i].pixel}, work, count);
  }
  found.resize(work.shadings.size());
  shader_.shade(work.shadings, work.shadows, found, count);
  pixelShader_.findOutshining(work, found);
  PixelShader::add(work, found);
  for (size_t i = 0; i < asked.size(); ++i) {
    FilterPixel& p = history_.pixels().pixels[asked[i].pixel];
    PastLight& now = history_.light(asked[i].pixel);
    const FilterPixel fresh = meanOf(sums[i], counts[i]);
    if (now.instance == kNoHit) {
      p = asked[i].past.estimates > 0 ? meanOfWholes(p, asked[i].past.estimates, fresh) : fresh;
      now.estimates = p.weight;
      continue;
    }
    now = together(asked[i].past, lightOf(fresh, now.instance));
    p = fresh;
    setLight(now, p);
  }
}

void FrameMaker::make(int x0, int y0, GatherCounters& count) const {
  const int x1 = std::min(settings_.width, x0 + kTile), y1 = std::min(settings_.height, y0 + kTile);
  thread_local std::vector<Ray> rays;
  thread_local std::vector<Hit> hits;
  thread_local std::vector<Asked> asked;
  rays.clear(), asked.clear();
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) rays.push_back(pixelRays_.ray(x, y, 0));
  }
  hits.resize(rays.size());
  rays_.intersectClose(rays, hits);
  count.rays += rays.size();
  size_t i = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x, ++i) see(x, y, rays[i], hits[i], asked);
  }
  light(asked, count);
}

}  // namespace

Image gatherView(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, const Camera& camera, const PictureSettings& settings, FrameHistory* history, const Progress& progress) {
  if (history && history->settings().reuse && settings.samples == 1) return gatherFrame(rays, lights, shader, camera, settings, *history, progress);
  return gatherPicture(rays, lights, shader, camera, settings, progress).image;
}

Image gatherFrame(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, const Camera& camera, const PictureSettings& settings, FrameHistory& history, const Progress& progress) {
  PictureSettings use = settings;
  use.samples = 1;
  history.begin(camera, use.width, use.height);
  const FrameMaker maker(rays, lights, shader, camera, use, history);
  const size_t across = static_cast<size_t>((use.width + kTile - 1) / kTile), tiles = across * static_cast<size_t>((use.height + kTile - 1) / kTile);
  parallelRanges(tiles, kTilesAtOnce, [&](size_t begin, size_t end) {
    GatherCounters count;
    for (size_t tile = begin; tile < end; ++tile) {
      if (progress.stop()) return;
      maker.make(static_cast<int>(tile % across) * kTile, static_cast<int>(tile / across) * kTile, count);
    }
  });
  if (progress.stop()) {
    history.forget();
    return {};
  }
  Image out = use.filterPasses > 0 ? filtered(history.pixels(), use.filterPasses, maker.wraps()) : composed(history.pixels());
  history.end();
  return out;
}

}  // namespace roomlight
