#include "view/overlaps.h"

#include <algorithm>
#include <cmath>

namespace roomlight::view {
namespace {

constexpr float kAsideM = 0.01f, kUpM = 0.02f;  // by so much, things that touch may be in each other
constexpr float kExactM = 1e-3f, kDeepestM = 0.64f;  // measured to this, and no further
constexpr float kRugHighM = 0.04f, kRugWideM = 0.5f;
constexpr int kWaysAside = 8;

bool moved(const ObjectState& a, const ObjectState& b) { return !(a.move == b.move) || a.turnDeg != b.turnDeg; }
bool changed(const ObjectState& a, const ObjectState& b) {
  return moved(a, b) || a.hidden != b.hidden || a.open != b.open;
}
bool appearedOrMoved(const ObjectState& from, const ObjectState& to) {
  return !to.hidden && (moved(from, to) || from.hidden);
}

bool isAlike(const Affine& a, const Affine& b) {
  const auto near = [](Vec3 p, Vec3 q, float most) { return maxComponent(abs(p - q)) <= most; };
  return near(a.x, b.x, 1e-4f) && near(a.y, b.y, 1e-4f) && near(a.z, b.z, 1e-4f) && near(a.w, b.w, 2e-4f);
}

// Ways to part two things that are in each other by so much: up, down, aside, and aside and up; half of that too, for
// what is parted on one side may meet on the other, as in a recess.
std::vector<Vec3> waysToPart(float depthM) {
  const float upM = std::max(depthM, kUpM);
  std::vector<Vec3> out{{}, {0, upM, 0}, {0, -depthM, 0}};
  for (const float share : {1.0f, 0.5f}) {
    for (int i = 0; i < kWaysAside; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(kWaysAside);
      const Vec3 aside = Vec3{std::cos(angle), 0, std::sin(angle)} * (share * depthM);
      out.push_back(aside);
      out.push_back(aside + Vec3{0, upM, 0});
    }
  }
  return out;
}

// Whether the second stands on the first, which is a rug.
bool standsOnRug(const Bounds3& rug, const Bounds3& b) {
  const Vec3 size = rug.size();
  return size.y <= kRugHighM && std::min(size.x, size.z) >= kRugWideM && b.lo.y >= rug.lo.y - kUpM &&
         b.lo.y <= rug.hi.y;
}

}  // namespace

// Whether two things lie to each other in one state as in the other.
bool Overlaps::lieAlike(size_t a, size_t b, const HomeState& s, const HomeState& t) const {
  const EditableObject &objectA = shapes_.home().objects[a], &objectB = shapes_.home().objects[b];
  if (s.objects[a].open != t.objects[a].open || s.objects[b].open != t.objects[b].open) return false;
  if (!moved(s.objects[a], t.objects[a]) && !moved(s.objects[b], t.objects[b])) return true;
  const auto between = [&](const HomeState& x) {
    return inverse(motionOf(objectA, x.objects[a])) * motionOf(objectB, x.objects[b]);
  };
  // Where b is, seen from a: about its middle, so that turns far from the origin lose no digits.
  const Vec3 middle = objectB.bounds.centre();
  Affine before = between(s), after = between(t);
  before.w = before.point(middle), after.w = after.point(middle);
  return isAlike(before, after);
}

// Whether a, moved by `way`, and b are in each other.
bool Overlaps::isIn(size_t a, size_t b, const HomeState& state, Vec3 way) {
  return shapes_.surfacesMeet(a, b, state, 0, way) || shapes_.isWithin(a, b, state, way) ||
         shapes_.isWithin(b, a, state, -way);
}

// Whether no way of that length parts them.
bool Overlaps::isDeeper(size_t a, size_t b, const HomeState& state, float depthM) {
  const Bounds3 boxA = shapes_.boundsIn(a, state), boxB = shapes_.boundsIn(b, state);
  if (!boxesMeet(boxA, boxB, 0) || standsOnRug(boxA, boxB) || standsOnRug(boxB, boxA)) return false;
  const std::vector<Vec3> ways = waysToPart(depthM);
  return std::all_of(ways.begin(), ways.end(), [&](Vec3 way) { return isIn(a, b, state, way); });
}

// From above; 0: they are not in each other; infinite: too deep to be measured.
float Overlaps::depthM(size_t a, size_t b, const HomeState& state) {
  float low = kExactM, high = kAsideM;
  if (!isDeeper(a, b, state, low)) return 0;
  while (high < kDeepestM && isDeeper(a, b, state, high)) low = high, high *= 2;
  if (high >= kDeepestM) return kInfinity;
  while (high - low > kExactM) {
    const float middle = (low + high) / 2;
    (isDeeper(a, b, state, middle) ? low : high) = middle;
  }
  return high;
}

float Overlaps::allowedM(size_t a, size_t b) {
  const auto [known, isNew] = allowed_.try_emplace(std::minmax(a, b), 0.0f);
  if (isNew && !start_.objects[a].hidden && !start_.objects[b].hidden) known->second = depthM(a, b, start_);
  return known->second;
}

bool Overlaps::runsInto(size_t a, size_t b, const HomeState& state) {
  const Pair pair = std::minmax(a, b);
  if (lieAlike(a, b, start_, state)) {
    allowed_.erase(pair);
    return false;
  }
  if (!isDeeper(a, b, state, kAsideM)) {
    if (!isIn(a, b, state, {})) allowed_[pair] = 0;
    return false;
  }
  const float allowed = allowedM(a, b);
  return allowed == 0 || (std::isfinite(allowed) && isDeeper(a, b, state, allowed + kAsideM));
}

void Overlaps::follow(const HomeState& from, const HomeState& to) {
  const size_t count = to.objects.size();
  const auto isThing = [&](size_t i) { return !shapes_.home().objects[i].lampBody && !to.objects[i].hidden; };
  const auto hasChanged = [&](size_t i) { return changed(from.objects[i], to.objects[i]); };
  std::vector<Overlap> next;
  for (const Overlap& o : list_) {
    if (!isThing(o.thing) || !isThing(o.into)) continue;
    if ((!hasChanged(o.thing) && !hasChanged(o.into)) || lieAlike(o.thing, o.into, from, to) ||
        runsInto(o.thing, o.into, to))
      next.push_back(o);
  }
  const auto isTold = [&](size_t a, size_t b) {
    return std::any_of(next.begin(), next.end(),
                       [&](const Overlap& o) { return std::minmax(o.thing, o.into) == std::minmax(a, b); });
  };
  for (size_t a = 0; a < count; ++a) {
    if (!isThing(a) || !appearedOrMoved(from.objects[a], to.objects[a])) continue;
    const Bounds3 box = shapes_.boundsIn(a, to);
    for (size_t b = 0; b < count; ++b) {
      if (a == b || !isThing(b) || isTold(a, b)) continue;
      const bool goAlong = !from.objects[a].hidden && !from.objects[b].hidden && lieAlike(a, b, from, to);
      if (!goAlong &&
          (boxesMeet(box, shapes_.boundsIn(b, to), 0) || allowed_.count(std::minmax(a, b)) ||
           boxesMeet(shapes_.boundsIn(a, start_), shapes_.boundsIn(b, start_), 0)) &&
          runsInto(a, b, to))
        next.push_back({a, b});
    }
  }
  list_ = std::move(next);
}

}  // namespace roomlight::view
