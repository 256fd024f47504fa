#include "radiance/near_lights.h"

namespace roomlight {
namespace {

constexpr float kNearVoxels = 4;  // further off a voxel sees the light under nearly the same distance everywhere
constexpr float kNearM = 0.5f;    // further off surfaces are no brighter than cones can deal with
constexpr float kNarrow = 0.5f;      // rad
constexpr float kNarrowVoxels = 8;  // radius of a disc of light
constexpr float kSmallM2 = kPi * kNearM * kNearM;  // area of an emissive mesh: a sphere of half the reach in radius
constexpr float kMostPoints = 8;  // size of its surroundings: bulbs all over a home that are one mesh are not small

float nearM(float voxelSizeM) { return std::max(kNearM, kNearVoxels * voxelSizeM); }

// Half-angle that holds most light of a lamp that has a beam.
float beamRad(const Lamp& lamp) {
  return lamp.web ? beamHalfAngleRad(*lamp.web) : lamp.kind == LampKind::Spot ? lamp.outerConeRad : kPi;
}

}  // namespace

LightSurroundings::LightSurroundings(const Lamp& lamp, float voxelSizeM)
    : position_(lamp.position),
      direction_(lamp.direction),
      acrossC0_(lamp.up),
      acrossC90_(cross(lamp.up, lamp.direction)),
      near_(nearM(voxelSizeM)),
      tanOuter_(std::tan(beamRad(lamp))),
      voxelSizeM_(voxelSizeM) {
  // How far a spot's disc of light is smaller than a few voxels, so that shadow rays from slots miss it. Not for wide
  // ones.
  const float outerRad = beamRad(lamp);
  if (outerRad < kNarrow) far_ = kNarrowVoxels * voxelSizeM / std::tan(std::max(outerRad, 1e-3f));
  if (lamp.extended) half_ = {0.5f * lamp.web->sizeC0M, 0.5f * lamp.web->sizeC90M, 0};
}

LightSurroundings::LightSurroundings(const Bounds3& box, float voxelSizeM)
    : position_(box.centre()), half_(box.size() * 0.5f), near_(nearM(voxelSizeM)), voxelSizeM_(voxelSizeM) {}

// From the nearest place of the opening or the box.
Vec3 LightSurroundings::toSource(Vec3 p) const {
  const Vec3 d = p - position_;
  if (isBlack(half_)) return d;
  const auto part = [&](Vec3 axis, float half) { return axis * std::clamp(dot(d, axis), -half, half); };
  return d - part(acrossC0_, half_.x) - part(acrossC90_, half_.y) - part(direction_, half_.z);
}

bool LightSurroundings::contains(Vec3 p) const {
  const Vec3 d = toSource(p);
  const float d2 = lengthSquared(d);
  if (d2 < near_ * near_) return true;
  if (d2 >= far_ * far_) return false;
  const float along = dot(d, direction_), lit = along * tanOuter_ + voxelSizeM_;
  return along > 0 && d2 - along * along < lit * lit;
}

bool LightSurroundings::touches(const Bounds3& box) const {
  const float reach = reachM();
  return lengthSquared(position_ - max(box.lo, min(box.hi, position_))) < reach * reach;
}

Bounds3 LightSurroundings::bounds() const {
  const Vec3 reach(reachM());
  return {position_ - reach, position_ + reach};
}

// Surface of all that lies within reach of a box (Steiner's formula), over that of a sphere.
float LightSurroundings::sizeOfPoints() const {
  const Vec3 s = half_ * 2;
  const float box = 2 * (s.x * s.y + s.y * s.z + s.z * s.x), edges = kPi * (s.x + s.y + s.z);
  return 1 + (box + 2 * edges * near_) / (4 * kPi * near_ * near_);
}

bool isSmall(const Lights& lights, size_t emitter, float voxelSizeM) {
  return lights.emitterAreaM2(emitter) <= kSmallM2 &&
         LightSurroundings(lights.emitterBounds(emitter), voxelSizeM).sizeOfPoints() <= kMostPoints;
}

std::vector<LightSurroundings> emitterSurroundings(const Lights& lights, float voxelSizeM) {
  std::vector<LightSurroundings> out(lights.emitterCount());
  for (size_t i = 0; i < out.size(); ++i) {
    if (isSmall(lights, i, voxelSizeM)) out[i] = LightSurroundings(lights.emitterBounds(i), voxelSizeM);
  }
  return out;
}

}  // namespace roomlight
