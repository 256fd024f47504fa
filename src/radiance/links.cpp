#include "radiance/links.h"

#include <numeric>
#include <tuple>

#include "base/parallel.h"
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
bool carriesKin(const Voxels& voxels, const Links& before, const Carried& carried, size_t b, Links& out) {
  const Int3 c = voxels.bricks[b].coord;
  for (int k = 0; k < 27; ++k) {
    const int32_t n = voxels.brickAt({c.x + k % 3 - 1, c.y + k / 3 % 3 - 1, c.z + k / 9 - 1});
    if (n >= 0 && !carried.keeps(static_cast<size_t>(n))) return false;
  }
  const auto [first, last] = slotsOfBrick(voxels, b);
  for (size_t s = first; s < last; ++s) {
    const Kin& old = before.kin[carried.firstOld[b] + (s - first)];
    for (size_t i = 0; i < kKin; ++i) {
      out.kin[s][i] = carried.newSlot[old[i]];
      if (out.kin[s][i] == Carried::kGone) return false;
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

// Of what arrived or escaped in the end: rays[k] is that of wanted[order[k]].
void noteDetours(const Voxels& voxels, size_t brick, std::span<const LinkOf> wanted, std::span<const uint32_t> order,
                 std::span<const Ray> rays, std::span<const Arrival> ends, std::span<const HiddenReflection> hidden,
                 std::vector<Detour>& out) {
  if (hidden.empty()) return;
  const auto firstSlot = static_cast<uint32_t>(slotsOfBrick(voxels, brick).first);
  constexpr float kAway = 1e6f;  // m: out of any scene
  std::vector<Bounds3> within(rays.size());
  for (const HiddenReflection& h : hidden) within[h.ray].add(h.p);
  for (size_t k = 0; k < rays.size(); ++k) {
    if (!ends[k].reflected) continue;
    const Ray& last = ends[k].ray;
    within[k].add(rays[k].origin), within[k].add(last.origin);
    if (ends[k].slot >= 0) {
      within[k].add(last.origin + last.direction * ends[k].hit.t);
    } else if (ends[k].escaped) {
      within[k].add(last.origin + last.direction * kAway);
    }
    out.push_back({wanted[order[k]].slot - firstSlot, wanted[order[k]].i, within[k]});
  }
  std::sort(out.begin(), out.end(),
            [](const Detour& a, const Detour& b) { return std::tie(a.slot, a.i) < std::tie(b.slot, b.i); });
}

Sampler wayOf(const SlotPaths& paths, LinkOf link, uint64_t seed) { return {paths.key(link.slot), link.i, seed + 5}; }

}  // namespace

size_t Links::bytes() const {
  size_t sum =
      (first.size() + links.size()) * sizeof(uint32_t) + kin.size() * sizeof(Kin) + detours.size() * sizeof(detours[0]);
  for (const auto& d : detours) sum += d.capacity() * sizeof(Detour);
  for (const auto& h : hidden) sum += h.capacity() * sizeof(HiddenPlace);
  return sum;
}

Links planLinks(const Voxels& voxels, const SlotPaths& paths, int most, const Links* before, const Carried* carried) {
  Links out;
  out.kin.resize(voxels.slots.size());
  parallelFor(voxels.bricks.size(), 16, [&](size_t b) {
    if (before && carriesKin(voxels, *before, *carried, b, out)) return;
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
  uint32_t next = 0;
  for (size_t s = 0; s < voxels.slots.size(); ++s) {
    out.first[s] = next;
    const auto kin = std::count_if(out.kin[s].begin(), out.kin[s].end(), [&](uint32_t o) { return o != s; });
    next += static_cast<uint32_t>(kin >= kEnoughKin ? (most + 1) / 2 : most);
  }
  out.first.back() = next;
  out.links.resize(next);
  out.detours.resize(voxels.bricks.size());
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

Ray linkRay(const Voxels& voxels, const SlotPaths& paths, LinkOf link, uint64_t seed) {
  Sampler sampler(paths.key(link.slot), link.i, seed);
  return {paths.point(link.slot, link.i),
          Frame(voxels.slots[link.slot].normal).toWorld(sampleCosineHemisphere(sampler.next2())), 0, kInfinity};
}

size_t lookAtSky(const Voxels& voxels, const SlotPaths& paths, size_t brick, uint64_t seed, const Links& links,
                 SkyGuideBuilder& guide) {
  const std::vector<LinkOf> all = linksOfBrick(voxels, links, brick);
  std::vector<Ray> rays;
  std::vector<Sampler> samplers;
  for (const LinkOf& l : all) {
    if (!links.links[links.first[l.slot] + l.i].isDark()) continue;
    rays.push_back(linkRay(voxels, paths, l, seed));
    samplers.push_back(wayOf(paths, l, seed));
  }
  std::vector<Arrival> ends;
  paths.follow(rays, samplers, ends);
  size_t next = 0;
  for (const LinkOf& l : all) {
    const bool followed = links.links[links.first[l.slot] + l.i].isDark();
    const float open = followed && ends[next].escaped ? luminance(ends[next].left) : 0.0f;
    guide.add(brick, voxels.slots[l.slot].face,
              followed ? rays[next].direction : linkRay(voxels, paths, l, seed).direction, open);
    next += followed;
  }
  return rays.size();
}

void traceLinks(const Voxels& voxels, const SlotPaths& paths, size_t brick, std::span<const LinkOf> wanted,
                uint64_t seed, Links& links, SkyGuideBuilder* guide) {
  // In order of direction: rays traced together then meet the same things.
  std::vector<Ray> unsorted, rays;
  std::vector<uint32_t> bins, order(wanted.size());
  std::array<uint32_t, 2 * kBins * kBins + 1> next{};
  for (const LinkOf& w : wanted) {
    bins.push_back(binOf(unsorted.emplace_back(linkRay(voxels, paths, w, seed)).direction));
    ++next[bins.back() + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (uint32_t j = 0; j < bins.size(); ++j) order[next[bins[j]]++] = j;
  std::vector<Sampler> samplers;
  for (const uint32_t j : order) {
    rays.push_back(unsorted[j]);
    samplers.push_back(wayOf(paths, wanted[j], seed));
  }
  std::vector<Arrival> ends;
  std::vector<HiddenReflection> hidden;
  paths.follow(rays, samplers, ends, &hidden);
  if (!links.hidden.empty()) {
    for (const HiddenReflection& h : hidden)
      links.hidden[brick].push_back({wanted[order[h.ray]].slot, h.p, h.n, h.left});
  }
  noteDetours(voxels, brick, wanted, order, rays, ends, hidden, links.detours[brick]);
  for (size_t k = 0; k < ends.size(); ++k) {
    const Arrival& end = ends[k];
    const LinkOf& of = wanted[order[k]];
    const bool arrives = end.slot >= 0;
    links.links[links.first[of.slot] + of.i] =
        Link(arrives ? static_cast<uint32_t>(end.slot) : of.slot, arrives ? luminance(end.left) : 0, end.reflected);
  }
  if (!guide) return;
  // In the order asked for, so that sums are the same.
  std::vector<float> open(ends.size());
  for (size_t k = 0; k < ends.size(); ++k) open[order[k]] = ends[k].escaped ? luminance(ends[k].left) : 0.0f;
  for (size_t j = 0; j < open.size(); ++j)
    guide->add(brick, voxels.slots[wanted[j].slot].face, unsorted[j].direction, open[j]);
}

}  // namespace roomlight
