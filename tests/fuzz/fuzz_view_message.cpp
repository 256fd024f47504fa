// Any bytes as a browser's message: no crash, no hang. What is refused says why in one short line; what is taken can be
// applied to a home.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "scene/primitives.h"
#include "view/apply_edit.h"
#include "view/shown.h"
#include "view/view_camera.h"

namespace roomlight::fuzz {
namespace {

void require(bool fact) {
  if (!fact) std::abort();
}

// A box, a panel that shines and a lamp.
const view::ViewHome& smallHome() {
  static const view::ViewHome home = [] {
    Scene scene;
    addBox(scene, {0, 0, 0}, {1, 1, 1}, addMaterial(scene, lambertian(0.5f)));
    addRectangle(scene, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, addMaterial(scene, lambertian(0, 100)));
    scene.lamps = {pointLamp({2, 2, 2}, 100)};
    return view::ViewHome("home", std::move(scene));
  }();
  return home;
}

void check(const view::ViewError& e) {
  require(!e.code.empty() && !e.message.empty() && e.message.size() < 2000 &&
          e.message.find('\n') == std::string::npos);
}

void check(const view::ViewCamera& c) {
  const Affine frame = view::cameraOf(c).worldFromCamera;
  require(isFinite(frame.x) && isFinite(frame.y) && isFinite(frame.z) && isFinite(frame.w) &&
          std::abs(frame.determinant() - 1) < 1e-3f);
}

void check(const view::Viewport& v) {
  const auto [width, height] = view::frameSize(v, 1);
  require(width >= 16 && height >= 16 && width <= view::kMostFrameWidth + 16 && height <= view::kMostFrameHeight + 16);
}

void check(const view::Edit& edit) {
  const view::ViewHome& home = smallHome();
  view::Edited out;
  if (const auto refused = view::applyEdit(home.editable, home.scene, edit, home.atStart(), out))
    return check(*refused);
  Scene scene = home.scene;
  view::stage(home.editable, home.atStart(), out.state, scene);
  for (const Instance& i : scene.instances) require(isFinite(i.worldFromObject.w) && isFinite(i.worldFromObject.x));
  for (const Lamp& l : scene.lamps)
    require(isFinite(l.position) && isFinite(l.intensityCd) && minComponent(l.intensityCd) >= 0);
}

void check(const view::DisplayChange& change) {
  view::ViewDisplay display;
  view::apply(change, display);
  Image light(4, 4);
  for (Vec3& p : light.pixels) p = Vec3(50);
  view::Adaptation eye;
  view::FrameInfo info;
  view::showPicture(light, Vec3(1), display, 1, eye, info);
  require(std::isfinite(info.ev100));
  view::showAmounts(light, display, info);
  require(info.scaleHigh > info.scaleLow);
}

template <class T>
void check(const T&) {}

}  // namespace

void view_message(const uint8_t* data, size_t size) {
  const view::Message message = view::readMessage({reinterpret_cast<const char*>(data), size});
  std::visit([](const auto& m) { check(m); }, message);
}

}  // namespace roomlight::fuzz
