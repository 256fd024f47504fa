#include "bake/glb.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "bake/batch.h"
#include "bake/glb_materials.h"
#include "bake/glb_writer.h"
#include "bake/light_map.h"
#include "bake/light_texels.h"
#include "bake/stitch.h"
#include "photometry/colour_temperature.h"

namespace roomlight::bake {
namespace {

// Places of a home as whole numbers of steps from its lowest corner; no steps where those would be too long.
struct Grid {
  Vec3 origin;
  float stepM = 0;
};
constexpr float kLongestStepM = 0.0005f;  // things 1 mm apart stay apart
constexpr float kSteps = 65535;

std::array<int8_t, 4> packedNormal(Vec3 n) {
  const auto pack = [](float f) { return static_cast<int8_t>(std::lround(std::clamp(f, -1.0f, 1.0f) * 127)); };
  return {pack(n.x), pack(n.y), pack(n.z), 0};
}

uint8_t packedByte(float f) { return static_cast<uint8_t>(std::lround(std::clamp(f, 0.0f, 1.0f) * 255)); }

// Of a corner of a triangle: its place in PlacedChart::vertices, and the one of them whose texel it is lit by.
using Corner = std::pair<uint32_t, uint32_t>;

class BatchMaker {
 public:
  // `light`: on the atlas. Given, triangles that would be lit by vertices have one texel each, as programs that know
  // light maps alone would else read what lies between the texels of corners.
  BatchMaker(const Scene& scene, const Atlas& atlas, const Image* light)
      : scene_(scene), atlas_(atlas), light_(light) {}

  void add(const PlacedChart& placed, Batch& batch) const {
    const bool facets = light_ && placed.chart.byVertices;
    std::vector<Corner> corners;
    std::map<Corner, uint32_t> known;
    const auto first = static_cast<uint32_t>(batch.positions.size());
    const auto use = [&](const Corner& corner) {
      const auto [at, isNew] = known.try_emplace(corner, static_cast<uint32_t>(corners.size()));
      if (isNew) corners.push_back(corner);
      batch.indices.push_back(first + at->second);
    };
    for (size_t t = 0; t + 2 < placed.indices.size(); t += 3) {
      const uint32_t* triangle = &placed.indices[t];
      const uint32_t middle = facets ? middlingOf(placed, triangle) : 0;
      for (int k = 0; k < 3; ++k) use({triangle[k], facets ? middle : triangle[k]});
    }
    addVertices(placed, corners, placed.chart.byVertices && !facets, batch);
  }

 private:
  void addVertices(const PlacedChart& placed, const std::vector<Corner>& corners, bool byVertices, Batch& batch) const {
    const Instance& instance = scene_.instances[placed.chart.instance];
    const Mesh& mesh = scene_.meshes[static_cast<size_t>(instance.mesh)];
    const Material& material = scene_.materials[static_cast<size_t>(mesh.material)];
    const TextureRef* coordinates = coordinatesOf(material);
    const std::vector<Vec3> flat = mesh.normals.empty() ? faceNormals(placed, mesh, instance) : std::vector<Vec3>();
    for (const auto& [i, litBy] : corners) {
      const uint32_t v = placed.vertices[i].vertex;
      batch.positions.push_back(instance.worldFromObject.point(mesh.positions[v]));
      Vec3 n = flat.empty() ? instance.worldFromObject.normal(mesh.normals[v]) : flat[i];
      if (flat.empty() && dot(n, placed.chart.normal) < 0 && !placed.chart.byVertices) n = -n;
      if (flat.empty() && placed.chart.byVertices && placed.chart.back) n = -n;
      batch.normals.push_back(packedNormal(length(n) > 0 ? normalize(n) : placed.chart.normal));
      const std::vector<Vec2>* uv = coordinates ? &mesh.uv[coordinates->uvSet] : nullptr;
      batch.uv.push_back(uv && v < uv->size() ? transformUv(*coordinates, (*uv)[v]) : Vec2{});
      batch.atlas.push_back(onAtlas(placed.vertices[litBy].texel));
      batch.vertexLit.push_back({static_cast<uint8_t>(byVertices ? 1 : 0), 0, 0, 0});
      const Vec3 c = v < mesh.colors.size() ? mesh.colors[v] : Vec3(1);
      const float alpha = v < mesh.colorAlphas.size() ? mesh.colorAlphas[v] : 1;
      batch.colors.push_back({packedByte(c.x), packedByte(c.y), packedByte(c.z), packedByte(alpha)});
      batch.coloured |= !mesh.colors.empty();
    }
  }
  // Of the corners of a triangle the one with the middling light.
  uint32_t middlingOf(const PlacedChart& placed, const uint32_t* triangle) const {
    const auto lux = [&](uint32_t i) {
      const Vec2 texel = placed.vertices[i].texel;
      return luminance(light_->at(static_cast<int>(texel.x), static_cast<int>(texel.y)));
    };
    std::array<uint32_t, 3> by{triangle[0], triangle[1], triangle[2]};
    std::sort(by.begin(), by.end(),
              [&](uint32_t a, uint32_t b) { return std::pair(lux(a), a) < std::pair(lux(b), b); });
    return by[1];
  }
  // Where a mesh has no normals: means over the chart's faces, which are nearly flat.
  static std::vector<Vec3> faceNormals(const PlacedChart& placed, const Mesh& mesh, const Instance& instance) {
    std::vector<Vec3> sums(placed.vertices.size());
    for (size_t t = 0; t + 2 < placed.indices.size(); t += 3) {
      const auto at = [&](size_t k) {
        return instance.worldFromObject.point(mesh.positions[placed.vertices[placed.indices[t + k]].vertex]);
      };
      const Vec3 n = cross(at(1) - at(0), at(2) - at(0));
      for (size_t k = 0; k < 3; ++k) sums[placed.indices[t + k]] += n;
    }
    return sums;
  }
  std::array<uint16_t, 2> onAtlas(Vec2 texel) const {
    const auto pack = [](float f, int size) {
      return static_cast<uint16_t>(std::lround(std::clamp(f / static_cast<float>(size), 0.0f, 1.0f) * 65535));
    };
    return {pack(texel.x, atlas_.width), pack(texel.y, atlas_.height)};
  }

  const Scene& scene_;
  const Atlas& atlas_;
  const Image* const light_;
};

// Triangles in an order that is quick to draw and small once compressed, vertices as they are used.
void reorder(Batch& b) {
  const size_t count = b.positions.size();
  meshopt_optimizeVertexCache(b.indices.data(), b.indices.data(), b.indices.size(), count);
  std::vector<uint32_t> place(count);
  const size_t used = meshopt_optimizeVertexFetchRemap(place.data(), b.indices.data(), b.indices.size(), count);
  meshopt_remapIndexBuffer(b.indices.data(), b.indices.data(), b.indices.size(), place.data());
  const auto move = [&](auto& values) {
    meshopt_remapVertexBuffer(values.data(), values.data(), count, sizeof(values[0]), place.data());
    values.resize(used);
  };
  move(b.positions), move(b.normals), move(b.uv), move(b.atlas), move(b.colors), move(b.vertexLit);
}

int addPositions(GlbWriter& glb, const std::vector<Vec3>& positions, const Grid& grid) {
  Bounds3 bounds;
  if (grid.stepM <= 0) {
    for (const Vec3 p : positions) bounds.add(p);
    const int accessor =
        glb.addAccessor(bytesOf(positions), Component::Float, "VEC3", positions.size(), sizeof(Vec3), false);
    glb.setBounds(accessor, bounds);
    return accessor;
  }
  std::vector<std::array<uint16_t, 4>> steps;
  for (const Vec3 p : positions) {
    const Vec3 at = (p - grid.origin) / grid.stepM;
    const auto round = [](float f) { return static_cast<uint16_t>(std::lround(std::clamp(f, 0.0f, kSteps))); };
    steps.push_back({round(at.x), round(at.y), round(at.z), 0});
    bounds.add({static_cast<float>(steps.back()[0]), static_cast<float>(steps.back()[1]),
                static_cast<float>(steps.back()[2])});
  }
  const int accessor = glb.addAccessor(bytesOf(steps), Component::UnsignedShort, "VEC3", steps.size(), 8, false);
  glb.setBounds(accessor, bounds);
  return accessor;
}

Json primitiveOf(GlbWriter& glb, Batch& b, const Grid& grid, bool textured, int material) {
  reorder(b);
  const size_t n = b.positions.size();
  Json attributes;
  attributes["POSITION"] = addPositions(glb, b.positions, grid);
  attributes["NORMAL"] = glb.addAccessor(bytesOf(b.normals), Component::Byte, "VEC3", n, 4, true);
  if (textured) attributes["TEXCOORD_0"] = glb.addAccessor(bytesOf(b.uv), Component::Float, "VEC2", n, 8, false);
  attributes["TEXCOORD_1"] = glb.addAccessor(bytesOf(b.atlas), Component::UnsignedShort, "VEC2", n, 4, true);
  if (b.coloured)
    attributes["COLOR_0"] = glb.addAccessor(bytesOf(b.colors), Component::UnsignedByte, "VEC4", n, 4, true);
  attributes["_VERTEX_LIT"] = glb.addAccessor(bytesOf(b.vertexLit), Component::UnsignedByte, "SCALAR", n, 4, false);
  const int indices = glb.addAccessor(bytesOf(b.indices), Component::UnsignedInt, "SCALAR", b.indices.size(), 0, false);
  return {{"attributes", attributes}, {"indices", indices}, {"material", material}};
}

using Batches = std::map<std::pair<int, int>, Batch>;  // by material and layer of what it emits

Grid gridOf(const Batches& batches) {
  Bounds3 bounds;
  for (const auto& [key, batch] : batches) {
    for (const Vec3 p : batch.positions) bounds.add(p);
  }
  if (batches.empty()) return {};
  const float stepM = maxComponent(bounds.size()) / kSteps;
  return {bounds.lo, stepM > kLongestStepM ? 0 : stepM};
}

void addNode(GlbWriter& glb, const Json& primitives, const Grid& grid) {
  glb.json["meshes"] = Json::array({{{"name", "home"}, {"primitives", primitives}}});
  Json node = {{"name", "home"}, {"mesh", 0}};
  if (grid.stepM > 0) {
    node["translation"] = {grid.origin.x, grid.origin.y, grid.origin.z};
    node["scale"] = {grid.stepM, grid.stepM, grid.stepM};
  }
  glb.json["nodes"] = Json::array({node});
  glb.json["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
  glb.json["scene"] = 0;
}

// For the light map.
struct AtFirst {
  Image light;  // on the atlas
  float ev100 = 0;
};

// What is known of the textures once they are written.
struct Textures {
  size_t bytes = 0;
  Json lightMap;  // null: there is none
};

Result<Textures> addGeometry(GlbWriter& glb, const Scene& scene, const Atlas& atlas, const LampLayers& lamps,
                             const GlbSettings& settings, const AtFirst* first) {
  const BatchMaker maker(scene, atlas, first ? &first->light : nullptr);
  constexpr int kDark = -2;  // the side that does not shine
  Batches batches;
  for (const PlacedChart& placed : atlas.charts) {
    const Instance& instance = scene.instances[placed.chart.instance];
    const int material = scene.meshes[static_cast<size_t>(instance.mesh)].material;
    // Front is what it is in object space (glTF 2.0, 3.7.4); charts know sides of the world.
    const bool front = placed.chart.back == (instance.worldFromObject.determinant() < 0);
    const bool shines = front || scene.materials[static_cast<size_t>(material)].doubleSided;
    maker.add(placed, batches[{material, shines ? lamps.ofInstance[placed.chart.instance] : kDark}]);
  }
  std::vector<Batch*> all;
  for (auto& [key, batch] : batches) all.push_back(&batch);
  stitch(all);
  Grid grid;
  if (settings.compressed) grid = gridOf(batches);
  GlbMaterials materials(scene, glb, settings);
  Textures textures;
  if (first) {
    const LightMap map = lightMapOf(first->light, first->ev100);
    const Result<int> number = materials.useLightMap(map, exposureFromEv100(first->ev100));
    if (!number) return Error{number.error()};
    textures.lightMap = {{"texture", number.value()}, {"luxAtOne", map.luxAtOne}};
  }
  Json primitives = Json::array();
  for (auto& [key, batch] : batches) {
    const bool isOff = first && key.second >= 0 && !lamps.layers[static_cast<size_t>(key.second)].on;
    const Result<int> material = materials.add(key.first, key.second, key.second != kDark && !isOff);
    if (!material) return Error{material.error()};
    // Sets of coordinates are numbered from 0 (glTF 2.0, 3.7.2.1): some programs find the second by the first alone.
    primitives.push_back(primitiveOf(glb, batch, grid, first || materials.textured(key.first), material.value()));
  }
  materials.finish();
  textures.bytes = materials.textureBytes();
  addNode(glb, primitives, grid);
  return textures;
}

constexpr int kTile = 32;

Json vectorJson(Vec3 v) { return {v.x, v.y, v.z}; }

constexpr int kSlackOfLean = 3;  // of 511: 1 % of what a bump of 20° changes

Json texelsJson(GlbWriter& glb, const Image& light, int slack, size_t& lightBytes) {
  const LightTexels texels = lightTexels(light, kTile, slack);
  lightBytes += texels.stream.size();
  return {{"bufferView", glb.addView(texels.stream)}, {"scale", texels.scale}, {"tiles", texels.tiles}};
}

Json layerJson(GlbWriter& glb, const Scene& scene, const Atlas& atlas, const BakedLayer& layer, size_t& lightBytes) {
  constexpr const char* kKinds[] = {"lamp", "sun", "sky"};
  Json json = {{"name", layer.name}, {"kind", kKinds[static_cast<size_t>(layer.role)]}, {"on", layer.on}};
  if (layer.role == LayerRole::Lamp) {
    json["position"] = vectorJson(layer.position);
    if (const std::optional<double> kelvin = kelvinOf(layer.color)) json["kelvin"] = *kelvin;
    if (const int room = roomAt(scene, layer.position); room >= 0)
      json["room"] = scene.rooms[static_cast<size_t>(room)].name;
  } else {
    json["hour"] = layer.hour;
  }
  json["color"] = vectorJson(layer.color);
  json["light"] = texelsJson(glb, onAtlas(atlas, layer.lux), kSlack, lightBytes);
  if (!layer.lean.empty()) json["lean"] = texelsJson(glb, onAtlas(atlas, layer.lean), kSlackOfLean, lightBytes);
  if (layer.sun) {
    const MaskTexels mask = maskTexels(layer.mask, atlas.width, kTile);
    lightBytes += mask.stream.size();
    json["sun"] = {{"direction", vectorJson(layer.sun->toLight)},
                   {"lux", vectorJson(layer.sun->illuminanceLux)},
                   {"halfAngleDeg", layer.sun->halfAngleRad * 180 / kPi},
                   {"mask",
                    {{"bufferView", glb.addView(mask.stream)},
                     {"fine", kFineCells},
                     {"channels", mask.channels},
                     {"tiles", mask.tiles}}}};
  }
  if (layer.panorama.width > 0) {
    const LightTexels sky = lightTexels(layer.panorama);
    json["panorama"] = {{"bufferView", glb.addView(sky.stream)},
                        {"width", layer.panorama.width},
                        {"height", layer.panorama.height},
                        {"scale", sky.scale}};
  }
  return json;
}

Json whitesJson(const std::vector<ShownWhite>& whites) {
  Json out = Json::array();
  for (const ShownWhite& w : whites) out.push_back({{"light", vectorJson(w.light)}, {"shown", vectorJson(w.shown)}});
  return out;
}

Json roomsJson(const Scene& scene) {
  Json rooms = Json::array();
  for (const Room& room : scene.rooms) {
    Json floor = Json::array();
    for (const Vec2 p : room.floor) floor.push_back({p.x, p.y});
    rooms.push_back(
        {{"name", room.name}, {"floor", floor}, {"elevationM", room.elevationM}, {"heightM", room.heightM}});
  }
  return rooms;
}

Json camerasJson(const std::vector<Camera>& cameras) {
  Json out = Json::array();
  for (const Camera& c : cameras)
    out.push_back({{"name", c.name},
                   {"position", vectorJson(c.worldFromCamera.w)},
                   {"forward", vectorJson(-c.worldFromCamera.z)},
                   {"yFovDeg", c.yFovRad * 180 / kPi}});
  return out;
}

}  // namespace

Result<Glb> glbOf(const Scene& scene, const Atlas& atlas, const LampLayers& lamps,
                  const std::vector<BakedLayer>& daylight, const ShownAs& shown, const GlbSettings& settings) {
  GlbWriter glb(settings.compressed);
  AtFirst first;
  if (settings.lightMap) first = {lightAtFirst(atlas, lamps, daylight), shown.ev100};
  const Result<Textures> textures =
      addGeometry(glb, scene, atlas, lamps, settings, settings.lightMap ? &first : nullptr);
  if (!textures) return Error{textures.error()};
  Json layers = Json::array();
  Glb out;
  out.textureBytes = textures.value().bytes;
  for (const auto* group : {&lamps.layers, &daylight}) {
    for (const BakedLayer& layer : *group) layers.push_back(layerJson(glb, scene, atlas, layer, out.lightBytes));
  }
  const std::vector<Camera> cameras = camerasInside(scene);
  Json extension = {{"version", 4},
                    {"atlas", {{"width", atlas.width}, {"height", atlas.height}, {"tile", kTile}}},
                    {"layers", layers},
                    {"rooms", roomsJson(scene)},
                    {"cameras", camerasJson(cameras)},
                    {"camera", cameraInUse(scene, cameras)},
                    {"display",
                     {{"ev100", shown.ev100},
                      {"tone", toneCurveName(shown.tone.curve)},
                      {"contrast", shown.tone.contrast},
                      {"saturation", shown.tone.saturation},
                      {"whiteGains", vectorJson(shown.whiteGains)},
                      {"whites", whitesJson(shown.whites)}}}};
  if (!daylight.empty()) extension["hour"] = daylight.front().hour;
  if (settings.lightMap) extension["lightMap"] = textures.value().lightMap;
  glb.json["extensions"]["ROOMLIGHT_light_layers"] = extension;
  glb.json["extensionsUsed"].push_back("ROOMLIGHT_light_layers");
  if (settings.compressed) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      glb.json[list].push_back("EXT_meshopt_compression");
  }
  out.bytes = glb.finished();
  return out;
}

}  // namespace roomlight::bake
