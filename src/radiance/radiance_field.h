// Light in voxels: what every slot receives and sends out, and the directional pyramid that cones read.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "radiance/lamp_glow.h"
#include "radiance/seen_lights.h"
#include "radiance/slot_light.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

// How a lamp's light is attenuated by the orientation of a voxel's surface.
enum class Attenuation : uint8_t {
  NormalWeighted,  // per axis face, weighted with the squared normal (docs/methods/radiance.md)
  Plain            // max(n . l, 0)
};

// How light goes on from slot to slot.
enum class BounceBy : uint8_t {
  Rays,  // along links, traced once
  Cones  // through the directional pyramid, as the published study has it: slow, and less exact
};

struct RadianceSettings {
  Attenuation attenuation = Attenuation::Plain;
  int directSamples = 8;  // per slot among emissive meshes, half as many (4 at most) of each lamp and sun; fewer where
                          // shadows are the same all round
  int links = 8;  // rays per slot that find where its indirect light comes from; half of them on flat sheets, which
                  // share theirs
  BounceBy bounceBy = BounceBy::Rays;
  float residual = 0.002f;  // bounces stop when the light still to come is below this fraction of what is there
  int maxBounces = 100;
  int bouncesAtOnce = 0;  // of an update: what is missing then follows with the next; 0: no limit
  bool emittersApart =
      false;  // emissive meshes one by one (up to 48), so that one can be dimmed or moved alone; more rays at first
  bool still = false;  // for pictures of a scene that stays as it is: what the sun lights is kept as points, from which
                       // slots and pictures sample it, and places that no slot stands for are lit as well; an update
                       // would do both anew
  bool pyramid = true;  // directional levels for cones; without them only what slots receive is known
  std::vector<Camera> views;  // with `still`: what pictures will be taken of; light that they hardly show gets fewer
                              // rays (brick_importance.h); none: of everything
  uint64_t seed = 0;
  std::shared_ptr<const LightLayers> layers;  // lights that are told apart; none: they are not
};

// In voxel edges: no plane further from the middle than half a diagonal cuts the voxel.
constexpr float kFarthestPlane = 0.8660255f;

// What a voxel shows to the six directions, in the order of Voxels' faces: to each the surfaces whose normal is nearest
// to it, as one plane with a normal, a place and a coverage of its own. A ray meets it where it crosses the plane
// inside the voxel; so a wall stays where it is and as thin as it is on every level, and its two sides stay apart. One
// level of the pyramid has the same sparse bricks as Voxels, with these records.
template <class T>
using PerFace = std::array<T, 6>;

// What every ray through the voxel reads: half a cache line, field by field, so that all faces are tested at once.
// Eight bytes may be read from the start of each field.
struct alignas(32) DirectionalPlanes {
  PerFace<int8_t> normalX{}, normalY{}, normalZ{};  // in 1/127, unit; 0: no surface faces this way
  PerFace<uint8_t> plane{};  // distance from the voxel's middle along the normal; see distance()
  uint64_t mask = 0;  // 4x4x4 sub-cells that hold surfaces; bit x + 4 y + 16 z

  Vec3 normal(size_t face) const {
    return Vec3{static_cast<float>(normalX[face]), static_cast<float>(normalY[face]),
                static_cast<float>(normalZ[face])} *
           (1.0f / 127);
  }
  float distance(size_t face) const { return (static_cast<float>(plane[face]) * (2.0f / 255) - 1) * kFarthestPlane; }
};

// What a ray reads that meets a plane.
struct alignas(64) DirectionalLight {
  PerFace<std::array<uint16_t, 3>> radiance{};  // half floats, in units of RadianceField::unitCdM2
  PerFace<uint8_t> coverage{};  // surface on the plane where the mask is set, in 1/255
  PerFace<uint8_t> opacity{};  // of that surface, in 1/255
  PerFace<uint8_t> behind{};  // bit f: this face's surfaces lie behind the plane of face f, as at the edge of a box
  PerFace<uint8_t> glow{};  // part of the radiance that is kept as LampGlow too, in 1/255; on the base level, where
                            // alone there is any
};

struct RadianceLevel {
  float voxelSizeM = 0;
  Int3 brickDims;
  std::vector<int32_t> brickIndex;
  std::vector<Brick> bricks;
  std::vector<DirectionalPlanes> planes;  // one record a voxel
  std::vector<DirectionalLight> light;

  // Null where there is none.
  const Brick* brickAt(Int3 b) const {
    if (static_cast<unsigned>(b.x) >= static_cast<unsigned>(brickDims.x) ||
        static_cast<unsigned>(b.y) >= static_cast<unsigned>(brickDims.y) ||
        static_cast<unsigned>(b.z) >= static_cast<unsigned>(brickDims.z)) {
      return nullptr;
    }
    const int32_t i =
        brickIndex[(static_cast<size_t>(b.z) * static_cast<size_t>(brickDims.y) + static_cast<size_t>(b.y)) *
                       static_cast<size_t>(brickDims.x) +
                   static_cast<size_t>(b.x)];
    return i < 0 ? nullptr : &bricks[static_cast<size_t>(i)];
  }
  // Record of voxel v, which lies in `brick`, or -1 where it is empty.
  int64_t find(const Brick& brick, Int3 v) const {
    const auto word = static_cast<size_t>(v.z & 7);
    const int bit = (v.x & 7) + 8 * (v.y & 7);
    if (!((brick.occupied[word] >> bit) & 1)) return -1;
    return brick.firstVoxel + brick.before[word] + std::popcount(brick.occupied[word] & ((uint64_t{1} << bit) - 1));
  }
  int64_t find(Int3 v) const {
    const Brick* brick = brickAt({v.x >> 3, v.y >> 3, v.z >> 3});
    return brick ? find(*brick, v) : -1;
  }
};

// Which parts of the sky the slots of one brick that face one way see: densities over the sky's blocks for sampling it
// through windows. Learned from the links, used only to choose directions, so it never biases.
struct SkyGuide {
  // Sums of chances up to each block, and up to the end of each row of blocks, which are looked at first: one row's
  // cache lines instead of a search through all.
  struct Cdf {
    std::array<float, SkyDistribution::kBlocksY> rows;
    std::array<float, SkyDistribution::kBlocks> blocks;  // ends at 1
    bool operator==(const Cdf&) const = default;
  };
  std::vector<std::array<int32_t, 6>> guideOfBrick;  // per base brick and face, -1: no sky seen
  std::vector<Cdf> cdf;
};

struct RadianceField {
  Vec3 origin;  // of all levels
  std::vector<RadianceLevel> levels;  // 0: base voxels; each next one twice as large
  float unitCdM2 = 1;
  std::vector<Vec3> irradianceLux;  // per slot of Voxels: direct and indirect, per channel
  std::vector<float>
      sunLux;  // per slot: luminous irradiance straight from the sun, where there is one alone; else empty
  SkyGuide guide;
  SeenLights seen;  // of pictures of a scene that stays as it is
  LampGlow glow;
  std::vector<GlowPoint> sunPoints;  // where the sun lights surfaces; empty unless asked for
  std::vector<float> glowShare;  // per slot: of the luminous irradiance whose reflection is glow; empty: none
  SlotLayers layers;
  int bounces = 0;  // done
  double residual = 0;  // estimate of light still missing where it is missing, fraction of what is there
  uint64_t rays = 0;
  size_t bytes() const;
};

// All light anew; LightCache (light_cache.h) keeps what a change leaves as it is. Once `progress` says stop it ends
// within about a second, then without levels and irradiance: there is nothing to gather.
RadianceField illuminate(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                         const RadianceSettings& settings, const Progress& progress = {});

// How much of a lamp's light a voxel's surface of mean normal n takes up from unit direction l towards the lamp.
// Normal-weighted: per axis the face that the normal picks, weighted with the squared normal; section 1 of the
// published study. Plain: Lambert's cosine.
inline float attenuation(Attenuation kind, Vec3 n, Vec3 l) {
  if (kind == Attenuation::Plain) return std::max(0.0f, dot(n, l));
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) sum += n[axis] * n[axis] * std::max(0.0f, n[axis] > 0 ? l[axis] : -l[axis]);
  return sum;
}

}  // namespace roomlight
