// KHR_draco_mesh_compression and EXT_meshopt_compression, on files made here and on files of other programs.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cstdlib>

#include "unit/import/gltf_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::GltfFile;
using testing::TemporaryFolder;

constexpr int kSide = 20;  // of a grid of squares with a bump

Vec3 gridPoint(int x, int y) { return {static_cast<float>(x), static_cast<float>(y), x == 3 && y == 4 ? 2.0f : 0.0f}; }

struct Grid {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
  Grid() {
    for (int y = 0; y <= kSide; ++y) {
      for (int x = 0; x <= kSide; ++x) {
        const Vec3 p = gridPoint(x, y);
        positions.insert(positions.end(), {p.x, p.y, p.z});
      }
    }
    for (uint32_t y = 0; y < kSide; ++y) {
      for (uint32_t x = 0; x < kSide; ++x) {
        const uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
        indices.insert(indices.end(), {a, b, d, a, d, c});
      }
    }
  }
};

void expectGrid(const Result<Imported>& imported) {
  ASSERT_TRUE(imported) << imported.error();
  const Scene& scene = imported.value().scene;
  EXPECT_EQ(scene.triangleCount(), 2u * kSide * kSide);
  EXPECT_NEAR(scene.bounds().hi.x, kSide, 0.02f);
  EXPECT_NEAR(scene.bounds().hi.z, 2, 0.02f);
  float area = 0;
  const Mesh& mesh = scene.meshes.at(0);
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
               c = mesh.positions[mesh.indices[t + 2]];
    area += cross(b - a, c - a).z / 2;
  }
  EXPECT_NEAR(area, kSide * kSide, 0.5f);
}

// A grid with its vertices in Draco's hands; `method` is one of draco::MeshEncoderMethod.
GltfFile dracoGrid(int method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2 * kSide * kSide);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const Grid grid;
  for (uint32_t t = 0; t < 2 * kSide * kSide; ++t) {
    const auto corner = [&](size_t k) { return &grid.positions[3 * grid.indices[3 * t + k]]; };
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(t), corner(0), corner(1), corner(2));
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  GltfFile f = GltfFile::triangle();
  const int view = f.addView(std::string(buffer.data(), buffer.size()));
  f.json["accessors"][0] = {{"componentType", 5126}, {"count", mesh->num_points()}, {"type", "VEC3"}};
  f.json["accessors"][1] = {{"componentType", 5125}, {"count", 6 * kSide * kSide}, {"type", "SCALAR"}};
  f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  f.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(0)->unique_id()}}}};
  return f;
}

// A grid with compressed views, the positions through the exponential filter.
GltfFile meshoptGrid(const char* indexMode) {
  Grid grid;
  GltfFile f = GltfFile::triangle();
  const size_t count = grid.positions.size() / 3;
  std::vector<uint8_t> filtered(grid.positions.size() * 4), vertices(meshopt_encodeVertexBufferBound(count, 12));
  meshopt_encodeFilterExp(filtered.data(), count, 12, 20, grid.positions.data());
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), filtered.data(), count, 12));
  std::vector<uint8_t> indices(meshopt_encodeIndexSequenceBound(grid.indices.size(), count) +
                               meshopt_encodeIndexBufferBound(grid.indices.size(), count));
  const bool triangles = std::string(indexMode) == "TRIANGLES";
  indices.resize(
      triangles
          ? meshopt_encodeIndexBuffer(indices.data(), indices.size(), grid.indices.data(), grid.indices.size())
          : meshopt_encodeIndexSequence(indices.data(), indices.size(), grid.indices.data(), grid.indices.size()));

  f.json["buffers"].push_back(
      {{"byteLength", 100'000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  const auto compress = [&](const std::vector<uint8_t>& bytes, size_t elements, size_t stride, const char* mode,
                            const char* filter) {
    const int packed = f.addView(std::string(bytes.begin(), bytes.end()));
    nlohmann::json extension = f.json["bufferViews"][static_cast<size_t>(packed)];
    extension.update({{"count", elements}, {"byteStride", stride}, {"mode", mode}, {"filter", filter}});
    f.json["bufferViews"].push_back(
        {{"buffer", 1}, {"byteLength", elements * stride}, {"extensions", {{"EXT_meshopt_compression", extension}}}});
    return f.json["bufferViews"].size() - 1;
  };
  f.json["accessors"][0] = {{"bufferView", compress(vertices, count, 12, "ATTRIBUTES", "EXPONENTIAL")},
                            {"componentType", 5126},
                            {"count", count},
                            {"type", "VEC3"}};
  f.json["accessors"][1] = {{"bufferView", compress(indices, grid.indices.size(), 4, indexMode, "NONE")},
                            {"componentType", 5125},
                            {"count", grid.indices.size()},
                            {"type", "SCALAR"}};
  f.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  return f;
}

class Compression : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(Compression, dracoOfBothMethods) {
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    expectGrid(dracoGrid(method).import(folder_ / "a.glb"));
}

TEST_F(Compression, meshoptTrianglesAndSequences) {
  for (const char* mode : {"TRIANGLES", "INDICES"}) expectGrid(meshoptGrid(mode).import(folder_ / "a.glb"));
}

// Every byte of the packed data broken once: a clean error or some triangles, never a crash.
TEST_F(Compression, damagedStreamsNeverCrash) {
  for (const GltfFile& original : {dracoGrid(draco::MESH_SEQUENTIAL_ENCODING),
                                   dracoGrid(draco::MESH_EDGEBREAKER_ENCODING), meshoptGrid("TRIANGLES")}) {
    for (size_t i = 44; i < original.bytes.size(); i += 1 + i / 40) {
      for (const int bits : {0xff, 0x80, 0x01}) {
        GltfFile f = original;
        f.bytes[i] = static_cast<char>(f.bytes[i] ^ bits);
        const auto imported = f.import(folder_ / "a.glb");
        EXPECT_EQ(imported.error().find('\n'), std::string::npos);
      }
    }
  }
}

TEST_F(Compression, streamsThatClaimTooMuchAreRefusedBeforeMemoryIsTaken) {
  // Header, connectivity of a sequential mesh: 2^31 faces, 2^31 points.
  const std::string sequential("DRACO\x02\x02\x01\x00\x00\x00\x80\x80\x80\x80\x08\x80\x80\x80\x80\x08", 21);
  GltfFile f = dracoGrid(draco::MESH_SEQUENTIAL_ENCODING);
  f.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", sequential.size()}});
  f.primitive()["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = f.json["bufferViews"].size() - 1;
  std::copy(sequential.begin(), sequential.end(), f.bytes.begin());
  const auto draco = f.import(folder_ / "a.glb");
  ASSERT_FALSE(draco);
  EXPECT_NE(draco.error().find("meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: claims far more"),
            std::string::npos)
      << draco.error();

  GltfFile m = meshoptGrid("TRIANGLES");
  m.json["bufferViews"].back()["extensions"]["EXT_meshopt_compression"]["count"] = 3'000'000'000u;
  const auto meshopt = m.import(folder_ / "a.glb");
  ASSERT_FALSE(meshopt);
  EXPECT_NE(meshopt.error().find("more than its"), std::string::npos) << meshopt.error();

  GltfFile many = meshoptGrid("TRIANGLES");
  const auto view = many.json["bufferViews"].back();
  for (int i = 0; i < 100; ++i) many.json["bufferViews"].push_back(view);
  const auto unfolded = many.import(folder_ / "a.glb");
  ASSERT_FALSE(unfolded);
  EXPECT_NE(unfolded.error().find("too many compressed buffer views"), std::string::npos) << unfolded.error();
}

// The same rooms written by other programs, plain and compressed.
TEST_F(Compression, filesOfOtherProgramsShowTheSameScene) {
  const char* given = std::getenv("ROOMLIGHT_SHARED_DATA");
  const std::filesystem::path data =
      (given ? std::filesystem::path(given) : std::filesystem::path(ROOMLIGHT_SOURCE_DIR) / "../shared/data") / "gltf";
  if (!std::filesystem::exists(data / "base.glb")) GTEST_SKIP() << "no shared data";
  const auto base = importScene(data / "base.glb");
  ASSERT_TRUE(base) << base.error();
  for (const char* name : {"draco.glb", "meshopt.glb", "webp.glb", "inst.glb"}) {
    const auto other = importScene(data / name);
    ASSERT_TRUE(other) << other.error();
    EXPECT_EQ(other.value().scene.triangleCount(), base.value().scene.triangleCount()) << name;
    EXPECT_NEAR(length(other.value().scene.bounds().hi - base.value().scene.bounds().hi), 0, 1e-2f) << name;
    EXPECT_EQ(other.value().scene.textures.size(), base.value().scene.textures.size()) << name;
    EXPECT_TRUE(other.value().warnings.empty()) << name << ": " << other.value().warnings[0];
  }
}

}  // namespace
}  // namespace roomlight
