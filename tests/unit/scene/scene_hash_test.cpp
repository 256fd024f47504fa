#include "scene/scene_hash.h"

#include <gtest/gtest.h>

#include <set>

namespace roomlight {
namespace {

// Something of each kind, so that there is a value of every member.
Scene oneOfEach() {
  Scene s;
  s.meshes.resize(1), s.instances.resize(1), s.leaves.resize(1), s.materials.resize(1), s.textures.resize(1);
  s.lamps.resize(1), s.suns.resize(1), s.cameras.resize(1), s.rooms.resize(1);
  Mesh& m = s.meshes[0];
  m.positions = m.normals = m.tangents = m.colors = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  m.tangentSigns = m.colorAlphas = {1, 1, 1};
  m.uv[0] = m.uv[1] = {{0, 0}, {1, 0}, {0, 1}};
  m.indices = {0, 1, 2};
  s.textures[0].width = 3, s.textures[0].height = 1, s.textures[0].rgba.assign(12, 7);
  s.rooms[0].floor = {{0, 0}, {0, 1}, {1, 1}};
  s.sky.image = Image(3, 1);
  PhotometricWeb web;
  web.cRad = {0, 6}, web.gammaRad = {0, 1, 2}, web.candela = {1, 2, 3, 4, 5, 6}, web.tiltRad = {0},
  web.tiltFactor = {1};
  s.lamps[0].web = std::make_shared<const PhotometricWeb>(web);
  return s;
}

using Change = void (*)(Scene&);

// One for each member, and for what could be mistaken for another.
const std::vector<Change> kOfWhole = {
    [](Scene& s) { s.meshes.emplace_back(); },   [](Scene& s) { s.instances.emplace_back(); },
    [](Scene& s) { s.leaves.emplace_back(); },   [](Scene& s) { s.materials.emplace_back(); },
    [](Scene& s) { s.textures.emplace_back(); }, [](Scene& s) { s.lamps.emplace_back(); },
    [](Scene& s) { s.suns.emplace_back(); },     [](Scene& s) { s.cameras.emplace_back(); },
    [](Scene& s) { s.rooms.emplace_back(); },    [](Scene& s) { s.cameraInUse = 1; },
};
const std::vector<Change> kOfShapes = {
    [](Scene& s) { s.meshes[0].name = "x"; },
    [](Scene& s) { s.meshes[0].positions[2].z = 1; },
    [](Scene& s) { s.meshes[0].normals[2].z = 1; },
    [](Scene& s) { s.meshes[0].tangents[2].z = 1; },
    [](Scene& s) { s.meshes[0].tangentSigns[2] = -1; },
    [](Scene& s) { s.meshes[0].uv[0][2].x = 0.5f; },
    [](Scene& s) { s.meshes[0].uv[1][2].x = 0.5f; },
    [](Scene& s) { s.meshes[0].colors[2].z = 1; },
    [](Scene& s) { s.meshes[0].colorAlphas[2] = 0; },
    [](Scene& s) { s.meshes[0].indices[2] = 1; },
    [](Scene& s) { s.meshes[0].material = 1; },
    [](Scene& s) { s.meshes[0].normals.clear(); },
    [](Scene& s) { s.meshes[0].tangents.clear(); },
    [](Scene& s) { s.instances[0].name = "x"; },
    [](Scene& s) { s.instances[0].mesh = 1; },
    [](Scene& s) { s.instances[0].object = 1; },
    [](Scene& s) { s.instances[0].worldFromObject.x.x = 2; },
    [](Scene& s) { s.instances[0].worldFromObject.w.z = 1; },
    [](Scene& s) { s.instances[0].leaf = 0; },
    [](Scene& s) { s.leaves[0].hinge.x = 1; },
    [](Scene& s) { s.leaves[0].axis.x = 1; },
    [](Scene& s) { s.leaves[0].turnRad = 1; },
    [](Scene& s) { s.leaves[0].slideM.x = 1; },
    [](Scene& s) { s.leaves[0].atRest = 1; },
    [](Scene& s) { s.rooms[0].name = "x"; },
    [](Scene& s) { s.rooms[0].floor[2].x = 2; },
    [](Scene& s) { s.rooms[0].elevationM = 1; },
    [](Scene& s) { s.rooms[0].heightM = 3; },
    [](Scene& s) { s.rooms[0].use = "kitchen"; },
};
const std::vector<Change> kOfMaterials = {
    [](Scene& s) { s.materials[0].name = "x"; },
    [](Scene& s) { s.materials[0].baseColor.y = 0.5f; },
    [](Scene& s) { s.materials[0].alpha = 0.5f; },
    [](Scene& s) { s.materials[0].baseColorTexture.texture = 0; },
    [](Scene& s) { s.materials[0].baseColorTexture.uvSet = 1; },
    [](Scene& s) { s.materials[0].baseColorTexture.m[0][0] = 2; },
    [](Scene& s) { s.materials[0].baseColorTexture.m[1][2] = 2; },
    [](Scene& s) { s.materials[0].metallic = 0.5f; },
    [](Scene& s) { s.materials[0].roughness = 0.5f; },
    [](Scene& s) { s.materials[0].metallicRoughnessTexture.texture = 0; },
    [](Scene& s) { s.materials[0].normalTexture.texture = 0; },
    [](Scene& s) { s.materials[0].normalScale = 0.5f; },
    [](Scene& s) { s.materials[0].emission.z = 5; },
    [](Scene& s) { s.materials[0].emissionTexture.texture = 0; },
    [](Scene& s) { s.materials[0].alphaMode = AlphaMode::Mask; },
    [](Scene& s) { s.materials[0].alphaMode = AlphaMode::Blend; },
    [](Scene& s) { s.materials[0].alphaCutoff = 0.7f; },
    [](Scene& s) { s.materials[0].doubleSided = true; },
    [](Scene& s) { s.materials[0].transmission = 0.5f; },
    [](Scene& s) { s.materials[0].transmissionTexture.texture = 0; },
    [](Scene& s) { s.materials[0].ior = 1.4f; },
    [](Scene& s) { s.materials[0].specular = 0; },
    [](Scene& s) { s.materials[0].specularColor.x = 0; },
    [](Scene& s) { s.materials[0].attenuationColor.x = 0; },
    [](Scene& s) { s.materials[0].attenuationDistanceM = 1; },
    [](Scene& s) { s.materials[0].thicknessM = 1; },
    [](Scene& s) { s.materials[0].glazing.panes = 2; },
    [](Scene& s) { s.materials[0].glazing.ior = 1.6f; },
    [](Scene& s) { s.materials[0].glazing.internalTransmittance = 0.9f; },
    [](Scene& s) { s.materials[0].glazingReflectance = 0.1f; },
    [](Scene& s) { s.textures[0].name = "x"; },
    [](Scene& s) { s.textures[0].width = 1, s.textures[0].height = 3; },
    [](Scene& s) { s.textures[0].wrapU = Wrap::ClampToEdge; },
    [](Scene& s) { s.textures[0].wrapV = Wrap::ClampToEdge; },
    [](Scene& s) { s.textures[0].rgba[0] = 8; },
    [](Scene& s) { s.textures[0].rgba[11] = 8; },
};
const std::vector<Change> kOfLamps = {
    [](Scene& s) { s.lamps[0].name = "x"; },
    [](Scene& s) { s.lamps[0].kind = LampKind::Spot; },
    [](Scene& s) { s.lamps[0].position.x = 1; },
    [](Scene& s) { s.lamps[0].direction.x = 1; },
    [](Scene& s) { s.lamps[0].up.y = 1; },
    [](Scene& s) { s.lamps[0].intensityCd.z = 1; },
    [](Scene& s) { s.lamps[0].web = nullptr; },
    [](Scene& s) { s.lamps[0].extended = true; },
    [](Scene& s) { s.lamps[0].innerConeRad = 0.1f; },
    [](Scene& s) { s.lamps[0].outerConeRad = 0.1f; },
    [](Scene& s) { s.lamps[0].widthM = 1; },
    [](Scene& s) { s.lamps[0].heightM = 1; },
    [](Scene& s) { s.lamps[0].luminanceCdM2.x = 1; },
    [](Scene& s) { s.lamps[0].wattsW = 1; },
    [](Scene& s) { s.lamps[0].group = "x"; },
};
const std::vector<Change> kOfSkies = {
    [](Scene& s) { s.suns[0].name = "x"; },
    [](Scene& s) { s.suns[0].toLight.x = 1; },
    [](Scene& s) { s.suns[0].illuminanceLux.x = 1; },
    [](Scene& s) { s.suns[0].halfAngleRad = 0.1f; },
    [](Scene& s) { s.sky.luminanceCdM2.x = 1; },
    [](Scene& s) { s.sky.image.pixels[2].z = 1; },
    [](Scene& s) { s.sky.image.width = 1, s.sky.image.height = 3; },
    [](Scene& s) { s.sky.horizonEdge = true; },
    [](Scene& s) { s.sky.rotationRad = 1; },
    [](Scene& s) { s.cameras[0].name = "x"; },
    [](Scene& s) { s.cameras[0].worldFromCamera.w.x = 1; },
    [](Scene& s) { s.cameras[0].yFovRad = 1; },
    [](Scene& s) { s.cameras[0].aspect = 1; },
    [](Scene& s) { s.cameras[0].nearM = 1; },
    [](Scene& s) { s.cameras[0].projection = Projection::Panorama; },
    [](Scene& s) { s.cameras[0].emptyBackdrop = true; },
    [](Scene& s) { s.cameras[0].yMagM = 2; },
    [](Scene& s) { s.cameras[0].cutHeightM = 2; },
};

using WebChange = void (*)(PhotometricWeb&);
const std::vector<WebChange> kOfWebs = {
    [](PhotometricWeb& w) { w.name = "x"; },       [](PhotometricWeb& w) { w.manufacturer = "x"; },
    [](PhotometricWeb& w) { w.format = "x"; },     [](PhotometricWeb& w) { w.cRad[1] = 1; },
    [](PhotometricWeb& w) { w.gammaRad[2] = 3; },  [](PhotometricWeb& w) { w.candela[5] = 7; },
    [](PhotometricWeb& w) { w.peakCd = 7; },       [](PhotometricWeb& w) { w.fluxLm = 1; },
    [](PhotometricWeb& w) { w.statedFluxLm = 1; }, [](PhotometricWeb& w) { w.watts = 1; },
    [](PhotometricWeb& w) { w.sizeC0M = 1; },      [](PhotometricWeb& w) { w.sizeC90M = 1; },
    [](PhotometricWeb& w) { w.heightM = 1; },      [](PhotometricWeb& w) { w.round = true; },
    [](PhotometricWeb& w) { w.tiltRad[0] = 1; },   [](PhotometricWeb& w) { w.tiltFactor[0] = 0.5f; },
};

TEST(SceneHash, NoticesAChangeOfEveryMember) {
  const std::string before = hashOfScene(oneOfEach());
  EXPECT_EQ(hashOfScene(oneOfEach()), before) << "a web is known by what it holds, not by where it lies";
  std::set<std::string> seen = {before};
  for (const std::vector<Change>& changes : {kOfWhole, kOfShapes, kOfMaterials, kOfLamps, kOfSkies}) {
    for (size_t i = 0; i < changes.size(); ++i) {
      Scene scene = oneOfEach();
      changes[i](scene);
      EXPECT_TRUE(seen.insert(hashOfScene(scene)).second) << "change " << i << " of " << changes.size();
    }
  }
  for (size_t i = 0; i < kOfWebs.size(); ++i) {
    Scene scene = oneOfEach();
    PhotometricWeb web = *scene.lamps[0].web;
    kOfWebs[i](web);
    scene.lamps[0].web = std::make_shared<const PhotometricWeb>(web);
    EXPECT_TRUE(seen.insert(hashOfScene(scene)).second) << "web, change " << i;
  }
}

TEST(SceneHash, ListsThatFollowOneAnotherAreToldApart) {
  Scene a, b;
  a.textures.resize(2), b.textures.resize(2);
  a.textures[0].name = "ab", a.textures[0].rgba = {1, 2}, a.textures[1].rgba = {3};
  b.textures[0].name = "ab", b.textures[0].rgba = {1}, b.textures[1].rgba = {2, 3};
  EXPECT_NE(hashOfScene(a), hashOfScene(b));
}

}  // namespace
}  // namespace roomlight
