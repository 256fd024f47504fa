#include "import/gltf_lights.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "import/failure.h"
#include "import/photometric_file.h"

namespace roomlight::importers {
namespace {

constexpr float kBrightest = 1e12f;

std::string nameOf(const Json& thing, const std::string& nodeName) {
  const std::string name = thing.name();
  return name.empty() ? nodeName : name;
}

// "spot.ies", also where a modelling program has numbered copies: "spot.ies.002".
std::string photometricName(const std::string& nodeName) {
  std::string name = nodeName;
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  if (const size_t n = name.size(); n > 4 && name[n - 4] == '.' && isDigit(name[n - 3]) && isDigit(name[n - 2]) && isDigit(name[n - 1])) name.resize(n - 4);
  return isPhotometric(name) ? name : "";
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
    camera.projection = Projection::Orthographic;
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

void addGltfLuminaire(GltfDocument& document, const Json& node, const Affine& world, Scene& scene) {
  const auto extras = node.find("extras");
  const auto ours = extras && extras->raw().is_object() ? extras->find("roomlight") : std::nullopt;
  std::string name = ours ? ours->at("ies").text() : photometricName(node.name());
  if (name.empty()) return;
  double fluxLm = -1, factor = 1;
  LampSize size = LampSize::AsStated;
  if (ours) {
    for (const auto& [key, value] : ours->raw().items()) {
      if (key != "ies" && key != "fluxLm" && key != "dimming" && key != "lightLossFactor" && key != "as") ours->fail(fmt::format("the key '{}' is unknown", printable(key)));
    }
    if (ours->find("fluxLm")) fluxLm = static_cast<double>(ours->number("fluxLm", 0, 0, kBrightest));
    factor = static_cast<double>(ours->number("dimming", 1, 0, 1) * ours->number("lightLossFactor", 1, 1e-6f, 1));
    const std::string as = ours->text("as");
    if (!as.empty() && as != "point" && as != "area") ours->at("as").fail("is neither point nor area");
    size = as == "point" ? LampSize::Point : as == "area" ? LampSize::Area
                                                          : LampSize::AsStated;
  }
  const std::string place = ours ? ours->at("ies").path() : node.path();
  std::filesystem::path file;
  try {
    file = pathInside(document.folder, name, place);
  } catch (const Failure&) {
    if (ours) throw;
  }
  std::error_code code;
  if (!ours && !std::filesystem::is_regular_file(file, code)) return document.warnings.add(fmt::format("the luminaire '{}' is left out: there is no such file beside the scene", printable(name)));
  const Result<PhotometricFiles::Web> web = document.photometric.read(file);
  if (!web) fail(place, fmt::format("'{}': {}", printable(name), web.error()));
  if (size == LampSize::Area && !web.value()->hasOpening()) fail(place, "the file states no luminous opening; 'as' must be point");
  Lamp lamp;
  lamp.name = node.name().empty() ? name : node.name();
  lamp.position = world.w;
  lamp.direction = -normalize(world.z);
  lamp.up = perpendicular(normalize(world.y), lamp.direction);
  if (isBlack(lamp.up)) fail(place, "the node's transform leaves no direction for C0");
  setWeb(lamp, web.value(), size, Vec3(1), fluxLm, factor);
  if (!(luminance(lamp.intensityCd) <= 1.001f * kBrightest)) fail(place, "an intensity is above 1e12 cd");
  scene.lamps.push_back(lamp);
}

}  // namespace roomlight::importers
