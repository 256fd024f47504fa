#include "import/sh3d_wall_parts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

namespace roomlight::importers::sh3d {
namespace {

constexpr size_t kStepsAPoint = 8;

// In the unit square.
PlanArea shapeOf(const Piece& p, Effort& effort, Warnings& warnings) {
  const PlanArea whole{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
  if (p.door.cutOutShape.empty()) return whole;
  PlanArea unit = svgPath(p.door.cutOutShape);
  if (unit.empty()) {
    warnings.add("cut-out shapes that cannot be read are taken as rectangles");
  } else if (!effort.untangles(unit, p.place)) {
    warnings.add(fmt::format("cut-out shapes that cross themselves more than {} times are taken as rectangles",
                             Effort::kMostOwnCrossings));
  } else {
    return unit;
  }
  return whole;
}

}  // namespace

std::vector<Opening> openingsOf(const Home& home, Effort& effort, Warnings& warnings) {
  std::vector<Opening> out;
  for (const Piece& p : home.pieces) {
    if (p.kind != PieceKind::DoorOrWindow || !isShown(home, p.level)) continue;
    if (!(p.widthCm > 0) || !(p.heightCm > 0)) continue;
    Opening o;
    o.along = {std::cos(p.angleRad), std::sin(p.angleRad)};
    o.vLow = o.v(p.centre) - p.depthCm / 2, o.vHigh = o.v(p.centre) + p.depthCm / 2;
    o.bothSides = p.door.cutOutOnBothSides;
    const double uLow = o.u(p.centre) - p.widthCm / 2, top = elevationOf(home, p.level) + p.elevationCm + p.heightCm;
    PlanArea unit = shapeOf(p, effort, warnings);
    for (PlanRing& ring : unit) {
      for (PlanPoint& q : ring) {
        const double x = p.mirrored ? 1 - q.x : q.x;
        q = {uLow + x * p.widthCm, top - q.y * p.heightCm};
      }
    }
    o.shape = united(unit, {});
    o.points = combiningSteps(o.shape, {}, std::numeric_limits<uint32_t>::max()) / kStepsAPoint;
    o.centre = p.centre;
    o.radiusCm = std::hypot(p.depthCm / 2, p.widthCm / 2);
    if (!o.shape.empty()) out.push_back(std::move(o));
  }
  return out;
}

// SVG 1.1, 8.3 "Path data": M L H V C S Q T A Z, capitals absolute, small letters relative to the current point.

namespace {

constexpr int kChords = 24;  // of a curve
constexpr size_t kMostPoints = 2000;
constexpr double kLargest = 100;  // of the unit square

class PathReader {
 public:
  explicit PathReader(const std::string& text) : text_(text) {}

  PlanArea read() {
    skip();
    while (at_ < text_.size() && fine_) {
      if (std::isalpha(static_cast<unsigned char>(text_[at_])))
        command_ = text_[at_++];
      else if (command_ == 0 || command_ == 'Z' || command_ == 'z')
        fine_ = false;
      segment();
      skip();
      if (points_ > kMostPoints) fine_ = false;
    }
    close();
    return fine_ ? area_ : PlanArea();
  }

 private:
  void skip() {
    while (at_ < text_.size() && (std::isspace(static_cast<unsigned char>(text_[at_])) || text_[at_] == ',')) ++at_;
  }
  double number() {
    skip();
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    double v = 0;
    const auto [end, code] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), v);
    if (code != std::errc() || !(std::abs(v) <= kLargest))
      fine_ = false, v = 0;
    else
      at_ = static_cast<size_t>(end - text_.data());
    return v;
  }
  PlanPoint point(bool relative) {
    const double x = number(), y = number();
    return relative ? PlanPoint{now_.x + x, now_.y + y} : PlanPoint{x, y};
  }
  void add(PlanPoint p) {
    if (!(std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest)) fine_ = false;
    ring_.push_back(p), now_ = p, ++points_;
  }
  void close() {
    if (ring_.size() > 2) area_.push_back(ring_);
    if (!ring_.empty()) now_ = ring_.front();
    ring_.clear();
  }

  void curve(PlanPoint a, PlanPoint b, PlanPoint end) {
    const PlanPoint from = now_;
    for (int i = 1; i <= kChords; ++i) {
      const double t = static_cast<double>(i) / kChords, s = 1 - t;
      const double w[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
      add({w[0] * from.x + w[1] * a.x + w[2] * b.x + w[3] * end.x,
           w[0] * from.y + w[1] * a.y + w[2] * b.y + w[3] * end.y});
    }
  }
  // A quadratic curve is the cubic whose inner points lie two thirds of the way to its own.
  void quadratic(PlanPoint c, PlanPoint end) {
    const PlanPoint from = now_;
    curve({from.x + (c.x - from.x) * 2 / 3, from.y + (c.y - from.y) * 2 / 3},
          {end.x + (c.x - end.x) * 2 / 3, end.y + (c.y - end.y) * 2 / 3}, end);
  }

  // SVG 1.1, F.6.5: from end points to the centre; F.6.6: radii that are too small grow.
  void arc(double rx, double ry, double turnRad, bool large, bool sweep, PlanPoint end) {
    const PlanPoint from = now_;
    rx = std::abs(rx), ry = std::abs(ry);
    if (rx < 1e-9 || ry < 1e-9) return add(end);
    const double c = std::cos(turnRad), s = std::sin(turnRad), dx = (from.x - end.x) / 2, dy = (from.y - end.y) / 2;
    const double x = c * dx + s * dy, y = -s * dx + c * dy;
    const double needed = x * x / (rx * rx) + y * y / (ry * ry);
    if (needed > 1) rx *= std::sqrt(needed), ry *= std::sqrt(needed);
    const double q = rx * rx * y * y + ry * ry * x * x;
    double k = q > 0 ? std::sqrt(std::max(0.0, rx * rx * ry * ry / q - 1)) : 0;
    if (large == sweep) k = -k;
    const double cx = k * rx * y / ry, cy = -k * ry * x / rx;
    const double first = std::atan2((y - cy) / ry, (x - cx) / rx), last = std::atan2((-y - cy) / ry, (-x - cx) / rx);
    double extent = last - first;
    if (sweep && extent < 0) extent += 2 * std::numbers::pi;
    if (!sweep && extent > 0) extent -= 2 * std::numbers::pi;
    for (int i = 1; i < kChords; ++i) {
      const double angle = first + extent * i / kChords, px = rx * std::cos(angle) + cx, py = ry * std::sin(angle) + cy;
      add({c * px - s * py + (from.x + end.x) / 2, s * px + c * py + (from.y + end.y) / 2});
    }
    add(end);
  }

  void segment() {
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(command_)));
    const bool relative = letter != command_;
    const PlanPoint mirrored = last_ == letter || (last_ == 'C' && letter == 'S') || (last_ == 'S' && letter == 'C') ||
                                       (last_ == 'Q' && letter == 'T') || (last_ == 'T' && letter == 'Q')
                                   ? PlanPoint{2 * now_.x - control_.x, 2 * now_.y - control_.y}
                                   : now_;
    if (letter != 'M' && letter != 'Z' && ring_.empty()) ring_.push_back(now_);
    switch (letter) {
      case 'M': {
        const PlanPoint p = point(relative);
        close();
        add(p);
        command_ = relative ? 'l' : 'L';  // further pairs are lines
        break;
      }
      case 'Z': close(); break;
      case 'L': add(point(relative)); break;
      case 'H': add({number() + (relative ? now_.x : 0), now_.y}); break;
      case 'V': add({now_.x, number() + (relative ? now_.y : 0)}); break;
      case 'C':
      case 'S': {
        const PlanPoint a = letter == 'C' ? point(relative) : mirrored, b = point(relative), end = point(relative);
        curve(a, b, end);
        control_ = b;
        break;
      }
      case 'Q':
      case 'T': {
        const PlanPoint c = letter == 'Q' ? point(relative) : mirrored, end = point(relative);
        quadratic(c, end);
        control_ = c;
        break;
      }
      case 'A': {
        const double rx = number(), ry = number(), turn = number() * std::numbers::pi / 180;
        const bool large = number() != 0, sweep = number() != 0;
        arc(rx, ry, turn, large, sweep, point(relative));
        break;
      }
      default: fine_ = false;
    }
    last_ = letter;
  }

  const std::string& text_;
  size_t at_ = 0, points_ = 0;
  char command_ = 0, last_ = 0;
  PlanPoint now_, control_;
  PlanRing ring_;
  PlanArea area_;
  bool fine_ = true;
};

}  // namespace

PlanArea svgPath(const std::string& path) { return PathReader(path).read(); }

}  // namespace roomlight::importers::sh3d
