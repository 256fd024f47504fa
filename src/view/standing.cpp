#include "view/standing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace roomlight::view {
namespace {

constexpr float kStandsM = 0.02f;   // between a thing and what it stands on
constexpr float kHoversM = 0.1f;    // from what does not move: it was meant to stand or hang there
constexpr float kTouchesM = 0.01f;  // between things that are joined
constexpr float kLevel = 0.5f;      // cosine: what is steeper is no surface to stand on
constexpr float kFlatM = 0.04f;     // rugs and mats: what stands on them stands on the floor
constexpr float kLampSlackM = 0.05f;
constexpr float kLampReachM = 0.3f;  // from a lamp to the surface of its thing

// What a thing stands on: how many of its lowest points each thing holds.
using Holders = std::map<size_t, int>;

float volume(const Bounds3& b) {
  const Vec3 size = max(b.size(), Vec3(1e-3f));
  return size.x * size.y * size.z;
}

Bounds3 shared(const Bounds3& a, const Bounds3& b) {
  Bounds3 out;
  out.lo = max(a.lo, b.lo), out.hi = min(a.hi, b.hi);
  return out;
}

// Whether points lie on all sides of a place, seen from above.
bool surround(const std::vector<Vec3>& points, Vec3 place) {
  std::vector<float> angles;
  for (const Vec3 p : points) {
    if (std::hypot(p.x - place.x, p.z - place.z) < 1e-4f) return true;
    angles.push_back(std::atan2(p.z - place.z, p.x - place.x));
  }
  if (angles.empty()) return false;
  std::sort(angles.begin(), angles.end());
  float widest = angles.front() + 2 * kPi - angles.back();
  for (size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest < kPi * 1.001f;
}

class LoadFinder {
 public:
  LoadFinder(ThingShapes& shapes, size_t root, const HomeState& state)
      : shapes_(shapes), home_(shapes.home()), root_(root), state_(state) {
    for (size_t i = 0; i < home_.objects.size(); ++i) boxes_.push_back(shapes.boundsIn(i, state));
  }

  Load find() {
    moved_.insert(root_);
    for (bool more = true; more;) {
      more = false;
      for (size_t i = 0; i < home_.objects.size(); ++i) {
        if (!moved_.count(i) && isThing(i) && home_.objects[i].movable && isNearMoved(i) && goesAlong(i))
          moved_.insert(i), more = true;
      }
    }
    Load load;
    for (const size_t i : moved_) {
      if (i != root_) load.things.push_back(i);
    }
    for (size_t i = 0; i < home_.lamps.size(); ++i) {
      if (belongsToMoved(i)) load.lamps.push_back(i);
    }
    return load;
  }

 private:
  struct Cluster {  // things that stand on nothing and touch each other
    std::set<size_t> things;
    std::map<size_t, float> joins;  // standing things that they touch, and how far they reach into these
    bool isFixed = false;           // it touches what does not move
    bool isLocked = false;          // it reaches into a standing thing, not only against it
  };

  bool isThing(size_t i) const { return !home_.objects[i].lampBody; }
  bool isFixed(size_t i) const { return !home_.objects[i].movable; }
  bool isNearMoved(size_t i) const {
    return std::any_of(moved_.begin(), moved_.end(),
                       [&](size_t m) { return boxesMeet(boxes_[i], boxes_[m], kStandsM); });
  }
  bool isFlat(size_t i) const { return boxes_[i].size().y <= kFlatM; }

  bool goesAlong(size_t i) {
    const Holders& holders = holdersOf(i);
    if (!holders.empty()) {
      int held = 0, all = 0;
      for (const auto& [thing, points] : holders) all += points, held += moved_.count(thing) ? points : 0;
      return 2 * held > all;
    }
    const std::optional<size_t> join = joinOf(i);
    return join && moved_.count(*join);
  }

  // Empty: it stands on nothing.
  const Holders& holdersOf(size_t i) {
    const auto [known, isNew] = holders_.try_emplace(i);
    if (isNew) known->second = findHolders(i);
    return known->second;
  }

  Holders findHolders(size_t i) {
    const std::vector<Vec3> points = shapes_.footing(i, state_);
    Holders out, below;
    std::vector<Vec3> held, hovering;
    Vec3 middle;
    for (const Vec3 p : points) {
      middle += p / static_cast<float>(points.size());
      const auto [thing, gapM] = under(i, p);
      if (!thing) continue;
      hovering.push_back(p), ++below[*thing];
      if (gapM <= kStandsM) held.push_back(p), ++out[*thing];
    }
    const auto isEnough = [&](const std::vector<Vec3>& some) {
      return !some.empty() && (2 * some.size() >= points.size() || surround(some, middle));
    };
    if (isEnough(held)) return out;
    if (isEnough(hovering)) return below;
    if (boxes_[i].lo.y <= shapes_.bounds().lo.y + kStandsM) return {{i, 1}};  // on ground that the file leaves out
    return {};
  }

  // What is under one of its lowest points, and how near; of movable things only what is near enough to stand on.
  std::pair<std::optional<size_t>, float> under(size_t i, Vec3 p) {
    const Vec3 from = p + Vec3{0, kStandsM, 0}, to = p - Vec3{0, kHoversM, 0};
    std::optional<size_t> fixed, movable;
    float fixedM = kInfinity, movableM = kInfinity;
    std::vector<LineCrossing> met;
    for (size_t k = 0; k < boxes_.size(); ++k) {
      const Bounds3& b = boxes_[k];
      if (k == i || !isThing(k) || p.x < b.lo.x || p.x > b.hi.x || p.z < b.lo.z || p.z > b.hi.z) continue;
      if (b.lo.y > from.y || b.hi.y < to.y || (!isFixed(k) && b.lo.y > p.y - 1e-3f)) continue;
      met.clear();
      shapes_.addLineCrossings(k, state_, from, to, met);
      for (const LineCrossing& c : met) {
        const float gapM = std::abs(c.t * (from.y - to.y) - kStandsM);
        if (std::abs(c.cosine) < kLevel) continue;
        if (isFixed(k) && gapM < fixedM) fixed = k, fixedM = gapM;
        if (!isFixed(k) && gapM <= kStandsM && gapM < movableM) movable = k, movableM = gapM;
      }
    }
    const bool onFloor = fixed && (!movable || fixedM < movableM || (isFlat(*movable) && fixedM <= kFlatM));
    return onFloor ? std::pair(fixed, fixedM) : std::pair(movable, movableM);
  }

  // The standing thing that one which stands on nothing belongs to.
  std::optional<size_t> joinOf(size_t i) {
    if (const auto known = joins_.find(i); known != joins_.end()) return known->second;
    Cluster cluster = clusterAround(i);
    if (cluster.joins.empty() && !cluster.isFixed) addWhatItReachesInto(cluster);
    if (!cluster.isLocked) cluster.isFixed = cluster.isFixed || isNearFixed(cluster);
    std::optional<size_t> best;
    for (const auto& [thing, reach] : cluster.joins) {
      if (!best || reach > cluster.joins[*best]) best = thing;
    }
    if (cluster.isFixed) best.reset();
    for (const size_t c : cluster.things) joins_[c] = best;
    return best;
  }

  Cluster clusterAround(size_t start) {
    Cluster cluster;
    cluster.things = {start};
    std::vector<size_t> open{start};
    while (!open.empty() && !cluster.isFixed) {
      const size_t i = open.back();
      open.pop_back();
      for (size_t k = 0; k < boxes_.size(); ++k) {
        if (!isThing(k) || cluster.things.count(k) || !boxesMeet(boxes_[i], boxes_[k], kTouchesM)) continue;
        if (!shapes_.surfacesMeet(i, k, state_, kTouchesM)) continue;
        if (isFixed(k)) {
          cluster.isFixed = true;
        } else if (k == root_ || !holdersOf(k).empty()) {
          addJoin(cluster, i, k);
        } else {
          cluster.things.insert(k), open.push_back(k);
        }
      }
    }
    return cluster;
  }

  void addWhatItReachesInto(Cluster& cluster) {
    for (const size_t i : cluster.things) {
      for (size_t k = 0; k < boxes_.size(); ++k) {
        if (!isThing(k) || isFixed(k) || cluster.things.count(k) || !boxesMeet(boxes_[i], boxes_[k], 0)) continue;
        if (k == root_ || !holdersOf(k).empty()) addJoin(cluster, i, k);
      }
    }
  }

  void addJoin(Cluster& cluster, size_t i, size_t k) const {
    const Bounds3 common = shared(boxes_[i], boxes_[k]);
    cluster.joins[k] += volume(common);
    cluster.isLocked = cluster.isLocked || minComponent(common.size()) > kTouchesM;
  }

  // A wall cupboard beside a tall one hangs on the wall, even if a gap is left behind it.
  bool isNearFixed(const Cluster& cluster) {
    for (const size_t i : cluster.things) {
      for (size_t k = 0; k < boxes_.size(); ++k) {
        if (isThing(k) && isFixed(k) && boxesMeet(boxes_[i], boxes_[k], kHoversM) &&
            shapes_.surfacesMeet(i, k, state_, kHoversM))
          return true;
      }
    }
    return false;
  }

  bool belongsToMoved(size_t lamp) {
    const EditableLamp& l = home_.lamps[lamp];
    if (l.object >= 0 || l.sources.empty()) return false;
    const Vec3 at = state_.lamps[lamp].position;
    std::optional<size_t> thing = smallestAround(at, 0);
    if (!thing || isFixed(*thing)) thing = smallestAround(at, kLampSlackM);
    return thing && moved_.count(*thing) && shapes_.isNear(at, *thing, state_, kLampReachM);
  }

  std::optional<size_t> smallestAround(Vec3 at, float slackM) const {
    std::optional<size_t> smallest;
    for (size_t i = 0; i < home_.objects.size(); ++i) {
      const Bounds3& b = home_.objects[i].bounds;
      const Vec3 p = inverse(motionOf(home_.objects[i], state_.objects[i])).point(at);
      const bool isAround = minComponent(min(p - b.lo, b.hi - p)) >= -slackM;
      if (isThing(i) && isAround && (!smallest || volume(b) < volume(home_.objects[*smallest].bounds))) smallest = i;
    }
    return smallest;
  }

  ThingShapes& shapes_;
  const EditableHome& home_;
  const size_t root_;
  const HomeState& state_;
  std::vector<Bounds3> boxes_;
  std::set<size_t> moved_;
  std::map<size_t, Holders> holders_;
  std::map<size_t, std::optional<size_t>> joins_;
};

}  // namespace

Load findLoad(ThingShapes& shapes, size_t thing, const HomeState& state) {
  return LoadFinder(shapes, thing, state).find();
}

// Without a turn places are only added to: what goes back is where it was, to the bit.
void carry(const EditableHome& home, const Load& load, size_t thing, bool alone, const HomeState& from,
           HomeState& next) {
  const ObjectState &before = from.objects[thing], &after = next.objects[thing];
  const float turnDeg = alone ? 0 : after.turnDeg - before.turnDeg;
  const Vec3 move = alone ? Vec3() : after.move - before.move;
  const Affine motion = motionOf(home.objects[thing], after) * inverse(motionOf(home.objects[thing], before));
  const auto place = [&](Vec3 p) { return turnDeg == 0 ? p + move : motion.point(p); };
  for (const size_t i : load.things) {
    const Vec3 middle = home.objects[i].bounds.centre();
    const ObjectState& s = from.objects[i];
    next.objects[i].move = turnDeg == 0 ? s.move + move : place(middle + s.move) - middle;
    next.objects[i].turnDeg = s.turnDeg + turnDeg;
  }
  for (const size_t i : load.lamps) {
    const LampState& s = from.lamps[i];
    next.lamps[i].position = place(s.position);
    if (!home.lamps[i].aimed) continue;
    next.lamps[i].direction = turnDeg == 0 ? s.direction : normalize(motion.vector(s.direction));
    next.lamps[i].turnDeg = s.turnDeg + turnDeg;
  }
}

}  // namespace roomlight::view
