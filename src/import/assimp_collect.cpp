#include "import/model_reader.h"

#include <fmt/format.h>

#include <assimp/camera.h>
#include <assimp/light.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

constexpr int kDeepestNode = 512;
constexpr float kRadPerDegree = std::numbers::pi_v<float> / 180;

std::string text(const aiString& s) { return std::string(s.data, std::min<size_t>(s.length, sizeof(s.data))); }
Vec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }
Vec3 vec(const aiColor3D& v) { return {v.r, v.g, v.b}; }
Affine affine(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

// Vertex colours are meant as a screen shows them.
float linear(float srgb) { return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f); }

class MaterialReader {
 public:
  MaterialReader(const aiScene& scene, const aiMaterial& in) : scene_(scene), in_(in) {}

  ForeignMaterial read() const {
    ForeignMaterial out;
    aiString name;
    if (in_.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) out.name = text(name);
    colour(AI_MATKEY_COLOR_DIFFUSE, out.diffuse);
    colour(AI_MATKEY_COLOR_SPECULAR, out.specular);
    colour(AI_MATKEY_COLOR_EMISSIVE, out.emission);
    in_.Get(AI_MATKEY_OPACITY, out.opacity);
    if (in_.Get(AI_MATKEY_SHININESS, out.shininess) != aiReturn_SUCCESS)
      in_.Get("$raw.Shininess", 0, 0, out.shininess);  // FBX has both
    out.diffusePicture = picture(aiTextureType_DIFFUSE);
    if (out.diffusePicture.empty()) out.diffusePicture = picture(aiTextureType_BASE_COLOR);
    out.opacityPicture = picture(aiTextureType_OPACITY);
    out.emissionPicture = picture(aiTextureType_EMISSIVE);
    out.normalPicture = picture(aiTextureType_NORMALS);
    // "Transparent by all of black": written by exporters that mean no transparency.
    Vec3 transparent(1);
    colour(AI_MATKEY_COLOR_TRANSPARENT, transparent);
    if (out.opacity == 0 && isBlack(transparent)) out.opacity = 1;
    return out;
  }

 private:
  void colour(const char* key, unsigned type, unsigned index, Vec3& v) const {
    aiColor3D c;
    if (in_.Get(key, type, index, c) == aiReturn_SUCCESS) v = vec(c);
  }

  std::string picture(aiTextureType type) const {
    aiString path;
    if (in_.GetTextureCount(type) == 0 || in_.GetTexture(type, 0, &path) != aiReturn_SUCCESS) return {};
    const aiTexture* own = scene_.GetEmbeddedTexture(path.C_Str());
    for (unsigned i = 0; own && own->mWidth > 0 && i < scene_.mNumTextures; ++i) {
      if (scene_.mTextures[i] == own) return fmt::format("*{}", i);
    }
    return text(path);
  }

  const aiScene& scene_;
  const aiMaterial& in_;
};

class Collector {
 public:
  Collector(const aiScene& scene, AssimpFormat format, size_t maxTriangles)
      : scene_(scene), format_(format), maxTriangles_(maxTriangles) {}

  ForeignModel collect() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) addMaterial(*scene_.mMaterials[i]);
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) addMesh(*scene_.mMeshes[i]);
    for (unsigned i = 0; i < scene_.mNumTextures; ++i) addPicture(*scene_.mTextures[i]);
    // The library turns 3D Studio's z up to y up although nothing in the file says it.
    const aiMatrix4x4 turnedBack(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
    if (scene_.mRootNode) walk(*scene_.mRootNode, format_ == AssimpFormat::Studio3D ? turnedBack : aiMatrix4x4(), 0);
    for (unsigned i = 0; i < scene_.mNumCameras; ++i) addCamera(*scene_.mCameras[i]);
    for (unsigned i = 0; i < scene_.mNumLights; ++i) addLight(*scene_.mLights[i]);
    readFrame();
    return std::move(model_);
  }

 private:
  void walk(const aiNode& node, const aiMatrix4x4& above, int depth) {
    if (depth > kDeepestNode) fail("", fmt::format("has nodes nested more than {} deep", kDeepestNode));
    const aiMatrix4x4 m = above * node.mTransformation;
    const std::string name = text(node.mName);
    nodes_.emplace(name, m);
    const auto object = static_cast<uint32_t>(nodesWithMeshes_);
    if (node.mNumMeshes > 0) ++nodesWithMeshes_;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const unsigned mesh = node.mMeshes[i];
      triangles_ += model_.meshes.at(mesh).triangleCount();
      if (triangles_ > maxTriangles_) fail("", fmt::format("has more than {} triangles", maxTriangles_));
      model_.instances.push_back({name, mesh, object, affine(m)});
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], m, depth + 1);
  }

  // STL has no materials and PLY next to none: what the library puts in their place is a white that swallows no light.
  void addMaterial(const aiMaterial& in) {
    model_.materials.push_back(MaterialReader(scene_, in).read());
    ForeignMaterial& m = model_.materials.back();
    if (format_ == AssimpFormat::Stl || format_ == AssimpFormat::Ply)
      m.diffuse = ForeignMaterial().diffuse, m.specular = m.emission = {}, m.shininess = 0;
  }

  void addMesh(const aiMesh& in) {
    Mesh out;
    out.name = text(in.mName), out.material = static_cast<int>(in.mMaterialIndex);
    const bool colours = format_ == AssimpFormat::Ply && in.HasVertexColors(0);
    for (unsigned i = 0; i < in.mNumVertices; ++i) {
      out.positions.push_back(vec(in.mVertices[i]));
      if (in.HasNormals()) out.normals.push_back(vec(in.mNormals[i]));
      // Texture coordinates count from the picture's bottom here, from its top in the scene.
      if (in.HasTextureCoords(0)) out.uv[0].push_back({in.mTextureCoords[0][i].x, 1 - in.mTextureCoords[0][i].y});
      if (colours)
        out.colors.push_back({linear(in.mColors[0][i].r), linear(in.mColors[0][i].g), linear(in.mColors[0][i].b)});
    }
    for (unsigned i = 0; i < in.mNumFaces; ++i) {
      const aiFace& face = in.mFaces[i];
      if (face.mNumIndices == 3) out.indices.insert(out.indices.end(), face.mIndices, face.mIndices + 3);
      if (face.mNumIndices != 3) ++model_.noTriangles;
    }
    model_.meshes.push_back(std::move(out));
  }

  // Files in a file; pictures as bare texels are written by no exporter of these formats.
  void addPicture(const aiTexture& in) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(in.pcData);
    model_.pictures.emplace_back();
    if (in.mHeight == 0 && bytes) model_.pictures.back().assign(bytes, bytes + in.mWidth);
  }

  Affine placeOf(const aiString& name) const {
    const auto it = nodes_.find(text(name));
    return it == nodes_.end() ? Affine() : affine(it->second);
  }

  void addCamera(const aiCamera& in) {
    const Affine m = placeOf(in.mName);
    ForeignCamera out;
    out.name = text(in.mName);
    out.position = m.point(vec(in.mPosition)), out.direction = m.vector(vec(in.mLookAt)),
    out.up = m.vector(vec(in.mUp));
    out.xFovRad = in.mHorizontalFOV, out.aspect = in.mAspect;
    // 3D Studio says the focal length in mm where the library takes degrees: the angle is 2400 / mm degrees.
    if (format_ == AssimpFormat::Studio3D && in.mHorizontalFOV > 0)
      out.xFovRad = 2400 / (in.mHorizontalFOV / kRadPerDegree) * kRadPerDegree;
    model_.cameras.push_back(out);
  }

  void addLight(const aiLight& in) {
    if (in.mType == aiLightSource_AMBIENT) {
      ++model_.otherLights;
      return;
    }
    const Affine m = placeOf(in.mName);
    ForeignLight out;
    out.name = text(in.mName);
    // FBX's area lights come as lights of no kind.
    out.kind = in.mType == aiLightSource_POINT         ? ForeignLightKind::Point
               : in.mType == aiLightSource_SPOT        ? ForeignLightKind::Spot
               : in.mType == aiLightSource_DIRECTIONAL ? ForeignLightKind::Directional
                                                       : ForeignLightKind::Area;
    out.position = m.point(vec(in.mPosition)), out.direction = m.vector(vec(in.mDirection)),
    out.up = m.vector(vec(in.mUp));
    out.colour = vec(in.mColorDiffuse);
    out.innerConeRad = in.mAngleInnerCone / 2, out.outerConeRad = in.mAngleOuterCone / 2;
    // COLLADA's falloff angle is where the light ends; beyond it the library guesses.
    if (format_ == AssimpFormat::Collada) out.outerConeRad = out.innerConeRad, out.innerConeRad *= 0.7f;
    out.width = in.mSize.x * length(m.x), out.height = in.mSize.y * length(m.y);
    model_.lights.push_back(out);
  }

  // COLLADA's axis and unit are in the root's transform.
  void readFrame() {
    if (format_ == AssimpFormat::Collada) model_.up = 'y', model_.metresPerUnit = 1;
    if (format_ != AssimpFormat::Fbx || !scene_.mMetaData) return;
    int32_t axis = -1;
    if (scene_.mMetaData->Get("UpAxis", axis) && axis >= 0 && axis <= 2) model_.up = "xyz"[axis];
    float centimetres = 1;
    scene_.mMetaData->Get("UnitScaleFactor", centimetres);
    model_.metresPerUnit = centimetres * 0.01f;
  }

  const aiScene& scene_;
  AssimpFormat format_;
  size_t maxTriangles_, triangles_ = 0, nodesWithMeshes_ = 0;
  std::map<std::string, aiMatrix4x4> nodes_;
  ForeignModel model_;
};

}  // namespace

ForeignModel collectForeign(const aiScene& scene, AssimpFormat format, size_t maxTriangles) {
  return Collector(scene, format, maxTriangles).collect();
}

}  // namespace roomlight::importers
