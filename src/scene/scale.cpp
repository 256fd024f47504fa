#include "scene/scale.h"

namespace roomlight {

void scaleScene(Scene& scene, float s) {
  for (Instance& instance : scene.instances) {
    Affine& m = instance.worldFromObject;
    m = {m.x * s, m.y * s, m.z * s, m.w * s};
  }
  for (Leaf& leaf : scene.leaves) leaf.hinge *= s, leaf.slideM *= s;
  for (Camera& camera : scene.cameras) {
    camera.worldFromCamera.w *= s;
    camera.nearM *= s;
    camera.yMagM *= s;
  }
  for (Room& room : scene.rooms) {
    for (Vec2& corner : room.floor) corner = corner * s;
    room.elevationM *= s, room.heightM *= s;
  }
  for (Material& material : scene.materials) {
    material.thicknessM *= s;
    material.attenuationDistanceM *= s;
  }
  for (Lamp& lamp : scene.lamps) {
    lamp.position *= s;
    lamp.widthM *= s;
    lamp.heightM *= s;
  }
}

}  // namespace roomlight
