#include "import/gltf_lights.h"

#include <cmath>

namespace roomlight::importers {
namespace {

constexpr float kBrightest = 1e12f;

std::string nameOf(const Json& thing, const std::string& nodeName) {
  const std::string name = thing.name();
  return name.empty() ? nodeName : name;
}

}  // namespace

Camera readGltfCamera(const Json& in, const std::string& nodeName, const Affine& world) {
  Camera camera;
  camera.name = nameOf(in, nodeName);
  camera.worldFromCamera = {normalize(world.x), normalize(world.y), normalize(world.z), world.w};
  const std::string type = in.at("type").text();
  if (type == "orthographic") {
    const Json o = in.at("orthographic");
    const float xMag = std::abs(o.number("xmag", 1, -1e6f, 1e6f));
    camera.orthographic = true;
    camera.yMagM = std::abs(o.number("ymag", 1, -1e6f, 1e6f));
    if (xMag == 0 || camera.yMagM == 0) o.fail("sees nothing: xmag and ymag must not be zero");
    camera.aspect = xMag / camera.yMagM;
    camera.nearM = o.number("znear", 0, -1e6f, 1e6f);
  } else if (type == "perspective") {
    // The near plane only serves depth buffers: a picture of a room is not cut open by it.
    const Json p = in.at("perspective");
    p.at("yfov");
    camera.yFovRad = p.number("yfov", 0, 1e-4f, kPi - 1e-3f);
    camera.aspect = p.number("aspectRatio", 0, 0, 1e4f);
  } else {
    in.at("type").fail("is neither perspective nor orthographic");
  }
  return camera;
}

void addGltfLight(const GltfDocument& document, const Json& extension, const std::string& nodeName, const Affine& world, Scene& scene) {
  const auto all = document.root().extension("KHR_lights_punctual");
  if (!all) extension.fail("the file has no lights");
  const Json lights = all->at("lights");
  const Json in = lights[static_cast<size_t>(extension.at("light").index(lights.size()))];
  const Vec3 colour = in.vec3("color", Vec3(1));
  if (minComponent(colour) < 0 || maxComponent(colour) > 1e6f) in.at("color").fail("must be from 0 to 1");
  const Vec3 strength = colour * in.number("intensity", 1, 0, kBrightest);
  const std::string type = in.at("type").text(), name = nameOf(in, nodeName);
  if (type == "directional") {
    scene.suns.push_back({.name = name, .toLight = normalize(world.z), .illuminanceLux = strength});
    return;
  }
  Lamp lamp;
  lamp.name = name;
  lamp.position = world.w;
  lamp.direction = -normalize(world.z);
  lamp.intensityCd = strength;
  if (type == "spot") {
    lamp.kind = LampKind::Spot;
    if (const auto spot = in.find("spot")) {
      lamp.outerConeRad = spot->number("outerConeAngle", kPi / 4, 0, kPi / 2 + 1e-4f);
      lamp.innerConeRad = spot->number("innerConeAngle", 0, 0, kPi / 2 + 1e-4f);
    }
    if (lamp.innerConeRad > lamp.outerConeRad || lamp.outerConeRad == 0) in.at("spot").fail("the inner cone must be smaller than the outer one");
  } else if (type != "point") {
    in.at("type").fail("is none of point, spot and directional");
  }
  scene.lamps.push_back(lamp);
}

}  // namespace roomlight::importers
