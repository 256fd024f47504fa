#include "view/thing_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace roomlight::view {
namespace {

constexpr float kFootM = 0.01f;  // what is no higher above its lowest point touches the floor
constexpr int kFootCells = 8;    // on a side of the grid of its footing
constexpr size_t kMostProbes = 4;
constexpr float kSmallerM = 5e-4f;

// What makes a thing smaller on each side of its box.
Affine smaller(const Bounds3& b) {
  const Vec3 size = max(b.size(), Vec3(4 * kSmallerM)), factor = (size - Vec3(2 * kSmallerM)) / size, c = b.centre();
  return {{factor.x, 0, 0}, {0, factor.y, 0}, {0, 0, factor.z}, c - c * factor};
}

// One point for each cell of a grid that what touches the floor reaches into.
class Footprint {
 public:
  Footprint(const Bounds3& around, float heightM) : lo_(around.lo), heightM_(heightM) {
    cell_ = max(around.size(), Vec3(1e-4f)) / static_cast<float>(kFootCells);
  }
  void addPoint(Vec3 p) {
    const int i = index((p.x - lo_.x) / cell_.x), k = index((p.z - lo_.z) / cell_.z);
    mark(i, k, {p.x, heightM_, p.z});
  }
  // The middles of the cells that it covers.
  void addTriangle(const Corners& q) {
    Bounds3 b;
    for (const Vec3 p : q) b.add(p);
    for (int i = index((b.lo.x - lo_.x) / cell_.x); i <= index((b.hi.x - lo_.x) / cell_.x); ++i) {
      for (int k = index((b.lo.z - lo_.z) / cell_.z); k <= index((b.hi.z - lo_.z) / cell_.z); ++k) {
        const Vec3 middle{lo_.x + (static_cast<float>(i) + 0.5f) * cell_.x, heightM_,
                          lo_.z + (static_cast<float>(k) + 0.5f) * cell_.z};
        if (covers(q, middle)) mark(i, k, middle);
      }
    }
  }
  std::vector<Vec3> points() const {
    std::vector<Vec3> out;
    for (const std::optional<Vec3>& p : cells_) {
      if (p) out.push_back(*p);
    }
    return out;
  }

 private:
  static int index(float v) { return std::clamp(static_cast<int>(v), 0, kFootCells - 1); }
  void mark(int i, int k, Vec3 p) {
    std::optional<Vec3>& cell = cells_[static_cast<size_t>(i * kFootCells + k)];
    if (!cell) cell = p;
  }
  // Seen from above.
  static bool covers(const Corners& q, Vec3 p) {
    const auto side = [&](Vec3 a, Vec3 b) { return (b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x); };
    const float s = side(q[0], q[1]), t = side(q[1], q[2]), u = side(q[2], q[0]);
    return (s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0);
  }

  Vec3 lo_, cell_;
  float heightM_;
  std::array<std::optional<Vec3>, size_t{kFootCells} * kFootCells> cells_{};
};

}  // namespace

ThingShapes::ThingShapes(const EditableHome& home, const Scene& atRest)
    : home_(home), scene_(atRest), trees_(home.objects.size()), footings_(home.objects.size()) {
  for (const EditableObject& o : home.objects) bounds_.add(o.bounds);
}

Bounds3 ThingShapes::boundsIn(size_t thing, const HomeState& state) const {
  return boundsOf(home_.objects[thing], state.objects[thing]);
}

TriangleTree& ThingShapes::treeOf(size_t thing, size_t part) {
  const EditableObject& object = home_.objects[thing];
  std::vector<std::unique_ptr<TriangleTree>>& trees = trees_[thing];
  trees.resize(object.parts.size());
  if (!trees[part]) {
    const EditableObject::Part& p = object.parts[part];
    trees[part] = std::make_unique<TriangleTree>(scene_.meshes[static_cast<size_t>(p.mesh)], p.atRest);
  }
  return *trees[part];
}

bool ThingShapes::surfacesMeet(size_t a, size_t b, const HomeState& state, float reachM, Vec3 offset) {
  const EditableObject &objectA = home_.objects[a], &objectB = home_.objects[b];
  const Bounds3 whole = boundsIn(b, state);
  for (size_t i = 0; i < objectA.parts.size(); ++i) {
    Affine motion = motionOf(objectA, objectA.parts[i], state.objects[a]);
    motion.w += offset;
    if (reachM == 0) motion = motion * smaller(objectA.bounds);
    const Bounds3 box = movedBounds(objectA.parts[i].bounds, motion);
    if (!boxesMeet(box, whole, reachM)) continue;
    for (size_t k = 0; k < objectB.parts.size(); ++k) {
      const Affine motionB = motionOf(objectB, objectB.parts[k], state.objects[b]);
      if (!boxesMeet(box, movedBounds(objectB.parts[k].bounds, motionB), reachM)) continue;
      if (trianglesMeet(treeOf(a, i), treeOf(b, k), inverse(motionB) * motion, reachM)) return true;
    }
  }
  return false;
}

void ThingShapes::addLineCrossings(size_t thing, const HomeState& state, Vec3 from, Vec3 to,
                                   std::vector<LineCrossing>& out) {
  const EditableObject& object = home_.objects[thing];
  for (size_t k = 0; k < object.parts.size(); ++k) {
    const Affine back = inverse(motionOf(object, object.parts[k], state.objects[thing]));
    Bounds3 line;
    line.add(back.point(from)), line.add(back.point(to));
    if (boxesMeet(line, object.parts[k].bounds, 1e-4f))
      addCrossings(treeOf(thing, k), back.point(from), back.point(to), out);
  }
}

// Whichever way one leaves it, the first surface is met from its back, and one more is left than entered: a room whose
// walls look inwards holds its things without them being inside of anything.
bool ThingShapes::isInside(Vec3 p, size_t thing, const HomeState& state) {
  const float far = length(boundsIn(thing, state).size()) + 1;
  std::vector<LineCrossing> met;
  for (const Vec3 way : {Vec3{0.302f, 0.931f, 0.207f}, Vec3{-0.811f, 0.146f, 0.566f}, Vec3{0.417f, -0.538f, -0.732f}}) {
    met.clear();
    addLineCrossings(thing, state, p, p + way * far, met);
    if (met.size() % 2 == 0) return false;
    const auto first = std::min_element(met.begin(), met.end(),
                                        [](const LineCrossing& a, const LineCrossing& b) { return a.t < b.t; });
    if (first->cosine < 0) return false;
  }
  return true;
}

bool ThingShapes::isWithin(size_t a, size_t b, const HomeState& state, Vec3 offset) {
  const EditableObject& object = home_.objects[a];
  const Bounds3 whole = boundsIn(b, state);
  for (size_t i = 0; i < std::min(object.parts.size(), kMostProbes); ++i) {
    Affine motion = motionOf(object, object.parts[i], state.objects[a]);
    motion.w += offset;
    motion = motion * smaller(object.bounds);
    const Bounds3 box = movedBounds(object.parts[i].bounds, motion);
    if (minComponent(min(box.lo - whole.lo, whole.hi - box.hi)) < 0) continue;
    if (isInside(motion.point(treeOf(a, i).triangle(0)[0]), b, state)) return true;
  }
  return false;
}

bool ThingShapes::isNear(Vec3 p, size_t thing, const HomeState& state, float reachM) {
  const EditableObject& object = home_.objects[thing];
  bool found = false;
  for (size_t i = 0; i < object.parts.size() && !found; ++i) {
    const Vec3 at = inverse(motionOf(object, object.parts[i], state.objects[thing])).point(p);
    Bounds3 point;
    point.add(at);
    visitTriangles(
        treeOf(thing, i), [&](const Bounds3& b) { return !found && boxesMeet(point, b, reachM); },
        [&](const Corners& q) { found = found || length(nearestOn(q, at) - at) <= reachM; });
  }
  return found;
}

std::vector<Vec3> ThingShapes::findFooting(size_t thing) {
  const EditableObject& object = home_.objects[thing];
  const float lowest = object.bounds.lo.y, highest = lowest + kFootM;
  const auto isLow = [&](Vec3 p) { return p.y <= highest; };
  const auto visitLow = [&](const auto& visit) {
    for (size_t i = 0; i < object.parts.size(); ++i)
      visitTriangles(
          treeOf(thing, i), [&](const Bounds3& b) { return b.lo.y <= highest; }, visit);
  };
  Bounds3 around;
  visitLow([&](const Corners& q) {
    for (const Vec3 p : q) {
      if (isLow(p)) around.add(p);
    }
  });
  Footprint footprint(around, lowest);
  visitLow([&](const Corners& q) {
    if (std::all_of(q.begin(), q.end(), isLow)) footprint.addTriangle(q);
  });
  visitLow([&](const Corners& q) {
    for (const Vec3 p : q) {
      if (isLow(p)) footprint.addPoint(p);
    }
  });
  return footprint.points();
}

std::vector<Vec3> ThingShapes::footing(size_t thing, const HomeState& state) {
  std::vector<Vec3>& atRest = footings_[thing];
  if (atRest.empty()) atRest = findFooting(thing);
  std::vector<Vec3> out = atRest;
  const Affine motion = motionOf(home_.objects[thing], state.objects[thing]);
  for (Vec3& p : out) p = motion.point(p);
  return out;
}

}  // namespace roomlight::view
