// glTF 2.0, JSON and binary, through tinygltf; extensions arrive as raw JSON values.
#include <fmt/format.h>

#include <cstring>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#include <tiny_gltf.h>

#include "import/import.h"
#include "scene/validate.h"

namespace roomlight {
namespace {

using tinygltf::Value;

double number(const Value& v, double fallback) { return v.IsNumber() ? v.GetNumberAsDouble() : fallback; }
float field(const Value& v, const char* key, float fallback) {
  return v.IsObject() && v.Has(key) ? static_cast<float>(number(v.Get(key), fallback)) : fallback;
}
Vec3 colour(const Value& v, const char* key, Vec3 fallback) {
  if (!v.IsObject() || !v.Has(key) || !v.Get(key).IsArray() || v.Get(key).ArrayLen() < 3) return fallback;
  const Value& a = v.Get(key);
  return {static_cast<float>(number(a.Get(0), 0)), static_cast<float>(number(a.Get(1), 0)), static_cast<float>(number(a.Get(2), 0))};
}
const Value* extension(const tinygltf::ExtensionMap& map, const char* name) {
  const auto it = map.find(name);
  return it == map.end() ? nullptr : &it->second;
}

class Reader {
 public:
  Reader(const tinygltf::Model& model, Imported& out) : model_(model), out_(out), scene_(out.scene) {}

  void read() {
    for (const tinygltf::Image& image : model_.images) readImage(image);
    for (const tinygltf::Material& m : model_.materials) readMaterial(m);
    for (const tinygltf::Mesh& mesh : model_.meshes) readMesh(mesh);
    const int index = model_.defaultScene >= 0 ? model_.defaultScene : 0;
    if (static_cast<size_t>(index) < model_.scenes.size()) {
      for (const int node : model_.scenes[static_cast<size_t>(index)].nodes) readNode(node, {}, 0);
    }
  }

  std::string error;

 private:
  void readImage(const tinygltf::Image& image) {
    Texture t;
    t.name = image.name.empty() ? image.uri : image.name;
    t.width = image.width, t.height = image.height;
    const size_t count = static_cast<size_t>(std::max(0, image.width)) * static_cast<size_t>(std::max(0, image.height));
    if (image.component == 4 && image.bits == 8 && image.image.size() == count * 4 && count > 0) {
      t.rgba = image.image;
    } else {
      out_.warnings.push_back(fmt::format("image '{}' cannot be decoded and shows as white", t.name));
      t.width = t.height = 1;
      t.rgba.assign(4, 255);
    }
    scene_.textures.push_back(std::move(t));
  }

  // Texture index of a glTF texture; wrap modes belong to the sampler, kept on the image.
  TextureRef reference(int texture, int uvSet, const Value* transform) {
    TextureRef ref;
    if (texture < 0 || static_cast<size_t>(texture) >= model_.textures.size()) return ref;
    const tinygltf::Texture& t = model_.textures[static_cast<size_t>(texture)];
    int source = t.source;
    if (const Value* webp = extension(t.extensions, "EXT_texture_webp")) source = static_cast<int>(field(*webp, "source", -1));
    if (source < 0 || static_cast<size_t>(source) >= scene_.textures.size()) return ref;
    ref.texture = source;
    ref.uvSet = uvSet;
    if (t.sampler >= 0 && static_cast<size_t>(t.sampler) < model_.samplers.size()) {
      const tinygltf::Sampler& s = model_.samplers[static_cast<size_t>(t.sampler)];
      const auto wrap = [](int mode) {
        return mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE ? Wrap::ClampToEdge
               : mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::MirroredRepeat : Wrap::Repeat;
      };
      scene_.textures[static_cast<size_t>(source)].wrapU = wrap(s.wrapS);
      scene_.textures[static_cast<size_t>(source)].wrapV = wrap(s.wrapT);
    }
    if (transform && transform->IsObject()) {
      float o[2] = {0, 0}, s[2] = {1, 1};
      for (int k = 0; k < 2; ++k) {
        if (transform->Has("offset")) o[k] = static_cast<float>(number(transform->Get("offset").Get(k), 0));
        if (transform->Has("scale")) s[k] = static_cast<float>(number(transform->Get("scale").Get(k), 1));
      }
      const float r = field(*transform, "rotation", 0), c = std::cos(r), n = std::sin(r);
      ref.m[0][0] = c * s[0], ref.m[0][1] = n * s[1], ref.m[0][2] = o[0];
      ref.m[1][0] = -n * s[0], ref.m[1][1] = c * s[1], ref.m[1][2] = o[1];
      if (transform->Has("texCoord")) ref.uvSet = static_cast<int>(field(*transform, "texCoord", 0));
    }
    return ref;
  }
  template <class Info>
  TextureRef reference(const Info& info) {
    return reference(info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform"));
  }
  TextureRef reference(const Value& holder, const char* key) {
    if (!holder.IsObject() || !holder.Has(key)) return {};
    const Value& info = holder.Get(key);
    const Value* transform = nullptr;
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform")) transform = &info.Get("extensions").Get("KHR_texture_transform");
    return reference(static_cast<int>(field(info, "index", -1)), static_cast<int>(field(info, "texCoord", 0)), transform);
  }

  void readMaterial(const tinygltf::Material& in) {
    Material m;
    m.name = in.name;
    const tinygltf::PbrMetallicRoughness& pbr = in.pbrMetallicRoughness;
    m.baseColor = {static_cast<float>(pbr.baseColorFactor[0]), static_cast<float>(pbr.baseColorFactor[1]), static_cast<float>(pbr.baseColorFactor[2])};
    m.alpha = static_cast<float>(pbr.baseColorFactor[3]);
    m.baseColorTexture = reference(pbr.baseColorTexture);
    m.metallic = static_cast<float>(pbr.metallicFactor);
    m.roughness = static_cast<float>(pbr.roughnessFactor);
    m.metallicRoughnessTexture = reference(pbr.metallicRoughnessTexture);
    m.normalTexture = reference(in.normalTexture);
    m.normalScale = static_cast<float>(in.normalTexture.scale);
    m.emission = {static_cast<float>(in.emissiveFactor[0]), static_cast<float>(in.emissiveFactor[1]), static_cast<float>(in.emissiveFactor[2])};
    m.emissionTexture = reference(in.emissiveTexture);
    m.alphaMode = in.alphaMode == "MASK" ? AlphaMode::Mask : in.alphaMode == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
    m.alphaCutoff = static_cast<float>(in.alphaCutoff);
    m.doubleSided = in.doubleSided;
    if (const Value* e = extension(in.extensions, "KHR_materials_emissive_strength")) m.emission *= field(*e, "emissiveStrength", 1);
    if (const Value* e = extension(in.extensions, "KHR_materials_transmission")) {
      m.transmission = field(*e, "transmissionFactor", 0);
      m.transmissionTexture = reference(*e, "transmissionTexture");
    }
    if (const Value* e = extension(in.extensions, "KHR_materials_ior")) m.ior = field(*e, "ior", 1.5f);
    if (const Value* e = extension(in.extensions, "KHR_materials_specular")) {
      m.specular = field(*e, "specularFactor", 1);
      m.specularColor = colour(*e, "specularColorFactor", Vec3(1));
    }
    if (const Value* e = extension(in.extensions, "KHR_materials_volume")) {
      m.thicknessM = field(*e, "thicknessFactor", 0);
      m.attenuationColor = colour(*e, "attenuationColor", Vec3(1));
      m.attenuationDistanceM = field(*e, "attenuationDistance", kInfinity);
    }
    if (extension(in.extensions, "KHR_materials_unlit")) {
      // An unlit surface shines by itself and takes no light: 100 cd/m² for white.
      m.emission = m.baseColor * 100.0f;
      m.emissionTexture = m.baseColorTexture;
      m.baseColor = Vec3(0);
      m.metallic = 0;
      m.specular = 0;
    }
    scene_.materials.push_back(m);
  }

  // Element i of an accessor as doubles, normalised where it says so.
  struct View {
    const tinygltf::Accessor* accessor = nullptr;
    const unsigned char* data = nullptr;
    size_t stride = 0;
    int components = 0;
    double at(size_t i, int c) const {
      const unsigned char* p = data + i * stride + static_cast<size_t>(c) * static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor->componentType)));
      const bool n = accessor->normalized;
      switch (accessor->componentType) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT: { float v; std::memcpy(&v, p, 4); return v; }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: { uint32_t v; std::memcpy(&v, p, 4); return v; }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: { uint16_t v; std::memcpy(&v, p, 2); return n ? v / 65535.0 : v; }
        case TINYGLTF_COMPONENT_TYPE_SHORT: { int16_t v; std::memcpy(&v, p, 2); return n ? std::max(v / 32767.0, -1.0) : v; }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return n ? *p / 255.0 : *p;
        case TINYGLTF_COMPONENT_TYPE_BYTE: { int8_t v; std::memcpy(&v, p, 1); return n ? std::max(v / 127.0, -1.0) : v; }
        default: return 0;
      }
    }
  };

  bool view(int index, View& v, const std::string& where) {
    if (index < 0 || static_cast<size_t>(index) >= model_.accessors.size()) return fail(where + ": accessor does not exist");
    v.accessor = &model_.accessors[static_cast<size_t>(index)];
    const tinygltf::Accessor& a = *v.accessor;
    if (a.bufferView < 0 || static_cast<size_t>(a.bufferView) >= model_.bufferViews.size()) return fail(where + ": accessor without data");
    const tinygltf::BufferView& bv = model_.bufferViews[static_cast<size_t>(a.bufferView)];
    if (bv.buffer < 0 || static_cast<size_t>(bv.buffer) >= model_.buffers.size()) return fail(where + ": buffer does not exist");
    const auto& bytes = model_.buffers[static_cast<size_t>(bv.buffer)].data;
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(a.componentType));
    v.components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(a.type));
    if (size <= 0 || v.components <= 0) return fail(where + ": unknown component type");
    const size_t element = static_cast<size_t>(size) * static_cast<size_t>(v.components);
    v.stride = bv.byteStride ? bv.byteStride : element;
    const size_t begin = bv.byteOffset + a.byteOffset;
    if (a.count == 0) return true;
    if (a.count > bytes.size() || begin > bytes.size() || (a.count - 1) * v.stride + element > bytes.size() - begin) {
      return fail(fmt::format("{}: accessor {} claims {} elements, which do not fit its buffer", where, index, a.count));
    }
    v.data = bytes.data() + begin;
    return true;
  }

  bool fail(std::string what) {
    if (error.empty()) error = std::move(what);
    return false;
  }

  // For primitives without one; made when first needed.
  int defaultMaterial() {
    if (defaultMaterial_ < 0) {
      Material plain;
      plain.name = "default";
      plain.metallic = 0;
      defaultMaterial_ = static_cast<int>(scene_.materials.size());
      scene_.materials.push_back(plain);
    }
    return defaultMaterial_;
  }

  void readMesh(const tinygltf::Mesh& in) {
    std::vector<int> meshes;
    for (size_t p = 0; p < in.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = in.primitives[p];
      const std::string where = fmt::format("mesh '{}' primitive {}", in.name, p);
      if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) {
        out_.warnings.push_back(where + ": only triangle lists are drawn");
        continue;
      }
      Mesh mesh;
      mesh.name = in.name;
      mesh.material = primitive.material >= 0 ? primitive.material : defaultMaterial();
      if (!readAttributes(primitive, mesh, where)) return;
      if (!mesh.indices.empty()) {
        scene_.meshes.push_back(std::move(mesh));
        meshes.push_back(static_cast<int>(scene_.meshes.size()) - 1);
      }
    }
    primitivesOfMesh_.push_back(meshes);
  }

  bool readAttributes(const tinygltf::Primitive& primitive, Mesh& mesh, const std::string& where) {
    const auto find = [&](const char* name) {
      const auto it = primitive.attributes.find(name);
      return it == primitive.attributes.end() ? -1 : it->second;
    };
    View v;
    if (!view(find("POSITION"), v, where + " POSITION")) return false;
    const size_t n = v.accessor->count;
    mesh.positions.resize(n);
    for (size_t i = 0; i < n; ++i) mesh.positions[i] = vec3(v, i);
    if (find("NORMAL") >= 0) {
      if (!view(find("NORMAL"), v, where + " NORMAL") || v.accessor->count != n) return fail(where + ": NORMAL differs in length");
      mesh.normals.resize(n);
      for (size_t i = 0; i < n; ++i) {
        const Vec3 normal = vec3(v, i);
        const float l = length(normal);
        mesh.normals[i] = l > 0 ? normal / l : Vec3{0, 1, 0};
      }
    }
    if (find("TANGENT") >= 0 && view(find("TANGENT"), v, where + " TANGENT") && v.accessor->count == n && v.components == 4) {
      mesh.tangents.resize(n);
      mesh.tangentSigns.resize(n);
      for (size_t i = 0; i < n; ++i) mesh.tangents[i] = vec3(v, i), mesh.tangentSigns[i] = v.at(i, 3) < 0 ? -1.0f : 1.0f;
    }
    for (int set = 0; set < 2; ++set) {
      const int index = find(set ? "TEXCOORD_1" : "TEXCOORD_0");
      if (index < 0) continue;
      if (!view(index, v, where + " TEXCOORD") || v.accessor->count != n) return fail(where + ": TEXCOORD differs in length");
      mesh.uv[set].resize(n);
      for (size_t i = 0; i < n; ++i) mesh.uv[set][i] = {static_cast<float>(v.at(i, 0)), static_cast<float>(v.at(i, 1))};
    }
    if (find("COLOR_0") >= 0 && view(find("COLOR_0"), v, where + " COLOR_0") && v.accessor->count == n) {
      mesh.colors.resize(n);
      for (size_t i = 0; i < n; ++i) mesh.colors[i] = vec3(v, i);
    }
    if (!error.empty()) return false;
    if (primitive.indices >= 0) {
      if (!view(primitive.indices, v, where + " indices")) return false;
      mesh.indices.resize(v.accessor->count / 3 * 3);
      for (size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<uint32_t>(v.at(i, 0));
    } else {
      mesh.indices.resize(n / 3 * 3);
      for (size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<uint32_t>(i);
    }
    dropDegenerate(mesh);
    return true;
  }

  static Vec3 vec3(const View& v, size_t i) {
    return {static_cast<float>(v.at(i, 0)), static_cast<float>(v.at(i, 1)), static_cast<float>(v.at(i, 2))};
  }

  static void dropDegenerate(Mesh& mesh) {
    size_t kept = 0;
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
      const size_t n = mesh.positions.size();
      if (a < n && b < n && c < n) {
        const Vec3 area = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        if (length(area) < 1e-16f) continue;
      }
      mesh.indices[kept++] = a, mesh.indices[kept++] = b, mesh.indices[kept++] = c;
    }
    mesh.indices.resize(kept);
  }

  static Affine transformOf(const tinygltf::Node& node) {
    Affine m;
    if (node.matrix.size() == 16) {
      const auto column = [&](size_t c) { return Vec3{static_cast<float>(node.matrix[4 * c]), static_cast<float>(node.matrix[4 * c + 1]), static_cast<float>(node.matrix[4 * c + 2])}; };
      return {column(0), column(1), column(2), column(3)};
    }
    if (node.rotation.size() == 4) {
      const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
      const auto f = [](double a, double b, double c) { return Vec3{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)}; };
      m.x = f(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w));
      m.y = f(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w));
      m.z = f(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y));
    }
    if (node.scale.size() == 3) m.x *= static_cast<float>(node.scale[0]), m.y *= static_cast<float>(node.scale[1]), m.z *= static_cast<float>(node.scale[2]);
    if (node.translation.size() == 3) m.w = {static_cast<float>(node.translation[0]), static_cast<float>(node.translation[1]), static_cast<float>(node.translation[2])};
    return m;
  }

  void readNode(int index, const Affine& parent, int depth) {
    if (index < 0 || static_cast<size_t>(index) >= model_.nodes.size()) return void(fail(fmt::format("node {} does not exist", index)));
    if (depth > 256) return void(fail(fmt::format("node {}: nodes are nested too deep or in a circle", index)));
    const tinygltf::Node& node = model_.nodes[static_cast<size_t>(index)];
    const Affine world = parent * transformOf(node);
    if (node.mesh >= 0 && static_cast<size_t>(node.mesh) < primitivesOfMesh_.size()) {
      for (const int mesh : primitivesOfMesh_[static_cast<size_t>(node.mesh)]) scene_.instances.push_back({node.name, mesh, nextObject_, world});
      ++nextObject_;
    }
    if (node.camera >= 0 && static_cast<size_t>(node.camera) < model_.cameras.size()) readCamera(model_.cameras[static_cast<size_t>(node.camera)], node.name, world);
    if (const Value* e = extension(node.extensions, "KHR_lights_punctual")) {
      const int light = static_cast<int>(field(*e, "light", -1));
      if (light >= 0 && static_cast<size_t>(light) < model_.lights.size()) readLight(model_.lights[static_cast<size_t>(light)], node.name, world);
    }
    for (const int child : node.children) {
      if (!error.empty()) return;
      readNode(child, world, depth + 1);
    }
  }

  void readCamera(const tinygltf::Camera& in, const std::string& name, const Affine& world) {
    Camera camera;
    camera.name = in.name.empty() ? name : in.name;
    camera.worldFromCamera = {normalize(world.x), normalize(world.y), normalize(world.z), world.w};
    if (in.type == "orthographic") {
      camera.orthographic = true;
      camera.yMagM = static_cast<float>(in.orthographic.ymag);
      camera.nearM = static_cast<float>(in.orthographic.znear);
    } else {
      camera.yFovRad = static_cast<float>(in.perspective.yfov);
      camera.aspect = static_cast<float>(in.perspective.aspectRatio);
      camera.nearM = 0;
    }
    scene_.cameras.push_back(camera);
  }

  void readLight(const tinygltf::Light& in, const std::string& name, const Affine& world) {
    Vec3 c{1, 1, 1};
    if (in.color.size() >= 3) c = {static_cast<float>(in.color[0]), static_cast<float>(in.color[1]), static_cast<float>(in.color[2])};
    c *= static_cast<float>(in.intensity);
    const std::string label = in.name.empty() ? name : in.name;
    if (in.type == "directional") {
      Sun sun;
      sun.name = label;
      sun.toLight = normalize(world.z);
      sun.illuminanceLux = c;
      scene_.suns.push_back(sun);
      return;
    }
    Lamp lamp;
    lamp.name = label;
    lamp.position = world.w;
    lamp.direction = -normalize(world.z);
    lamp.intensityCd = c;
    if (in.type == "spot") {
      lamp.kind = LampKind::Spot;
      lamp.innerConeRad = static_cast<float>(in.spot.innerConeAngle);
      lamp.outerConeRad = static_cast<float>(in.spot.outerConeAngle);
    }
    scene_.lamps.push_back(lamp);
  }

  const tinygltf::Model& model_;
  Imported& out_;
  Scene& scene_;
  int defaultMaterial_ = -1;
  std::vector<std::vector<int>> primitivesOfMesh_;
  int nextObject_ = 0;
};

}  // namespace

Result<Imported> importGltf(const std::filesystem::path& file, const ImportOptions&) {
  tinygltf::Model model;
  tinygltf::TinyGLTF loader;
  std::string problem, warning;
  bool loaded = false;
  try {
    loaded = file.extension() == ".gltf" ? loader.LoadASCIIFromFile(&model, &problem, &warning, file.string())
                                         : loader.LoadBinaryFromFile(&model, &problem, &warning, file.string());
  } catch (const std::exception& e) {
    problem = e.what();
  }
  if (!loaded) {
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    return Error{fmt::format("{}: {}", file.string(), problem.empty() ? "not a glTF file" : problem)};
  }
  Imported imported;
  Reader reader(model, imported);
  reader.read();
  if (!reader.error.empty()) return Error{fmt::format("{}: {}", file.string(), reader.error)};
  const Status status = validate(imported.scene);
  if (!status) return Error{fmt::format("{}: {}", file.string(), status.error())};
  return imported;
}


}  // namespace roomlight
