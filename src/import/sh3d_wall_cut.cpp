#include "import/sh3d_wall_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace roomlight::importers::sh3d {
namespace {

constexpr double kLeastAlong = 0.5;  // cosine between wall and opening
constexpr double kSmallestCm2 = 0.01;
constexpr double kReachCm = 1;        // windows that end this close to a wall's side cut it
constexpr double kThroughCm = 400;    // how far what cuts both sides reaches into the wall

struct Share {
  double first = 0, last = 1;
};

// The part of a panel, as shares of its length, that lies within the opening's depth.
std::optional<Share> withinDepth(const Panel& p, const Opening& o) {
  const double length = p.lengthCm();
  if (std::abs(o.u(p.b) - o.u(p.a)) < kLeastAlong * length) return {};
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
    if (const auto share = withinDepth(p, o)) out = out.empty() ? PlanArea{inFrame(p, o, *share)} : united(out, {inFrame(p, o, *share)});
  }
  return out;
}

struct Range {
  double low = 1e300, high = -1e300;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  bool overlaps(Range o) const { return high > o.low && low < o.high; }
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
  const double cosine = frame.along.x * o.along.x + frame.along.y * o.along.y, sine = frame.along.x * o.along.y - frame.along.y * o.along.x;
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

// Its back is the end of the piece that lies deeper in the wall, without the reach that made it go through.
void makeNiche(WallCut& cut) {
  Opening& o = cut.opening;
  const Panel& open = (cut.throughLeft ? cut.sides->left : cut.sides->right).front();
  const Panel& closed = (cut.throughLeft ? cut.sides->right : cut.sides->left).front();
  const double towards = o.v(closed.a) + o.v(closed.b) - o.v(open.a) - o.v(open.b);
  cut.backV = towards > 0 ? o.vHigh - kReachCm : o.vLow + kReachCm;
  if ((cut.backV - o.v(open.a)) * towards <= 0) o.shape.clear();  // the piece only touches the wall
}

}  // namespace

double Panel::lengthCm() const { return std::hypot(b.x - a.x, b.y - a.y); }
PlanRing Panel::outline() const { return {{0, baseCm}, {lengthCm(), baseCm}, {lengthCm(), topBCm}, {0, topACm}}; }

PlanArea WallCut::holeIn(const Panel& panel) const {
  const auto share = withinDepth(panel, opening);
  if (!share) return {};
  PlanArea hole = intersected(opening.shape, {inFrame(panel, opening, *share)});
  const double ua = opening.u(panel.a), scale = panel.lengthCm() / (opening.u(panel.b) - ua);
  for (PlanRing& ring : hole) {
    for (PlanPoint& q : ring) q.x = (q.x - ua) * scale;
  }
  return hole;
}

PlanPoint WallCut::on(const std::vector<Panel>& side, double u) const {
  PlanPoint best;
  double nearest = 1e300;
  for (const Panel& p : side) {
    const auto share = withinDepth(p, opening);
    if (!share) continue;
    const double ua = opening.u(p.a), t = (u - ua) / (opening.u(p.b) - ua), inside = std::clamp(t, share->first, share->last);
    if (std::abs(t - inside) * p.lengthCm() >= nearest) continue;
    nearest = std::abs(t - inside) * p.lengthCm();
    const double held = std::clamp(t, 0.0, 1.0);
    best = {p.a.x + (p.b.x - p.a.x) * held, p.a.y + (p.b.y - p.a.y) * held};
  }
  return best;
}

std::vector<WallCut> cutsOf(const WallSides& sides, std::span<const Opening> openings) {
  std::vector<WallCut> cuts;
  for (const Opening& o : openings) {
    if (!touches(sides, o)) continue;
    Opening merged = o;
    const double reach = o.bothSides ? kThroughCm : kReachCm;
    merged.vLow -= reach, merged.vHigh += reach;
    for (size_t i = 0; i < cuts.size();) {
      const Opening& known = cuts[i].opening;
      const auto same = inFrameOf(known, merged);
      if (!same || same->vLow > known.vHigh || same->vHigh < known.vLow) {
        ++i;
        continue;
      }
      merged = *same;
      merged.vLow = std::min(merged.vLow, known.vLow), merged.vHigh = std::max(merged.vHigh, known.vHigh);
      merged.shape = united(merged.shape, {});
      merged.shape = united(merged.shape, known.shape);
      cuts.erase(cuts.begin() + static_cast<ptrdiff_t>(i));
    }
    cuts.push_back({std::move(merged), &sides});
  }
  std::erase_if(cuts, [&](WallCut& cut) {
    Opening& o = cut.opening;
    const PlanArea left = sideInFrame(sides.left, o), right = sideInFrame(sides.right, o);
    cut.throughLeft = !left.empty(), cut.throughRight = !right.empty();
    if (cut.throughLeft) o.shape = intersected(o.shape, left);
    if (cut.throughRight) o.shape = intersected(o.shape, right);
    if (cut.throughLeft != cut.throughRight) makeNiche(cut);
    return (!cut.throughLeft && !cut.throughRight) || areaOf(o.shape) < kSmallestCm2;
  });
  return cuts;
}

}  // namespace roomlight::importers::sh3d
