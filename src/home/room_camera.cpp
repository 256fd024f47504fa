#include "home/cameras.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/parallel.h"
#include "base/random.h"
#include "home/rooms.h"
#include "scene/outline.h"
#include "trace/camera_rays.h"

namespace roomlight::home {
namespace {

constexpr float kEyeM = 1.6f, kMostOfHeight = 0.65f;
constexpr float kNearM = 0.5f, kStandM = 0.35f;
constexpr float kBesideM = 3.2f;           // how far beside a room that is open to a side
constexpr int kPlaces = 14;                // along each side of the room
constexpr int kAround = 96, kUp = 15;  // rays of one place, all around and over kTallDeg to each side of the horizon
constexpr int kHeadings = 32;
constexpr double kAlike = 0.004;  // difference of scores
constexpr float kHalfHighDeg = 26, kHalfWideDeg = 41;  // of the picture: a lens of 21 mm
constexpr float kFov = 2 * kHalfHighDeg * kPi / 180;

struct Look {
  float distanceM = kInfinity;  // to the first surface, not to what is behind panes
  uint32_t kind = kNoHit;  // of surface: material, thing and the way it faces
  bool inRoom = false;
};

using Panorama = std::vector<Look>;  // kUp rows of kAround

float elevation(int row) { return kHalfHighDeg * kPi / 180 * (2 * (static_cast<float>(row) + 0.5f) / kUp - 1); }
float azimuth(int column) { return 2 * kPi * (static_cast<float>(column) + 0.5f) / kAround; }

uint32_t kindOf(const Scene& scene, const Hit& hit) {
  const Vec3 n = abs(hit.ng);
  const uint32_t axis = n.y > std::max(n.x, n.z) ? 0 : n.x > n.z ? 1 : 2;
  const auto material =
      static_cast<uint32_t>(scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)].material);
  return mix32(hit.instance * 3 + axis + 0x9e3779b9u * material) & 0x7fffffffu;
}

// The room's outline follows cells, so that its walls may stand a little beyond.
bool belongsTo(const Room& room, Vec3 p) {
  constexpr float kWallM = 0.35f;
  const bool between = p.y > room.elevationM - kWallM && p.y < room.elevationM + room.heightM + kWallM;
  return between && (contains(room.floor, {p.x, p.z}) || distanceToEdgeM(room.floor, {p.x, p.z}) < kWallM);
}

Panorama lookAround(const RayScene& rays, const Room& room, Vec3 eye) {
  Panorama all(kAround * kUp);
  std::vector<Ray> sent(all.size());
  std::vector<Hit> hits(all.size());
  for (int row = 0; row < kUp; ++row) {
    for (int column = 0; column < kAround; ++column) {
      const float a = azimuth(column), e = elevation(row);
      sent[static_cast<size_t>(row * kAround + column)] = {
          eye, {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)}, 0, kInfinity};
    }
  }
  rays.intersect(sent, hits);
  for (size_t i = 0; i < all.size(); ++i) {
    if (!hits[i].valid()) continue;
    const Vec3 p = sent[i].origin + sent[i].direction * (hits[i].t * 0.995f);
    all[i] = {hits[i].t, kindOf(rays.scene(), hits[i]), belongsTo(room, p)};
  }
  return all;
}

// How good a picture with that heading is.
double scoreOf(const Panorama& all, float heading, double surfaceM2, double farM) {
  double weight = 0, good = 0, seenM2 = 0;
  std::unordered_map<uint32_t, double> things;
  for (int row = 0; row < kUp; ++row) {
    const float e = elevation(row);
    for (int column = 0; column < kAround; ++column) {
      const float aside = std::remainder(azimuth(column) - heading, 2 * kPi);
      if (std::abs(aside) > kHalfWideDeg * kPi / 180) continue;
      // A pixel's share of the picture grows away from its middle.
      const double w = 1 / static_cast<double>(std::cos(aside) * std::cos(aside) * std::cos(aside) * std::cos(e));
      weight += w;
      const Look& look = all[static_cast<size_t>(row * kAround + column)];
      if (look.kind == kNoHit || !look.inRoom) {
        good += look.distanceM > kNearM ? 0.25 * w : -2 * w;  // out of a window, into another room
        continue;
      }
      const double d = static_cast<double>(look.distanceM);
      if (d < static_cast<double>(kNearM)) {
        good -= 3 * w;
        continue;
      }
      const double nearness = d < 1.5 ? 0.2 + 0.8 * (d - 0.5) : 1;
      good += w * std::min(nearness, std::max(0.4, farM / d));
      const double m2 =
          d * d * static_cast<double>(2 * kPi / kAround * 2 * kHalfHighDeg * kPi / 180 / kUp * std::cos(e));
      seenM2 += m2;
      things[look.kind] += w;
    }
  }
  if (!(weight > 0)) return 0;
  // Many things make a picture, one wall does not: the effective number of kinds of surfaces.
  double sum = 0, squares = 0;
  for (const auto& [kind, w] : things) sum += w, squares += w * w;
  const double variety = squares > 0 ? std::min(1.0, std::log2(sum * sum / squares) / 3.5) : 0;
  const double whole = std::min(1.0, seenM2 / (0.6 * surfaceM2));
  return good / weight * (0.15 + 0.5 * whole + 0.35 * variety);
}

// Floor, ceiling and walls, m².
double surfaceOf(const Room& room) {
  double around = 0;
  for (size_t i = 0; i < room.floor.size(); ++i) {
    const Vec2 side = room.floor[(i + 1) % room.floor.size()] - room.floor[i];
    around += std::hypot(static_cast<double>(side.x), static_cast<double>(side.y));
  }
  return 2 * areaM2(room) + around * static_cast<double>(room.heightM);
}

bool canStand(const RayScene& rays, Vec3 eye) {
  for (int i = 0; i < 16; ++i) {
    const float a = 2 * kPi * static_cast<float>(i) / 16;
    if (rays.intersect({eye, {std::sin(a), 0, std::cos(a)}, 0, kStandM}).valid()) return false;
  }
  return !rays.intersect({eye, {0, 1, 0}, 0, 0.2f}).valid() && !rays.intersect({eye, {0, -1, 0}, 0, 0.4f}).valid() &&
         !insideBody(rays, eye);
}

// Whether an eye beside the room looks into it: a wall between would hide all of it, things in it do not.
bool seesRoom(const RayScene& rays, Vec3 eye, Vec2 low, Vec2 high) {
  constexpr int kSide = 5;
  int seen = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const float u = (static_cast<float>(i % kSide) + 0.5f) / kSide, v = (static_cast<float>(i / kSide) + 0.5f) / kSide;
    const Vec3 to = Vec3{low.x + u * (high.x - low.x), eye.y, low.y + v * (high.y - low.y)} - eye;
    seen += rays.intersect({eye, to, 0, 0.98f}).valid() ? 0 : 1;
  }
  return 3 * seen > kSide * kSide;
}

std::vector<Vec3> placesFor(const RayScene& rays, const Room& room) {
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const Vec2 c : room.floor)
    low = {std::min(low.x, c.x), std::min(low.y, c.y)}, high = {std::max(high.x, c.x), std::max(high.y, c.y)};
  const float y = room.elevationM + std::min(kEyeM, kMostOfHeight * room.heightM);
  std::vector<Vec3> places;
  const auto add = [&](float x, float z, bool beside) {
    const Vec3 eye{x, y, z};
    const bool inside = contains(room.floor, {x, z});
    if (inside == beside || !canStand(rays, eye) || (beside && !seesRoom(rays, eye, low, high))) return;
    places.push_back(eye);
  };
  for (int j = 0; j < kPlaces; ++j) {
    for (int i = 0; i < kPlaces; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / kPlaces, v = (static_cast<float>(j) + 0.5f) / kPlaces;
      add(low.x + u * (high.x - low.x), low.y + v * (high.y - low.y), false);
    }
  }
  // Small rooms that are open to a side are looked into from there.
  if (std::max(high.x - low.x, high.y - low.y) < 6) {
    for (const float out : {0.6f, 1.4f, 2.2f, kBesideM}) {
      for (int i = 0; i < 5; ++i) {
        const float s = (static_cast<float>(i) + 0.5f) / 5;
        for (const float side : {0.0f, 1.0f}) {
          const float beyond = side > 0 ? out : -out;
          add((side > 0 ? high.x : low.x) + beyond, low.y + s * (high.y - low.y), true);
          add(low.x + s * (high.x - low.x), (side > 0 ? high.y : low.y) + beyond, true);
        }
      }
    }
  }
  return places;
}

}  // namespace

std::optional<RoomView> viewOf(const RayScene& rays, const Room& room) {
  const std::vector<Vec3> places = placesFor(rays, room);
  struct Best {
    double score = -kInfinity;
    float heading = 0;
  };
  std::vector<Best> best(places.size());
  const double surfaceM2 = surfaceOf(room), farM = std::clamp(0.9 * std::sqrt(areaM2(room)), 6.0, 10.0);
  parallelFor(places.size(), 1, [&](size_t i) {
    const Panorama all = lookAround(rays, room, places[i]);
    for (int h = 0; h < kHeadings; ++h) {
      const float heading = 2 * kPi * static_cast<float>(h) / kHeadings;
      const double score = scoreOf(all, heading, surfaceM2, farM);
      if (score > best[i].score + kAlike) best[i] = {score, heading};
    }
  });
  std::optional<RoomView> out;
  for (size_t i = 0; i < places.size(); ++i) {
    if (out && !(best[i].score > out->score + kAlike))
      continue;  // the first of those that are as good: rounding does not decide
    out.emplace();
    out->score = best[i].score;
    out->camera.name = room.name;
    out->camera.yFovRad = kFov;
    out->camera.worldFromCamera = looking(places[i], {std::sin(best[i].heading), 0, -std::cos(best[i].heading)});
  }
  return out && out->score > 0 ? out : std::nullopt;
}

}  // namespace roomlight::home
