#include "measure/meter_place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "measure/lattice.h"

namespace roomlight {
namespace {

constexpr float kThickestWallM = 0.65f, kLeastWallHeightM = 2.2f, kLeastWallLengthM = 2;
constexpr float kParallel = 0.9f;  // cosine
constexpr float kHollowM = 1.2f;   // no room is so small in every direction
constexpr int kLevelRays = 16;
constexpr float kFarM = 100;  // what is farther away encloses nothing
constexpr int kOpenSides = 7, kOpenSidesUnderRoof = 9;  // of the level rays

struct Look {
  float distanceM = kInfinity;
  bool back = false;  // of a face
  Vec3 normal;        // of the face, to either side
  uint32_t instance = kNoHit;
  bool met() const { return distanceM < kFarM; }
};

Look look(const RayScene& rays, Vec3 p, Vec3 direction) {
  const Hit hit = rays.intersect({p, direction, 1e-4f, kFarM});
  return hit.valid() ? Look{hit.t, dot(hit.ng, direction) > 0, normalize(hit.ng), hit.instance} : Look{};
}

// Level rays first, k and k + 8 opposite, then up and down.
std::array<Look, kLevelRays + 2> lookAround(const RayScene& rays, Vec3 p) {
  std::array<Look, kLevelRays + 2> seen;
  for (int k = 0; k < kLevelRays; ++k) {
    const float angle = 2 * kPi * static_cast<float>(k) / kLevelRays;
    seen[static_cast<size_t>(k)] = look(rays, p, {std::cos(angle), 0, std::sin(angle)});
  }
  seen[kLevelRays] = look(rays, p, {0, 1, 0}), seen[kLevelRays + 1] = look(rays, p, {0, -1, 0});
  return seen;
}

// Two backs of faces that are parallel and close together. A corner of a room whose faces look outwards has no such.
bool isPair(const Look& a, const Look& b) {
  return a.back && b.back && a.distanceM + b.distanceM <= kThickestWallM &&
         std::abs(dot(a.normal, b.normal)) > kParallel;
}

// The first of two level rays that meet the sides of something thin; null: none.
const Look* thinSides(const std::array<Look, kLevelRays + 2>& seen) {
  for (size_t k = 0; k < kLevelRays / 2; ++k) {
    if (isPair(seen[k], seen[k + kLevelRays / 2])) return &seen[k];
  }
  return nullptr;
}

bool isInWall(const std::array<Look, kLevelRays + 2>& seen) {
  const auto fronts = std::count_if(seen.begin(), seen.end(), [](const Look& l) { return l.met() && !l.back; });
  const auto backs = std::count_if(seen.begin(), seen.end(), [](const Look& l) { return l.met() && l.back; });
  if (fronts > 2 || (fronts > 0 && backs < 12)) return false;
  return thinSides(seen) || isPair(seen[kLevelRays], seen[kLevelRays + 1]);
}

// Of what is solid and small: as high and as long as walls are?
bool hasSizeOfWall(const Scene& scene, const Look& side) {
  const Vec3 size = instanceBounds(scene, scene.instances[side.instance]).size();
  return size.y >= kLeastWallHeightM && std::max(size.x, size.z) >= kLeastWallLengthM;
}

// In a fridge or a cupboard that has surfaces inside: all around, close by, is one thing that is no room.
bool isInHollowThing(const Scene& scene, const std::array<Look, kLevelRays + 2>& seen) {
  for (const Look& l : seen) {
    if (l.distanceM > kHollowM || scene.instances[l.instance].object != scene.instances[seen[0].instance].object) {
      return false;
    }
  }
  return true;
}

}  // namespace

const char* placeName(MeterPlace place) {
  switch (place) {
    case MeterPlace::Furniture: return "furniture";
    case MeterPlace::Wall: return "wall";
    case MeterPlace::Outdoors: return "outdoors";
    case MeterPlace::Free: break;
  }
  return "free";
}

MeterPlace placeOf(const RayScene& rays, Vec3 p) {
  const auto seen = lookAround(rays, p);
  if (insideThing(rays, p)) {
    const Look* side = thinSides(seen);
    return side && hasSizeOfWall(rays.scene(), *side) ? MeterPlace::Wall : MeterPlace::Furniture;
  }
  if (isInHollowThing(rays.scene(), seen)) return MeterPlace::Furniture;
  if (isInWall(seen)) return MeterPlace::Wall;
  const auto open = std::count_if(seen.begin(), seen.begin() + kLevelRays, [](const Look& l) { return !l.met(); });
  return open >= (seen[kLevelRays].met() ? kOpenSidesUnderRoof : kOpenSides) ? MeterPlace::Outdoors : MeterPlace::Free;
}

LatticePlaces leaveOutMisplaced(const RayScene& rays, MeterGrid& lattice, bool roofs) {
  std::vector<size_t> cells;
  for (size_t i = 0; i < lattice.used.size(); ++i) {
    if (lattice.used[i]) cells.push_back(i);
  }
  std::vector<MeterPlace> places(cells.size());
  parallelFor(cells.size(), 16, [&](size_t i) {
    const auto columns = static_cast<size_t>(lattice.columns);
    places[i] =
        placeOf(rays, lattice.centre(static_cast<int>(cells[i] % columns), static_cast<int>(cells[i] / columns)));
    if (places[i] == MeterPlace::Outdoors && !roofs) places[i] = MeterPlace::Free;
  });
  LatticePlaces out;
  out.outdoors = std::count(places.begin(), places.end(), MeterPlace::Outdoors) > 0 &&
                 std::count(places.begin(), places.end(), MeterPlace::Free) == 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    if (places[i] == MeterPlace::Free || (places[i] == MeterPlace::Outdoors && out.outdoors)) continue;
    lattice.used[cells[i]] = 0;
    out.leftOut.push_back({cells[i], places[i]});
  }
  return out;
}

size_t cellsUnderRoof(const RayScene& rays, const MeterGrid& lattice) {
  const std::vector<SurfaceElement> elements = lattice.elements();
  return static_cast<size_t>(std::count_if(elements.begin(), elements.end(), [&](const SurfaceElement& e) {
    return look(rays, e.position, {0, 1, 0}).met();
  }));
}

}  // namespace roomlight
