#include "measure/drawings.h"

#include <fmt/format.h>

#include <cmath>

#include "report/page.h"
#include "scene/shown_names.h"

namespace roomlight {
namespace {

constexpr float kMarginM = 0.45f;
constexpr int kShadesAStep = 6;            // colours between two contours
constexpr size_t kShortestRun = 8;         // points of a contour
constexpr float kLabelPx = 30;             // from one label to the next, at least
constexpr double kWidthPx = 620, kHeightPx = 520;
constexpr float kLampHeightM = 4;          // lamps up to so high above the plane are marked
constexpr float kLargestLampM = 3;         // what emits and is larger is no lamp

// The values with a ring of their own edge around them, so that colours and lines go on to the border of the outer
// cells.
std::vector<float> ringed(const Field& field) {
  const int columns = field.lattice.columns, rows = field.lattice.rows;
  const std::vector<float> inner = withoutGaps(field.lux, columns, rows);
  std::vector<float> out;
  for (int y = -1; y <= rows; ++y) {
    for (int x = -1; x <= columns; ++x)
      out.push_back(inner[field.lattice.index(std::clamp(x, 0, columns - 1), std::clamp(y, 0, rows - 1))]);
  }
  return out;
}

class Drawing {
 public:
  Drawing(const GridReading& grid, const Scene& scene, const LightScale& scale, int number)
      : grid_(grid),
        field_(grid.map ? *grid.map : grid.points),
        scene_(scene),
        scale_(scale),
        number_(number),
        wall_(std::abs(lattice().normal.y) < 0.5f),
        size_{lattice().stepUM * static_cast<float>(lattice().columns),
              lattice().stepVM * static_cast<float>(lattice().rows)},
        px_(static_cast<float>(std::max((static_cast<double>(size_.x + 2 * kMarginM) * 100) / kWidthPx,
                                        (static_cast<double>(size_.y + 2 * kMarginM) * 100 + 30) / kHeightPx))),
        values_(ringed(field_)) {}

  std::string svg() const {
    const Vec2 margin{kMarginM, kMarginM}, size = (size_ + margin * 2) * 100;
    std::string s = openSvg("map", grid_.name, margin * -1, {size.x, size.y + 30}, px_);
    s += fmt::format("<clipPath id=\"c{}\"><path clip-rule=\"evenodd\" d=\"{}\"/></clipPath>\n", number_, region());
    s += fmt::format("<g clip-path=\"url(#c{})\">\n{}</g>\n", number_, shades());
    s += plan();
    s += contourLines() + points();
    s += lamps();
    s += scaleBar();
    return s + "</svg>\n";
  }

 private:
  const MeterGrid& lattice() const { return field_.lattice; }
  std::vector<std::vector<ContourPoint>> lines(double level) const {
    auto loops = contours(values_, lattice().columns + 2, lattice().rows + 2, static_cast<float>(level));
    for (auto& loop : loops) {
      for (ContourPoint& point : loop) point.p = point.p - Vec2{1, 1};
    }
    return loops;
  }
  // From cells to the picture; on walls up is up.
  Vec2 place(Vec2 cells) const {
    const float y = cells.y * lattice().stepVM;
    return {cells.x * lattice().stepUM, wall_ ? size_.y - y : y};
  }
  Vec2 place(Vec3 world) const {
    return {dot(world - lattice().corner, lattice().u), dot(world - lattice().corner, lattice().v)};
  }

  // Where there is something to show: the floor, where it is known, else the cells measured.
  std::string region() const {
    std::vector<Vec2> outline;
    for (const Vec2 corner : wall_ ? std::vector<Vec2>() : grid_.floor)
      outline.push_back(place(Vec3{corner.x, lattice().corner.y, corner.y}));
    if (!outline.empty()) return pathOf(outline, true);
    return pathOf(lattice(), [&](Vec2 cells) { return place(cells); });
  }

  std::string shades() const {
    std::vector<double> steps = roundSteps(scale_.low, scale_.high), levels;
    for (size_t i = 0; i + 1 < steps.size(); ++i) {
      for (int k = 0; k < kShadesAStep; ++k)
        levels.push_back(steps[i] * std::pow(steps[i + 1] / steps[i], static_cast<double>(k) / kShadesAStep));
    }
    std::string s = fmt::format("<rect x=\"0\" y=\"0\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", cm(size_.x),
                                cm(size_.y), hexColour(falseColour(0)));
    for (size_t i = 1; i < levels.size(); ++i) {
      std::string d;
      for (const auto& loop : lines(levels[i])) {
        std::vector<Vec2> points;
        for (const ContourPoint& point : loop) points.push_back(place(point.p));
        d += pathOf(points, true);
      }
      const double middle = i + 1 < levels.size() ? std::sqrt(levels[i] * levels[i + 1]) : levels[i];
      if (!d.empty())
        s += fmt::format("<path fill=\"{}\" fill-rule=\"evenodd\" d=\"{}\"/>\n",
                         hexColour(falseColour(scale_.position(middle))), d);
    }
    return s;
  }

  // Labels go where a line runs well inside.
  std::string contourLines() const {
    std::string paths, labels;
    std::vector<Vec2> labelled;
    const float clear = kLabelPx / 100 * px_;
    for (const double level : roundSteps(scale_.low, scale_.high)) {
      for (const auto& loop : lines(level)) {
        std::string d;
        bool on = false;
        std::vector<Vec2> run, best;
        for (size_t k = 0; k <= loop.size(); ++k) {
          const ContourPoint& point = loop[k % loop.size()];
          const int column = std::clamp(static_cast<int>(point.p.x), 0, lattice().columns - 1),
                    row = std::clamp(static_cast<int>(point.p.y), 0, lattice().rows - 1);
          if (point.rim || !lattice().used[lattice().index(column, row)]) {
            on = false;
            run.clear();
            continue;
          }
          const Vec2 p = place(point.p);
          d += fmt::format("{}{},{}", on ? "L" : "M", cm(p.x), cm(p.y));
          on = true;
          run.push_back(p);
          if (run.size() > best.size()) best = run;
        }
        if (best.size() < kShortestRun) continue;
        paths += d;
        const Vec2 middle = best[best.size() / 2];
        if (std::any_of(labelled.begin(), labelled.end(),
                        [&](Vec2 p) { return std::hypot(p.x - middle.x, p.y - middle.y) < clear; }))
          continue;
        labelled.push_back(middle);
        labels +=
            fmt::format("<text class=\"level\" x=\"{}\" y=\"{}\">{:g}</text>\n", cm(middle.x), cm(middle.y), level);
      }
    }
    return fmt::format("<path class=\"contour\" clip-path=\"url(#c{})\" d=\"{}\"/>\n{}", number_, paths, labels);
  }

  std::string plan() const {
    if (wall_)
      return fmt::format("<rect class=\"wall\" x=\"0\" y=\"0\" width=\"{}\" height=\"{}\"/>\n", cm(size_.x),
                         cm(size_.y));
    const MeterGrid& l = lattice();
    const PlanFrame frame{l.corner, l.u, l.v, {-kMarginM, -kMarginM}, {size_.x + kMarginM, size_.y + kMarginM}};
    return fmt::format("<path class=\"wall\" d=\"{}\"/>\n", pathOf(cutPlan(scene_, frame)));
  }

  // Where statistics come from.
  std::string points() const {
    std::string d;
    for (const SurfaceElement& e : grid_.points.lattice.elements()) {
      Vec2 p = place(e.position);
      if (wall_) p.y = size_.y - p.y;
      d += fmt::format("M{} {}h0", cm(p.x), cm(p.y));
    }
    std::string crosses;
    for (const LeftOutCell& c : grid_.leftOut) {
      const MeterGrid& l = grid_.points.lattice;
      Vec2 p = place(l.centre(static_cast<int>(c.cell) % l.columns, static_cast<int>(c.cell) / l.columns));
      if (wall_) p.y = size_.y - p.y;
      crosses += fmt::format("M{} {}l8 8m-8 0l8-8", cm(p.x) - 4, cm(p.y) - 4);
    }
    return fmt::format("<path class=\"point\" d=\"{}\"/>\n<path class=\"out\" d=\"{}\"/>\n", d, crosses);
  }

  std::string lamp(Vec3 at, const std::string& name) const {
    const Vec2 p = place(at);
    if (p.x < 0 || p.y < 0 || p.x > size_.x || p.y > size_.y || at.y < lattice().corner.y - 1 ||
        at.y > lattice().corner.y + kLampHeightM)
      return {};
    return fmt::format(
        "<g class=\"lamp\" transform=\"translate({} {})\"><title>{}, {:.2f} m</title><circle r=\"9\"/><path "
        "d=\"M-6.4-6.4L6.4 6.4M-6.4 6.4L6.4-6.4\"/></g>\n",
        cm(p.x), cm(p.y), report::escaped(name), at.y);
  }

  std::string lamps() const {
    if (wall_) return {};
    std::string s;
    const std::vector<SceneLamp> all = findLamps(scene_);
    const std::vector<std::string> shown = shownLampNames(scene_, all);
    for (size_t k = 0; k < all.size(); ++k) {
      for (const size_t i : all[k].lamps) {
        if (scene_.lamps[i].kind != LampKind::Area) s += lamp(scene_.lamps[i].position, shown[k]);
      }
      for (const uint32_t i : all[k].instances) {
        const Bounds3 b = instanceBounds(scene_, scene_.instances[i]);
        if (!b.empty() && maxComponent(b.size()) < kLargestLampM) s += lamp(b.centre(), shown[k]);
      }
    }
    return s;
  }

  std::string scaleBar() const {
    const int y = cm(size_.y + kMarginM) + 12;
    const int metres = size_.x > 1.5f ? 1 : 0, length = metres ? 100 : 10;
    return fmt::format(
        "<g class=\"bar\"><path d=\"M0,{0}v{1:.0f}h{2}v-{1:.0f}\"/><text x=\"{3:.0f}\" y=\"{4:.0f}\">{5}</text></g>\n",
        y, 6 * px_, length, static_cast<float>(length) + 6 * px_, static_cast<float>(y) + 8 * px_,
        metres ? "1 m" : "10 cm");
  }

  const GridReading& grid_;
  const Field& field_;
  const Scene& scene_;
  const LightScale& scale_;
  const int number_;
  const bool wall_;
  const Vec2 size_;  // metres
  const float px_;   // centimetres a pixel
  const std::vector<float> values_;
};

}  // namespace

const char* const kLightMapStyle = R"(
.map .wall{fill:none;stroke:#111820;stroke-width:calc(1.3*var(--px));stroke-linejoin:round;stroke-linecap:round}
.map .contour{fill:none;stroke:#fff;stroke-opacity:.8;stroke-width:calc(1.1*var(--px))}
.map .point{stroke:#111820;stroke-opacity:.55;stroke-width:calc(2.6*var(--px));stroke-linecap:round}
.map .out{fill:none;stroke:#111820;stroke-opacity:.45;stroke-width:var(--px)}
.map text.level{font-size:calc(11.5*var(--px));text-anchor:middle;dominant-baseline:central;paint-order:stroke;stroke:#fff;stroke-opacity:.85;stroke-width:calc(3*var(--px));stroke-linejoin:round}
.map .lamp circle{fill:#fff;stroke:#111820;stroke-width:calc(1.2*var(--px))}
.map .lamp path{stroke:#111820;stroke-width:calc(1.2*var(--px))}
.map .bar path{fill:none;stroke:var(--ink);stroke-width:calc(1.4*var(--px))}
.map .bar text{font-size:calc(12*var(--px))}
)";

std::string pathOf(std::span<const Vec2> metres, bool isClosed) {
  std::string d;
  for (const Vec2 p : metres) d += fmt::format("{}{},{}", d.empty() ? "M" : "L", cm(p.x), cm(p.y));
  return isClosed ? d + "Z" : d;
}

std::string pathOf(std::span<const PlanLine> lines) {
  std::string d;
  for (const PlanLine& line : lines) d += pathOf(line, false);
  return d;
}

std::string pathOf(const MeterGrid& l, const std::function<Vec2(Vec2 cells)>& place) {
  std::string d;
  for (int row = 0; row < l.rows; ++row) {
    for (int column = 0; column < l.columns; ++column) {
      const int first = column;
      while (column < l.columns && l.used[l.index(column, row)]) ++column;
      if (column == first) continue;
      const Vec2 a = place({static_cast<float>(first), static_cast<float>(row)}),
                 b = place({static_cast<float>(column), static_cast<float>(row + 1)});
      d += fmt::format("M{},{}H{}V{}H{}Z", cm(a.x), cm(a.y), cm(b.x), cm(b.y), cm(a.x));
    }
  }
  return d;
}

std::string openSvg(const std::string& kind, const std::string& label, Vec2 low, Vec2 sizeCm, float cmAPixel) {
  return fmt::format(
      "<svg class=\"{}\" xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"{} {} "
      "{:.0f} {:.0f}\" style=\"--px:{:.3f}px\" role=\"img\" aria-label=\"{}\">\n",
      kind, sizeCm.x / cmAPixel, sizeCm.y / cmAPixel, cm(low.x), cm(low.y), sizeCm.x, sizeCm.y, cmAPixel,
      report::escaped(label));
}

std::string lightMapSvg(const GridReading& grid, const Scene& scene, const LightScale& scale, int number) {
  return Drawing(grid, scene, scale, number).svg();
}

std::string legendSvg(const LightScale& scale, const std::string& unit) {
  constexpr int kHeight = 300, kPieces = 60;
  std::string s = fmt::format(
      "<svg class=\"legend\" xmlns=\"http://www.w3.org/2000/svg\" width=\"78\" height=\"{}\" viewBox=\"0 -26 78 "
      "{}\">\n<text x=\"0\" y=\"-12\">{}</text>\n",
      kHeight + 40, kHeight + 40, report::escaped(unit));
  for (int i = 0; i < kPieces; ++i) {
    s += fmt::format("<rect x=\"0\" y=\"{}\" width=\"22\" height=\"{}\" fill=\"{}\"/>\n",
                     kHeight - (i + 1) * kHeight / kPieces, kHeight / kPieces + 1,
                     hexColour(falseColour((i + 0.5) / kPieces)));
  }
  for (const double step : roundSteps(scale.low, scale.high)) {
    const double y = kHeight * (1 - scale.position(step));
    s += fmt::format("<path class=\"tick\" d=\"M22,{0:.1f}h5\"/><text x=\"31\" y=\"{1:.1f}\">{2:g}</text>\n", y, y + 4,
                     step);
  }
  return s + "</svg>\n";
}

}  // namespace roomlight
