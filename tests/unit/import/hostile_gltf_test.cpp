// Damaged, hostile and absurd glTF files: one line that names the file and the place in it; no crash, no huge memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <functional>

#include "unit/import/gltf_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using nlohmann::json;
using testing::GltfFile;
using testing::TemporaryFolder;

struct Case {
  const char* name;
  std::function<void(GltfFile&)> damage;
  const char* expected;  // part of the message
};

void expectRefused(const Result<Imported>& imported, const std::string& name, const std::string& expected) {
  ASSERT_FALSE(imported) << name;
  EXPECT_NE(imported.error().find("a.glb: "), std::string::npos) << name << ": " << imported.error();
  EXPECT_NE(imported.error().find(expected), std::string::npos) << name << ": " << imported.error();
  EXPECT_EQ(imported.error().find('\n'), std::string::npos) << name;
  EXPECT_LT(imported.error().size(), 1000u) << name;
}

class HostileGltf : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  void expectAllRefused(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
      GltfFile f = GltfFile::triangle();
      c.damage(f);
      expectRefused(f.import(folder_ / "a.glb"), c.name, c.expected);
    }
  }
};

TEST_F(HostileGltf, wrongTypesAndMissingMembers) {
  expectAllRefused({
      {"needs a newer reader", [](GltfFile& f) { f.json["asset"]["minVersion"] = "2.1"; }, "asset.minVersion"},
      {"nodes is text", [](GltfFile& f) { f.json["nodes"] = "hello"; }, "nodes: is not an array"},
      {"node is null", [](GltfFile& f) { f.json["nodes"][0] = nullptr; }, "nodes[0]: is not an object"},
      {"mesh is text", [](GltfFile& f) { f.node()["mesh"] = "0"; }, "nodes[0].mesh: is not a number"},
      {"attributes is a list", [](GltfFile& f) { f.primitive()["attributes"] = json::array(); },
       "attributes: is not an object"},
      {"colour too short",
       [](GltfFile& f) {
         f.json["materials"][0]["emissiveFactor"] = {1, 1};
       },
       "materials[0].emissiveFactor"},
      {"colour of text",
       [](GltfFile& f) {
         f.json["materials"][0]["emissiveFactor"] = {"a", "b", "c"};
       },
       "emissiveFactor[0]: is not a number"},
      {"extension is a number", [](GltfFile& f) { f.json["materials"][0]["extensions"]["KHR_materials_ior"] = 3; },
       "KHR_materials_ior: is not an object"},
      {"required extension", [](GltfFile& f) { f.json["extensionsRequired"] = {"ACME_teapots"}; },
       "extensionsRequired[0]: the file requires 'ACME_teapots'"},
      {"required is a number", [](GltfFile& f) { f.json["extensionsRequired"] = {1}; }, "extensionsRequired[0]"},
      {"mesh is a fraction",
       [](GltfFile& f) { f.json["meshes"].push_back(f.json["meshes"][0]), f.node()["mesh"] = 0.5; }, "nodes[0].mesh"},
      {"first version", [](GltfFile& f) { f.json["asset"]["version"] = "1.0"; },
       "glTF 1.0 is not read; convert it to 2.0"},
      {"first version by its shape",
       [](GltfFile& f) {
         f.json = {{"nodes", {{"a", json::object()}}}};
       },
       "glTF 1.0 is not read; convert it to 2.0"},
      {"third version", [](GltfFile& f) { f.json["asset"]["version"] = "3.0"; }, "asset.version"},
      {"nothing to see", [](GltfFile& f) { f.json["nodes"] = json::array({json::object()}); }, "no triangle"},
  });
}

TEST_F(HostileGltf, nodesThatAreNoTree) {
  expectAllRefused({
      {"too deep",
       [](GltfFile& f) {
         for (int i = 1; i < 100'000; ++i) f.json["nodes"].push_back({{"children", {i + 1}}});
         f.json["nodes"].push_back(json::object());
         f.node()["children"] = {1};
       },
       "deeper than 512"},
      {"short matrix",
       [](GltfFile& f) {
         f.node()["matrix"] = {1, 2, 3};
       },
       "nodes[0].matrix"},
      {"infinite scale",
       [](GltfFile& f) {
         f.node()["scale"] = {1e39, 1, 1};
       },
       "nodes[0].scale"},
      {"scale that overflows",
       [](GltfFile& f) {
         f.node() = {{"scale", {1e30, 1e30, 1e30}}, {"children", {1}}};
         f.json["nodes"].push_back({{"scale", {1e30, 1e30, 1e30}}, {"mesh", 0}});
       },
       "too large"},
      {"as wide as the way to the moon",
       [](GltfFile& f) {
         f.node()["scale"] = {4e8, 1, 1};
       },
       "--metres-per-unit"},
  });
}

TEST_F(HostileGltf, accessorsAndBuffers) {
  expectAllRefused({
      {"count beyond the view", [](GltfFile& f) { f.json["accessors"][0]["count"] = 4; },
       "accessors[0]: 4 elements of 12 bytes reach beyond"},
      {"a billion vertices", [](GltfFile& f) { f.json["accessors"][0]["count"] = 1'000'000'000; }, "accessors[0]"},
      {"a billion zeros",
       [](GltfFile& f) {
         f.json["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 1'000'000'000}};
         f.primitive().erase("indices");
       },
       "unfolds"},
      {"2^63 elements", [](GltfFile& f) { f.json["accessors"][0]["count"] = uint64_t{1} << 63; }, "accessors[0].count"},
      {"offset overflow", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 18446744073709551615u; },
       "accessors[0].byteOffset"},
      {"offset beyond", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 4096; }, "accessors[0]"},
      {"negative offset", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = -4; }, "accessors[0].byteOffset"},
      {"stride too small", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 4; },
       "accessors[0]: elements of 12 bytes overlap"},
      {"stride too large", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 64; }, "accessors[0]"},
      {"component type", [](GltfFile& f) { f.json["accessors"][0]["componentType"] = 5130; },
       "accessors[0].componentType"},
      {"matrix positions", [](GltfFile& f) { f.json["accessors"][0]["type"] = "MAT4"; }, "accessors[0].type"},
      {"scalar positions", [](GltfFile& f) { f.json["accessors"][0]["type"] = "SCALAR"; },
       "accessors[0]: has 1 components, 3 are needed"},
      {"float indices",
       [](GltfFile& f) {
         f.primitive()["indices"] = f.addFloats({0, 1, 2}, "SCALAR");
       },
       "unsigned integers"},
      {"view that begins beyond the buffer", [](GltfFile& f) { f.json["bufferViews"][0]["byteOffset"] = 10'000; },
       "accessors[0]: 3 elements of 12 bytes reach beyond"},
      {"only NaN vertices",
       [](GltfFile& f) {
         for (size_t i = 0; i < 36; ++i) f.bytes[i] = i % 4 < 2 ? '\0' : i % 4 == 2 ? '\xc0' : '\x7f';
       },
       "no triangle"},
      {"view offset overflow", [](GltfFile& f) { f.json["bufferViews"][0]["byteOffset"] = 9007199254740991u; },
       "bufferViews[0].byteOffset"},
      {"buffer out of range", [](GltfFile& f) { f.json["bufferViews"][0]["buffer"] = 1; }, "bufferViews[0].buffer"},
      {"buffer longer than its bytes", [](GltfFile& f) { f.json["buffers"][0]["byteLength"] = 1'000'000'000; },
       "buffers[0]: claims 1000000000 bytes"},
      {"second buffer without bytes",
       [](GltfFile& f) {
         f.json["buffers"].push_back({{"byteLength", 4}});
       },
       "buffers[1]"},
      {"sparse out of range",
       [](GltfFile& f) {
         const int i = f.addView(std::string(1, 9)), v = f.addView(std::string(12, 0));
         f.json["accessors"][0]["sparse"] = {
             {"count", 1}, {"indices", {{"bufferView", i}, {"componentType", 5121}}}, {"values", {{"bufferView", v}}}};
       },
       "accessors[0].sparse.indices"},
      {"sparse beyond its view",
       [](GltfFile& f) {
         const int v = f.addView(std::string(4, 0));
         f.json["accessors"][0]["sparse"] = {
             {"count", 3}, {"indices", {{"bufferView", v}, {"componentType", 5125}}}, {"values", {{"bufferView", v}}}};
       },
       "accessors[0].sparse.indices"},
      {"instances of different number",
       [](GltfFile& f) {
         const int t = f.addFloats({0, 0, 0}, "VEC3"), s = f.addFloats({1, 1, 1, 1, 1, 1}, "VEC3");
         f.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", t}, {"SCALE", s}};
       },
       "SCALE: has 2 elements, others have 1"},
      {"a billion instances",
       [](GltfFile& f) {
         f.json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 1'000'000'000}});
         f.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 2}};
       },
       "unfolds"},
      {"three million instances",
       [](GltfFile& f) {
         f.json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 3'000'000}});
         f.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 2}};
       },
       "TRANSLATION: meshes are placed more than 2000000 times"},
  });
}

// Names are copied to every primitive and placement.
TEST_F(HostileGltf, endlessNamesAreCut) {
  GltfFile f = GltfFile::triangle();
  f.node()["name"] = f.json["meshes"][0]["name"] = std::string(100'000, 'x');
  const auto imported = f.import(folder_ / "a.glb");
  ASSERT_TRUE(imported) << imported.error();
  EXPECT_LT(imported.value().scene.instances[0].name.size(), 300u);
  EXPECT_LT(imported.value().scene.meshes[0].name.size(), 300u);
}

TEST_F(HostileGltf, picturesThatLie) {
  const auto picture = [](const std::string& bytes) {
    return [bytes](GltfFile& f) {
      f.json["images"] = {{{"bufferView", f.addView(bytes)}}};
      f.json["textures"] = {{{"source", 0}}};
      f.json["materials"][0]["normalTexture"] = {{"index", 0}};
    };
  };
  std::string huge = testing::pngOf(4, 4, 1), cut = huge.substr(0, huge.size() / 2), broken = huge;
  huge.replace(16, 8, std::string("\x00\x00\x40\x00\x00\x00\x40\x00", 8));  // 16384 x 16384
  broken[broken.size() - 30] = static_cast<char>(broken[broken.size() - 30] ^ 0x55);
  std::string endless = testing::pngOf(4, 4, 1);
  endless.replace(16, 8, std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff", 8));
  const std::vector<Case> cases = {
      {"huge PNG in few bytes", picture(huge), "the picture claims 16384 x 16384 pixels, but has only"},
      {"endless PNG", picture(endless), "the picture claims 2147483647"},
      {"cut PNG", picture(cut), "images[0] ("},
      {"broken PNG", picture(broken), "images[0] ("},
      {"PNG without a header", picture("\x89PNG\r\n\x1a\n"), "images[0] ("},
      {"JPEG of nothing", picture("\xff\xd8\xff\xe0"), "images[0] ("},
      {"WebP of nothing", picture("RIFF\x10\x20\x30\x40WEBPVP8 "), "images[0] ("},
      {"BMP of nothing", picture("BM"), "images[0] ("},
      {"KTX2 of nothing", picture("\xabKTX 20\xbb\r\n\x1a\n"), "images[0] ("},
      {"image without bytes",
       [](GltfFile& f) {
         f.json["images"] = json::array({json::object()});
         f.json["textures"] = {{{"source", 0}}};
         f.json["materials"][0]["normalTexture"] = {{"index", 0}};
       },
       "missing"},
  };
  for (const Case& c : cases) {
    GltfFile f = GltfFile::triangle();
    c.damage(f);
    const auto imported = f.import(folder_ / "a.glb");
    ASSERT_TRUE(imported) << c.name << ": " << imported.error();
    EXPECT_TRUE(imported.value().scene.textures.empty()) << c.name;
    ASSERT_EQ(imported.value().warnings.size(), 1u) << c.name;
    EXPECT_NE(imported.value().warnings[0].find(c.expected), std::string::npos)
        << c.name << ": " << imported.value().warnings[0];
  }
}

TEST_F(HostileGltf, uniformResourceIdentifiersStayInTheFolder) {
  testing::writeFile(folder_ / "secret.bin", std::string(100, 'x'));
  std::filesystem::create_directory(folder_ / "home");
  std::filesystem::create_symlink(folder_ / "secret.bin", folder_ / "home/link.bin");
  std::filesystem::create_directory_symlink(folder_.path(), folder_ / "home/up");
  const std::string absolute = (folder_ / "secret.bin").string();
  for (const std::string& uri : {std::string("../secret.bin"),
                                 std::string("%2e%2e/secret.bin"),
                                 std::string("%2E%2E%2Fsecret.bin"),
                                 std::string("a/../../secret.bin"),
                                 absolute,
                                 "file://" + absolute,
                                 std::string("http://example.org/a.bin"),
                                 std::string("link.bin"),
                                 std::string("up/secret.bin"),
                                 std::string("..\\secret.bin"),
                                 std::string("C:\\secret.bin"),
                                 std::string("\\\\server\\a.bin"),
                                 std::string("%00"),
                                 std::string("%zz"),
                                 std::string("%2"),
                                 std::string(""),
                                 std::string("missing.bin"),
                                 std::string("."),
                                 std::string("data:,hello"),
                                 std::string("data:application/octet-stream;base64,!!!!"),
                                 std::string("data:;base64,AAAAA"),
                                 std::string(5000, 'a'),
                                 std::string("/dev/zero"),
                                 std::string("home\n.bin")}) {
    GltfFile f = GltfFile::triangle();
    f.json["buffers"][0] = {{"uri", uri}, {"byteLength", 44}};
    const auto imported = f.import(folder_ / "home/a.glb");
    expectRefused(imported, uri, "buffers[0]");
  }
}

TEST_F(HostileGltf, cutAndScrambledFiles) {
  const std::string whole = GltfFile::triangle().glb();
  for (size_t length = 0; length + 4 < whole.size(); length += 7) {
    testing::writeFile(folder_ / "a.glb", whole.substr(0, length));
    expectRefused(importScene(folder_ / "a.glb"), "cut at " + std::to_string(length), "");
  }
  for (size_t i = 0; i < whole.size(); i += 3) {
    std::string scrambled = whole;
    scrambled[i] = static_cast<char>(scrambled[i] ^ 0x41);
    testing::writeFile(folder_ / "a.glb", scrambled);
    const auto imported = importScene(folder_ / "a.glb");
    if (!imported) expectRefused(imported, "byte " + std::to_string(i), "");
  }
}

TEST_F(HostileGltf, textThatIsNoGltf) {
  const std::string deep(1'000'000, '[');
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string("null"), std::string("{}"),
        std::string("hello"), std::string("{\"asset\": {\"version\": \"2.0\"}}"),
        std::string("{\"asset\": \"\xff\xfe\"}"), std::string("{\"a\": 1e999}"), deep, "{\"extras\":" + deep}) {
    testing::writeFile(folder_ / "a.glb", text);
    expectRefused(importScene(folder_ / "a.glb"), text.substr(0, 20), "");
  }
}

TEST_F(HostileGltf, primitivesThatShareDataCannotFillTheMemory) {
  GltfFile f = GltfFile::triangle();
  std::vector<uint32_t> indices(300'000);
  for (size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<uint32_t>(i % 3);
  f.primitive()["indices"] = f.addAccessor(indices, 5125, "SCALAR");
  const json primitive = f.primitive();
  for (int i = 0; i < 5000; ++i) f.json["meshes"][0]["primitives"].push_back(primitive);
  expectRefused(f.import(folder_ / "a.glb", {.maxTriangles = 1'000'000}), "shared", "");
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 2'000'000) << "kilobytes";
}

// Each node places all primitives of its mesh.
TEST_F(HostileGltf, instancesAreCounted) {
  GltfFile f = GltfFile::triangle();
  const json primitive = f.primitive(), node = f.node();
  for (int i = 1; i < 1500; ++i) {
    f.json["meshes"][0]["primitives"].push_back(primitive);
    f.json["nodes"].push_back(node);
    f.json["scenes"][0]["nodes"].push_back(i);
  }
  expectRefused(f.import(folder_ / "a.glb"), "nodes times primitives", "meshes are placed more than 2000000 times");
}

TEST_F(HostileGltf, sparseValuesThatAreSharedCount) {
  constexpr int kCount = 10'000;
  GltfFile f = GltfFile::triangle();
  std::vector<uint32_t> indices(kCount);
  for (size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<uint32_t>(i);
  const int normals = f.addFloats(std::vector<float>(3 * kCount, 1), "VEC3"),
            numbers = f.addAccessor(indices, 5125, "SCALAR");
  const json view = f.json["accessors"][static_cast<size_t>(numbers)]["bufferView"],
             values = f.json["accessors"][static_cast<size_t>(normals)]["bufferView"];
  f.json["accessors"][static_cast<size_t>(normals)]["sparse"] = {
      {"count", kCount},
      {"indices", {{"bufferView", view}, {"componentType", 5125}}},
      {"values", {{"bufferView", values}}}};
  f.primitive()["attributes"]["NORMAL"] = normals;
  const json primitive = f.primitive();
  for (int i = 0; i < 6000; ++i) f.json["meshes"][0]["primitives"].push_back(primitive);
  expectRefused(f.import(folder_ / "a.glb"), "sparse", "unfolds");
}

TEST_F(HostileGltf, valuesOfTheJsonAreCounted) {
  testing::writeFile(folder_ / "a.glb", "{\"extras\":[" + std::string(50'000'001, ','));
  expectRefused(importScene(folder_ / "a.glb"), "commas", "holds more than 50000000 values");
}

}  // namespace
}  // namespace roomlight
