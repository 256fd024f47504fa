// What exporters write against the rules and every viewer opens: mended, and told in one line.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "unit/import/gltf_file.h"
#include "unit/import/ktx2_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using nlohmann::json;
using testing::GltfFile;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

struct Case {
  const char* name;
  std::function<void(GltfFile&)> bend;
  const char* expected;  // part of the one warning; empty: none
};

class GltfMended : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;

  Imported read(const GltfFile& f) {
    auto imported = f.import(folder_ / "a.glb");
    EXPECT_TRUE(imported) << imported.error();
    return imported ? imported.value() : Imported{};
  }
  // Each opens with its one triangle or more, and with this warning, or this small fault, alone.
  void expectAllMended(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
      GltfFile f = GltfFile::triangle();
      c.bend(f);
      const auto imported = f.import(folder_ / "a.glb");
      ASSERT_TRUE(imported) << c.name << ": " << imported.error();
      EXPECT_GE(imported.value().scene.triangleCount(), 1u) << c.name;
      std::vector<std::string> warnings = imported.value().warnings;
      warnings.insert(warnings.end(), imported.value().faults.begin(), imported.value().faults.end());
      ASSERT_EQ(warnings.size(), std::string(c.expected).empty() ? 0u : 1u)
          << c.name << (warnings.empty() ? "" : ": " + warnings[0]);
      if (warnings.empty()) continue;
      EXPECT_NE(warnings[0].find(c.expected), std::string::npos) << c.name << ": " << warnings[0];
    }
  }
};

TEST_F(GltfMended, containers) {
  expectAllMended({
      {"no asset", [](GltfFile& f) { f.json.erase("asset"); }, "states no version"},
      {"no version", [](GltfFile& f) { f.json["asset"] = json::object(); }, "states no version"},
      {"version is a number", [](GltfFile& f) { f.json["asset"]["version"] = 2.0; }, ""},
      {"buffer without a length", [](GltfFile& f) { f.json["buffers"][0].erase("byteLength"); }, ""},
      {"view longer than the buffer", [](GltfFile& f) { f.json["bufferViews"][1]["byteLength"] = 4096; }, ""},
      {"nulls",
       [](GltfFile& f) {
         f.json["accessors"][0]["byteOffset"] = f.node()["extras"] = f.node()["camera"] =
             f.json["materials"][0]["normalTexture"] = nullptr;
       },
       ""},
      {"harmless extension",
       [](GltfFile& f) {
         f.json["extensionsRequired"] = {"KHR_xmp_json_ld", "MSFT_lod"};
       },
       ""},
  });
}

TEST_F(GltfMended, lengthsAndBytesAroundTheJson) {
  const std::string whole = GltfFile::triangle().glb();
  std::string wrong = whole;
  wrong[8] = '\x01';
  GltfFile text = GltfFile::triangle();
  text.json["buffers"][0] = {{"uri", "a.bin"}, {"byteLength", text.bytes.size()}};
  testing::writeFile(folder_ / "a.bin", text.bytes);
  std::string latin = text.json.dump();
  latin.replace(latin.find("thing"), 5, "t\xfcr e");
  for (const std::string& bytes :
       {whole + "trailing", wrong, "\xef\xbb\xbf" + text.json.dump(), text.json.dump() + std::string(3, '\0'), latin}) {
    testing::writeFile(folder_ / "a.gltf", bytes);
    const auto imported = importScene(folder_ / "a.gltf");
    ASSERT_TRUE(imported) << imported.error();
    EXPECT_EQ(imported.value().scene.triangleCount(), 1u);
  }
}

TEST_F(GltfMended, materials) {
  const auto material = [](json value) { return [value](GltfFile& f) { f.json["materials"][0] = value; }; };
  const char* limited = "values of materials outside their range";
  expectAllMended({
      {"bright paint", material({{"pbrMetallicRoughness", {{"baseColorFactor", {1.5, 0.5, 0.5, 1}}}}}), limited},
      {"rough metal", material({{"pbrMetallicRoughness", {{"roughnessFactor", 1.00001}}}}), limited},
      {"attenuation at once", material({{"extensions", {{"KHR_materials_volume", {{"attenuationDistance", 0}}}}}}),
       limited},
      {"attenuation backwards", material({{"extensions", {{"KHR_materials_volume", {{"attenuationDistance", -1}}}}}}),
       limited},
      {"thin air", material({{"extensions", {{"KHR_materials_ior", {{"ior", 0.9}}}}}}), limited},
      {"more than all light",
       material({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1.1}}}}}}), limited},
      {"cut off below nothing", material({{"alphaMode", "MASK"}, {"alphaCutoff", -0.5}}), limited},
      {"alpha mode", material({{"alphaMode", "GLASS"}}), "unknown alphaMode"},
      {"texture out of range", material({{"normalTexture", {{"index", 3}}}}), "pictures are missing"},
      {"material out of range", [](GltfFile& f) { f.primitive()["material"] = -1; }, "without a material"},
      {"wrap mode",
       [](GltfFile& f) {
         f.json["images"] = {{{"bufferView", f.addView(testing::pngOf(1, 1, 1))}, {"mimeType", "image/jpeg"}}};
         f.json["samplers"] = {{{"wrapS", 10496}}};
         f.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
         f.json["materials"][0]["normalTexture"] = {{"index", 0}};
       },
       "unknown wrap mode"},
  });
}

TEST_F(GltfMended, geometry) {
  const auto indices = [](std::vector<uint32_t> values) {
    return [values](GltfFile& f) { f.primitive()["indices"] = f.addAccessor(values, 5125, "SCALAR"); };
  };
  // A second primitive that is broken stands beside the sound one.
  const auto beside = [](std::function<void(GltfFile&, json&)> bend) {
    return [bend](GltfFile& f) {
      json primitive = f.primitive();
      bend(f, primitive);
      f.json["meshes"][0]["primitives"].push_back(primitive);
    };
  };
  const auto attribute = [](const char* name, std::vector<float> numbers, const char* type) {
    return [=](GltfFile& f) { f.primitive()["attributes"][name] = f.addFloats(numbers, type); };
  };
  expectAllMended({
      {"index out of range", indices({0, 1, 2, 0, 1, 3}), "a vertex that does not exist are left out (once)"},
      {"signed indices",
       [](GltfFile& f) {
         f.primitive()["indices"] = f.addAccessor<int16_t>({0, 1, 2, 0, 1, -1}, 5122, "SCALAR");
       },
       "a vertex that does not exist are left out (once)"},
      {"four indices", indices({0, 1, 2, 0}), "make no whole triangle"},
      {"empty mesh",
       [](GltfFile& f) {
         f.json["meshes"].push_back({{"primitives", json::array()}});
       },
       ""},
      {"mesh without primitives", [](GltfFile& f) { f.json["meshes"].push_back(json::object()); }, ""},
      {"no vertices",
       beside([](GltfFile& f, json& p) { p.erase("indices"), p["attributes"]["POSITION"] = f.addFloats({}, "VEC3"); }),
       ""},
      {"no positions", beside([](GltfFile&, json& p) { p["attributes"].erase("POSITION"); }), "without positions"},
      {"mode 99", beside([](GltfFile&, json& p) { p["mode"] = 99; }), "unknown kind"},
      {"NaN vertex", beside([](GltfFile& f, json& p) {
         p["attributes"]["POSITION"] = f.addFloats({0, 0, 0, 1, kNaN, 0, 0, 1, 0}, "VEC3");
       }),
       "a vertex that is no finite number"},
      {"NaN coordinates", attribute("TEXCOORD_0", {0, 0, kNaN, 0, 0, 1}, "VEC2"), "texture coordinates"},
      {"coordinates far away", attribute("TEXCOORD_0", {0, 0, 1e30f, 0, 0, 1}, "VEC2"), "texture coordinates"},
      {"too few normals", attribute("NORMAL", {0, 0, 1}, "VEC3"), "do not fit"},
      {"flat normals", attribute("NORMAL", {0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC2"), "do not fit"},
      {"more normals than vertices", attribute("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3"), ""},
      {"NaN tangent", attribute("TANGENT", {kNaN, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4"), ""},
      {"NaN colour", attribute("COLOR_0", {kNaN, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3"), ""},
  });
}

TEST_F(GltfMended, normalsWithoutADirectionAreMadeAnew) {
  GltfFile f = GltfFile::triangle();
  f.primitive()["attributes"]["NORMAL"] = f.addFloats({1, 0, 0, 0, 0, 0, kNaN, 0, 0}, "VEC3");
  const Imported imported = read(f);
  EXPECT_EQ(imported.scene.meshes.at(0).normals, (std::vector<Vec3>{{1, 0, 0}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(imported.faults, (std::vector<std::string>{"normals without a direction are made anew (2 times)"}));
}

TEST_F(GltfMended, nodes) {
  expectAllMended({
      {"own child", [](GltfFile& f) { f.node()["children"] = {0}; }, "second parent"},
      {"circle",
       [](GltfFile& f) {
         f.node()["children"] = {1}, f.json["nodes"].push_back({{"children", {0}}});
       },
       "second parent"},
      {"two parents",
       [](GltfFile& f) {
         f.json["nodes"].push_back({{"children", {0}}}), f.json["scenes"][0]["nodes"] = {1, 0};
       },
       "second parent"},
      {"child out of range", [](GltfFile& f) { f.node()["children"] = {12}; }, "do not exist"},
      {"mesh out of range",
       [](GltfFile& f) {
         f.json["nodes"].push_back({{"mesh", 7}}), f.node()["children"] = {1};
       },
       "do not exist"},
      {"mesh -1",
       [](GltfFile& f) {
         f.json["nodes"].push_back({{"mesh", -1}}), f.node()["children"] = {1};
       },
       ""},
      {"scene out of range", [](GltfFile& f) { f.json["scene"] = 4; }, "do not exist"},
      {"empty scene", [](GltfFile& f) { f.json["scenes"][0] = json::object(); }, ""},
      {"no nodes", [](GltfFile& f) { f.json.erase("nodes"), f.json.erase("scenes"), f.json.erase("scene"); },
       "at the origin"},
      {"zero rotation",
       [](GltfFile& f) {
         f.node()["rotation"] = {0, 0, 0, 0};
       },
       ""},
      {"almost affine matrix",
       [](GltfFile& f) { f.node()["matrix"] = {1, 0, 0, 1e-9, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }, ""},
      {"hidden node",
       [](GltfFile& f) {
         f.json["nodes"].push_back({{"mesh", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
         f.node()["children"] = {1};
         f.json["extensionsRequired"] = {"KHR_node_visibility"};
       },
       "hides"},
  });
}

TEST_F(GltfMended, lightsAndCameras) {
  const auto light = [](json value) {
    return [value](GltfFile& f) {
      f.json["extensions"]["KHR_lights_punctual"]["lights"] = json::array({value});
      f.node()["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
    };
  };
  const auto camera = [](json value) {
    return [value](GltfFile& f) { f.json["cameras"] = json::array({value}), f.node()["camera"] = 0; };
  };
  expectAllMended({
      {"negative light", light({{"type", "point"}, {"intensity", -5}}), "values of lights"},
      {"unknown light", light({{"type", "laser"}}), "unknown kind"},
      {"cones swapped", light({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}}),
       "values of lights"},
      {"no cone", light({{"type", "spot"}, {"spot", {{"outerConeAngle", 0}}}}), "values of lights"},
      {"no lights",
       [](GltfFile& f) {
         f.node()["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
       },
       "do not exist"},
      {"frames whose axes cannot be squared",
       [](GltfFile& f) {
         f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}, {{"type", "directional"}}};
         for (int i = 0; i < 2; ++i) {
           f.json["nodes"].push_back(
               {{"scale", {1e10, 1e10, 1e-25}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
           f.json["scenes"][0]["nodes"].push_back(1 + i);
         }
       },
       ""},
      {"no field of view", camera({{"type", "perspective"}, {"perspective", {{"yfov", 0}}}}), "see nothing"},
      {"field of view", camera({{"type", "perspective"}, {"perspective", {{"yfov", 7}}}}), "see nothing"},
      {"no aspect", camera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"aspectRatio", 0}}}}), ""},
      {"flat camera", camera({{"type", "orthographic"}, {"orthographic", {{"xmag", 0}, {"ymag", 1}}}}), "see nothing"},
      {"camera of no type", camera(json::object()), "see nothing"},
  });
}

TEST_F(GltfMended, companionsUnderOtherNames) {
  std::filesystem::create_directories(folder_ / "Textures");
  testing::writeFile(folder_ / "Textures/My Oak.PNG", testing::pngOf(1, 1, 0));
  testing::writeFile(folder_ / "50%.png", testing::pngOf(1, 1, 0));
  testing::writeFile(folder_ / "wood.png", testing::pngOf(1, 1, 0));
  for (const char* uri : {"textures/my%20oak.png", "Textures\\My Oak.PNG", "./textures//MY OAK.png", "50%.png",
                          "50%25.png", "../maps/wood.png", "C:\\models\\wood.png"}) {
    GltfFile f = GltfFile::triangle();
    f.json["images"] = {{{"uri", uri}}};
    f.json["textures"] = {{{"source", 0}}};
    f.json["materials"][0]["normalTexture"] = {{"index", 0}};
    const Imported imported = read(f);
    EXPECT_EQ(imported.scene.textures.size(), 1u) << uri;
    EXPECT_TRUE(imported.warnings.empty()) << uri << ": " << imported.warnings[0];
  }
}

TEST_F(GltfMended, missingPicturesAreCountedByName) {
  GltfFile f = GltfFile::triangle();
  f.json["images"] = {{{"uri", "a.png"}}, {{"uri", "b.png"}}};
  f.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  f.json["materials"][0] = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                            {"normalTexture", {{"index", 1}}}};
  const Imported imported = read(f);
  EXPECT_EQ(
      imported.warnings,
      (std::vector<std::string>{"pictures are missing, their materials show without them: a.png, b.png (2 times)"}));
  EXPECT_EQ(imported.scene.materials[0].baseColor, Vec3(0.6f));
}

TEST_F(GltfMended, aMissingBufferIsAnErrorThatNamesIt) {
  GltfFile f = GltfFile::triangle();
  f.json["buffers"][0] = {{"uri", "geometry.bin"}, {"byteLength", 44}};
  const auto imported = f.import(folder_ / "a.glb");
  ASSERT_FALSE(imported);
  EXPECT_NE(imported.error().find("'geometry.bin': there is no such file"), std::string::npos) << imported.error();
}

TEST_F(GltfMended, firstVersionInItsOwnContainer) {
  testing::writeFile(folder_ / "a.glb", std::string("glTF\x01\0\0\0\x20\0\0\0\x04\0\0\0\0\0\0\0{}  ", 24));
  const auto imported = importScene(folder_ / "a.glb");
  ASSERT_FALSE(imported);
  EXPECT_NE(imported.error().find("glTF 1.0 is not read; convert it to 2.0, for example with Blender or gltf-pipeline"),
            std::string::npos)
      << imported.error();
}

// A few hundred files of all that is new here, cut and scrambled: a scene or one line.
TEST_F(GltfMended, damagedFilesNeverCrash) {
  GltfFile f = GltfFile::triangle();
  f.json["images"] = {{{"bufferView", f.addView(testing::pngOf(4, 4, 0.5f))}},
                      {{"bufferView", f.addView(testing::basisLzPicture().bytes())}}};
  f.json["textures"] = {{{"source", 0}}, {{"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}}};
  f.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseTexture", {{"index", 0}}},
      {"specularGlossinessTexture", {{"index", 1}}},
      {"specularFactor", {0.9, 0.5, 0.1}}};
  f.json["extensionsRequired"] = {"KHR_texture_basisu", "KHR_materials_pbrSpecularGlossiness"};
  f.primitive()["attributes"]["NORMAL"] = f.addFloats({1, 0, 0, 0, 0, 0, kNaN, 0, 0}, "VEC3");
  f.primitive()["attributes"]["TEXCOORD_0"] = f.addFloats({0, 0, 1, 0, 0, 1}, "VEC2");
  const std::string whole = f.glb();
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 1 + i % 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 4 == 0) bytes.resize(random() % bytes.size());
    testing::writeFile(folder_ / "a.glb", bytes);
    const auto imported = importScene(folder_ / "a.glb");
    if (imported) continue;
    EXPECT_NE(imported.error().find("a.glb: "), std::string::npos) << imported.error();
    EXPECT_EQ(imported.error().find('\n'), std::string::npos) << imported.error();
  }
}

}  // namespace
}  // namespace roomlight
