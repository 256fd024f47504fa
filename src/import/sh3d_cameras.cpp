#include "import/sh3d_environment.h"

#include <algorithm>
#include <cmath>

#include "import/sh3d_draft.h"

namespace roomlight::importers::sh3d {
namespace {

std::string nameOf(const Camera& c) { return c.name.empty() ? c.kind : c.name; }

// Yaw 0 looks along the plan's y, towards the viewer; it turns clockwise on the plan. Pitch looks down.
roomlight::Camera converted(const Camera& in, double aspect) {
  const double cp = std::cos(in.pitchRad), sp = std::sin(in.pitchRad), cy = std::cos(in.yawRad),
               sy = std::sin(in.yawRad);
  const Vec3 forward =
      normalize(Vec3(static_cast<float>(-sy * cp), static_cast<float>(-sp), static_cast<float>(cy * cp)));
  const Vec3 right = normalize(Vec3(static_cast<float>(-cy), 0, static_cast<float>(-sy)));
  roomlight::Camera out;
  out.name = nameOf(in);
  out.worldFromCamera = {right, cross(right, forward), -forward, toWorld({in.x, in.y}, in.z)};
  out.aspect = static_cast<float>(aspect);
  // The field of view is that of the picture's width.
  out.yFovRad = static_cast<float>(2 * std::atan(std::tan(in.fieldOfViewRad / 2) / aspect));
  return out;
}

std::vector<const Camera*> inOrder(const Home& home) {
  std::vector<const Camera*> order;
  for (const Camera& c : home.cameras) order.push_back(&c);
  const auto rank = [&](const Camera* c) { return c->kind == home.camera ? 0 : c->kind == "storedCamera" ? 2 : 1; };
  std::stable_sort(order.begin(), order.end(), [&](const Camera* a, const Camera* b) { return rank(a) < rank(b); });
  return order;
}

}  // namespace

const Camera* cameraOfTime(const Home& home, const std::string& wanted) {
  const std::vector<const Camera*> order = inOrder(home);
  const Camera* found = nullptr;
  for (size_t i = 0; i < order.size() && !wanted.empty(); ++i) {
    const bool named = nameOf(*order[i]) == wanted;
    if (named || (!found && std::to_string(i) == wanted)) found = order[i];
    if (named) break;
  }
  if (found && found->timeMs) return found;
  return order.empty() ? nullptr : order.front();
}

void addCameras(const Home& home, Scene& scene, Warnings& warnings) {
  for (const Camera* c : inOrder(home)) {
    if (!c->pinhole) warnings.add("cameras with a fisheye or spherical lens look through a pinhole");
    scene.cameras.push_back(converted(*c, home.environment.photoAspect));
  }
}

}  // namespace roomlight::importers::sh3d
