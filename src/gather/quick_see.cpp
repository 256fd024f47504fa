#include "gather/quick_maker.h"

#include <algorithm>

#include "base/progress.h"
#include "trace/bsdf.h"

namespace roomlight {
namespace {

constexpr float kNearM = 0.5f;         // of what moved: light has changed there
constexpr float kFootprints = 1.5f;    // how far off it may be, in pixels, and
constexpr float kOffPlane = 0.25f;     // of that off the tangent plane
constexpr uint32_t kLookAgain = 64;    // of so many pixels one is traced, whatever the frame before says
constexpr float kFar = 0.6f;          // pixels
constexpr float kStale = 3;            // pixels off the plane of what is met: of some other place
constexpr int kHidden = 3;              // pixels around one that nothing came to
constexpr float kNearer = 0.96f;       // of a pixel's distance: what is before it

}  // namespace

const QuickFrames::Pixel* QuickFrames::Maker::find(uint32_t key, Vec3 p, Vec3 n) const {
  if (!f_.camera_ || !f_.hasPast_ || f_.changed_.hasMoved(key)) return nullptr;
  const Vec3 c = f_.fromWorld_.point(p);
  if (!(c.z < 0)) return nullptr;
  const float u = f_.pixelScale_.x * c.x / -c.z + 0.5f * static_cast<float>(f_.pastWidth_),
              v = 0.5f * static_cast<float>(f_.pastHeight_) - f_.pixelScale_.y * c.y / -c.z;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(f_.pastWidth_) && v < static_cast<float>(f_.pastHeight_)))
    return nullptr;
  const Vec3 toEye = eye_ - p;
  const float distance2 = lengthSquared(toEye), facing = dot(toEye, n),
              cosine2 = std::max(Rules::kLeastCosine * Rules::kLeastCosine * distance2, facing * facing);
  const float footprint2 = kFootprints * kFootprints * coarser_ * coarser_ * distance2,
              offPlane2 = kOffPlane * kOffPlane * footprint2;
  float nearest = footprint2 * distance2 / cosine2;
  const Pixel* best = nullptr;
  const auto look = [&](int i, int j) {
    const Pixel& q = f_.past_[static_cast<size_t>(j) * static_cast<size_t>(f_.pastWidth_) + static_cast<size_t>(i)];
    if (q.key != key || q.state == kNone) return;
    const Vec3 between = q.position - p;
    const float d2 = lengthSquared(between), off = dot(between, n);
    if (d2 >= nearest || off * off > offPlane2) return;
    if (dot(Vec3{static_cast<float>(q.normalX), static_cast<float>(q.normalY), static_cast<float>(q.normalZ)}, n) <
        Rules::kFacing * 127)
      return;
    nearest = d2, best = &q;
  };
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const float enough = 0.2f * nearest;
  look(i, j);
  if (best && nearest < enough) return best;
  const int di = u - static_cast<float>(i) < 0.5f ? -1 : 1, dj = v - static_cast<float>(j) < 0.5f ? -1 : 1;
  const bool across = i + di >= 0 && i + di < f_.pastWidth_, down = j + dj >= 0 && j + dj < f_.pastHeight_;
  if (across) look(i + di, j);
  if (down) look(i, j + dj);
  if (across && down) look(i + di, j + dj);
  return best;
}

bool QuickFrames::Maker::knowsSky(Vec3 direction) const {
  const Vec3 c = f_.fromWorld_.vector(direction);
  if (!(c.z < 0)) return false;
  const float u = f_.pixelScale_.x * c.x / -c.z + 0.5f * static_cast<float>(f_.pastWidth_),
              v = 0.5f * static_cast<float>(f_.pastHeight_) - f_.pixelScale_.y * c.y / -c.z;
  return u >= 0 && v >= 0 && u < static_cast<float>(f_.pastWidth_) && v < static_cast<float>(f_.pastHeight_) &&
         f_.past_[static_cast<size_t>(v) * static_cast<size_t>(f_.pastWidth_) + static_cast<size_t>(u)].key ==
             Rules::kSky;
}

QuickFrames::Maker::Survey QuickFrames::Maker::survey() const {
  constexpr int kAcross = 12, kDown = 8;
  Work w;
  std::vector<float> distances, lux;
  int known = 0;
  for (int k = 0; k < kAcross * kDown; ++k) {
    Ray ray =
        rayOf((2 * (k % kAcross) + 1) * f_.width_ / (2 * kAcross), (2 * (k / kAcross) + 1) * f_.height_ / (2 * kDown));
    Hit hit = scene_.rays.intersect(ray);
    Vec3 n, p;
    int panes = 0;
    for (; hit.valid(); ++panes) {
      n = hit.ng * (1 / length(hit.ng)), p = ray.origin + ray.direction * hit.t;
      if (dot(n, ray.direction) > 0) n = -n;
      if (panes == Rules::kMostPanes || !clear_[hit.instance] || !paneAt(hit, n, ray.direction, w).clear) break;
      ray = {offsetOrigin(p, -n), ray.direction, 0, kInfinity};
      hit = scene_.rays.intersect(ray);
    }
    known += hit.valid() ? find(hit.instance, p, n) != nullptr : f_.hasPast_ && knowsSky(ray.direction);
    if (!hit.valid()) continue;
    distances.push_back(length(p - eye_));
    if (panes > 0) continue;  // in the light of another room, or of the day outside
    const SlotIrradiance e = receivedAt(hit.instance, p, n);
    lux.push_back(luminance(e.soft + e.sharp));
  }
  // What all but such a share lie below.
  const auto quantile = [](std::vector<float>& of, size_t share, float none) {
    if (of.empty()) return none;
    const auto at = of.end() - 1 - static_cast<std::ptrdiff_t>(of.size() / share);
    std::nth_element(of.begin(), at, of.end());
    return *at;
  };
  return {static_cast<float>(known) / (kAcross * kDown), quantile(distances, 2, kInfinity), quantile(lux, 5, 0)};
}

const QuickFrames::Maker::Pane& QuickFrames::Maker::paneAt(const Hit& hit, Vec3 n, Vec3 direction, Work& w) const {
  constexpr float kSameCosine = 0.01f;
  const Scene& scene = scene_.rays.scene();
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const float cosine = std::abs(dot(n, direction));
  if (w.pane.material == &material && std::abs(w.pane.cosine - cosine) < kSameCosine) return w.pane;
  const MaterialSample m = materialAt(scene, hit);
  const Bsdf bsdf(m, n, n, -direction);
  w.varied.material = &material, w.varied.cosine = cosine;
  w.varied.through = passing(m, material, cosine), w.varied.reflected = bsdf.specularAlbedo();
  w.varied.clear = luminance(w.varied.through) > 0.3f && luminance(bsdf.diffuseAlbedo()) < 0.05f;
  const bool uniform = w.varied.clear && material.alphaMode == AlphaMode::Opaque &&
                       material.baseColorTexture.texture < 0 && material.transmissionTexture.texture < 0 &&
                       mesh.colors.empty();
  if (!uniform) return w.varied;
  w.pane = w.varied;
  return w.pane;
}

void QuickFrames::Maker::see(const Sight& sight, const Met& met, Work& w, Image& out) const {
  const Hit& hit = met.hit;
  if (!hit.valid()) {
    if (f_.lands_) doubt(sight.pixel, Rules::kSky, {}, {}, w);
    if (sight.panes > 0 && luminance(sight.reflectance) > Rules::kLeastReflected) {
      Asked& a = w.asked.emplace_back();
      a.pixel = sight.pixel, a.sight = sight, a.hit = hit, a.n = sight.paneNormal,
      a.lit = isTurnOf(sight.pixel, std::max(1u, f_.everyNew_));
      return;
    }
    storeSky(sight, Vec3(0), out);
    return;
  }
  const Vec3 p = sight.ray.origin + sight.ray.direction * hit.t;
  if (clear_[hit.instance] && sight.panes < Rules::kMostPanes && luminance(sight.left) > Rules::kLeastLeft) {
    // Clear panes are looked through, what veils and leaves let pass belongs to them.
    const Pane& pane = paneAt(hit, met.n, sight.ray.direction, w);
    if (pane.clear) {
      Sight& next = w.on.emplace_back(sight);
      if (next.panes++ == 0) next.panePlace = p, next.paneNormal = met.n, next.reflectance = pane.reflected;
      next.left *= pane.through;
      next.ray = {offsetOrigin(p, -met.n), sight.ray.direction, 0, kInfinity};
      return;
    }
  }
  meet(sight, met, p, w, out);
}

void QuickFrames::Maker::meet(const Sight& sight, const Met& met, Vec3 p, Work& w, Image& out) const {
  const Hit& hit = met.hit;
  if (f_.lands_) doubt(sight.pixel, hit.instance, p, met.n, w);
  const Pixel* known = find(hit.instance, p, met.n);
  const bool stale = known && (f_.stale_ || (anyStale_ && f_.changed_.concern(p, kNearM))),
             waits = known && (stale || known->state == kLent);
  const uint32_t every = !known ? f_.everyNew_ : waits ? f_.everyOld_ : 0;
  const bool turn = every > 0 && isTurnOf(sight.pixel, every);
  if (known && !turn && !stale) {
    // Where this pixel sees it, else two would soon be one. What is far from where its light was found may be lit anew.
    Pixel& q = f_.now_[sight.pixel];
    const float apart2 = lengthSquared(known->position - p), pixel2 = slope_ * slope_ * lengthSquared(p - eye_);
    q = *known;
    q.position = p;
    if (q.state == kLit && apart2 > kFar * kFar * pixel2) q.state = kLent;
    out.pixels[sight.pixel] = q.colour;
    return;
  }
  Asked& a = w.asked.emplace_back();
  a.pixel = sight.pixel, a.sight = sight, a.hit = hit, a.p = p, a.n = met.n, a.lit = turn;
  if (!met.traced) {
    a.hit = scene_.rays.intersect(sight.ray);
    if (!a.hit.valid() || a.hit.instance != hit.instance) a.hit = hit;
  }
  if (known) a.old = known->colour;
}

void QuickFrames::Maker::store(const Asked& a, Vec3 colour, State state, Image& out) const {
  if (!a.hit.valid()) return storeSky(a.sight, colour, out);
  Pixel& q = f_.now_[a.pixel];
  q.position = a.p, q.key = a.hit.instance, q.colour = colour, q.state = state;
  q.normalX = static_cast<int8_t>(std::lround(127 * a.n.x)), q.normalY = static_cast<int8_t>(std::lround(127 * a.n.y)),
  q.normalZ = static_cast<int8_t>(std::lround(127 * a.n.z));
  out.pixels[a.pixel] = colour;
}

// Through panes, which have reflected so much.
void QuickFrames::Maker::storeSky(const Sight& sight, Vec3 reflected, Image& out) const {
  Pixel& q = f_.now_[sight.pixel];
  q = {};
  q.position = sight.ray.direction, q.key = Rules::kSky, q.state = kLit;
  q.colour = reflected + sight.left * background(scene_.lights, sight.ray.direction);
  out.pixels[sight.pixel] = q.colour;
}

// A pixel that nothing came to, between two that see one surface or the sky.
bool QuickFrames::Maker::between(int x, int y, const Pixel* a, const Pixel* b, Image& out) const {
  if (!a || !b || a->key != b->key || a->normalX != b->normalX || a->normalY != b->normalY || a->normalZ != b->normalZ)
    return false;
  const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(f_.width_) + static_cast<size_t>(x);
  Pixel& q = f_.now_[pixel];
  q = *a;
  q.colour = (a->colour + b->colour) * 0.5f;
  q.state = std::min(a->state, b->state);
  const Ray ray = rayOf(x, y);
  if (a->key == Rules::kSky) {
    q.position = ray.direction;
  } else {
    const Vec3 n{static_cast<float>(a->normalX), static_cast<float>(a->normalY), static_cast<float>(a->normalZ)};
    const float towards = dot(ray.direction, n), t = dot(a->position - eye_, n) / towards;
    if (!(t > 0) || std::abs(towards) < 127 * Rules::kLeastCosine) return false;
    q.position = eye_ + ray.direction * t;
  }
  out.pixels[pixel] = q.colour;
  return true;
}

// Whether a pixel is what one of the frame before has become.
bool QuickFrames::Maker::keep(int x, int y, Image& out) const {
  const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(f_.width_) + static_cast<size_t>(x);
  const uint64_t from = f_.landed_[pixel].load(std::memory_order_relaxed);
  if (Rules::isTurn(x, y, f_.frame_, kLookAgain)) return false;
  if (from == Rules::kNothing) {
    const auto row = static_cast<size_t>(f_.width_);
    if (x > 0 && x + 1 < f_.width_ && between(x, y, landedAt(pixel - 1), landedAt(pixel + 1), out)) return true;
    return y > 0 && y + 1 < f_.height_ && between(x, y, landedAt(pixel - row), landedAt(pixel + row), out);
  }
  const Pixel& q = f_.past_[static_cast<uint32_t>(from)];
  if (q.state == kLent && Rules::isTurn(x, y, f_.frame_, f_.everyOld_)) return false;
  // A crack in what is before it: that is on both sides.
  const float limit = kNearer * std::bit_cast<float>(static_cast<uint32_t>(from >> 32));
  const auto isNearer = [&](size_t i) {
    return std::bit_cast<float>(static_cast<uint32_t>(f_.landed_[i].load(std::memory_order_relaxed) >> 32)) < limit;
  };
  const auto w = static_cast<size_t>(f_.width_);
  if (x > 0 && x + 1 < f_.width_ && isNearer(pixel - 1) && isNearer(pixel + 1)) return false;
  if (y > 0 && y + 1 < f_.height_ && isNearer(pixel - w) && isNearer(pixel + w)) return false;
  f_.now_[pixel] = q;
  out.pixels[pixel] = q.colour;
  return true;
}

// Whether what landed where a ray has now met p, or the sky, is of some other place: then more about it may be stale.
// Of an edge it is not, since what is met has landed beside it.
void QuickFrames::Maker::doubt(uint32_t pixel, uint32_t key, Vec3 p, Vec3 n, Work& w) const {
  const int x = static_cast<int>(pixel) % f_.width_, y = static_cast<int>(pixel) / f_.width_;
  const float p2 = lengthSquared(p - eye_), off = kStale * kStale * slope_ * slope_ * p2;
  const auto isSame = [&](const Pixel& q) {
    const float apart = dot(q.position - p, n);
    return q.key == key && (key == Rules::kSky || apart * apart < off);
  };
  const Pixel* own = landedAt(pixel);
  if (own && isSame(*own)) return;
  int hidden = own ? kHidden : 0;
  for (int j = std::max(0, y - 1); j <= std::min(f_.height_ - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(f_.width_ - 1, x + 1); ++i) {
      const Pixel* q = landedAt(static_cast<size_t>(j) * static_cast<size_t>(f_.width_) + static_cast<size_t>(i));
      if (!q) continue;
      if (isSame(*q)) return;
      hidden +=
          key != Rules::kSky && (q->key == Rules::kSky || kNearer * kNearer * lengthSquared(q->position - eye_) > p2);
    }
  }
  if (hidden < kHidden) return;
  constexpr int kReach = 1, kBlocks = Rules::kTile / Rules::kBlock;
  const int x0 = x % Rules::kTile, y0 = y % Rules::kTile;
  for (const int j : {std::max(0, y0 - kReach), std::min(Rules::kTile - 1, y0 + kReach)}) {
    for (const int i : {std::max(0, x0 - kReach), std::min(Rules::kTile - 1, x0 + kReach)})
      w.doubted |= 1u << (j / Rules::kBlock * kBlocks + i / Rules::kBlock);
  }
}

// Pixels of doubted blocks do not keep what came to them.
void QuickFrames::Maker::lookAgain(int x0, int y0, Work& w, Count& count) const {
  constexpr int kBlocks = Rules::kTile / Rules::kBlock;
  const uint32_t blocks = w.doubted & ~w.lookedAt;
  w.lookedAt |= blocks;
  for (uint32_t left = blocks; left; left &= left - 1) {
    const int b = std::countr_zero(left), bx = b % kBlocks * Rules::kBlock, by = b / kBlocks * Rules::kBlock;
    for (int y = by; y < by + Rules::kBlock; ++y) {
      for (int x = bx; x < bx + Rules::kBlock; ++x) {
        bool& kept = w.kept[static_cast<size_t>(y * Rules::kTile + x)];
        if (!kept) continue;
        kept = false;
        --count.kept, ++count.traced;
        Sight& sight = w.on.emplace_back();
        sight.pixel = static_cast<uint32_t>((y0 + y) * f_.width_ + x0 + x), sight.ray = rayOf(x0 + x, y0 + y);
      }
    }
  }
}

// Every other pixel of every other row, and a rim: the rest where these do not tell.
void QuickFrames::Maker::trace(int x0, int y0, int x1, int y1, Work& w) const {
  const auto isSparse = [&](int x, int y) { return ((x & 1) == 0 || x == x1 - 1) && ((y & 1) == 0 || y == y1 - 1); };
  const auto traceAll = [&] {
    w.hits.resize(w.rays.size());
    scene_.rays.intersectClose(w.rays, w.hits);
    for (size_t k = 0; k < w.rays.size(); ++k) {
      Spot& spot = w.spots[w.places[k]];
      spot.hit = w.hits[k], spot.traced = true;
      if (!spot.hit.valid()) continue;
      spot.n = spot.hit.ng * (1 / length(spot.hit.ng));
      if (dot(spot.n, w.rays[k].direction) > 0) spot.n = -spot.n;
    }
    w.rays.clear(), w.places.clear();
  };
  const auto placeOf = [&](int x, int y) { return static_cast<uint32_t>((y - y0) * Rules::kTile + x - x0); };
  w.rays.clear(), w.places.clear();
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      w.spots[placeOf(x, y)].traced = false;
      if (isSparse(x, y)) w.rays.push_back(rayOf(x, y)), w.places.push_back(placeOf(x, y));
    }
  }
  traceAll();
  const auto same = [&](const Spot& a, const Spot& b) {
    return a.hit.valid() ? a.hit.instance == b.hit.instance && a.hit.triangle == b.hit.triangle : !b.hit.valid();
  };
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      if (isSparse(x, y)) continue;
      const int xa = (x & 1) && x < x1 - 1 ? 1 : 0, ya = (y & 1) && y < y1 - 1 ? 1 : 0;
      const Spot& a = w.spots[placeOf(x - xa, y - ya)];
      bool whole = same(a, w.spots[placeOf(x + xa, y + ya)]) && (!a.hit.valid() || !clear_[a.hit.instance]);
      if (xa && ya)
        whole = whole && same(a, w.spots[placeOf(x + xa, y - ya)]) && same(a, w.spots[placeOf(x - xa, y + ya)]);
      if (!whole) {
        w.rays.push_back(rayOf(x, y)), w.places.push_back(placeOf(x, y));
        continue;
      }
      // On the plane of the triangle that all around it see.
      Spot& spot = w.spots[placeOf(x, y)];
      spot.hit = a.hit, spot.n = a.n;
      if (!a.hit.valid()) continue;
      const Ray from = rayOf(x - xa, y - ya), ray = rayOf(x, y);
      spot.hit.t = a.hit.t * dot(from.direction, a.n) / dot(ray.direction, a.n);
    }
  }
  traceAll();
}

void QuickFrames::Maker::make(int x0, int y0, Count& count, Image& out) {
  thread_local Work w;
  const Stopwatch watch;
  w.on.clear(), w.asked.clear();
  w.pane = {}, w.doubted = w.lookedAt = 0;
  const int x1 = std::min(out.width, x0 + Rules::kTile), y1 = std::min(out.height, y0 + Rules::kTile);
  Sight first;
  if (f_.lands_) {
    w.kept.fill(false);
    // Fetched together, not one after the other.
    for (int y = y0; y < y1; ++y) {
      for (size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(out.width) + static_cast<size_t>(x0),
                  end = pixel + static_cast<size_t>(x1 - x0);
           pixel < end; ++pixel) {
        if (const Pixel* q = landedAt(pixel)) __builtin_prefetch(q);
        __builtin_prefetch(&f_.now_[pixel], 1);
      }
    }
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        if (keep(x, y, out)) {
          ++count.kept;
          w.kept[static_cast<size_t>((y - y0) * Rules::kTile + x - x0)] = true;
          continue;
        }
        Sight& sight = w.on.emplace_back();
        sight.pixel = static_cast<uint32_t>(y * out.width + x), sight.ray = rayOf(x, y);
      }
    }
  } else {
    trace(x0, y0, x1, y1, w);
  }
  for (int y = y0; y < y1 && !f_.lands_; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Spot& spot = w.spots[static_cast<size_t>((y - y0) * Rules::kTile + x - x0)];
      first.pixel = static_cast<uint32_t>(y * out.width + x), first.ray = rayOf(x, y);
      see(first, {spot.hit, spot.n, spot.traced}, w, out);
    }
  }
  count.traced += f_.lands_ ? w.on.size() : static_cast<size_t>((x1 - x0) * (y1 - y0));
  while (!w.on.empty()) {
    w.sights.swap(w.on);
    w.rays.clear(), w.on.clear();
    for (const Sight& s : w.sights) w.rays.push_back(s.ray);
    w.hits.resize(w.rays.size());
    scene_.rays.intersectClose(w.rays, w.hits);
    for (size_t i = 0; i < w.sights.size(); ++i) {
      const Hit& hit = w.hits[i];
      Vec3 n = hit.valid() ? hit.ng * (1 / length(hit.ng)) : Vec3();
      if (dot(n, w.sights[i].ray.direction) > 0) n = -n;
      see(w.sights[i], {hit, n, true}, w, out);
    }
    if (w.doubted & ~w.lookedAt) lookAgain(x0, y0, w, count);
  }
  const double seen = watch.seconds();
  if (!w.asked.empty()) light(w, count, out);
  count.otherMs += 1e3 * seen, count.litMs += 1e3 * (watch.seconds() - seen);
}

}  // namespace roomlight
