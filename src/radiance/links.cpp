#include "radiance/links.h"

#include <numeric>
#include <tuple>

#include "base/parallel.h"
#include "base/result.h"
#include "base/sampling.h"

namespace roomlight {
namespace {

constexpr float kLevel = 0.5f;    // voxels; steps between neighbours of one sheet are smaller
constexpr float kAlike = 0.9f;    // cosine between their normals
constexpr int kEnoughKin = 5;     // to get along with half of the links
constexpr int kBins = 16;         // of directions, along an edge of each half of an octahedron

bool areKin(const FaceSlot& a, const FaceSlot& b, float h) {
  return dot(a.normal, b.normal) > kAlike && std::abs(dot(a.position - b.position, a.normal)) < kLevel * h;
}

// Neighbouring voxels across the slot's face, where both hold one sheet and nothing else: no wall stands between them.
Kin kinOf(const Voxels& voxels, const SlotPaths& paths, size_t s, Int3 v) {
  Kin kin;
  kin.fill(static_cast<uint32_t>(s));
  if (!paths.isSheet(s)) return kin;
  const FaceSlot& slot = voxels.slots[s];
  const int axis = slot.face / 2;
  for (size_t k = 0, place = 0; k < 9; ++k) {
    if (k == 4) continue;
    int step[3] = {};
    step[(axis + 1) % 3] = static_cast<int>(k % 3) - 1, step[(axis + 2) % 3] = static_cast<int>(k / 3) - 1;
    const int64_t record = voxels.voxelAt({v.x + step[0], v.y + step[1], v.z + step[2]});
    const int64_t other = record < 0 ? -1 : voxels.slotAt(voxels.voxels[static_cast<size_t>(record)], slot.face);
    const auto o = static_cast<size_t>(other);
    if (other >= 0 && paths.isSheet(o) && areKin(slot, voxels.slots[o], voxels.voxelSizeM))
      kin[place] = static_cast<uint32_t>(o);
    ++place;
  }
  return kin;
}

// What a brick's slots had for kin, where nothing around it is other than before; false where something is.
bool keepsKin(const Voxels& voxels, const Links& before, const SlotRemap& remap, size_t b, Links& out) {
  const Int3 c = voxels.bricks[b].coord;
  for (int k = 0; k < 27; ++k) {
    const int32_t n = voxels.brickAt({c.x + k % 3 - 1, c.y + k / 3 % 3 - 1, c.z + k / 9 - 1});
    if (n >= 0 && !remap.keeps(static_cast<size_t>(n))) return false;
  }
  const auto [first, last] = slotsOfBrick(voxels, b);
  for (size_t s = first; s < last; ++s) {
    const Kin& old = before.kin[remap.firstOld[b] + (s - first)];
    for (size_t i = 0; i < kKin; ++i) {
      out.kin[s][i] = remap.newSlot[old[i]];
      if (out.kin[s][i] == SlotRemap::kGone) return false;
    }
  }
  return true;
}

// Like directions have near numbers: cells of an octahedron unfolded.
uint32_t binOf(Vec3 d) {
  const float scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  const auto cell = [&](float v) {
    return static_cast<uint32_t>(std::clamp((0.5f * v * scale + 0.5f) * kBins, 0.0f, kBins - 1.0f));
  };
  const uint32_t x = cell(d.x), y = cell(d.y);
  return (d.z < 0 ? kBins * kBins : 0) + y * kBins + (y & 1 ? kBins - 1 - x : x);
}

// Links of one brick as they were followed.
struct FollowedLinks {
  std::span<const LinkOf> wanted;
  std::vector<uint32_t> order;  // of their rays among those wanted
  std::vector<Ray> rays;
  std::vector<Arrival> ends;  // of each ray
  std::vector<HiddenReflection> hidden;
  const LinkOf& link(size_t ray) const { return wanted[order[ray]]; }
};

// Of what arrived or escaped in the end.
void noteLinkBounds(const FollowedLinks& followed, uint32_t firstSlot, std::vector<LinkBounds>& out) {
  if (followed.hidden.empty()) return;
  constexpr float kAway = 1e6f;  // m: out of any scene
  std::vector<Bounds3> within(followed.rays.size());
  for (const HiddenReflection& h : followed.hidden) within[h.ray].add(h.p);
  for (size_t k = 0; k < followed.rays.size(); ++k) {
    const Arrival& end = followed.ends[k];
    if (!end.reflected) continue;
    const Ray& last = end.ray;
    within[k].add(followed.rays[k].origin), within[k].add(last.origin);
    if (end.slot >= 0) {
      within[k].add(last.origin + last.direction * end.hit.t);
    } else if (end.escaped) {
      within[k].add(last.origin + last.direction * kAway);
    }
    out.push_back({followed.link(k).slot - firstSlot, followed.link(k).i, within[k]});
  }
  std::sort(out.begin(), out.end(),
            [](const LinkBounds& a, const LinkBounds& b) { return std::tie(a.slot, a.i) < std::tie(b.slot, b.i); });
}

Sampler samplerOf(const SlotSampling& slots, LinkOf link) {
  return {slots.paths.key(link.slot), link.i, slots.seed + 5};
}

// In order of direction: rays traced together then meet the same things. `unsorted`: rays as wanted.
FollowedLinks followLinks(const SlotSampling& slots, std::span<const LinkOf> wanted, std::vector<Ray>& unsorted) {
  FollowedLinks out;
  out.wanted = wanted, out.order.resize(wanted.size());
  std::vector<uint32_t> bins;
  std::array<uint32_t, 2 * kBins * kBins + 1> next{};
  for (const LinkOf& w : wanted) {
    bins.push_back(binOf(unsorted.emplace_back(linkRay(slots, w)).direction));
    ++next[bins.back() + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (uint32_t j = 0; j < bins.size(); ++j) out.order[next[bins[j]]++] = j;
  std::vector<Sampler> samplers;
  for (const uint32_t j : out.order) {
    out.rays.push_back(unsorted[j]);
    samplers.push_back(samplerOf(slots, wanted[j]));
  }
  slots.paths.follow(out.rays, samplers, out.ends, &out.hidden);
  return out;
}

// Of those that arrive nowhere, in their order.
std::vector<Arrival> followDark(const SlotSampling& slots, const Links& links, std::span<const LinkOf> all,
                                std::vector<Ray>& rays) {
  std::vector<Sampler> samplers;
  for (const LinkOf& l : all) {
    if (!links.links[links.first[l.slot] + l.i].isDark()) continue;
    rays.push_back(linkRay(slots, l));
    samplers.push_back(samplerOf(slots, l));
  }
  std::vector<Arrival> ends;
  slots.paths.follow(rays, samplers, ends);
  return ends;
}

}  // namespace

size_t Links::bytes() const {
  size_t sum = first.size() * sizeof(first[0]) + links.size() * sizeof(Link) + kin.size() * sizeof(Kin) +
               linkBounds.size() * sizeof(linkBounds[0]);
  for (const auto& d : linkBounds) sum += d.capacity() * sizeof(LinkBounds);
  for (const auto& h : hidden) sum += h.capacity() * sizeof(HiddenPlace);
  return sum;
}

Links planLinks(const Voxels& voxels, const SlotPaths& paths, int most, const BrickImportance& importance,
                const Links* before, const SlotRemap* remap) {
  if (voxels.slots.size() >= Link::kMostSlots)
    throw ResourceError("light is wanted at more places than can be told apart; give larger voxels (voxelSizeM)");
  Links out;
  out.kin.resize(voxels.slots.size());
  parallelFor(voxels.bricks.size(), 16, [&](size_t b) {
    if (before && keepsKin(voxels, *before, *remap, b, out)) return;
    const Brick& brick = voxels.bricks[b];
    size_t record = brick.firstVoxel;
    for (int z = 0; z < kBrickSize; ++z) {
      for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1, ++record) {
        const int bit = std::countr_zero(bits);
        const Int3 v{brick.coord.x * kBrickSize + (bit & 7), brick.coord.y * kBrickSize + (bit >> 3),
                     brick.coord.z * kBrickSize + z};
        const SurfaceVoxel& voxel = voxels.voxels[record];
        const size_t end = voxel.firstSlot + static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
        for (size_t s = voxel.firstSlot; s < end; ++s) out.kin[s] = kinOf(voxels, paths, s, v);
      }
    }
  });
  out.first.resize(voxels.slots.size() + 1);
  uint64_t next = 0;
  for (size_t b = 0; b < voxels.bricks.size(); ++b) {
    const uint32_t all = importance.raysOf(b, static_cast<uint32_t>(most));
    const auto [first, last] = slotsOfBrick(voxels, b);
    for (size_t s = first; s < last; ++s) {
      out.first[s] = next;
      const auto kin = std::count_if(out.kin[s].begin(), out.kin[s].end(), [&](uint32_t o) { return o != s; });
      next += kin >= kEnoughKin ? (all + 1) / 2 : all;
    }
  }
  out.first.back() = next;
  out.links.resize(next);
  out.linkBounds.resize(voxels.bricks.size());
  return out;
}

std::vector<LinkOf> linksOfBrick(const Voxels& voxels, const Links& links, size_t brick) {
  std::vector<LinkOf> all;
  const auto [first, last] = slotsOfBrick(voxels, brick);
  for (auto s = static_cast<uint32_t>(first); s < last; ++s) {
    for (uint32_t i = 0; i < links.count(s); ++i) all.push_back({s, i});
  }
  return all;
}

Ray linkRay(const SlotSampling& slots, LinkOf link) {
  Sampler sampler(slots.paths.key(link.slot), link.i, slots.seed);
  return {slots.paths.point(link.slot, link.i),
          Frame(slots.voxels.slots[link.slot].normal).toWorld(sampleCosineHemisphere(sampler.next2())), 0, kInfinity};
}

size_t lookAtSky(const SlotSampling& slots, size_t brick, const Links& links, SkyGuideBuilder& guide) {
  const std::vector<LinkOf> all = linksOfBrick(slots.voxels, links, brick);
  std::vector<Ray> rays;
  const std::vector<Arrival> ends = followDark(slots, links, all, rays);
  size_t next = 0;
  for (const LinkOf& l : all) {
    const bool followed = links.links[links.first[l.slot] + l.i].isDark();
    const float open = followed && ends[next].escaped ? luminance(ends[next].left) : 0.0f;
    guide.add(brick, slots.voxels.slots[l.slot].face, followed ? rays[next].direction : linkRay(slots, l).direction,
              open);
    next += followed;
  }
  return rays.size();
}

std::vector<SkyLink> linksToSky(const SlotSampling& slots, size_t brick, const Links& links,
                                const std::array<bool, 6>& faces, size_t& rayCount) {
  std::vector<LinkOf> straight = linksOfBrick(slots.voxels, links, brick);
  std::erase_if(straight, [&](const LinkOf& l) {
    return !faces[slots.voxels.slots[l.slot].face] || links.links[links.first[l.slot] + l.i].isBent();
  });
  std::vector<Ray> rays;
  const std::vector<Arrival> ends = followDark(slots, links, straight, rays);
  std::vector<SkyLink> out;
  size_t next = 0;
  for (const LinkOf& l : straight) {
    if (!links.links[links.first[l.slot] + l.i].isDark()) continue;
    if (const Arrival& end = ends[next]; end.escaped && !end.reflected)
      out.push_back({l, rays[next].direction, end.left});
    ++next;
  }
  rayCount += rays.size();
  return out;
}

void traceLinks(const SlotSampling& slots, size_t brick, std::span<const LinkOf> wanted, Links& links,
                SkyGuideBuilder* guide) {
  std::vector<Ray> unsorted;
  const FollowedLinks followed = followLinks(slots, wanted, unsorted);
  if (!links.hidden.empty()) {
    for (const HiddenReflection& h : followed.hidden)
      links.hidden[brick].push_back({followed.link(h.ray).slot, h.p, h.n, h.left});
  }
  noteLinkBounds(followed, static_cast<uint32_t>(slotsOfBrick(slots.voxels, brick).first), links.linkBounds[brick]);
  const std::vector<Arrival>& ends = followed.ends;
  for (size_t k = 0; k < ends.size(); ++k) {
    const Arrival& end = ends[k];
    const LinkOf& of = followed.link(k);
    const bool arrives = end.slot >= 0;
    links.links[links.first[of.slot] + of.i] =
        Link(arrives ? static_cast<uint32_t>(end.slot) : of.slot, arrives ? luminance(end.left) : 0, end.reflected);
  }
  if (!guide) return;
  // In the order asked for, so that sums are the same.
  std::vector<float> open(ends.size());
  for (size_t k = 0; k < ends.size(); ++k) open[followed.order[k]] = ends[k].escaped ? luminance(ends[k].left) : 0.0f;
  for (size_t j = 0; j < open.size(); ++j)
    guide->add(brick, slots.voxels.slots[wanted[j].slot].face, unsorted[j].direction, open[j]);
}

}  // namespace roomlight
