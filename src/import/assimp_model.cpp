#include "import/assimp_model.h"

#include <fmt/format.h>

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cstring>

#include "import/child_process.h"
#include "import/failure.h"
#include "import/foreign_model.h"

namespace roomlight::importers {
namespace {

constexpr size_t kMaxBytes = size_t{256} << 20;
constexpr int kDeepestNode = 512;

class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  size_t Read(void* to, size_t size, size_t count) override {
    if (size == 0) return 0;
    const size_t whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(to, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_
                                                                            : bytes_.size();
    const size_t to = base + offset;  // backwards wraps around
    if (to > bytes_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  size_t Tell() const override { return at_; }
  size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::span<const uint8_t> bytes_;
  size_t at_ = 0;
};

// A disk with one file.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::span<const uint8_t> bytes) : name_(std::move(name)), bytes_(bytes) {}
  bool Exists(const char* name) const override { return name == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char*) override { return name == name_ ? new MemoryStream(bytes_) : nullptr; }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::span<const uint8_t> bytes_;
};

std::string text(const aiString& s) { return std::string(s.data, std::min<size_t>(s.length, sizeof(s.data))); }

ForeignMaterial materialOf(const aiMaterial& in) {
  ForeignMaterial out;
  aiString name;
  if (in.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) out.name = text(name);
  const auto colour = [&](const char* key, unsigned type, unsigned index, Vec3& v) {
    aiColor3D c;
    if (in.Get(key, type, index, c) == aiReturn_SUCCESS) v = {c.r, c.g, c.b};
  };
  colour(AI_MATKEY_COLOR_DIFFUSE, out.diffuse);
  colour(AI_MATKEY_COLOR_SPECULAR, out.specular);
  colour(AI_MATKEY_COLOR_EMISSIVE, out.emission);
  in.Get(AI_MATKEY_OPACITY, out.opacity);
  in.Get(AI_MATKEY_SHININESS, out.shininess);
  const auto picture = [&](aiTextureType type) {
    aiString path;
    return in.GetTextureCount(type) > 0 && in.GetTexture(type, 0, &path) == aiReturn_SUCCESS ? text(path) : std::string();
  };
  out.diffusePicture = picture(aiTextureType_DIFFUSE);
  out.opacityPicture = picture(aiTextureType_OPACITY);
  out.emissionPicture = picture(aiTextureType_EMISSIVE);
  return out;
}

class Collector {
 public:
  Collector(const aiScene& scene, size_t maxTriangles) : scene_(scene), maxTriangles_(maxTriangles) {}

  ForeignModel collect() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) model_.materials.push_back(materialOf(*scene_.mMaterials[i]));
    if (scene_.mRootNode) walk(*scene_.mRootNode, aiMatrix4x4(), 0);
    return std::move(model_);
  }

 private:
  void walk(const aiNode& node, const aiMatrix4x4& above, int depth) {
    if (depth > kDeepestNode) fail("", fmt::format("has nodes nested more than {} deep", kDeepestNode));
    const aiMatrix4x4 m = above * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], text(node.mName), m);
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], m, depth + 1);
  }

  void add(const aiMesh& in, const std::string& name, const aiMatrix4x4& m) {
    Mesh out;
    out.name = name, out.material = static_cast<int>(in.mMaterialIndex);
    const bool mirrored = m.Determinant() < 0;
    aiMatrix3x3 forNormals(m);
    const bool normals = in.HasNormals() && m.Determinant() != 0;
    if (normals) forNormals.Inverse().Transpose();
    for (unsigned i = 0; i < in.mNumVertices; ++i) {
      const aiVector3D p = m * in.mVertices[i];
      out.positions.push_back({p.x, p.y, p.z});
      if (normals) {
        const aiVector3D n = forNormals * in.mNormals[i];
        out.normals.push_back({n.x, n.y, n.z});
      }
      // Texture coordinates count from the picture's bottom here, from its top in the scene.
      if (in.HasTextureCoords(0)) out.uv[0].push_back({in.mTextureCoords[0][i].x, 1 - in.mTextureCoords[0][i].y});
    }
    for (unsigned i = 0; i < in.mNumFaces; ++i) {
      const aiFace& face = in.mFaces[i];
      if (face.mNumIndices != 3) {
        ++model_.noTriangles;
        continue;
      }
      if (++triangles_ > maxTriangles_) fail("", fmt::format("has more than {} triangles", maxTriangles_));
      out.indices.insert(out.indices.end(), {face.mIndices[0], face.mIndices[mirrored ? 2 : 1], face.mIndices[mirrored ? 1 : 2]});
    }
    model_.meshes.push_back(std::move(out));
  }

  const aiScene& scene_;
  size_t maxTriangles_, triangles_ = 0;
  ForeignModel model_;
};

// Of the library's forty formats only the one that is meant.
void keepOnly(Assimp::Importer& importer, const std::string& extension) {
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* about = importer.GetImporterInfo(i);
    const std::string extensions = about && about->mFileExtensions ? fmt::format(" {} ", about->mFileExtensions) : "";
    if (extensions.find(" " + extension + " ") == std::string::npos) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

Bytes readInside(std::span<const uint8_t> bytes, const std::string& extension, size_t maxTriangles) {
  Assimp::Importer importer;
  keepOnly(importer, extension);
  const std::string name = "model." + extension;
  importer.SetIOHandler(new OneFile(name, bytes));  // owned by the importer
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);  // of nodes, instead of their ids
  const aiScene* scene = importer.ReadFile(name, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_TransformUVCoords);
  if (!scene) fail("", std::string("is damaged: ") + importer.GetErrorString());
  return toBytes(Collector(*scene, maxTriangles).collect());
}

}  // namespace

Scene readByAssimp(std::span<const uint8_t> bytes, AssimpFormat format, const ReadCompanion& companions, size_t maxTriangles, Warnings& warnings) {
  if (bytes.size() > kMaxBytes) fail("", fmt::format("is larger than {} MiB", kMaxBytes >> 20));
  const std::string extension = format == AssimpFormat::Collada ? "dae" : "3ds";
  const Bytes read = inChildProcess([&] { return readInside(bytes, extension, maxTriangles); });
  return sceneOf(foreignModel(read), companions, warnings);
}

}  // namespace roomlight::importers
