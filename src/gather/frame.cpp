#include "gather/frame.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "base/parallel.h"
#include "gather/pixel_rays.h"
#include "trace/bsdf.h"

namespace roomlight {
namespace {

constexpr int kTile = 16;
constexpr size_t kTilesAtOnce = 2;
constexpr int kPlaces = 64;  // of a pixel's camera rays
constexpr float kFewGlossy = 0.25f,
                kGlossyShare =
                    0.04f;  // estimates of reflected light that are too few, where it is so much of the whole

constexpr float kSmooth = 0.08f, kPane = 0.5f,
                kVeilAlbedo = 0.01f;  // of panes: roughness and own diffuse albedo at most, light that passes at least
constexpr int kMostPanes = 16;
constexpr float kLeastLeft = 1e-3f;
constexpr float kGradientM = 0.01f;  // farther apart than this, places may differ in how near their lamps are

// Kept from zero so that light can be divided by it, as the filter has it.
Vec3 divisor(Vec3 albedo) { return max(albedo, Vec3(1e-3f)); }

// A pixel that is to be lit anew.
struct Asked {
  uint32_t pixel;
  int every;  // of so many pixels it is the one whose turn it is
  PastLight past;
};

// A camera ray on its way through panes.
struct Sight {
  uint32_t pixel = 0;
  Ray ray;
  Hit hit;
  Vec3 eye;  // where it began
  Vec3 left{1, 1, 1};  // of what it comes to
  int panes = 0;
  std::span<const Hit> tile;  // what all rays of the tile met first
  Ray reflected;  // by the first pane,
  float paneM = 0;  // which is so far away
};

// As found now, of the surface that `seen` tells of.
PastLight lightOf(const FilterPixel& p, const PastLight& seen) {
  PastLight out;
  out.position = seen.position, out.normal = seen.normal, out.instance = seen.instance, out.whole = seen.whole;
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

// Mean of a pixel over camera rays, n before and those of b.
FilterPixel meanOfWholes(const FilterPixel& a, float n, const FilterPixel& b) {
  const float m = b.weight, s = m / (n + m);
  const auto mean = [](auto x, auto y, float share) { return x + (y - x) * share; };
  const auto variance = [&](float x, float y) { return (x * n * n + y * m * m) / ((n + m) * (n + m)); };
  FilterPixel out;
  out.diffuse = mean(a.diffuse, b.diffuse, s), out.sharp = mean(a.sharp, b.sharp, s),
  out.specular = mean(a.specular, b.specular, s), out.rest = mean(a.rest, b.rest, s);
  out.albedo = mean(a.albedo, b.albedo, s);
  out.diffuseVariance = variance(a.diffuseVariance, b.diffuseVariance),
  out.sharpVariance = variance(a.sharpVariance, b.sharpVariance);
  out.specularVariance = variance(a.specularVariance, b.specularVariance);
  out.surface = mean(a.surface, b.surface, s);
  if (out.surface > 0) {
    const float ofB = b.surface * s / out.surface;
    const Vec3 normal = mean(a.normal, b.normal, ofB);
    out.normal = length(normal) > 0 ? normalize(normal) : b.normal;
    out.position = mean(a.position, b.position, ofB), out.roughness = mean(a.roughness, b.roughness, ofB);
  }
  out.weight = n + m;
  return out;
}

// Which of its camera rays a pixel sends: the first, unless all stands still; then in each turn the next.
size_t placeOf(const FrameHistory& history) {
  const uint32_t every = std::bit_floor(static_cast<uint32_t>(history.settings().everyStill));
  return history.settled() ? (history.framesStill() + every - 1) / every % kPlaces : 0;
}

class FrameMaker {
 public:
  FrameMaker(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, const Camera& camera,
             const PictureSettings& settings, FrameHistory& history)
      : rays_(rays),
        lights_(lights),
        shader_(shader),
        settings_(settings),
        history_(history),
        pixelRays_(rays, camera, settings),
        pixelShader_(rays, lights, settings, false),
        sharp_(rays, lights),
        place_(placeOf(history)) {
    const Scene& scene = rays.scene();
    for (const Instance& i : scene.instances)
      opaque_.push_back(
          !letsLightThrough(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)]));
  }
  void make(int x0, int y0, GatherCounters& count) const;
  bool leftStale() const { return stale_; }  // pixels

 private:
  bool passPane(Sight& sight) const;
  void see(const Sight& sight, std::vector<Sight>& on, std::vector<Asked>& asked) const;
  void seePane(const Sight& sight, std::vector<Asked>& asked) const;
  void seeWhole(const Sight& sight, bool mirror, std::vector<Asked>& asked) const;
  void keep(const Sight& sight, const SeenSurface& seen, const FilterPixel& next, std::vector<Asked>& asked) const;
  void light(std::span<const Asked> asked, GatherCounters& count) const;
  PastLight find(const Sight& sight, const SeenSurface& seen) const;
  bool isReflection(const PastLight& past) const;
  bool isTurn(uint32_t pixel, int every) const;
  bool isAlone(const Sight& sight) const;
  PastLight as(PastLight past, const SeenSurface& seen) const;
  float unshadowed(Vec3 p, Vec3 n) const;

  const RayScene& rays_;
  const Lights& lights_;
  const SurfaceShader& shader_;
  const PictureSettings& settings_;
  FrameHistory& history_;
  const PixelRays pixelRays_;
  const PixelShader pixelShader_;
  const SharpLights sharp_;
  std::vector<uint8_t> opaque_;  // a flag an instance
  const size_t place_;  // of each pixel's camera ray
  mutable std::atomic<bool> stale_ = false;
};

bool FrameMaker::isTurn(uint32_t pixel, int every) const {
  const auto w = static_cast<uint32_t>(settings_.width);
  return PixelSequence(static_cast<int>(pixel % w), static_cast<int>(pixel / w), 4 * history_.frame(), settings_.seed,
                       std::bit_floor(static_cast<uint32_t>(every)))
      .gathers();
}

// Whether no pixel near it that sees the same is lit anew in this frame.
bool FrameMaker::isAlone(const Sight& sight) const {
  if (sight.panes > 0) return true;
  constexpr int kNear = 4;
  const int w = settings_.width, x = static_cast<int>(sight.pixel) % w, y = static_cast<int>(sight.pixel) / w,
            x0 = x / kTile * kTile, y0 = y / kTile * kTile;
  const int x1 = std::min(w, x0 + kTile), bx = x / kNear * kNear, by = y / kNear * kNear;
  for (int j = by; j < std::min(settings_.height, by + kNear); ++j) {
    for (int i = bx; i < std::min(w, bx + kNear); ++i) {
      const Hit& hit = sight.tile[static_cast<size_t>((j - y0) * (x1 - x0) + i - x0)];
      if (hit.instance == sight.hit.instance && hit.triangle == sight.hit.triangle &&
          isTurn(static_cast<uint32_t>(j * w + i), history_.settings().everyStale))
        return false;
    }
  }
  return true;
}

// Light of suns and lamps there, if nothing stood in its way: how it differs between two places of one surface. Of any
// unit.
float FrameMaker::unshadowed(Vec3 p, Vec3 n) const {
  float sum = 0;
  for (size_t i = 0; i < sharp_.count(); ++i) {
    const LightSample l = sharp_.sample(i, p, {0.5f, 0.5f});
    if (l.valid()) sum += luminance(l.radiance) * std::max(0.0f, dot(l.wi, n));
  }
  return sum;
}

// The ray goes on through a pane. False where more than that must be known: of mirrors, and of veils, which have light
// of their own.
bool FrameMaker::passPane(Sight& sight) const {
  const MaterialSample m = materialAt(rays_.scene(), sight.hit);
  const SurfacePoint s = surfaceAt(rays_.scene(), sight.hit, sight.ray.direction, m);
  const Vec3 through = passing(m, *s.material, std::abs(dot(s.ng, sight.ray.direction)));
  if (luminance(through) < kPane || s.m.roughness >= kSmooth || !isBlack(m.emission)) return false;
  if (maxComponent(Bsdf(m, s.ns, s.ng, -sight.ray.direction).diffuseAlbedo()) > kVeilAlbedo) return false;
  if (sight.panes++ == 0) {
    const Vec3 d = sight.ray.direction - s.ns * (2 * dot(sight.ray.direction, s.ns));
    sight.reflected = {offsetOrigin(s.p, s.ng), d, 0, kInfinity};
    sight.paneM = sight.hit.t;
  }
  sight.left *= through;
  sight.ray.origin = offsetOrigin(sight.ray.origin + sight.ray.direction * sight.hit.t, -s.ng);
  sight.ray.tMin = 0;
  return sight.panes < kMostPanes && luminance(sight.left) > kLeastLeft;
}

// Keeps what is known of a pixel, or asks for light. Rays that have to go on are left in `on`.
void FrameMaker::see(const Sight& sight, std::vector<Sight>& on, std::vector<Asked>& asked) const {
  FilterPixel& p = history_.pixel(sight.pixel);
  const Hit& hit = sight.hit;
  if (!hit.valid()) {
    if (sight.panes > 0) return seePane(sight, asked);
    FilterPixel sky;
    sky.rest = sight.ray.tMax > 0 ? background(lights_, sight.ray.direction) : Vec3(0);
    history_.light(sight.pixel) = {};
    p = history_.settled() ? meanOfWholes(p, p.weight, sky) : sky;
    return;
  }
  if (!opaque_[hit.instance]) {
    Sight next = sight;
    if (passPane(next)) {
      on.push_back(next);
    } else {
      seeWhole(sight, false, asked);
    }
    return;
  }
  const MaterialSample m = materialAt(rays_.scene(), hit);
  if (isMirror(m, false)) return seeWhole(sight, true, asked);
  const SurfacePoint s = surfaceAt(rays_.scene(), hit, sight.ray.direction, m);
  const Bsdf bsdf(m, s.ns, s.ng, -sight.ray.direction);
  FilterPixel next;
  next.albedo = sight.left * bsdf.diffuseAlbedo();
  next.rest = sight.left * s.emitted();
  next.normal = s.ns, next.position = veiledPlace(s, sight.left), next.roughness = m.roughness, next.surface = 1;
  keep(sight, {s.p, s.ns, -sight.ray.direction, hit.instance, false, sight.panes > 0 ? 0 : m.roughness, s.p}, next,
       asked);
}

// A pane before the sky: what it reflects is seen behind it, as far as it is before it.
void FrameMaker::seePane(const Sight& sight, std::vector<Asked>& asked) const {
  const Hit hit = rays_.intersect(sight.reflected);
  if (!hit.valid()) {
    history_.light(sight.pixel) = {};
    asked.push_back({sight.pixel, 1, {}});
    return;
  }
  const SurfacePoint s = surfaceAt(rays_.scene(), hit, sight.reflected.direction);
  FilterPixel next;
  next.rest = sight.left * background(lights_, sight.ray.direction);
  keep(sight,
       {s.p, s.ns, -sight.reflected.direction, hit.instance, false, -1,
        sight.eye + sight.ray.direction * (sight.paneM + hit.t)},
       next, asked);
}

// Of mirrors and veils, whose parts are not told apart: all that the pixel showed is found again where it was. What
// mirrors show is not, once the camera moves.
void FrameMaker::seeWhole(const Sight& sight, bool mirror, std::vector<Asked>& asked) const {
  const FrameSettings& use = history_.settings();
  const SurfacePlace s = placeAt(rays_.scene(), sight.hit, sight.ray.direction);
  const SeenSurface seen{s.p, s.ng, -sight.ray.direction, sight.hit.instance, true, 0, s.p};
  PastLight& now = history_.light(sight.pixel);
  PastLight past = find(sight, seen);
  if ((mirror && !history_.still()) || isReflection(past)) past = {};
  now = past;
  now.instance = seen.instance, now.whole = true, now.position = seen.position, now.normal = seen.normal;
  const int every = history_.settled() ? use.everyStill : history_.still() ? use.every : use.everyVeil;
  if (past.estimates < 1 || isTurn(sight.pixel, every)) {
    asked.push_back({sight.pixel, past.estimates < 1 ? 1 : every, past});
    return;
  }
  now.position = past.position;
  FilterPixel& p = history_.pixel(sight.pixel);
  p = history_.pixelBefore(past.pixel);
  p.weight = past.estimates;
}

// Whether what mirrors show is much of a pixel of several surfaces, and is not where it was.
bool FrameMaker::isReflection(const PastLight& past) const {
  if (history_.still() || !(past.estimates > 0) || past.glossy >= kFewGlossy) return false;
  const FilterPixel& p = history_.pixelBefore(past.pixel);
  return luminance(p.specular) > kGlossyShare * luminance(p.diffuse + p.sharp + p.specular + p.rest);
}

PastLight FrameMaker::find(const Sight& sight, const SeenSurface& seen) const {
  const int pixel = static_cast<int>(sight.pixel);
  return history_.find(pixel % settings_.width, pixel / settings_.width, seen);
}

// Light that was found at one place of a surface, at another: nearer to a lamp, or turned to it. What is kept is not
// scaled, else factors would pile up.
PastLight FrameMaker::as(PastLight past, const SeenSurface& seen) const {
  if (isBlack(past.sharp) || lengthSquared(past.position - seen.position) < kGradientM * kGradientM) return past;
  const float before = unshadowed(past.position, past.normal), after = unshadowed(seen.position, seen.normal),
              change = before > 0 ? std::clamp(after / before, 0.5f, 2.0f) : 1;
  past.sharp *= change, past.variance.y *= change * change;
  return past;
}

// `next`: the pixel without its light.
void FrameMaker::keep(const Sight& sight, const SeenSurface& seen, const FilterPixel& next,
                      std::vector<Asked>& asked) const {
  const FrameSettings& use = history_.settings();
  PastLight& now = history_.light(sight.pixel);
  const PastLight past = find(sight, seen);
  const float specular = luminance(past.specular),
              diffuse = luminance((past.irradiance + past.sharp) * next.albedo + next.rest);
  const bool askForGloss = past.glossy < kFewGlossy && specular > kGlossyShare * (diffuse + specular);
  now = past;
  now.instance = seen.instance, now.position = seen.position, now.normal = seen.normal;
  const bool none = !(past.estimates > 0), stale = past.estimates < 1;
  const int every = history_.settled() ? use.everyStill : stale ? use.everyStale : use.every;
  const bool turn = !none && isTurn(sight.pixel, every);
  if (turn || none || history_.settled() || askForGloss || (stale && isAlone(sight))) {
    asked.push_back({sight.pixel, turn ? every : 1, past});
    return;
  }
  now.position = past.position;
  FilterPixel& p = history_.pixel(sight.pixel);
  p = next;
  setLight(as(past, seen), p);
  if (stale) p.weight = 0, stale_ = true;  // its neighbours tell
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
    const PixelSequence sequence(x, y, 4 * history_.frame(), settings_.seed,
                                 std::bit_floor(static_cast<uint32_t>(asked[i].every)));
    pixelShader_.see(pixelRays_.at(x, y, place_, 1, some), sequence, {&sums[i], &counts[i], asked[i].pixel}, work,
                     count);
  }
  found.resize(work.shadings.size());
  shader_.shade(work.shadings, work.shadows, found, count);
  pixelShader_.findOutshining(work, found);
  PixelShader::add(work, found, nullptr);
  for (size_t i = 0; i < asked.size(); ++i) {
    FilterPixel& p = history_.pixel(asked[i].pixel);
    PastLight& now = history_.light(asked[i].pixel);
    const FilterPixel fresh = meanOf(sums[i], counts[i]);
    const PastLight& past = asked[i].past;
    const bool whole = now.whole || now.instance == kNoHit;
    const FilterPixel before = history_.pixelBefore(history_.settled() ? asked[i].pixel : past.pixel);
    if (whole) {
      now.estimates = past.estimates + fresh.weight, now.glossy = past.glossy + fresh.weight;
    } else {
      now = together(past, lightOf(fresh, now));
    }
    if (history_.settled()) {
      p = meanOfWholes(before, before.weight, fresh);
    } else if (whole && past.estimates > 0) {
      p = meanOfWholes(before, past.estimates, fresh);
    } else {
      p = fresh;
      if (!whole) setLight(now, p);
    }
  }
}

void FrameMaker::make(int x0, int y0, GatherCounters& count) const {
  const int x1 = std::min(settings_.width, x0 + kTile), y1 = std::min(settings_.height, y0 + kTile);
  thread_local std::vector<Ray> rays;
  thread_local std::vector<Hit> hits;
  thread_local std::vector<Sight> sights, on;
  thread_local std::vector<Asked> asked;
  sights.clear(), asked.clear();
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const auto pixel = static_cast<uint32_t>(y * settings_.width + x);
      if (history_.settled() && !isTurn(pixel, history_.settings().everyStill)) continue;
      Sight& s = sights.emplace_back();
      s.pixel = pixel, s.ray = pixelRays_.ray(x, y, place_), s.eye = s.ray.origin;
    }
  }
  thread_local std::vector<Hit> first;
  first.clear();
  while (!sights.empty()) {
    rays.clear(), on.clear();
    for (const Sight& s : sights) rays.push_back(s.ray);
    hits.resize(rays.size());
    rays_.intersectClose(rays, hits);
    count.rays += rays.size();
    if (first.empty()) first = hits;
    for (size_t i = 0; i < sights.size(); ++i) {
      sights[i].hit = hits[i], sights[i].tile = first;
      see(sights[i], on, asked);
    }
    sights.swap(on);
  }
  light(asked, count);
}

}  // namespace

Image gatherView(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
                 const PictureSettings& settings, FrameHistory* history, const Progress& progress) {
  if (history && history->settings().reuse && settings.samples == 1 && !settings.white)
    return gatherFrame(scene, shader, camera, settings, *history, progress);
  return gatherPicture(scene.rays, scene.lights, shader, camera, settings, progress).image;
}

Image gatherFrame(const TracedScene& scene, const SurfaceShader& shader, const Camera& camera,
                  const PictureSettings& settings, FrameHistory& history, const Progress& progress) {
  PictureSettings use = settings;
  use.samples = kPlaces;
  history.begin(camera, use.width, use.height, scene.lights);
  const FrameMaker maker(scene.rays, scene.lights, shader, camera, use, history);
  const size_t across = static_cast<size_t>((use.width + kTile - 1) / kTile),
               tiles = across * static_cast<size_t>((use.height + kTile - 1) / kTile);
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
  std::vector<Vec3> smooth;
  Image out = use.filterPasses > 0 ? filtered(history.pixels(), use.filterPasses, &smooth) : composed(history.pixels());
  history.end(smooth, maker.leftStale());
  return out;
}

}  // namespace roomlight
