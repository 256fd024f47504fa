// Five clues compare y with z, each from -1 (y) to 1 (z); their weighted sum decides beyond a threshold:
//  plumb     things turned and rounded about the vertical keep surfaces level or upright: their area, of all
//  grounded  what was drawn to stand on the ground starts at 0 of the vertical and lies about 0 of the other axis
//  stands    the points at the bottom reach around the middle of the whole
//  open      rooms without a ceiling and buildings without an underside have more area that looks up than down
//  storey    a home is wider than high, with most area level, and its levels lie as far apart as floor and ceiling
#include "import/up_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace roomlight::importers {
namespace {

constexpr double kClear = 1.5;
constexpr int kY = 1, kZ = 2;

using Three = std::array<double, 3>;

double limited(double v) { return std::clamp(v, -1.0, 1.0); }

// What one pass over all triangles gathers.
struct Areas {
  double all = 0;
  Three signedAll{};       // sum of area times normal
  Three level{}, plumb{};  // of faces that an axis is the normal of; of those and the faces that it lies in
  Three middle{};          // of all surfaces
};

template <class Visit>
void forTriangles(const Scene& scene, Visit&& visit) {
  for (const Instance& i : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    std::vector<Vec3> world;
    world.reserve(mesh.positions.size());
    for (const Vec3 p : mesh.positions) world.push_back(i.worldFromObject.point(p));
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3)
      visit(world[mesh.indices[t]], world[mesh.indices[t + 1]], world[mesh.indices[t + 2]]);
  }
}

Areas measured(const Scene& scene) {
  Areas a;
  forTriangles(scene, [&](Vec3 p, Vec3 q, Vec3 r) {
    const Vec3 n = cross(q - p, r - p);
    const double twice = length(n);
    if (!(twice > 0)) return;
    a.all += twice;
    for (int i = 0; i < 3; ++i) {
      const double share = std::abs(n[i]) / twice;
      a.signedAll[static_cast<size_t>(i)] += n[i];
      if (share > 0.999) a.level[static_cast<size_t>(i)] += twice;
      if (share > 0.999 || share < 0.02) a.plumb[static_cast<size_t>(i)] += twice;
      a.middle[static_cast<size_t>(i)] += twice * (double(p[i]) + q[i] + r[i]) / 3;
    }
  });
  for (double& m : a.middle) m /= a.all;
  return a;
}

// Whether the points within 2 % of the lowest reach around the middle in both other directions.
bool stands(const Scene& scene, const Bounds3& bounds, const Areas& areas, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const float limit = bounds.lo[axis] + 0.02f * bounds.size()[axis];
  Bounds3 feet;
  forTriangles(scene, [&](Vec3 p, Vec3 q, Vec3 r) {
    for (const Vec3 c : {p, q, r}) {
      if (c[axis] <= limit) feet.add(c);
    }
  });
  const auto around = [&](int i) {
    const double middle = areas.middle[static_cast<size_t>(i)], margin = 0.1 * bounds.size()[i];
    return feet.lo[i] < middle - margin && feet.hi[i] > middle + margin;
  };
  return around(u) && around(v);
}

double grounded(const Bounds3& b) {
  const auto onZero = [&](int i) { return std::abs(b.lo[i]) < 0.01f * b.size()[i]; };
  const auto aboutZero = [&](int i) { return std::abs(b.centre()[i]) < 0.1f * b.size()[i]; };
  return (onZero(kZ) && aboutZero(kY) ? 1 : 0) - (onZero(kY) && aboutZero(kZ) ? 1 : 0);
}

// How likely two strong level planes one over the other are floor and ceiling: log of a log-normal about 2.6 m.
double storeyLikelihood(double heightM) {
  const double d = std::log(heightM / 2.6) / 0.2;
  return -d * d / 2;
}

// Area of level faces by height, in slices; distances between the two strongest that are no neighbours.
double strongestStep(const Scene& scene, const Bounds3& bounds, const Areas& areas, int axis) {
  constexpr int kSlices = 256;
  std::array<double, kSlices> slices{};
  const float lo = bounds.lo[axis], size = bounds.size()[axis];
  forTriangles(scene, [&](Vec3 p, Vec3 q, Vec3 r) {
    const Vec3 n = cross(q - p, r - p);
    const double twice = length(n);
    if (!(twice > 0) || std::abs(n[axis]) / twice <= 0.999) return;
    slices[static_cast<size_t>(std::clamp(static_cast<int>((p[axis] - lo) / size * kSlices), 0, kSlices - 1))] += twice;
  });
  const auto strong = [&](int i) {
    return slices[static_cast<size_t>(i)] > 0.15 * areas.level[static_cast<size_t>(axis)];
  };
  double least = 0;
  for (int i = 0, last = -1; i < kSlices; ++i) {
    if (!strong(i)) continue;
    if (last >= 0 && i - last > kSlices / 16) {
      const double step = static_cast<double>(i - last) / kSlices * size;
      least = least > 0 ? std::min(least, step) : step;
    }
    last = i;
  }
  return least;
}

// Compared in the unit in which the likelier of the two is likeliest: files without an axis have no unit either.
double storey(const Scene& scene, const Bounds3& bounds, const Areas& areas, float metresPerUnit) {
  const double stepY = strongestStep(scene, bounds, areas, kY), stepZ = strongestStep(scene, bounds, areas, kZ);
  if (!(stepY > 0 && stepZ > 0)) return 0;
  double best = -1e30, difference = 0;
  for (const double unit : {1.0, 0.01, 0.001, 0.0254, 0.3048}) {
    const double y = storeyLikelihood(stepY * metresPerUnit * unit), z = storeyLikelihood(stepZ * metresPerUnit * unit);
    if (std::max(y, z) > best) best = std::max(y, z), difference = z - y;
  }
  return best > -2 ? limited(difference / 2) : 0;
}

// Lower than wide and deep, with most of the area level; thin plates say nothing.
double flatness(const Bounds3& b, const Areas& areas) {
  const auto flat = [&](int axis) {
    const float h = b.size()[axis], u = b.size()[(axis + 1) % 3], v = b.size()[(axis + 2) % 3];
    const double level = areas.level[static_cast<size_t>(axis)];
    return h < 0.8f * std::min(u, v) && h > 0.05f * std::min(u, v) &&
           level >= areas.level[static_cast<size_t>((axis + 1) % 3)] &&
           level >= areas.level[static_cast<size_t>((axis + 2) % 3)];
  };
  return (flat(kZ) ? 1 : 0) - (flat(kY) ? 1 : 0);
}

// Above 0: z.
double evidence(const Scene& scene, float metresPerUnit) {
  const Bounds3 bounds = scene.bounds();
  const Areas areas = measured(scene);
  if (!(areas.all > 0) || !(minComponent(bounds.size()) > 0)) return 0;
  const double plumb = limited((areas.plumb[kZ] - areas.plumb[kY]) / areas.all / 0.2);
  const double open =
      limited((std::max(areas.signedAll[kZ], 0.0) - std::max(areas.signedAll[kY], 0.0)) / areas.all / 0.1);
  const double standing = (stands(scene, bounds, areas, kZ) ? 1 : 0) - (stands(scene, bounds, areas, kY) ? 1 : 0);
  return 1.25 * plumb + grounded(bounds) + standing + 0.5 * open + 0.75 * flatness(bounds, areas) +
         storey(scene, bounds, areas, metresPerUnit);
}

Affine uprightFrom(UpAxis up) {
  if (up == UpAxis::Z) return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
  if (up == UpAxis::X) return {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {}};
  return {};
}

}  // namespace

UpAxis guessUpAxis(const Scene& scene, float metresPerUnit, UpAxis usual) {
  const double z = evidence(scene, metresPerUnit);
  return z >= kClear ? UpAxis::Z : z <= -kClear ? UpAxis::Y : usual;
}

void turnUpright(Scene& scene, UpAxis up) {
  if (up == UpAxis::Y) return;
  const Affine turn = uprightFrom(up);
  for (Instance& i : scene.instances) i.worldFromObject = turn * i.worldFromObject;
  for (Lamp& l : scene.lamps)
    l.position = turn.point(l.position), l.direction = turn.vector(l.direction), l.up = turn.vector(l.up);
  for (Sun& s : scene.suns) s.toLight = turn.vector(s.toLight);
  for (Camera& c : scene.cameras) c.worldFromCamera = turn * c.worldFromCamera;
}

void standUpright(Scene& scene, std::optional<char> wanted, float metresPerUnit, UpAxis usual, Warnings& warnings) {
  if (wanted) return turnUpright(scene, static_cast<UpAxis>(*wanted));
  const UpAxis up = guessUpAxis(scene, metresPerUnit, usual);
  const auto say = [&](const char* why) {
    warnings.say(fmt::format("the file does not say which axis points up; {} it is taken to be {}; --up decides", why,
                             static_cast<char>(up)));
  };
  if (up != usual) {
    say("by its shapes");
  } else if (up != UpAxis::Y) {
    say("as in most such files");
  }
  turnUpright(scene, up);
}

}  // namespace roomlight::importers
