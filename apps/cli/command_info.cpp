// roomlight info: what a scene or a photometric file holds.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "commands.h"
#include "console.h"
#include "engine/views.h"
#include "import/import.h"
#include "home/rooms.h"
#include "import/photometric_file.h"
#include "output_files.h"
#include "measure/luminaires.h"
#include "scene/object_measures.h"
#include "scene/shown_names.h"
#include "arguments.h"
#include "trace/light_layers.h"

namespace roomlight::cli {
namespace {

struct InfoOptions : SceneOptions {
  bool json = false, objects = false;
};

Json vector(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

// As the file says.
Json webJson(const PhotometricWeb& web) {
  return {{"name", web.name},         {"manufacturer", web.manufacturer},        {"format", web.format},
          {"fileFluxLm", web.fluxLm}, {"statedFluxLm", web.statedFluxLm},        {"peakCd", web.peakCd},
          {"watts", web.watts},       {"openingM", {web.sizeC0M, web.sizeC90M}}, {"round", web.round}};
}

Json lampJson(const Lamp& lamp) {
  Json j = {{"name", lamp.name}};
  if (lamp.kind == LampKind::Area) {
    const double fluxLm = static_cast<double>(luminance(lamp.luminanceCdM2) * lamp.widthM * lamp.heightM * kPi);
    j["kind"] = "area";
    j["luminanceCdM2"] = luminance(lamp.luminanceCdM2);
    j["fluxLm"] = fluxLm;
  } else {
    j["kind"] = lamp.kind == LampKind::Spot ? "spot" : "point";
    j["intensityCd"] = luminance(lamp.intensityCd);
  }
  if (lamp.web) {
    // Of the luminaire as it is here: dimmed, tilted, with another flux.
    j["kind"] = "photometric", j["as"] = lamp.extended ? "area" : "point";
    j["fluxLm"] = lamp.web->fluxLm * static_cast<double>(luminance(lamp.intensityCd) / lamp.web->peakCd);
    j["web"] = webJson(*lamp.web);
  }
  j["positionM"] = vector(lamp.position);
  return j;
}

Json objectsJson(const Scene& scene) {
  Json out = Json::array();
  const std::map<int, std::string> shown = shownObjectNames(scene);
  std::map<int, const std::string*> names;  // of whole objects; their parts go by their own
  for (const Instance& i : scene.instances) names.try_emplace(i.object, &i.name);
  for (const ObjectMeasures& o : measureObjects(scene)) {
    out.push_back({{"name", o.name},
                   {"label", o.name == *names.at(o.object) ? shown.at(o.object) : o.name},
                   {"triangles", o.triangles},
                   {"areaM2", o.areaM2()},
                   {"areaUpM2", o.areaUpM2},
                   {"areaDownM2", o.areaDownM2},
                   {"areaUprightM2", o.areaUprightM2},
                   {"netAreaM2", o.netAreaM2},
                   {"volumeM3", o.volumeM3},
                   {"boundsM", {{"low", vector(o.bounds.lo)}, {"high", vector(o.bounds.hi)}}}});
  }
  return out;
}

const char* kindName(LayerKind kind) {
  return kind == LayerKind::Lamp ? "lamp" : kind == LayerKind::Group ? "group" : "mesh";
}

// What people switch, as render --layers tells it apart: lamps, groups of lamps, shining meshes.
Json lightsJson(const Scene& scene) {
  Json out = Json::array();
  const Lights lights(scene);
  const Result<LightLayers> layers = layersOf(scene, lights);
  if (!layers) return Json();  // too many to be told apart
  for (const LightLayer& l : layers.value().layers) {
    if (l.kind == LayerKind::Sun || l.kind == LayerKind::Sky) continue;
    const int room = roomAt(scene, l.position);
    out.push_back({{"name", l.name},
                   {"kind", kindName(l.kind)},
                   {"fluxLm", luminance(l.fluxLm)},
                   {"positionM", vector(l.position)}});
    out.back()["room"] = room >= 0 ? Json(scene.rooms[static_cast<size_t>(room)].name) : Json();
  }
  return out;
}

Json roomsJson(const Scene& scene) {
  Json rooms = Json::array();
  const std::vector<Luminaire> luminaires = luminairesOf(scene);  // as measure counts them
  const std::vector<Level> levels = levelsOf(scene.rooms);
  for (const Room& room : scene.rooms) {
    size_t level = 0;
    for (size_t i = 0; i < levels.size(); ++i) level = room.elevationM >= levels[i].elevationM - 1e-3f ? i : level;
    rooms.push_back({{"name", room.name},
                     {"areaM2", home::areaM2(room)},
                     {"elevationM", room.elevationM},
                     {"heightM", room.heightM},
                     {"level", level}});
    const auto lamps = std::count_if(luminaires.begin(), luminaires.end(),
                                     [&](const Luminaire& l) { return home::isIn(room, l.position); });
    rooms.back()["lamps"] = lamps;
  }
  return rooms;
}

Json describe(const home::OpenedHome& home) {
  const Scene& scene = home.scene;
  const Bounds3 bounds = scene.bounds();
  size_t emissive = 0;
  for (const Material& m : scene.materials) emissive += isBlack(m.emission) ? 0 : 1;
  Json lamps = Json::array(), suns = Json::array(), cameras = Json::array();
  for (const Lamp& lamp : scene.lamps) lamps.push_back(lampJson(lamp));
  for (const Sun& sun : scene.suns)
    suns.push_back(
        {{"name", sun.name}, {"illuminanceLux", luminance(sun.illuminanceLux)}, {"toLight", vector(sun.toLight)}});
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const Camera& c = scene.cameras[i];
    cameras.push_back({{"name", c.name},
                       {"kind", c.projection == Projection::Orthographic ? "orthographic" : "perspective"},
                       {"positionM", vector(c.worldFromCamera.w)},
                       {"proposed", i >= home.fileCameras},
                       {"default", static_cast<int>(i) == scene.cameraInUse}});
    if (i < home.fileCameras && c.cutHeightM < kInfinity) cameras.back()["cutHeightM"] = c.cutHeightM;
    if (c.projection == Projection::Perspective) cameras.back()["verticalAngleDeg"] = c.yFovRad * 180 / kPi;
  }
  return {{"triangles", scene.triangleCount()},
          {"meshes", scene.meshes.size()},
          {"instances", scene.instances.size()},
          {"materials", scene.materials.size()},
          {"emissiveMaterials", emissive},
          {"textures", scene.textures.size()},
          {"lamps", lamps},
          {"lights", lightsJson(scene)},
          {"suns", suns},
          {"sky", scene.sky.present()},
          {"rooms", roomsJson(scene)},
          {"levels", levelsOf(scene.rooms).size()},
          {"cameras", cameras},
          {"metresPerUnit", home.metresPerUnit},
          {"boundsM", {{"low", vector(bounds.lo)}, {"high", vector(bounds.hi)}}},
          {"notes", home.notes},
          {"warnings", home.warnings}};
}

// Names come from files; line breaks in them must not break the table.
std::string shown(const Json& name) {
  std::string s = name.get<std::string>();
  for (char& c : s) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return "'" + s + "'";
}

void printObjects(const Json& objects) {
  fmt::print("objects            {}\n  {:>9} {:>11} {:>11}  {:<24}  name\n", objects.size(), "triangles", "area m2",
             "volume m3", "size m");
  for (const Json& o : objects) {
    const auto low = o["boundsM"]["low"].get<std::vector<double>>(),
               high = o["boundsM"]["high"].get<std::vector<double>>();
    fmt::print("  {:>9} {:>11.4f} {:>11.4f}  {:<24}  {}\n", o["triangles"].get<size_t>(), o["areaM2"].get<double>(),
               o["volumeM3"].get<double>(),
               fmt::format("{:.3f} x {:.3f} x {:.3f}", high[0] - low[0], high[1] - low[1], high[2] - low[2]),
               o["label"] == o["name"] ? shown(o["name"])
                                       : fmt::format("{}, in the file {}", shown(o["label"]), shown(o["name"])));
  }
}

void printLamps(const Json& j) {
  fmt::print("{:<18} {}\n", "lamps", j["lamps"].size());
  for (const Json& lamp : j["lamps"]) {
    if (lamp["kind"] == "photometric") {
      const Json& web = lamp["web"];
      fmt::print("  photometric {}: {:.6g} lm, peak {:.6g} cd, as {}; {}, {}\n", shown(lamp["name"]),
                 lamp["fluxLm"].get<double>(), lamp["intensityCd"].get<double>(), lamp["as"].get<std::string>(),
                 web["format"].get<std::string>(), shown(web["name"]));
      continue;
    }
    const bool area = lamp["kind"] == "area";
    fmt::print(
        "  {} {}: {}\n", lamp["kind"].get<std::string>(), shown(lamp["name"]),
        area ? fmt::format("{:.6g} cd/m2, {:.6g} lm", lamp["luminanceCdM2"].get<double>(), lamp["fluxLm"].get<double>())
             : fmt::format("{:.6g} cd", lamp["intensityCd"].get<double>()));
  }
  // Lamps that are meshes, and what is switched together.
  if (j["lights"].is_null()) {
    fmt::print("{:<18} more than {}\n", "lights", kMostLayers);
    return;
  }
  fmt::print("{:<18} {}\n", "lights", j["lights"].size());
  for (const Json& light : j["lights"]) {
    fmt::print("  {} {}: {:.6g} lm{}\n", light["kind"].get<std::string>(), shown(light["name"]),
               light["fluxLm"].get<double>(),
               light["room"].is_null() ? "" : fmt::format(", room {}", shown(light["room"])));
  }
}

void printHome(const Json& j) {
  for (const char* key : {"triangles", "meshes", "instances", "materials", "emissiveMaterials", "textures"}) {
    fmt::print("{:<18} {}\n", key, j[key].get<size_t>());
  }
  const auto low = j["boundsM"]["low"].get<std::vector<double>>(),
             high = j["boundsM"]["high"].get<std::vector<double>>();
  fmt::print("{:<18} {:.2f} x {:.2f} x {:.2f} m, from ({:.2f}, {:.2f}, {:.2f}) to ({:.2f}, {:.2f}, {:.2f})\n", "bounds",
             high[0] - low[0], high[1] - low[1], high[2] - low[2], low[0], low[1], low[2], high[0], high[1], high[2]);
  printLamps(j);
  fmt::print("{:<18} {}\n", "suns", j["suns"].size());
  for (const Json& sun : j["suns"])
    fmt::print("  {}: {:.6g} lx\n", shown(sun["name"]), sun["illuminanceLux"].get<double>());
  fmt::print("{:<18} {}\n", "sky", j["sky"].get<bool>() ? "yes" : "no");
  fmt::print("{:<18} {}, on {} levels\n", "rooms", j["rooms"].size(), j["levels"].get<size_t>());
  for (const Json& r : j["rooms"]) {
    fmt::print("  {}: {:.1f} m2, {:.2f} m high, level {} at {:.2f} m, lamps {}\n", shown(r["name"]),
               r["areaM2"].get<double>(), r["heightM"].get<double>(), r["level"].get<size_t>(),
               r["elevationM"].get<double>(), r["lamps"].get<long>());
  }
  fmt::print("{:<18} {}\n", "cameras", j["cameras"].size());
  size_t index = 0;
  for (const Json& c : j["cameras"]) {
    const auto at = c["positionM"].get<std::vector<double>>();
    fmt::print("  {} {}: {} at ({:.2f}, {:.2f}, {:.2f}){}{}\n", index++, shown(c["name"]), c["kind"].get<std::string>(),
               at[0], at[1], at[2],
               c.contains("cutHeightM")    ? fmt::format(", cuts the home at {:.2f} m", c["cutHeightM"].get<double>())
               : c["proposed"].get<bool>() ? ", proposed"
                                           : "",
               c["default"].get<bool>() ? ", shown by default" : "");
  }
}

int showPhotometricFile(const InfoOptions& o) {
  importers::PhotometricFiles files;
  const auto web = files.read(o.scene);
  if (!web) {
    printError(fmt::format("{}: {}", o.scene, web.error()));
    return kBadInput;
  }
  Json j = webJson(*web.value());
  j["warnings"] = files.warnings();
  if (o.json) {
    fmt::print("{}\n", j.dump(2, ' ', false, Json::error_handler_t::replace));
    return kOk;
  }
  const PhotometricWeb& w = *web.value();
  fmt::print("{:<18} {}\n{:<18} {}\n{:<18} {}\n", "luminaire", shown(j["name"]), "manufacturer",
             shown(j["manufacturer"]), "format", w.format);
  fmt::print("{:<18} {:.6g} lm\n{:<18} {}\n{:<18} {:.6g} cd\n", "flux", w.fluxLm, "stated flux",
             w.statedFluxLm > 0 ? fmt::format("{:.6g} lm", w.statedFluxLm) : "none", "peak", w.peakCd);
  fmt::print("{:<18} {}\n", "opening",
             w.hasOpening() ? fmt::format("{:.4g} m along C0, {:.4g} m along C90, {}", w.sizeC0M, w.sizeC90M,
                                          w.round ? "round" : "rectangular")
                            : "none");
  printWarnings(files.warnings());
  return kOk;
}

int runInfo(const InfoOptions& o) {
  if (importers::isPhotometric(o.scene)) return showPhotometricFile(o);

  Result<home::OpenWish> wish = readSceneOptions(o);
  if (!wish) {
    printError(wish.error());
    return kBadInput;
  }
  if (o.light == "auto" && o.writeLighting.empty()) wish.value().light = home::LightWish::File;  // what the file holds
  wish.value().allCameras = true;
  const Result<home::OpenedHome> opened = home::openHome(wish.value());
  if (!opened) {
    printError(opened.error());
    return kBadInput;
  }
  if (const Status s = writeAddedLight(o, opened.value()); !s) {
    printError(s.error());
    return kBadInput;
  }
  Json j = describe(opened.value());
  const bool objects = o.objects || std::filesystem::path(o.scene).extension() == ".sh3f";  // a library is its pieces
  if (objects) j["objects"] = objectsJson(opened.value().scene);
  if (o.json) {
    fmt::print("{}\n", j.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    printHome(j);
    if (objects) printObjects(j["objects"]);
    printOpened(o, opened.value());
  }
  return kOk;
}

}  // namespace

Registered addInfo(CLI::App& program) {
  const auto o = std::make_shared<InfoOptions>();
  CLI::App* app = program.add_subcommand("info", "Say what a scene or a photometric file holds");
  addSceneOptions(*app, *o, "SCENE");
  app->add_flag("--objects", o->objects, "List every object with its triangles, area, volume and bounds");
  app->add_flag("--json", o->json, "Print JSON");
  app->footer("Example:\n  roomlight info flat.glb --json");
  return {app, [o] { return runInfo(*o); }};
}

}  // namespace roomlight::cli
