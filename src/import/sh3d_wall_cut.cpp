#include "import/sh3d_wall_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace roomlight::importers::sh3d {
namespace {

constexpr double kLeastAlong = 0.5;  // cosine between wall and opening
constexpr double kParallel = 0.0175;  // sine: a degree
constexpr double kSmallestCm2 = 0.01;
constexpr double kTouchCm = 1e-3;     // shapes this close are one hole
constexpr double kSteepCm = 0.05;     // ends that run less along an opening stand at a right angle to it
constexpr double kThroughCm = 400;    // how far what cuts both sides reaches into the wall

struct Share {
  double first = 0, last = 1;
};

bool isParallel(const Panel& p, const Opening& o) { return std::abs(o.v(p.b) - o.v(p.a)) < kParallel * p.lengthCm(); }
bool runsAlong(const Panel& p, const Opening& o) {
  return p.isEnd || std::abs(o.u(p.b) - o.u(p.a)) >= kLeastAlong * p.lengthCm();
}

// The part of a panel, as shares of its length, that lies within the opening's depth.
std::optional<Share> withinDepth(const Panel& p, const Opening& o) {
  const double length = p.lengthCm();
  const double va = o.v(p.a), slope = o.v(p.b) - va;
  if (std::abs(slope) < 1e-9 * length) return va >= o.vLow && va <= o.vHigh ? std::optional(Share{}) : std::nullopt;
  const double t0 = (o.vLow - va) / slope, t1 = (o.vHigh - va) / slope;
  const Share s{std::max(0.0, std::min(t0, t1)), std::min(1.0, std::max(t0, t1))};
  return s.first < s.last ? std::optional(s) : std::nullopt;
}

// That part, of (u, h).
PlanRing inFrame(const Panel& p, const Opening& o, Share s) {
  const double ua = o.u(p.a), ub = o.u(p.b);
  const auto u = [&](double t) { return ua + (ub - ua) * t; };
  const auto top = [&](double t) { return p.topACm + (p.topBCm - p.topACm) * t; };
  return {{u(s.first), p.baseCm}, {u(s.last), p.baseCm}, {u(s.last), top(s.last)}, {u(s.first), top(s.first)}};
}

PlanArea sideInFrame(const std::vector<Panel>& side, const Opening& o) {
  PlanArea out;
  for (const Panel& p : side) {
    if (!runsAlong(p, o)) continue;
    if (const auto share = withinDepth(p, o))
      out = out.empty() ? PlanArea{inFrame(p, o, *share)} : united(out, {inFrame(p, o, *share)});
  }
  return out;
}

struct Range {
  double low = 1e300, high = -1e300;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  bool overlaps(Range o) const { return high > o.low && low < o.high; }
};

auto longest(const std::vector<Panel>& side) {
  return std::max_element(side.begin(), side.end(),
                          [](const Panel& p, const Panel& q) { return p.lengthCm() < q.lengthCm(); });
}

struct Bounds {
  Range u, h;
};

// Whether the piece itself touches the wall's body where both are side by side.
bool touches(const WallSides& sides, const Opening& o) {
  Range us, hs, depth;
  for (const PlanRing& ring : o.shape) {
    for (const PlanPoint& q : ring) us.add(q.x), hs.add(q.y);
  }
  for (const auto* side : {&sides.left, &sides.right}) {
    for (const Panel& p : *side) {
      Range u, h;
      u.add(o.u(p.a)), u.add(o.u(p.b)), h.add(p.baseCm), h.add(std::max(p.topACm, p.topBCm));
      if (u.overlaps(us) && h.overlaps(hs)) depth.add(o.v(p.a)), depth.add(o.v(p.b));
    }
  }
  return depth.overlaps({o.vLow, o.vHigh});
}

// The same opening in the frame of another that runs the same way or the opposite one.
std::optional<Opening> inFrameOf(const Opening& frame, const Opening& o) {
  const double cosine = frame.along.x * o.along.x + frame.along.y * o.along.y,
               sine = frame.along.x * o.along.y - frame.along.y * o.along.x;
  if (std::abs(sine) > 1e-4) return {};
  if (cosine > 0) return o;
  Opening turned = o;
  turned.along = frame.along;
  turned.vLow = -o.vHigh, turned.vHigh = -o.vLow;
  for (PlanRing& ring : turned.shape) {
    for (PlanPoint& q : ring) q.x = -q.x;
  }
  return turned;
}

Bounds boundsOf(const PlanArea& shape) {
  Bounds b;
  for (const PlanRing& ring : shape) {
    for (const PlanPoint& q : ring) b.u.add(q.x), b.h.add(q.y);
  }
  return b;
}

bool touchEachOther(const PlanArea& a, const PlanArea& b) {
  const Bounds x = boundsOf(a), y = boundsOf(b);
  const auto near = [](Range r, Range s) { return r.high > s.low - kTouchCm && r.low < s.high + kTouchCm; };
  return near(x.u, y.u) && near(x.h, y.h);
}

// A box-shaped opening as walls across it meet it: its depth is their width. Other shapes cut those walls nowhere.
std::optional<Opening> across(const Opening& o) {
  const Bounds b = boundsOf(o.shape);
  const double box = (b.u.high - b.u.low) * (b.h.high - b.h.low);
  if (areaOf(o.shape) < (1 - 1e-6) * box) return {};
  Opening out = o;
  out.along = {-o.along.y, o.along.x};
  out.shape = {{{o.vLow, b.h.low}, {o.vHigh, b.h.low}, {o.vHigh, b.h.high}, {o.vLow, b.h.high}}};
  out.vLow = kTouchCm - b.u.high, out.vHigh = -b.u.low - kTouchCm;  // walls that the piece only touches stay whole
  out.bothSides = false, out.reachCm = 0;
  return out;
}

// Where a shape lies at one u, as heights of lower and upper borders in turn.
std::vector<double> heightsAt(const PlanArea& shape, double u) {
  std::vector<double> out;
  for (const PlanRing& ring : shape) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      if ((p.x > u) != (q.x > u)) out.push_back(p.y + (q.y - p.y) * (u - p.x) / (q.x - p.x));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Ends are slanted to an opening by mitres, or as the wall is turned against it. Round walls are compared along their
// own ends.
WallSides withEnds(const WallSides& sides, const Opening& o) {
  WallSides out = sides;
  const Panel l = sides.left.back(), r = sides.right.back(), m = sides.left.front(), s = sides.right.front();
  const auto further = [&](const Panel& p, PlanPoint a, PlanPoint b) {
    const double along = sides.straight
                             ? (o.u(a) - o.u(b)) * (o.u(p.b) > o.u(p.a) ? 1 : -1)
                             : ((a.x - b.x) * (p.b.x - p.a.x) + (a.y - b.y) * (p.b.y - p.a.y)) / p.lengthCm();
    return along > kTouchCm;
  };
  if (further(l, l.b, r.b)) out.right.push_back({r.b, l.b, r.baseCm, r.topBCm, l.topBCm, true});
  if (further(l, r.b, l.b)) out.left.push_back({l.b, r.b, l.baseCm, l.topBCm, r.topBCm, true});
  if (further(m, s.a, m.a)) out.right.insert(out.right.begin(), {m.a, s.a, s.baseCm, m.topACm, s.topACm, true});
  if (further(m, m.a, s.a)) out.left.insert(out.left.begin(), {s.a, m.a, m.baseCm, s.topACm, m.topACm, true});
  return out;
}

// Its back is the end of the piece that lies deeper in the wall, without the reach that made it go through.
void makeNiche(WallCut& cut) {
  Opening& o = cut.opening;
  const std::vector<Panel>& side = cut.throughLeft ? cut.sides.left : cut.sides.right;
  const Panel &open = *longest(side), &closed = *longest(cut.throughLeft ? cut.sides.right : cut.sides.left);
  const double towards = o.v(closed.a) + o.v(closed.b) - o.v(open.a) - o.v(open.b);
  double outside = o.v(open.a);
  for (const Panel& p : side)
    outside = towards > 0 ? std::min({outside, o.v(p.a), o.v(p.b)}) : std::max({outside, o.v(p.a), o.v(p.b)});
  cut.backV = towards > 0 ? o.vHigh - o.reachCm : o.vLow + o.reachCm;
  if ((cut.backV - outside) * towards <= 0) o.shape.clear();  // the piece only touches the wall
}

}  // namespace

double Panel::lengthCm() const { return std::hypot(b.x - a.x, b.y - a.y); }
PlanRing Panel::outline() const { return {{0, baseCm}, {lengthCm(), baseCm}, {lengthCm(), topBCm}, {0, topACm}}; }

PlanArea WallCut::holeInEnd(const Panel& panel) const {
  const double ua = opening.u(panel.a), ub = opening.u(panel.b), length = panel.lengthCm();
  if (std::abs(ub - ua) > kSteepCm) return holeIn(panel);
  const auto share = withinDepth(panel, opening);
  if (!share) return {};
  std::vector<double> heights;
  for (const double nudge : {-kTouchCm, kTouchCm}) {
    if (heights.empty()) heights = heightsAt(opening.shape, (ua + ub) / 2 + nudge);
  }
  PlanArea hole;
  for (size_t i = 0; i + 1 < heights.size(); i += 2) {
    const double first = share->first * length, last = share->last * length, low = heights[i], high = heights[i + 1];
    hole.push_back({{first, low}, {last, low}, {last, high}, {first, high}});
  }
  return hole.empty() ? hole : intersected(hole, {panel.outline()});
}

PlanArea WallCut::holeIn(const Panel& panel) const {
  const auto share = withinDepth(panel, opening);
  if (!share || !runsAlong(panel, opening)) return {};
  PlanArea hole = intersected(opening.shape, {inFrame(panel, opening, *share)});
  const double ua = opening.u(panel.a), length = panel.lengthCm(), scale = length / (opening.u(panel.b) - ua);
  // The grid is coarse where little of the opening's width is much of the panel's: no slivers at the corners.
  const double coarse = 2 * kPlanGrid * std::abs(scale);
  for (PlanRing& ring : hole) {
    for (PlanPoint& q : ring) {
      q.x = (q.x - ua) * scale;
      q.x = q.x < coarse ? 0 : q.x > length - coarse ? length : q.x;
    }
  }
  return hole;
}

PlanPoint WallCut::on(const std::vector<Panel>& side, double u) const {
  PlanPoint best;
  double nearest = 1e300;
  for (const Panel& p : side) {
    const auto share = withinDepth(p, opening);
    if (!share || !runsAlong(p, opening)) continue;
    const double ua = opening.u(p.a), t = (u - ua) / (opening.u(p.b) - ua),
                 inside = std::clamp(t, share->first, share->last);
    if (std::abs(t - inside) * p.lengthCm() >= nearest) continue;
    nearest = std::abs(t - inside) * p.lengthCm();
    const double held = std::clamp(t, 0.0, 1.0);
    best = {p.a.x + (p.b.x - p.a.x) * held, p.a.y + (p.b.y - p.a.y) * held};
  }
  return best;
}

std::vector<WallCut> cutsOf(const WallSides& sides, std::span<const Opening> openings, Effort& effort,
                            const std::string& place) {
  std::vector<WallCut> cuts;
  for (const Opening& o : openings) {
    Opening merged = o;
    if (sides.straight && !runsAlong(*longest(sides.left), o)) {
      const auto turned = across(o);
      if (!turned) continue;
      merged = *turned;
    }
    if (!touches(withEnds(sides, merged), merged)) continue;
    const double reach =
        merged.bothSides && (!sides.straight || isParallel(*longest(sides.left), o)) ? kThroughCm : merged.reachCm;
    merged.vLow -= reach, merged.vHigh += reach;
    for (size_t i = 0; i < cuts.size();) {
      const Opening& known = cuts[i].opening;
      const auto same = inFrameOf(known, merged);
      if (!same || same->vLow > known.vHigh || same->vHigh < known.vLow || !touchEachOther(same->shape, known.shape)) {
        ++i;
        continue;
      }
      merged = *same;
      merged.vLow = std::min(merged.vLow, known.vLow), merged.vHigh = std::max(merged.vHigh, known.vHigh);
      merged.shape = united(merged.shape, {});
      effort.spendOn(merged.shape, known.shape, place);
      merged.shape = united(merged.shape, known.shape);
      cuts.erase(cuts.begin() + static_cast<ptrdiff_t>(i));
    }
    cuts.push_back({std::move(merged), {}});
  }
  std::erase_if(cuts, [&](WallCut& cut) {
    Opening& o = cut.opening;
    cut.sides = withEnds(sides, o);
    const PlanArea left = sideInFrame(cut.sides.left, o), right = sideInFrame(cut.sides.right, o);
    cut.throughLeft = !left.empty(), cut.throughRight = !right.empty();
    for (const PlanArea* side : {&left, &right}) {
      if (side->empty()) continue;
      effort.spendOn(o.shape, *side, place);
      o.shape = intersected(o.shape, *side);
    }
    if (cut.throughLeft != cut.throughRight) makeNiche(cut);
    return (!cut.throughLeft && !cut.throughRight) || areaOf(o.shape) < kSmallestCm2;
  });
  return cuts;
}

}  // namespace roomlight::importers::sh3d
