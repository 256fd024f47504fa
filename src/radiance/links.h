// Links: where light comes to a slot from. Rays traced once, along which bounces are iterated without tracing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "radiance/brick_importance.h"
#include "radiance/radiance_field.h"
#include "radiance/sky_guide.h"
#include "radiance/slot_paths.h"

namespace roomlight {

// Where a ray from a slot arrives: the slot it sees, and in four bits how much of the light the glass on the way
// leaves. Nothing comes along a ray that arrives nowhere.
class Link {
 public:
  static constexpr size_t kMostSlots = size_t{1} << 27;  // that links can tell apart
  static constexpr float kUnit = 1.0f / 15;
  Link() = default;
  Link(uint32_t slot, float left, bool bent)
      : packed_(slot | (bent ? kBent : 0) |
                static_cast<uint32_t>(std::lround(15 * std::clamp(left, 0.0f, 1.0f))) << 28) {}
  uint32_t slot() const { return packed_ & (kBent - 1); }
  float left() const { return static_cast<float>(packed_ >> 28); }  // in kUnit
  bool isDark() const { return packed_ >> 28 == 0; }
  bool isBent() const { return (packed_ & kBent) != 0; }  // reflected on the way
  Link withSlot(uint32_t slot) const {
    Link out;
    out.packed_ = (packed_ & ~(kBent - 1)) | slot;
    return out;
  }

 private:
  static constexpr uint32_t kBent = kMostSlots;
  uint32_t packed_ = 0;
};

// Neighbours that a slot shares a flat sheet of surface with; the slot itself where there is none.
constexpr size_t kKin = 8;
using Kin = std::array<uint32_t, kKin>;

// Where the way of a bent link is known to keep within: world, m.
struct LinkBounds {
  uint32_t slot, i;  // counted from the brick's first; of its links
  Bounds3 within;
};

// A surface on the way of a link that no slot stands for.
struct HiddenPlace {
  uint32_t slot;    // that the link belongs to
  Vec3 p, n, left;  // left: share of what falls on it that goes along the link
};

struct Links {
  std::vector<uint64_t> first;  // per slot, and the end: where its links begin
  std::vector<Link> links;
  std::vector<Kin> kin;         // per slot
  std::vector<std::vector<LinkBounds>> linkBounds;  // per brick, in order of slots and links
  std::vector<std::vector<HiddenPlace>> hidden;  // per brick, where they are kept
  size_t bytes() const;
  size_t count(size_t slot) const { return static_cast<size_t>(first[slot + 1] - first[slot]); }
};

// Kin of all slots, and room for as many links as each gets: `links`, half as many where neighbours on the sheet have
// theirs, and less where light is of little importance. Where bricks and all around them are carried from `before`, so
// are their kin. Throws ResourceError where there are more slots than links can tell apart.
Links planLinks(const Voxels& voxels, const SlotPaths& paths, int links, const BrickImportance& importance,
                const Links* before = nullptr, const SlotRemap* remap = nullptr);

struct LinkOf {
  uint32_t slot, i;
};

// All links of a brick.
std::vector<LinkOf> linksOfBrick(const Voxels& voxels, const Links& links, size_t brick);

// The ray of a link.
Ray linkRay(const SlotSampling& slots, LinkOf link);

// Tells `guide` what all links of a brick see of the sky: of those traced already only the ones that arrive nowhere are
// followed again. Returns how many.
size_t lookAtSky(const SlotSampling& slots, size_t brick, const Links& links, SkyGuideBuilder& guide);

// Of a brick the links that come from the sky, through panes at most, in order of slots and links; of slots on the
// `faces` wanted. Adds the rays followed again to `rayCount`.
struct SkyLink {
  LinkOf link;
  Vec3 direction, left;  // left: share of the sky's light
};
std::vector<SkyLink> linksToSky(const SlotSampling& slots, size_t brick, const Links& links,
                                const std::array<bool, 6>& faces, size_t& rayCount);

// Traces the wanted links of one brick, and tells `guide` (null: no sky) what they saw of the sky.
void traceLinks(const SlotSampling& slots, size_t brick, std::span<const LinkOf> wanted, Links& links,
                SkyGuideBuilder* guide);

}  // namespace roomlight
