#include "home/cameras.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sampling.h"
#include "engine/views.h"
#include "home/rooms.h"
#include "trace/camera_rays.h"

namespace roomlight::home {
namespace {

constexpr float kOutsideFov = 0.62f;     // a lens of 38 mm
constexpr float kFrameRatio = 16.0f / 9; // of a usual picture
constexpr float kFill = 1.12f;           // how much farther away than what just fits
constexpr size_t kMostRooms = 40;
constexpr int kSurfacePlaces = 3000;

// Whether light could come to a room: a lamp in it, something that shines, an opening.
bool isLit(const RayScene& rays, const Room& room, const Camera& camera, bool lightComes) {
  if (hasLight(rays.scene(), room)) return true;
  if (!lightComes) return false;
  constexpr int kRays = 512;
  float open = 0;
  for (int i = 0; i < kRays; ++i) {
    const Vec3 d = sampleSphere(latticePoint(i, kRays));
    open += luminance(rays.transmittance({camera.worldFromCamera.w, d, 0, kInfinity}));
  }
  return open > 0.002f * kRays;
}

// What the picture should be filled with: not a wide ground under smaller things.
std::vector<uint32_t> subjectOf(const Scene& scene) {
  const Bounds3 all = scene.bounds();
  std::vector<uint32_t> everything, things;
  Bounds3 ofThings;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Bounds3 b = instanceBounds(scene, scene.instances[i]);
    if (b.empty()) continue;
    everything.push_back(i);
    const Vec3 size = b.size();
    const bool wide = size.x > 0.7f * all.size().x && size.z > 0.7f * all.size().z;
    if (wide && size.y < 0.03f * std::max(size.x, size.z)) continue;
    things.push_back(i), ofThings.add(b);
  }
  const bool smaller =
      !things.empty() && std::max(ofThings.size().x, ofThings.size().z) < 0.7f * std::max(all.size().x, all.size().z);
  return smaller ? things : everything;
}

// Places on surfaces, by area, so that what is seen can be counted.
std::vector<Vec3> surfacePlaces(const Scene& scene, const std::vector<uint32_t>& instances) {
  struct Piece {
    size_t instance;
    size_t triangle;
    double upTo;
  };
  std::vector<Piece> pieces;
  double sum = 0;
  const auto corners = [&](size_t instance, size_t triangle) {
    const Instance& in = scene.instances[instance];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(in.mesh)];
    std::array<Vec3, 3> c;
    for (size_t k = 0; k < 3; ++k) c[k] = in.worldFromObject.point(mesh.positions[mesh.indices[3 * triangle + k]]);
    return c;
  };
  for (const uint32_t i : instances) {
    const size_t count = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangleCount();
    const size_t step = 1 + count / 20000;
    for (size_t t = 0; t < count; t += step) {
      const auto c = corners(i, t);
      sum += 0.5 * static_cast<double>(length(cross(c[1] - c[0], c[2] - c[0]))) * static_cast<double>(step);
      pieces.push_back({i, t, sum});
    }
  }
  std::vector<Vec3> places;
  Rng random(1, 2, 3);
  for (int k = 0; k < kSurfacePlaces && sum > 0; ++k) {
    const double at = (k + static_cast<double>(random.uniform())) / kSurfacePlaces * sum;
    const auto piece =
        std::lower_bound(pieces.begin(), pieces.end(), at, [](const Piece& p, double s) { return p.upTo < s; });
    if (piece == pieces.end()) continue;
    const auto c = corners(piece->instance, piece->triangle);
    const Vec2 b = sampleTriangle(random.uniform2());
    places.push_back(c[0] * (1 - b.x - b.y) + c[1] * b.x + c[2] * b.y);
  }
  return places;
}

// Looks at the middle of the bounds from there, from where all of them just fit into the picture.
Camera framing(const Bounds3& b, Vec3 back) {
  Camera c;
  c.name = "Outside";
  c.yFovRad = kOutsideFov;
  c.worldFromCamera = looking(b.centre(), -back);
  const float up = std::tan(0.5f * kOutsideFov), side = up * kFrameRatio;
  // Of each corner how far the eye has to be from the middle, and how far it lies beside the axis: first the axis, then
  // the distance.
  const auto fit = [&](Vec3 centre) {
    float distance = 0, low = kInfinity, high = -kInfinity;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner{i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z};
      const Vec3 p = corner - centre;
      const float depth = dot(p, c.worldFromCamera.z), x = dot(p, c.worldFromCamera.x), y = dot(p, c.worldFromCamera.y);
      distance = std::max({distance, depth + std::abs(x) / side, depth + std::abs(y) / up});
      low = std::min(low, y), high = std::max(high, y);
    }
    return std::pair(distance, 0.5f * (low + high));
  };
  const float rise = fit(b.centre()).second;
  const Vec3 centre = b.centre() + c.worldFromCamera.y * rise;
  c.worldFromCamera.w = centre + back * (fit(centre).first * kFill);
  return c;
}

// Three-quarter view, from the side and height that show most of the surfaces; glTF's front is +z, so that side is
// tried first.
Camera outside(const RayScene& rays) {
  const std::vector<uint32_t> subject = subjectOf(rays.scene());
  Bounds3 b;
  for (const uint32_t i : subject) b.add(instanceBounds(rays.scene(), rays.scene().instances[i]));
  const std::vector<Vec3> places = surfacePlaces(rays.scene(), subject);
  Camera best;
  double bestScore = -1;
  for (const float elevationDeg : {18.0f, 30.0f, 48.0f}) {
    for (int i = 0; i < 8; ++i) {
      const float azimuth = (35 + 45 * static_cast<float>(i)) * kPi / 180, elevation = elevationDeg * kPi / 180;
      const Vec3 back{std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                      std::cos(azimuth) * std::cos(elevation)};
      const Camera c = framing(b, back);
      std::vector<uint8_t> seen(places.size(), 0);
      parallelFor(places.size(), 128, [&](size_t k) {
        const Vec3 to = places[k] - c.worldFromCamera.w;
        seen[k] = rays.intersect({c.worldFromCamera.w, to, 0, 0.9995f}).valid() ? 0 : 1;
      });
      const double share = static_cast<double>(std::count(seen.begin(), seen.end(), 1)) /
                           std::max<double>(1, static_cast<double>(places.size()));
      const double front = std::cos(static_cast<double>(azimuth));
      const double score = share * (1 + 0.1 * front) * (elevationDeg < 20 ? 1 : elevationDeg < 40 ? 0.93 : 0.75);
      if (score > bestScore) bestScore = score, best = c;
    }
  }
  return best;
}

Camera planOf(const RayScene& rays, const std::vector<Room>& rooms) {
  ViewWish wish;
  wish.view = View::Plan;
  wish.size = {960, 540};
  const Result<Viewed> plan = makeView(rays.scene(), rooms, {}, false, {960, 540}, wish);
  Camera c = plan ? plan.value().camera : Camera();
  c.name = "Plan";
  return c;
}

}  // namespace

std::vector<Camera> proposeCameras(const RayScene& rays, const std::vector<Room>& rooms, bool lightComes) {
  struct Proposal {
    Camera camera;
    double worth = 0;
  };
  std::vector<Proposal> proposals;
  for (size_t i = 0; i < std::min(rooms.size(), kMostRooms); ++i) {
    const std::optional<RoomView> view = viewOf(rays, rooms[i]);
    if (!view) continue;
    const double size = std::sqrt(std::min(80.0, areaM2(rooms[i])));
    proposals.push_back(
        {view->camera, view->score * size * (isLit(rays, rooms[i], view->camera, lightComes) ? 1 : 0.3)});
  }
  std::stable_sort(proposals.begin(), proposals.end(),
                   [](const Proposal& a, const Proposal& b) { return a.worth > b.worth; });
  std::vector<Camera> cameras;
  for (Proposal& p : proposals) cameras.push_back(std::move(p.camera));
  cameras.push_back(outside(rays));
  if (!rooms.empty()) cameras.push_back(planOf(rays, rooms));
  return cameras;
}

std::string faultOf(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera) {
  if (camera.projection != Projection::Perspective) return "";
  constexpr int kAcross = 24, kDown = 14;
  const CameraRays through(camera, kAcross, kDown);
  int met = 0, near = 0, close = 0, inRooms = 0;
  for (int y = 0; y < kDown; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      const Ray ray = through.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Hit hit = rays.intersect(ray);
      if (!hit.valid()) continue;
      ++met;
      const float distance = hit.t * length(ray.direction);
      near += distance < 0.25f ? 1 : 0, close += distance < 0.6f ? 1 : 0;
      const Vec3 p = ray.origin + ray.direction * (hit.t * 0.995f);
      inRooms += std::any_of(rooms.begin(), rooms.end(), [&](const Room& r) { return isIn(r, p); }) ? 1 : 0;
    }
  }
  constexpr int kAll = kAcross * kDown;
  const Vec3 eye = camera.worldFromCamera.w;
  if (near > 0.5 * kAll || (close > 0.5 * kAll && insideBody(rays, eye))) return "stands in a wall or a thing";
  if (met < 0.02 * kAll) return "sees nothing of the scene";
  const bool inside = std::any_of(rooms.begin(), rooms.end(), [&](const Room& r) { return isIn(r, eye); });
  const bool roofed = rays.intersect({eye, {0, 1, 0}, 0, kInfinity}).valid();
  if (!rooms.empty() && !inside && !roofed && inRooms < 0.3 * met) return "stands outside";
  return "";
}

}  // namespace roomlight::home
