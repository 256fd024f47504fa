// Small files of FBX, COLLADA, 3D Studio, STL and PLY, written by hand.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <variant>
#include <vector>

namespace roomlight::testing {

template <class T>
std::string rawBytes(T v) {
  std::string s(sizeof(T), '\0');
  std::memcpy(s.data(), &v, sizeof(T));
  return s;
}

// A BMP of one red pixel.
inline std::string redBmp() {
  const auto word = [](uint32_t v) { return rawBytes(v); };
  return "BM" + word(58) + word(0) + word(54) + word(40) + word(1) + word(1) + rawBytes(uint16_t{1}) +
         rawBytes(uint16_t{24}) + word(0) + word(4) + word(0) + word(0) + word(0) + word(0) +
         std::string("\x00\x00\xff\x00", 4);
}

// The tree of an FBX file, which has a spelling in text and one in bytes.
struct FbxName {
  std::string name, kind;  // "Model::plate"
};
struct FbxRaw {
  std::string bytes;
};
using FbxValue =
    std::variant<int32_t, int64_t, double, std::string, FbxName, FbxRaw, std::vector<double>, std::vector<int32_t>>;
struct FbxNode {
  std::string name;
  std::vector<FbxValue> values;
  std::vector<FbxNode> children = {};
};

inline std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t v = 0;
    for (size_t k = 0; k < 3; ++k) v = v << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[v >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

inline std::string fbxText(const std::vector<FbxNode>& nodes, const std::string& indent = "") {
  std::string out = indent.empty() ? "; FBX 7.4.0 project file\n" : "";
  for (const FbxNode& n : nodes) {
    out += indent + n.name + ": ";
    bool array = false;
    for (size_t i = 0; i < n.values.size(); ++i) {
      if (i > 0) out += ", ";
      std::visit(
          [&](const auto& v) {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_arithmetic_v<T>) {
              out += fmt::format("{}", v);
            } else if constexpr (std::is_same_v<T, std::string>) {
              out += "\"" + v + "\"";
            } else if constexpr (std::is_same_v<T, FbxName>) {
              out += "\"" + v.kind + "::" + v.name + "\"";
            } else if constexpr (std::is_same_v<T, FbxRaw>) {
              out += "\n" + indent + ",\"" + base64(v.bytes) + "\"";
            } else {
              array = true;
              out += fmt::format("*{} {{\n{} a: {}\n{}}}", v.size(), indent, fmt::join(v, ","), indent);
            }
          },
          n.values[i]);
    }
    if (!array && (!n.children.empty() || n.values.empty()))
      out += " {\n" + fbxText(n.children, indent + " ") + indent + "}";
    out += "\n";
  }
  return out;
}

// Nodes of version 7.4: end, number of values, their bytes, name; values; children and an empty node behind them.
inline std::string fbxBytes(const std::vector<FbxNode>& nodes, bool top = true, size_t before = 27) {
  std::string out = top ? std::string("Kaydara FBX Binary  \0\x1a\0", 23) + rawBytes(uint32_t{7400}) : "";
  const size_t base = top ? 0 : before;
  for (const FbxNode& n : nodes) {
    std::string values;
    for (const FbxValue& value : n.values) {
      std::visit(
          [&](const auto& v) {
            using T = std::decay_t<decltype(v)>;
            const auto text = [&](char kind, const std::string& s) {
              values += kind + rawBytes(static_cast<uint32_t>(s.size())) + s;
            };
            if constexpr (std::is_same_v<T, int32_t>) values += 'I' + rawBytes(v);
            if constexpr (std::is_same_v<T, int64_t>) values += 'L' + rawBytes(v);
            if constexpr (std::is_same_v<T, double>) values += 'D' + rawBytes(v);
            if constexpr (std::is_same_v<T, std::string>) text('S', v);
            if constexpr (std::is_same_v<T, FbxName>) text('S', v.name + std::string("\0\x01", 2) + v.kind);
            if constexpr (std::is_same_v<T, FbxRaw>) text('R', v.bytes);
            if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, std::vector<int32_t>>) {
              const size_t size = v.size() * sizeof(v[0]);
              values += std::string(1, std::is_same_v<T, std::vector<double>> ? 'd' : 'i') +
                        rawBytes(static_cast<uint32_t>(v.size())) + rawBytes(uint32_t{0}) +
                        rawBytes(static_cast<uint32_t>(size));
              values.append(reinterpret_cast<const char*>(v.data()), size);
            }
          },
          value);
    }
    const size_t start = base + out.size() + 13 + n.name.size() + values.size();
    std::string children = n.children.empty() ? "" : fbxBytes(n.children, false, start) + std::string(13, '\0');
    out += rawBytes(static_cast<uint32_t>(start + children.size())) + rawBytes(static_cast<uint32_t>(n.values.size())) +
           rawBytes(static_cast<uint32_t>(values.size())) + static_cast<char>(n.name.size()) + n.name + values +
           children;
  }
  return top ? out + std::string(13, '\0') : out;
}

inline FbxNode fbxProperty(const std::string& name, const std::string& type, std::vector<FbxValue> values) {
  FbxNode n{"P", {name, type, std::string(), std::string("A")}};
  n.values.insert(n.values.end(), values.begin(), values.end());
  return n;
}
inline FbxNode fbxVector(const std::string& name, double x, double y, double z) {
  return fbxProperty(name, name.starts_with("Lcl") ? name : "Vector3D", {x, y, z});
}
inline FbxNode fbxNumber(const std::string& name, double v) { return fbxProperty(name, "double", {v}); }
inline FbxNode fbxWhole(const std::string& name, int32_t v) { return fbxProperty(name, "int", {v}); }
inline FbxNode fbxLink(int64_t from, int64_t to, const std::string& property = "") {
  return property.empty() ? FbxNode{"C", {std::string("OO"), from, to}}
                          : FbxNode{"C", {std::string("OP"), from, to, property}};
}

// Z up, in inches. A plate of 40 x 20 in the plane z = 0 placed twice, once 100 higher, of one material with a picture;
// a camera; a spot and a point lamp of half its intensity, a sun and an area light. `picture` is in the file, or only
// named.
inline std::vector<FbxNode> fbxScene(const std::string& picture = "",
                                     const std::string& named = "C:\\Users\\x\\tex\\Red.BMP") {
  const std::vector<double> corners{0, 0, 0, 40, 0, 0, 40, 20, 0, 0, 20, 0};
  const FbxNode layer{
      "Layer",
      {int32_t{0}},
      {{"LayerElement", {}, {{"Type", {std::string("LayerElementMaterial")}}, {"TypedIndex", {int32_t{0}}}}}}};
  const FbxNode mesh{"Geometry",
                     {int64_t{10}, FbxName{"g", "Geometry"}, std::string("Mesh")},
                     {{"Vertices", {corners}},
                      {"PolygonVertexIndex", {std::vector<int32_t>{0, 1, 2, -4}}},
                      {"LayerElementMaterial",
                       {int32_t{0}},
                       {{"Version", {int32_t{101}}},
                        {"Name", {std::string()}},
                        {"MappingInformationType", {std::string("AllSame")}},
                        {"ReferenceInformationType", {std::string("IndexToDirect")}},
                        {"Materials", {std::vector<int32_t>{0}}}}},
                      layer}};
  const auto model = [](int64_t id, const char* name, const char* kind, std::vector<FbxNode> properties) {
    return FbxNode{"Model",
                   {id, FbxName{name, "Model"}, std::string(kind)},
                   {{"Version", {int32_t{232}}}, {"Properties70", {}, std::move(properties)}}};
  };
  const auto attribute = [](int64_t id, const char* kind, std::vector<FbxNode> properties) {
    return FbxNode{"NodeAttribute",
                   {id, FbxName{"", "NodeAttribute"}, std::string(kind)},
                   {{"TypeFlags", {std::string(kind)}}, {"Properties70", {}, std::move(properties)}}};
  };
  FbxNode video{"Video",
                {int64_t{52}, FbxName{"v", "Video"}, std::string("Clip")},
                {{"Type", {std::string("Clip")}}, {"FileName", {named}}, {"RelativeFilename", {named}}}};
  if (!picture.empty()) video.children.push_back({"Content", {FbxRaw{picture}}});
  FbxNode objects{
      "Objects",
      {},
      {mesh,
       model(20, "low", "Mesh", {fbxVector("Lcl Translation", 0, 0, 0)}),
       model(21, "high", "Mesh", {fbxVector("Lcl Translation", 0, 0, 100)}),
       {"Material",
        {int64_t{30}, FbxName{"wood", "Material"}, std::string()},
        {{"Version", {int32_t{102}}},
         {"ShadingModel", {std::string("phong")}},
         {"Properties70",
          {},
          {fbxProperty("DiffuseColor", "Color", {0.8, 0.4, 0.2}),
           fbxProperty("EmissiveColor", "Color", {0.5, 0.25, 0.0}), fbxNumber("Shininess", 30)}}}},
       {"Texture",
        {int64_t{50}, FbxName{"t", "Texture"}, std::string()},
        {{"Type", {std::string("TextureVideoClip")}},
         {"Version", {int32_t{202}}},
         {"FileName", {named}},
         {"RelativeFilename", {named}}}},
       video,
       attribute(60, "Camera",
                 {fbxNumber("FieldOfView", 60), fbxNumber("AspectWidth", 320), fbxNumber("AspectHeight", 160)}),
       model(61, "eye", "Camera", {fbxVector("Lcl Translation", 10, -50, 60)}),
       attribute(70, "Light",
                 {fbxWhole("LightType", 2), fbxNumber("Intensity", 200), fbxNumber("InnerAngle", 40),
                  fbxNumber("OuterAngle", 60)}),
       model(71, "spot", "Light", {fbxVector("Lcl Translation", 0, 0, 90), fbxVector("Lcl Rotation", 90, 0, 0)}),
       attribute(72, "Light", {fbxWhole("LightType", 0), fbxNumber("Intensity", 100)}),
       model(73, "bulb", "Light", {fbxVector("Lcl Translation", 0, 10, 80)}),
       attribute(74, "Light", {fbxWhole("LightType", 1), fbxNumber("Intensity", 300)}),
       model(75, "sun", "Light", {}),
       attribute(76, "Light", {fbxWhole("LightType", 3), fbxNumber("Intensity", 200)}),
       model(77, "panel", "Light", {})}};
  FbxNode links{"Connections", {}, {}};
  for (const int64_t id : {20, 21})
    links.children.insert(links.children.end(), {fbxLink(id, 0), fbxLink(10, id), fbxLink(30, id)});
  for (const int64_t id : {60, 70, 72, 74, 76})
    links.children.insert(links.children.end(), {fbxLink(id + 1, 0), fbxLink(id, id + 1)});
  links.children.insert(links.children.end(), {fbxLink(50, 30, "DiffuseColor"), fbxLink(52, 50)});
  return {{"FBXHeaderExtension", {}, {{"FBXHeaderVersion", {int32_t{1003}}}, {"FBXVersion", {int32_t{7400}}}}},
          {"GlobalSettings",
           {},
           {{"Version", {int32_t{1000}}},
            {"Properties70",
             {},
             {fbxWhole("UpAxis", 2), fbxWhole("UpAxisSign", 1), fbxWhole("FrontAxis", 1), fbxWhole("FrontAxisSign", -1),
              fbxWhole("CoordAxis", 0), fbxWhole("CoordAxisSign", 1), fbxNumber("UnitScaleFactor", 2.54)}}}},
          objects,
          links};
}

// A plate of 2 x 4 units of 10 cm at height 3, z up, with a point lamp, a spot, a sun, an ambient light and a camera.
inline std::string colladaScene(const std::string& picture = "tex/red.bmp") {
  const auto light = [](const char* id, const std::string& inside) {
    return fmt::format("<light id='{}' name='{}'><technique_common>{}</technique_common></light>", id, id, inside);
  };
  const auto place = [](const char* id, const char* what) {
    return fmt::format("<node id='n_{}' name='{}'><translate>1 2 30</translate><instance_{} url='#{}'/></node>", id, id,
                       what, id);
  };
  return "<?xml version='1.0' encoding='utf-8'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit name='dm' meter='0.1'/><up_axis>Z_UP</up_axis></asset>"
         "<library_cameras><camera id='eye' "
         "name='eye'><optics><technique_common><perspective><xfov>60</xfov><aspect_ratio>2</aspect_ratio><znear>0.1</"
         "znear><zfar>100</zfar></perspective></technique_common></optics></camera></library_cameras>"
         "<library_lights>" +
         light("bulb", "<point><color>2 2 2</color></point>") +
         light("spot", "<spot><color>1 1 1</color><falloff_angle>60</falloff_angle></spot>") +
         light("sun", "<directional><color>3 3 3</color></directional>") +
         light("fill", "<ambient><color>1 1 1</color></ambient>") +
         "</library_lights><library_images><image id='i'><init_from>" + picture +
         "</init_from></image></library_images><library_effects><effect id='e'><profile_COMMON><newparam "
         "sid='p'><surface type='2D'><init_from>i</init_from></surface></newparam>"
         "<newparam sid='q'><sampler2D><source>p</source></sampler2D></newparam><technique "
         "sid='t'><phong><diffuse><texture texture='q' texcoord='U'/></diffuse></phong></technique>"
         "</profile_COMMON></effect></library_effects><library_materials><material id='m' name='wood'><instance_effect "
         "url='#e'/></material></library_materials>"
         "<library_geometries><geometry id='g'><mesh><source id='v'><float_array id='va' count='12'>0 0 3 2 0 3 2 4 3 "
         "0 4 3</float_array>"
         "<technique_common><accessor source='#va' count='4' stride='3'><param name='X' type='float'/><param name='Y' "
         "type='float'/><param name='Z' type='float'/></accessor></technique_common></source>"
         "<vertices id='vs'><input semantic='POSITION' source='#v'/></vertices><polylist material='s' count='1'><input "
         "semantic='VERTEX' source='#vs' offset='0'/><vcount>4</vcount><p>0 1 2 "
         "3</p></polylist></mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id='vis'><node id='n' name='plate'><instance_geometry "
         "url='#g'><bind_material><technique_common><instance_material symbol='s' "
         "target='#m'/></technique_common></bind_material></instance_geometry></node>" +
         place("eye", "camera") + place("bulb", "light") + place("spot", "light") + place("sun", "light") +
         place("fill", "light") +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#vis'/></scene></COLLADA>";
}

// A table 2 wide, 1 deep and 0.8 high on four legs, in the axes of its file: boxes of 12 triangles whose fronts look
// outwards.
struct Triangles {
  std::vector<std::array<float, 3>> corners;  // three a triangle
};
inline void addBoxTo(Triangles& out, std::array<float, 3> lo, std::array<float, 3> hi) {
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const auto corner = [&](int i) {
    return std::array<float, 3>{i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]};
  };
  for (const auto& f : kFaces) {
    for (const int k : {0, 1, 2, 0, 2, 3}) out.corners.push_back(corner(f[k]));
  }
}
inline Triangles turnedYUp(Triangles in) {
  for (auto& c : in.corners) c = {c[0], c[2], -c[1]};
  return in;
}
inline Triangles tableZUp() {
  Triangles t;
  addBoxTo(t, {-1, -0.5f, 0.75f}, {1, 0.5f, 0.8f});
  for (const float x : {-0.95f, 0.85f}) {
    for (const float y : {-0.45f, 0.35f}) addBoxTo(t, {x, y, 0}, {x + 0.1f, y + 0.1f, 0.75f});
  }
  return t;
}

inline std::string stlText(const Triangles& t) {
  std::string out = "solid thing\n";
  for (size_t i = 0; i < t.corners.size(); i += 3) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (size_t k = 0; k < 3; ++k)
      out += fmt::format("vertex {} {} {}\n", t.corners[i + k][0], t.corners[i + k][1], t.corners[i + k][2]);
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid thing\n";
}
inline std::string stlBytes(const Triangles& t) {
  std::string out = std::string(80, ' ') + rawBytes(static_cast<uint32_t>(t.corners.size() / 3));
  for (size_t i = 0; i < t.corners.size(); ++i) {
    if (i % 3 == 0) out += std::string(12, '\0');
    for (const float v : t.corners[i]) out += rawBytes(v);
    if (i % 3 == 2) out += std::string(2, '\0');
  }
  return out;
}
// Every vertex of this colour.
inline std::string ply(const Triangles& t, bool binary, std::array<uint8_t, 3> colour) {
  std::string out = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
      "red\nproperty uchar green\nproperty uchar blue\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      binary ? "binary_little_endian" : "ascii", t.corners.size(), t.corners.size() / 3);
  for (const auto& c : t.corners) {
    if (!binary) out += fmt::format("{} {} {} {} {} {}\n", c[0], c[1], c[2], colour[0], colour[1], colour[2]);
    if (binary) out += rawBytes(c[0]) + rawBytes(c[1]) + rawBytes(c[2]) + rawBytes(colour);
  }
  for (uint32_t i = 0; i < t.corners.size(); i += 3) {
    if (!binary) out += fmt::format("3 {} {} {}\n", i, i + 1, i + 2);
    if (binary) out += rawBytes(uint8_t{3}) + rawBytes(i) + rawBytes(i + 1) + rawBytes(i + 2);
  }
  return out;
}
inline std::string obj(const Triangles& t) {
  std::string out;
  for (const auto& c : t.corners) out += fmt::format("v {} {} {}\n", c[0], c[1], c[2]);
  for (size_t i = 1; i <= t.corners.size(); i += 3) out += fmt::format("f {} {} {}\n", i, i + 1, i + 2);
  return out;
}
// Also with a camera of 50 mm at (0, -5, 2) that looks along y.
inline std::string studio3d(const Triangles& t) {
  const auto chunk = [](uint16_t id, const std::string& inside) {
    return rawBytes(id) + rawBytes(static_cast<uint32_t>(inside.size() + 6)) + inside;
  };
  const auto count = [](size_t n) { return rawBytes(static_cast<uint16_t>(n)); };
  std::string vertices = count(t.corners.size()), faces = count(t.corners.size() / 3),
              users = std::string("blue\0", 5) + count(t.corners.size() / 3), camera;
  for (const auto& c : t.corners) vertices += rawBytes(c[0]) + rawBytes(c[1]) + rawBytes(c[2]);
  for (size_t i = 0; i < t.corners.size(); i += 3)
    faces += count(i) + count(i + 1) + count(i + 2) + count(0), users += count(i / 3);
  for (const float v : {0.0f, -5.0f, 2.0f, 0.0f, 0.0f, 2.0f, 0.0f, 50.0f}) camera += rawBytes(v);
  const std::string material = chunk(
      0xafff, chunk(0xa000, std::string("blue\0", 5)) + chunk(0xa020, chunk(0x0011, std::string("\x00\x00\xff", 3))));
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces + chunk(0x4130, users)));
  return chunk(0x4d4d, chunk(0x0002, rawBytes(uint32_t{3})) +
                           chunk(0x3d3d, material + chunk(0x4000, std::string("table\0", 6) + mesh) +
                                             chunk(0x4000, std::string("eye\0", 4) + chunk(0x4700, camera))));
}

}  // namespace roomlight::testing
