#include "validate/glare_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/lit_scene.h"
#include "measure/glare.h"
#include "scene/primitives.h"
#include "validate/quadrature.h"

namespace roomlight {
namespace {

using quadrature::Element;
using quadrature::Point;
using std::numbers::pi;

constexpr double kH = 2, kEye = 1.2, kSpacing = 0.25 * kH, kPanel = 0.3, kFluxLm = 1000;
constexpr double kCeiling = 0.7, kWalls = 0.5, kFloor = 0.2;
constexpr double kBelowCeiling = 0.001;
constexpr double kLuminance = kFluxLm / (pi * kPanel * kPanel);
constexpr double kBeforeWall = 0.01;

std::vector<Point> panelMiddles(const GlareRoom& room) {
  std::vector<Point> out;
  for (double z = kSpacing / 2; z < room.y * kH; z += kSpacing) {
    for (double x = kSpacing / 2; x < room.x * kH; x += kSpacing) out.push_back({x, kEye + kH - kBelowCeiling, z});
  }
  return out;
}

quadrature::Rectangle panelAt(Point middle) {
  return {middle + Point{-kPanel / 2, 0, -kPanel / 2}, {kPanel, 0, 0}, {0, 0, kPanel}};
}

// Guth's position index above the line of sight, which lies along z.
double position(Point d) {
  const double sigma = std::atan2(std::hypot(d.x, d.y), d.z) * 180 / pi,
               tau = std::atan2(std::abs(d.x), d.y) * 180 / pi;
  const double index = std::exp((35.2 - 0.31889 * tau - 1.22 * std::exp(-2 * tau / 9)) * 1e-3 * sigma +
                                (21 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma);
  return std::min(index, 16.0);
}

}  // namespace

const std::vector<GlareRoom>& glareRooms() {
  static const std::vector<GlareRoom> rooms = {{2, 2}, {2, 3},  {2, 4},  {2, 6},  {2, 8},  {2, 12}, {4, 2},
                                               {4, 3}, {4, 4},  {4, 6},  {4, 8},  {4, 12}, {8, 4},  {8, 6},
                                               {8, 8}, {8, 12}, {12, 4}, {12, 6}, {12, 8}};
  return rooms;
}

GlareSetUp glareSetUp(const GlareRoom& room) {
  GlareSetUp out;
  const auto size = [](double metres) { return static_cast<float>(metres); };
  const float x = size(room.x * kH), z = size(room.y * kH), height = size(kEye + kH);
  Scene& scene = out.scene;
  const int walls = addMaterial(scene, lambertian(size(kWalls))), floor = addMaterial(scene, lambertian(size(kFloor))),
            ceiling = addMaterial(scene, lambertian(size(kCeiling)));
  const int panel = addMaterial(scene, lambertian(size(kCeiling), size(kLuminance)));
  addRoom(scene, {0, 0, 0}, {x, height, z}, {walls, walls, floor, ceiling, walls, walls});
  for (const Point& p : panelMiddles(room)) {
    const quadrature::Rectangle r = panelAt(p);
    addRectangle(scene, {size(r.corner.x), size(r.corner.y), size(r.corner.z)}, {size(kPanel), 0, 0},
                 {0, 0, size(kPanel)}, panel);
  }
  out.eye = {x / 2, size(kEye), size(kBeforeWall)};
  out.view = {0, 0, 1};
  return out;
}

double directUgr(const GlareRoom& room) {
  const double x = room.x * kH, z = room.y * kH, height = kEye + kH;
  const std::vector<Point> panels = panelMiddles(room);
  const Point eye{x / 2, kEye, kBeforeWall};
  double sum = 0;
  for (const Point& p : panels) {
    const Point d = p - eye;
    const double distance = quadrature::length(d);
    sum += kLuminance * kLuminance * kPanel * kPanel * (d.y / distance) / (distance * distance) /
           std::pow(position(d * (1 / distance)), 2);
  }
  const std::vector<quadrature::Radiosity> faces = {
      {{{0, 0, 0}, {0, 0, z}, {x, 0, 0}}, kFloor, 0},      {{{0, height, 0}, {x, 0, 0}, {0, 0, z}}, kCeiling, 0},
      {{{0, 0, 0}, {0, height, 0}, {0, 0, z}}, kWalls, 0}, {{{x, 0, 0}, {0, 0, z}, {0, height, 0}}, kWalls, 0},
      {{{0, 0, 0}, {x, 0, 0}, {0, height, 0}}, kWalls, 0}, {{{0, 0, z}, {0, height, 0}, {x, 0, 0}}, kWalls, 0}};
  const auto direct = [&](const Element& e) {
    double lux = 0;
    for (const Point& p : panels) {
      if (e.position.y < p.y) lux += pi * kLuminance * quadrature::configurationFactor(e, panelAt(p));
    }
    return lux;
  };
  const double background = quadrature::illuminance(faces, {{eye, {0, 0, 1}}}, 12, direct)[0] / pi;
  return 8 * std::log10(0.25 / background * sum);
}

Result<std::vector<GlareRow>> validateGlare(const std::string& technique, bool brief, const RenderSettings& settings,
                                            const Progress& progress) {
  std::vector<GlareRow> rows;
  RenderSettings render = settings;
  render.technique = technique;
  for (size_t i = 0; i < glareRooms().size() && !progress.stop(); i += brief ? 4 : 1) {
    const GlareRoom& room = glareRooms()[i];
    const GlareSetUp setUp = glareSetUp(room);
    RenderStats stats;
    RenderProgress quiet;
    quiet.cancelled = progress.cancelled;
    Stages stages(quiet, stats);
    const Result<std::unique_ptr<LitScene>> lit = lightScene(setUp.scene, render, stages, {.changes = false});
    if (!lit) return Error{lit.error()};
    if (progress.stop()) break;
    GlarePlan plan;
    plan.name = "eye", plan.position = setUp.eye, plan.direction = setUp.view;
    std::vector<std::string> warnings;
    Progress inner;
    inner.cancelled = progress.cancelled;
    const std::vector<GlareReading> readings = readGlares(*lit.value(), {&plan, 1}, {}, inner, warnings);
    if (!progress.stop()) rows.push_back({room, directUgr(room), readings.front().ugr.value_or(0)});
    progress.at(static_cast<float>(i + 1) / static_cast<float>(glareRooms().size()));
  }
  return rows;
}

}  // namespace roomlight
