#include "import/sh3d_wall_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace roomlight::importers::sh3d {
namespace {

constexpr double kLeastAlong = 0.5;  // cosine between wall and opening
constexpr double kSmallestCm2 = 0.01;

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

bool near(const Panel& p, const Opening& o) {
  double low = 1e300, high = -1e300, bottom = 1e300, top = -1e300;
  for (const PlanRing& ring : o.shape) {
    for (const PlanPoint& q : ring) low = std::min(low, q.x), high = std::max(high, q.x), bottom = std::min(bottom, q.y), top = std::max(top, q.y);
  }
  const double ua = o.u(p.a), ub = o.u(p.b), va = o.v(p.a), vb = o.v(p.b);
  return std::max(ua, ub) > low && std::min(ua, ub) < high && std::max(va, vb) > o.vLow && std::min(va, vb) < o.vHigh && p.baseCm < top &&
         std::max(p.topACm, p.topBCm) > bottom;
}

bool nearAny(const std::vector<Panel>& side, const Opening& o) {
  return std::any_of(side.begin(), side.end(), [&](const Panel& p) { return near(p, o); });
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
    if (!nearAny(sides.left, o) || !nearAny(sides.right, o)) continue;
    Opening merged = o;
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
    o.shape = intersected(intersected(o.shape, sideInFrame(sides.left, o)), sideInFrame(sides.right, o));
    return areaOf(o.shape) < kSmallestCm2;
  });
  return cuts;
}

}  // namespace roomlight::importers::sh3d
