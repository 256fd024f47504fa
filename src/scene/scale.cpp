#include "scene/scene_change.h"

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

void moveScene(Scene& scene, Vec3 by) {
  for (Instance& instance : scene.instances) instance.worldFromObject.w += by;
  for (Leaf& leaf : scene.leaves) leaf.hinge += by;
  for (Camera& camera : scene.cameras) camera.worldFromCamera.w += by;
  for (Lamp& lamp : scene.lamps) lamp.position += by;
  for (Room& room : scene.rooms) {
    for (Vec2& corner : room.floor) corner = corner + Vec2{by.x, by.z};
    room.elevationM += by.y;
  }
}

}  // namespace roomlight
