// LightCache::update: light after instances have moved.
#include "base/parallel.h"
#include "radiance/light_cache.h"

namespace roomlight {
namespace {

constexpr float kWithin =
    2;  // voxels: so far at most from a slot's place lie points and hits on the surface it stands for

bool touched(const LinkBounds& detour, std::span<const Bounds3> places, float h) {
  return std::any_of(places.begin(), places.end(),
                     [&](const Bounds3& place) { return overlap(detour.within, place, kWithin * h); });
}

// What is left of the old links of a carried brick; returns those to trace again. A straight link is known to end at
// its slot, what is reflected on its way to keep within a box.
std::vector<LinkOf> keepLinks(const SlotSampling& slots, size_t brick, const Links& before, const SlotChange& change,
                              Links& links) {
  const Voxels& voxels = slots.voxels;
  const SlotRemap& remap = change.remap;
  std::vector<LinkOf> wanted;
  std::vector<Bounds3> ahead;
  const auto [first, last] = slotsOfBrick(voxels, brick);
  const float h = voxels.voxelSizeM;
  const Vec3 within(kWithin * h);
  // A voxel's width off a box counts as crossing it: once roughly, by where slots are, and only then with the ray
// itself.
  const auto crossed = [&](uint32_t s, uint32_t i, const Link& link, uint32_t end) {
    const Vec3 from = voxels.slots[s].position, to = voxels.slots[end].position;
    const Vec3 wide = within + Vec3(h);
    if (!link.isDark() && !mayMeetBetween({from - wide, from + wide}, {to - wide, to + wide}, ahead)) return false;
    Ray ray = linkRay(slots, {s, i});
    if (!link.isDark()) ray.tMax = length(to - ray.origin) + kWithin * h;
    return crosses(ray, ahead, h);
  };
  // In the order of the old links, of which a slot may have had more.
  const std::vector<LinkBounds>& linkBounds = before.linkBounds[static_cast<size_t>(remap.oldBrick[brick])];
  size_t next = 0;
  for (auto s = static_cast<uint32_t>(first); s < last; ++s) {
    while (next < linkBounds.size() && linkBounds[next].slot < s - first) ++next;
    inFront(voxels.slots[s], change.places, h, ahead);
    const size_t old = remap.firstOld[brick] + (s - first);
    for (uint32_t i = 0; i < links.count(s); ++i) {
      const bool known = i < before.count(old);
      const Link link = known ? before.links[before.first[old] + i] : Link();
      const uint32_t end = known ? remap.newSlot[link.slot()] : SlotRemap::kGone;
      const bool changed = end == SlotRemap::kGone || (link.isBent() ? touched(linkBounds[next], change.places, h)
                                                                     : !ahead.empty() && crossed(s, i, link, end));
      if (changed) {
        wanted.push_back({s, i});
      } else {
        links.links[links.first[s] + i] = link.withSlot(end);
        if (link.isBent())
          links.linkBounds[brick].push_back({s - static_cast<uint32_t>(first), i, linkBounds[next].within});
      }
      next += known && link.isBent() ? 1 : 0;
    }
  }
  return wanted;
}

}  // namespace

void LightCache::update(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                        std::span<const Bounds3> places, const Progress& progress) {
  const Home home{rays, lights, voxels, progress};
  std::vector<BrickMark> marks = marksOf(voxels);
  const SlotRemap remap = remapSlots(marks_, marks, voxels, places);
  const SlotChange change{remap, places};
  fewParticles_ = settings_.bouncesAtOnce > 0;
  field_.rays = 0;
  const SlotPaths::Before known{paths_, remap};
  const SlotPaths paths(rays, voxels, settings_.seed, progress, settings_.still, &known);
  if (progress.stop()) return;
  updateLinks(home, paths, change);
  paths_ = paths;
  learnLights(home);
  progress.at(0.5f);
  daylight_.update(tracing(home), change);
  emitters_.update(tracing(home), change);
  lamps_.update(tracing(home), change);
  emitters_.match(tracing(home));
  lamps_.match(tracing(home));
  progress.at(0.8f);
  std::vector<Vec3> indirect(voxels.slots.size());
  for (size_t o = 0; o < remap.newSlot.size(); ++o) {
    if (remap.newSlot[o] != SlotRemap::kGone) indirect[remap.newSlot[o]] = indirect_[o];
  }
  indirect_ = std::move(indirect);
  marks_ = std::move(marks);
  solve(home, bouncesOfUpdate());
}

void LightCache::updateLinks(const Home& home, const SlotPaths& paths, const SlotChange& change) {
  const bool hasSky = home.lights.sky().present();
  SkyGuideBuilder guide(home.voxels, home.lights.sky());
  const SlotSampling slots{home.voxels, paths, settings_.seed};
  Links links = planLinks(home.voxels, paths, settings_.links, {}, &links_, &change.remap);
  std::atomic<uint64_t> traced = 0;
  parallelFor(home.voxels.bricks.size(), 4, [&](size_t b) {
    if (home.progress.stop()) return;
    const bool keeps = change.remap.keeps(b);
    std::vector<LinkOf> wanted =
        keeps ? keepLinks(slots, b, links_, change, links) : linksOfBrick(home.voxels, links, b);
    traceLinks(slots, b, wanted, links, hasSky && !keeps ? &guide : nullptr);
    traced += wanted.size();
  });
  links_ = std::move(links);
  field_.rays += traced;
  if (hasSky) field_.guide = keptGuide(field_.guide, guide.finish(home.progress), change.remap);
}

}  // namespace roomlight
