#include "measure/light_map.h"

#include <fmt/format.h>

#include <cmath>

#include "measure/contour.h"
#include "measure/floor_plan.h"

namespace roomlight {
namespace {

constexpr float kMarginM = 0.45f;
constexpr int kShadesAStep = 6;            // colours between two contours
constexpr double kWidthPx = 620, kHeightPx = 520;
constexpr float kLampHeightM = 4;          // lamps up to so high above the plane are marked
constexpr float kLargestLampM = 3;         // what emits and is larger is no lamp

// Centimetres in the picture.
int cm(float metres) { return static_cast<int>(std::lround(metres * 100)); }

class Drawing {
 public:
  Drawing(const GridReading& grid, const Scene& scene, const LightScale& scale, int number)
      : grid_(grid), field_(grid.map ? *grid.map : grid.points), scene_(scene), scale_(scale), number_(number), wall_(std::abs(lattice().normal.y) < 0.5f),
        size_{lattice().stepUM * static_cast<float>(lattice().columns), lattice().stepVM * static_cast<float>(lattice().rows)},
        values_(withoutGaps(field_.lux, lattice().columns, lattice().rows)) {}

  std::string svg() const {
    const double width = static_cast<double>(size_.x + 2 * kMarginM) * 100, height = static_cast<double>(size_.y + 2 * kMarginM) * 100 + 30;
    const double scale = std::min(kWidthPx / width, kHeightPx / height);
    std::string s = fmt::format("<svg class=\"map\" xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"{} {} {:.0f} {:.0f}\" style=\"--px:{:.3f}px\" role=\"img\" aria-label=\"{}\">\n",
                                width * scale, height * scale, -cm(kMarginM), -cm(kMarginM), width, height, 1 / scale, escaped(grid_.name));
    s += fmt::format("<clipPath id=\"c{}\"><path clip-rule=\"evenodd\" d=\"{}\"/></clipPath>\n", number_, region());
    s += fmt::format("<g clip-path=\"url(#c{})\">\n{}</g>\n", number_, shades());
    s += plan();
    s += contourLines();
    s += lamps();
    s += scaleBar(static_cast<float>(1 / scale));
    return s + "</svg>\n";
  }

 private:
  const Lattice& lattice() const { return field_.lattice; }
  // From cells to the picture; on walls up is up.
  Vec2 place(Vec2 cells) const {
    const float y = cells.y * lattice().stepVM;
    return {cells.x * lattice().stepUM, wall_ ? size_.y - y : y};
  }
  Vec2 place(Vec3 world) const { return {dot(world - lattice().corner, lattice().u), dot(world - lattice().corner, lattice().v)}; }

  // Where there is something to show: the floor, where it is known, else the cells measured.
  std::string region() const {
    std::string d;
    for (const Vec2 corner : wall_ ? std::vector<Vec2>() : grid_.floor) {
      const Vec2 p = place(Vec3{corner.x, lattice().corner.y, corner.y});
      d += fmt::format("{}{},{}", d.empty() ? "M" : "L", cm(p.x), cm(p.y));
    }
    if (!d.empty()) return d + "Z";
    for (int row = 0; row < lattice().rows; ++row) {
      for (int column = 0; column < lattice().columns; ++column) {
        const int first = column;
        while (column < lattice().columns && lattice().used[lattice().index(column, row)]) ++column;
        if (column == first) continue;
        const Vec2 a = place(Vec2{static_cast<float>(first), static_cast<float>(row)}), b = place(Vec2{static_cast<float>(column), static_cast<float>(row + 1)});
        d += fmt::format("M{},{}H{}V{}H{}Z", cm(a.x), cm(a.y), cm(b.x), cm(b.y), cm(a.x));
      }
    }
    return d;
  }

  std::string shades() const {
    std::vector<double> steps = roundSteps(scale_.low, scale_.high), levels;
    for (size_t i = 0; i + 1 < steps.size(); ++i) {
      for (int k = 0; k < kShadesAStep; ++k) levels.push_back(steps[i] * std::pow(steps[i + 1] / steps[i], static_cast<double>(k) / kShadesAStep));
    }
    std::string s = fmt::format("<rect x=\"0\" y=\"0\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", cm(size_.x), cm(size_.y), hexColour(falseColour(0)));
    for (size_t i = 1; i < levels.size(); ++i) {
      std::string d;
      for (const auto& loop : contours(values_, lattice().columns, lattice().rows, static_cast<float>(levels[i]))) {
        for (size_t k = 0; k < loop.size(); ++k) {
          const Vec2 p = place(loop[k].p);
          d += fmt::format("{}{},{}", k ? "L" : "M", cm(p.x), cm(p.y));
        }
        d += "Z";
      }
      const double middle = i + 1 < levels.size() ? std::sqrt(levels[i] * levels[i + 1]) : levels[i];
      if (!d.empty()) s += fmt::format("<path fill=\"{}\" fill-rule=\"evenodd\" d=\"{}\"/>\n", hexColour(falseColour(scale_.position(middle))), d);
    }
    return s;
  }

  // Labels go where a line runs well inside.
  std::string contourLines() const {
    std::string lines, labels;
    for (const double level : roundSteps(scale_.low, scale_.high)) {
      for (const auto& loop : contours(values_, lattice().columns, lattice().rows, static_cast<float>(level))) {
        std::string d;
        bool on = false;
        std::vector<Vec2> run, best;
        for (size_t k = 0; k <= loop.size(); ++k) {
          const ContourPoint& point = loop[k % loop.size()];
          const int column = std::clamp(static_cast<int>(point.p.x), 0, lattice().columns - 1), row = std::clamp(static_cast<int>(point.p.y), 0, lattice().rows - 1);
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
        if (best.size() < 4) continue;
        lines += d;
        if (best.size() >= 9) labels += fmt::format("<text class=\"level\" x=\"{}\" y=\"{}\">{}</text>\n", cm(best[best.size() / 2].x), cm(best[best.size() / 2].y), fmt::format("{:g}", level));
      }
    }
    return fmt::format("<path class=\"contour\" d=\"{}\"/>\n{}", lines, labels);
  }

  std::string plan() const {
    if (wall_) return fmt::format("<rect class=\"wall\" x=\"0\" y=\"0\" width=\"{}\" height=\"{}\"/>\n", cm(size_.x), cm(size_.y));
    const Lattice& l = lattice();
    const PlanFrame frame{l.corner, l.u, l.v, {-kMarginM, -kMarginM}, {size_.x + kMarginM, size_.y + kMarginM}};
    std::string d;
    for (const PlanLine& line : cutPlan(scene_, frame)) {
      for (size_t i = 0; i < line.size(); ++i) d += fmt::format("{}{} {}", i ? "L" : "M", cm(line[i].x), cm(line[i].y));
    }
    return fmt::format("<path class=\"wall\" d=\"{}\"/>\n", d);
  }

  std::string lamp(Vec3 at, const std::string& name) const {
    const Vec2 p = place(at);
    if (p.x < 0 || p.y < 0 || p.x > size_.x || p.y > size_.y || at.y < lattice().corner.y - 1 || at.y > lattice().corner.y + kLampHeightM) return {};
    return fmt::format("<g class=\"lamp\" transform=\"translate({} {})\"><title>{}, {:.2f} m</title><circle r=\"9\"/><path d=\"M-6.4-6.4L6.4 6.4M-6.4 6.4L6.4-6.4\"/></g>\n", cm(p.x), cm(p.y), escaped(name), at.y);
  }

  std::string lamps() const {
    if (wall_) return {};
    std::string s;
    for (const Lamp& l : scene_.lamps) {
      if (l.kind != LampKind::Area) s += lamp(l.position, l.name);
    }
    for (const Instance& i : scene_.instances) {
      if (isBlack(scene_.materials[static_cast<size_t>(scene_.meshes[static_cast<size_t>(i.mesh)].material)].emission)) continue;
      const Bounds3 b = instanceBounds(scene_, i);
      if (!b.empty() && maxComponent(b.size()) < kLargestLampM) s += lamp(b.centre(), i.name);
    }
    return s;
  }

  std::string scaleBar(float px) const {
    const int y = cm(size_.y + kMarginM) + 12;
    const int metres = size_.x > 1.5f ? 1 : 0, length = metres ? 100 : 10;
    return fmt::format("<g class=\"bar\"><path d=\"M0,{0}v{1:.0f}h{2}v-{1:.0f}\"/><text x=\"{3:.0f}\" y=\"{4:.0f}\">{5}</text></g>\n", y, 6 * px, length, static_cast<float>(length) + 6 * px, static_cast<float>(y) + 8 * px,
                       metres ? "1 m" : "10 cm");
  }

  const GridReading& grid_;
  const Field& field_;
  const Scene& scene_;
  const LightScale& scale_;
  const int number_;
  const bool wall_;
  const Vec2 size_;
  const std::vector<float> values_;
};

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string lightMapSvg(const GridReading& grid, const Scene& scene, const LightScale& scale, int number) { return Drawing(grid, scene, scale, number).svg(); }

std::string legendSvg(const LightScale& scale, const std::string& unit) {
  constexpr int kHeight = 300, kPieces = 60;
  std::string s = fmt::format("<svg class=\"legend\" xmlns=\"http://www.w3.org/2000/svg\" width=\"78\" height=\"{}\" viewBox=\"0 -26 78 {}\">\n<text x=\"0\" y=\"-12\">{}</text>\n", kHeight + 40, kHeight + 40, escaped(unit));
  for (int i = 0; i < kPieces; ++i) {
    s += fmt::format("<rect x=\"0\" y=\"{}\" width=\"22\" height=\"{}\" fill=\"{}\"/>\n", kHeight - (i + 1) * kHeight / kPieces, kHeight / kPieces + 1, hexColour(falseColour((i + 0.5) / kPieces)));
  }
  for (const double step : roundSteps(scale.low, scale.high)) {
    const double y = kHeight * (1 - scale.position(step));
    s += fmt::format("<path class=\"tick\" d=\"M22,{0:.1f}h5\"/><text x=\"31\" y=\"{1:.1f}\">{2:g}</text>\n", y, y + 4, step);
  }
  return s + "</svg>\n";
}

}  // namespace roomlight
