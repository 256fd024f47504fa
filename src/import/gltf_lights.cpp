#include "import/gltf_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "import/failure.h"
#include "import/photometric_file.h"

namespace roomlight::importers {
namespace {

constexpr float kBrightest = 1e12f;
constexpr float kFarthest = 1e6f;

// The axis of a node's frame, whose scale may be beyond what can be squared.
Vec3 unit(Vec3 axis) {
  const float squared = lengthSquared(axis);
  if (std::isnormal(squared)) return normalize(axis);
  const float largest = maxComponent(abs(axis));
  return largest > 0 ? normalize(axis / largest) : Vec3(0, 0, 1);
}

std::string nameOf(const Json& thing, const std::string& nodeName) {
  const std::string name = thing.name();
  return name.empty() ? nodeName : name;
}

// "spot.ies", also where a modelling program has numbered copies: "spot.ies.002".
std::string photometricName(const std::string& nodeName) {
  std::string name = nodeName;
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  if (const size_t n = name.size();
      n > 4 && name[n - 4] == '.' && isDigit(name[n - 3]) && isDigit(name[n - 2]) && isDigit(name[n - 1]))
    name.resize(n - 4);
  return isPhotometric(name) ? name : "";
}

}  // namespace

std::optional<Camera> readGltfCamera(const Json& in, const std::string& nodeName, const Affine& world) {
  Camera camera;
  camera.name = nameOf(in, nodeName);
  camera.worldFromCamera = {unit(world.x), unit(world.y), unit(world.z), world.w};
  const std::string type = in.text("type");
  if (const auto o = in.find("orthographic"); o && type == "orthographic") {
    const float xMag = std::abs(o->number("xmag", 1));
    camera.projection = Projection::Orthographic;
    camera.yMagM = std::abs(o->number("ymag", 1));
    if (!(xMag > 0 && xMag <= kFarthest && camera.yMagM > 0 && camera.yMagM <= kFarthest)) return std::nullopt;
    camera.aspect = xMag / camera.yMagM;
    camera.nearM = std::clamp(o->number("znear", 0), -kFarthest, kFarthest);
    return camera;
  }
  if (const auto p = in.find("perspective"); p && type == "perspective") {
    // The near plane only serves depth buffers: a picture of a room is not cut open by it.
    camera.yFovRad = p->number("yfov", 0);
    if (camera.yFovRad < 1e-4f || camera.yFovRad > kPi - 1e-3f) return std::nullopt;
    const float aspect = p->number("aspectRatio", 0);
    camera.aspect = aspect >= 1e-4f && aspect <= 1e4f ? aspect : 0;
    return camera;
  }
  return std::nullopt;
}

void addGltfLight(GltfDocument& document, const Json& extension, const std::string& nodeName, const Affine& world,
                  Scene& scene) {
  const auto all = document.root().extension("KHR_lights_punctual");
  if (!all) return document.warnings.add("references to things that do not exist are ignored");
  const Json lights = all->list("lights");
  const int index = document.looseIndex(extension, "light", lights.size());
  if (index < 0) return;
  const Json in = lights[static_cast<size_t>(index)];
  const auto limited = [&](float v, float low, float high) {
    if (!(v >= low && v <= high)) document.warnings.add("values of lights outside their range are limited to it");
    return std::clamp(v, low, high);
  };
  Vec3 strength = in.vec3("color", Vec3(1));
  for (int c = 0; c < 3; ++c) strength[c] = limited(strength[c], 0, 1e6f);
  strength *= limited(in.number("intensity", 1), 0, kBrightest);
  const std::string type = in.text("type"), name = nameOf(in, nodeName);
  if (type == "directional") {
    scene.suns.push_back({.name = name, .toLight = unit(world.z), .illuminanceLux = strength});
    return;
  }
  Lamp lamp;
  lamp.name = name;
  lamp.position = world.w;
  lamp.direction = -unit(world.z);
  lamp.intensityCd = strength;
  if (type == "spot") {
    lamp.kind = LampKind::Spot;
    if (const auto spot = in.find("spot")) {
      lamp.outerConeRad = limited(spot->number("outerConeAngle", kPi / 4), 1e-3f, kPi / 2 + 1e-4f);
      lamp.innerConeRad = limited(spot->number("innerConeAngle", 0), 0, lamp.outerConeRad);
    }
  } else if (type != "point") {
    return document.warnings.add("lights of an unknown kind are left out");
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
      if (key != "ies" && key != "fluxLm" && key != "dimming" && key != "lightLossFactor" && key != "as")
        ours->fail(fmt::format("the key '{}' is unknown", printable(key)));
    }
    if (ours->find("fluxLm")) fluxLm = static_cast<double>(ours->number("fluxLm", 0, 0, kBrightest));
    factor = static_cast<double>(ours->number("dimming", 1, 0, 1) * ours->number("lightLossFactor", 1, 1e-6f, 1));
    const std::string as = ours->text("as");
    if (!as.empty() && as != "point" && as != "area") ours->at("as").fail("is neither point nor area");
    size = as == "point" ? LampSize::Point : as == "area" ? LampSize::Area : LampSize::AsStated;
  }
  const std::string place = ours ? ours->at("ies").path() : node.path();
  std::filesystem::path file;
  try {
    file = pathInside(document.folder, name, place);
  } catch (const Failure&) {
    if (ours) throw;
  }
  std::error_code code;
  if (!ours && !std::filesystem::is_regular_file(file, code))
    return document.warnings.add(
        fmt::format("the luminaire '{}' is left out: there is no such file beside the scene", printable(name)));
  const Result<PhotometricFiles::Web> web = document.photometric.read(file);
  if (!web) fail(place, fmt::format("'{}': {}", printable(name), web.error()));
  if (size == LampSize::Area && !web.value()->hasOpening())
    fail(place, "the file states no luminous opening; 'as' must be point");
  Lamp lamp;
  lamp.name = node.name().empty() ? name : node.name();
  lamp.position = world.w;
  lamp.direction = -unit(world.z);
  lamp.up = perpendicular(unit(world.y), lamp.direction);
  if (isBlack(lamp.up)) fail(place, "the node's transform leaves no direction for C0");
  setWeb(lamp, web.value(), size, Vec3(1), fluxLm, factor);
  if (!(luminance(lamp.intensityCd) <= 1.001f * kBrightest)) fail(place, "an intensity is above 1e12 cd");
  scene.lamps.push_back(lamp);
}

}  // namespace roomlight::importers
